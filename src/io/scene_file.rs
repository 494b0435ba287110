//! Scenes by name or from a file, changed by what the command line says.

use std::fs;
use std::path::{Path, PathBuf};

use glam::DVec3;

use super::colour_image;
use super::font::{self, FontError};
use super::height_image::{self, HeightImage, ImageError};
use super::image_sequence::{Player, SequenceError, SequenceFiles};
use super::imprint_image;
use super::mesh_file::{self, MeshError};
use crate::field::base::{self, Lettering};
use crate::field::stamp::StampImage;
use crate::mesh::{Mesh, MeshSource};
use crate::scene::{self, Base, Camera, Material, Playback, PomCounts, PyramidLeaf, Scene, SceneError, Sequence, Text, VERSION};
use crate::suggest;
use crate::surface::albedo_image::ColourImage;
use crate::surface::{Albedo, Shading, Shadow, Technique};

/// The scenes that come with the program: name and text. The first is the default.
pub const EMBEDDED: [(&str, &str); 20] = [
    ("ripples", include_str!("../../scenes/ripples.toml")),
    ("bullet-wall", include_str!("../../scenes/bullet-wall.toml")),
    ("relief", include_str!("../../scenes/relief.toml")),
    ("sidewalk", include_str!("../../scenes/sidewalk.toml")),
    ("fur", include_str!("../../scenes/fur.toml")),
    ("grass", include_str!("../../scenes/grass.toml")),
    ("text", include_str!("../../scenes/text.toml")),
    ("terrain", include_str!("../../scenes/terrain.toml")),
    ("depth-image", include_str!("../../scenes/depth-image.toml")),
    ("cube", include_str!("../../scenes/cube.toml")),
    ("gas-planet", include_str!("../../scenes/gas-planet.toml")),
    ("planet", include_str!("../../scenes/planet.toml")),
    ("dam-break", include_str!("../../scenes/dam-break.toml")),
    ("harbour", include_str!("../../scenes/harbour.toml")),
    ("rain-on-cobbles", include_str!("../../scenes/rain-on-cobbles.toml")),
    ("columns", include_str!("../../scenes/columns.toml")),
    ("dunes", include_str!("../../scenes/dunes.toml")),
    ("clockwork", include_str!("../../scenes/clockwork.toml")),
    ("explosions", include_str!("../../scenes/explosions.toml")),
    ("snow", include_str!("../../scenes/snow.toml")),
];

/// No scene is longer: what is must be another kind of file.
const BYTES_MAX: u64 = 1 << 20;

/// The size of the field, as the command line has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldSize {
    /// This width; the height follows the image's aspect, or is the same.
    Width(u32),
    /// This width and height.
    Exactly([u32; 2]),
}

/// A camera that stands still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraPlacement {
    /// The eye, metres.
    pub eye: [f64; 3],
    /// The point in the middle of the picture, metres.
    pub target: [f64; 3],
}

/// What the command line changes in a scene. `None` leaves the scene's own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneOverrides {
    /// An image whose heights replace the starting height.
    pub height: Option<PathBuf>,
    /// The values in the image that become 0 and 1.
    pub height_range: Option<[f32; 2]>,
    /// A series of images that is played as heights.
    pub sequence: Option<PathBuf>,
    /// A series of images whose colours lie over those.
    pub sequence_colours: Option<PathBuf>,
    /// Images of a series a second.
    pub images_per_second: Option<f32>,
    /// What comes after the last image of a series.
    pub playback: Option<Playback>,
    /// Whether images of a series fade into one another.
    pub interpolate: Option<bool>,
    /// A text that replaces the starting height, or that of a sign.
    pub text: Option<String>,
    /// The font of a text.
    pub font: Option<PathBuf>,
    /// An image whose colours lie over the field.
    pub albedo: Option<PathBuf>,
    /// The field's size.
    pub field: Option<FieldSize>,
    /// Depth of h = 0, metres.
    pub depth_metres: Option<f32>,
    /// The mesh that carries the relief.
    pub mesh: Option<MeshSource>,
    /// About how many triangles the technique `mesh` draws.
    pub mesh_triangles: Option<u32>,
    /// Draw its shell.
    pub shell: bool,
    /// Write the relief's depth.
    pub displaced_depth: bool,
    /// How the surface is traced.
    pub technique: Option<Technique>,
    /// The shadow upon it.
    pub shadow: Option<Shadow>,
    /// Level of detail from this mip level on; `Some(None)` is off.
    pub lod: Option<Option<f32>>,
    /// Whether `exact` stays exact under level of detail.
    pub lod_keep_exact: Option<bool>,
    /// What light does to it.
    pub shading: Option<Shading>,
    /// Fewest and most samples of a ray, of every technique that takes samples.
    pub samples: Option<[u32; 2]>,
    /// How `pom` and `pom-linear` choose their counts.
    pub pom_counts: Option<PomCounts>,
    /// Whether `relief` shortens the offset of rays that graze.
    pub relief_depth_bias: Option<bool>,
    /// What `pyramid` makes of a leaf.
    pub pyramid_leaf: Option<PyramidLeaf>,
    /// Seed of everything random.
    pub seed: Option<u64>,
    /// A camera in place of the scene's and all its motion.
    pub camera: Option<CameraPlacement>,
    /// Vertical field of view, degrees.
    pub vertical_fov_degrees: Option<f64>,
    /// Half the angle that the light's disc spans, degrees.
    pub light_half_angle_degrees: Option<f32>,
}

/// A scene that is ready to run: checked, its images and its font read.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadedScene {
    /// The scene, with the field's size as it will be.
    pub scene: Scene,
    /// The mesh that carries the relief; none: the plane.
    pub mesh: Option<Mesh>,
    /// The reliefs beside it, each as the scene that it is alone.
    pub reliefs: Vec<LoadedScene>,
    /// The files of its sequence, if it has one.
    pub sequence: Option<SequenceFiles>,
    image: Option<HeightImage>,
    lettering: Option<Lettering>,
    /// The images that stamps may have for their form.
    pub images: Vec<StampImage>,
    colours: Option<ColourImage>,
}

impl LoadedScene {
    /// The heights that the field starts from, and the colours that lie over it, if there are any: an image's, or what the base
    /// brings. Makes as many heights as the field has texels: check its size against the adapter's limits first.
    pub fn layers(&self) -> (Vec<f32>, Option<ColourImage>) {
        let (heights, colours) = match (&self.scene.base, &self.lettering, self.image_heights()) {
            (_, _, Some(image)) => (image.heights, None),
            (Base::Text(text), Some(lettering), _) => {
                (base::text::heights(text, lettering, self.scene.field.size, self.scene.texel_metres()), None)
            }
            (Base::StillLife {}, ..) => {
                let (heights, colours) = base::still_life::photograph(self.scene.field.size);
                (heights, Some(colours))
            }
            // Only an image and a text have no heights of their own.
            _ => (base::heights(&self.scene).unwrap_or_default(), None),
        };
        (heights, self.colours.clone().or(colours))
    }

    /// What plays its series of images, if it has one.
    pub fn player(&self) -> Option<Player> {
        let (files, sequence) = (self.sequence.as_ref()?, self.scene.sequence.as_ref()?);
        Some(Player::new(files.clone(), &self.scene, sequence))
    }

    /// The image's heights at the field's size, if the scene starts from an image.
    ///
    /// Resampling allocates what the field's size says: check that against the adapter's limits first.
    pub fn image_heights(&self) -> Option<HeightImage> {
        self.image.as_ref().map(|image| image.resampled(self.scene.field.size, self.scene.field.addressing))
    }
}

/// Why there is no scene to run.
#[derive(Debug, thiserror::Error)]
pub enum SceneFileError {
    /// No scene has this name.
    #[error("{0} (the name of a file ends in .toml)")]
    Unknown(String),
    /// The file cannot be read.
    #[error("cannot read the scene {}: {}", path.display(), height_image::explain(cause))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// The file is no scene.
    #[error("{}{} {problem}", path.display(), line.map(|line| format!(", line {line}:")).unwrap_or_default())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Where in it, from 1.
        line: Option<usize>,
        /// What is the matter.
        problem: String,
    },
    /// A value of it makes no sense.
    #[error("scene {name}: {error}")]
    Invalid {
        /// The scene.
        name: String,
        /// Which value, and what it may be.
        error: SceneError,
    },
    /// Its image is unfit.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// Its sequence is unfit.
    #[error(transparent)]
    Sequence(#[from] SequenceError),
    /// There is no series that could be played so.
    #[error(
        "--sequence-colour, -rate, -playback and -interpolate say how a series is played, and this scene has none: name one with --sequence"
    )]
    PlayWithoutSequence,
    /// Its font is unfit.
    #[error(transparent)]
    Font(#[from] FontError),
    /// There is no text that a font could set.
    #[error("--font sets a text, and this scene has none: write one with --text")]
    FontWithoutText,
    /// Its mesh is unfit.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// There is nothing that a range could map.
    #[error(
        "--height-range maps the values of an image, and this scene has none: name one with --height, or a series with --sequence"
    )]
    RangeWithoutImage,
}

/// Name and description of every scene that comes with the program.
pub fn list() -> Vec<(&'static str, String)> {
    EMBEDDED.iter().map(|&(name, _)| (name, embedded(name).map(|scene| scene.description).unwrap_or_default())).collect()
}

/// A scene that comes with the program, as it is.
pub fn embedded(name: &str) -> Option<Scene> {
    let (_, text) = EMBEDDED.iter().find(|(known, _)| *known == name)?;
    // A test parses and checks every one of them: none fails here.
    toml::from_str(text).ok()
}

/// Loads a scene by name, or from a file: whatever ends in `.toml` or has a path separator in it. Then applies the overrides, checks
/// every value, reads its image, and moves a camera of the program's own so that it shows the whole plane, or the whole
/// mesh, in a picture of this size.
///
/// # Errors
///
/// The scene is unknown, unreadable, malformed or has values out of range; its image is unfit.
pub fn load(which: &str, overrides: &SceneOverrides, image_size: [u32; 2]) -> Result<LoadedScene, SceneFileError> {
    let is_file = which.ends_with(".toml") || which.contains(std::path::is_separator);
    let (mut scene, given) = if is_file {
        read(Path::new(which))?
    } else {
        let names = EMBEDDED.map(|(name, _)| name);
        let scene = embedded(which).ok_or_else(|| SceneFileError::Unknown(suggest::unknown("scene", which, &names)))?;
        (scene, Given { field_size: true, relief_sizes: Vec::new(), camera: false })
    };
    apply(&mut scene, overrides)?;
    prepare(which, scene, &given, overrides, image_size)
}

/// Loads a scene that stands elsewhere whole: a journal's. Of the overrides, those apply that say how it is seen.
///
/// # Errors
///
/// It has values out of range, or its image is unfit.
pub fn load_whole(mut scene: Scene, overrides: &SceneOverrides, image_size: [u32; 2]) -> Result<LoadedScene, SceneFileError> {
    overrides.look(&mut scene);
    let name = scene.name.clone();
    prepare(
        &name,
        scene,
        &Given { field_size: true, relief_sizes: Vec::new(), camera: true },
        &SceneOverrides::default(),
        image_size,
    )
}

impl LoadedScene {
    /// Middle and radius of a ball round a mesh that a file puts where it likes, metres; none where cameras may not go.
    fn ball_of_file(&self) -> Option<(DVec3, f64)> {
        let settings = self.scene.mesh.as_ref()?;
        if settings.radius_metres.is_some() || matches!(settings.source, MeshSource::Shape(_)) {
            return None;
        }
        let mesh = self.mesh.as_ref()?;
        let middle = mesh.bounds().centre().as_dvec3();
        let radius = mesh.vertices.iter().map(|vertex| vertex.position.as_dvec3().distance(middle)).fold(0.0, f64::max);
        // A camera stands at most a million metres from the origin, and so far from a ball, ten times its radius, as a lens needs.
        (middle.length() + 10.0 * radius < 1e6).then_some((middle, radius))
    }
}

impl LoadedScene {
    /// The vertices of a mesh of the program's own, at its own size; none where a scene says how large it is to be.
    fn points_of_shape(&self) -> Option<impl Iterator<Item = DVec3>> {
        let settings = self.scene.mesh.as_ref()?;
        let own = settings.radius_metres.is_none() && matches!(settings.source, MeshSource::Shape(_));
        let mesh = self.mesh.as_ref().filter(|_| own)?;
        Some(mesh.vertices.iter().map(|vertex| vertex.position.as_dvec3()))
    }
}

/// Checks a scene and reads its files.
fn prepare(
    which: &str,
    scene: Scene,
    given: &Given,
    overrides: &SceneOverrides,
    image_size: [u32; 2],
) -> Result<LoadedScene, SceneFileError> {
    scene.validate().map_err(|error| SceneFileError::Invalid { name: which.to_owned(), error })?;
    let mut loaded = {
        let is_asked_for = overrides.height.is_some() || overrides.sequence.is_some() || !given.field_size;
        contents(scene, overrides.field, !is_asked_for)?
    };
    // Scenes of the program's own say every size.
    let sizes = given.relief_sizes.iter().copied().chain(std::iter::repeat(true));
    for (index, is_given) in (0..loaded.scene.reliefs.len()).zip(sizes) {
        let relief = contents(loaded.scene.reliefs[index].alone(&loaded.scene), None, is_given)?;
        loaded.scene.reliefs[index].field.size = relief.scene.field.size;
        loaded.reliefs.push(relief);
    }
    // A camera that someone chose stays where it is.
    if overrides.camera.is_none() && !given.camera {
        let aspect = f64::from(image_size[0]) / f64::from(image_size[1]);
        let camera = match (loaded.ball_of_file(), loaded.points_of_shape()) {
            (Some((middle, radius)), _) => loaded.scene.framing_of(middle, radius, aspect),
            (None, Some(points)) => loaded.scene.framing_of_points(points, aspect),
            (None, None) => loaded.scene.framing(aspect),
        };
        loaded.scene.camera = camera;
    }
    Ok(loaded)
}

/// Reads what a scene, or a relief alone, is made from: images, font, mesh. The field's size is settled: as it is asked for, else as it
/// is given, else the image's own.
fn contents(mut scene: Scene, asked: Option<FieldSize>, is_given: bool) -> Result<LoadedScene, SceneFileError> {
    let image = match &scene.base {
        Base::Image { path, range } => Some(HeightImage::read(path, *range)?),
        _ => None,
    };
    let sequence = scene.sequence.as_ref().map(SequenceFiles::find).transpose()?;
    let lettering = match &scene.base {
        Base::Text(text) => Some(font::lettering(&text.text, text.font.as_deref())?),
        _ => None,
    };
    let colours = scene.material.image.as_deref().map(colour_image::read).transpose()?;
    // What is played covers what it starts from.
    let image_size_texels = sequence.as_ref().map(SequenceFiles::size).or(image.as_ref().map(|image| image.size));
    let own_size = image_size_texels.filter(|_| !is_given);
    scene.field.size = match (asked, own_size) {
        (Some(size), _) => field_size(size, image_size_texels),
        (None, Some(size)) => size,
        (None, None) => scene.field.size,
    };
    let mesh = match &scene.mesh {
        Some(settings) => Some(load_mesh(settings, scene.plane_size_metres().map(|metres| metres as f32))?),
        None => None,
    };
    let images = imprint_image::load(&scene.imprints)?;
    Ok(LoadedScene { scene, mesh, reliefs: Vec::new(), sequence, image, lettering, images, colours })
}

fn load_mesh(settings: &scene::Mesh, tile_metres: [f32; 2]) -> Result<Mesh, MeshError> {
    let mesh = mesh_file::load(&settings.source, tile_metres)?.tiled(settings.tiles);
    Ok(match settings.radius_metres {
        Some(radius) => mesh.fitted(radius),
        None => mesh,
    })
}

/// What a file says itself, where its absence means something else than a default value.
struct Given {
    field_size: bool,
    /// The same of each further relief.
    relief_sizes: Vec<bool>,
    camera: bool,
}

/// Reads a scene from a file. A relative path to an image or a font is relative to the file.
fn read(path: &Path) -> Result<(Scene, Given), SceneFileError> {
    let unreadable = |cause| SceneFileError::Unreadable { path: path.to_owned(), cause };
    let malformed = |line, problem: String| SceneFileError::Malformed { path: path.to_owned(), line, problem };
    let metadata = fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(unreadable(std::io::ErrorKind::IsADirectory.into()));
    }
    if metadata.len() > BYTES_MAX {
        return Err(malformed(
            None,
            format!("has {} bytes, and no scene has more than {BYTES_MAX}: name a scene", metadata.len()),
        ));
    }
    let bytes = fs::read(path).map_err(unreadable)?;
    let text = String::from_utf8(bytes).map_err(|_| malformed(None, "is not a text file: name a scene in TOML".to_owned()))?;
    let explain = |error: toml::de::Error| {
        let line = error.span().map(|span| 1 + text[..span.start.min(text.len())].matches('\n').count());
        malformed(line, explain(error.message()))
    };

    let table: toml::Table = text.parse().map_err(explain)?;
    match table.get("version").map(toml::Value::as_integer) {
        Some(Some(version)) if version == i64::from(VERSION) => {}
        Some(Some(version)) => {
            let problem = format!(
                "is of version {version}, and this program reads version {VERSION}: adapt it and write `version = {VERSION}`"
            );
            return Err(malformed(None, problem));
        }
        _ => return Err(malformed(None, format!("says no version: write `version = {VERSION}` in its first line"))),
    }
    let mut scene: Scene = toml::from_str(&text).map_err(explain)?;
    if scene.name.is_empty() {
        scene.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    }
    let beside_scene = |file: &mut PathBuf| {
        if !file.as_os_str().is_empty() {
            *file = path.parent().unwrap_or(Path::new("")).join(&file);
        }
    };
    let resolve = |base: &mut Base, material: &mut Material, mesh: Option<&mut scene::Mesh>| {
        match base {
            Base::Image { path, .. } => beside_scene(path),
            Base::Text(text) => text.font.iter_mut().for_each(beside_scene),
            _ => {}
        }
        material.image.iter_mut().for_each(beside_scene);
        if let Some(mesh) = mesh {
            mesh.source.resolve(path.parent().unwrap_or(Path::new("")));
        }
    };
    resolve(&mut scene.base, &mut scene.material, scene.mesh.as_mut());
    for imprint in &mut scene.imprints {
        imprint.font.iter_mut().chain(&mut imprint.image).for_each(beside_scene);
    }
    if let Some(sequence) = &mut scene.sequence {
        beside_scene(&mut sequence.heights);
        sequence.colours.iter_mut().for_each(beside_scene);
    }
    for relief in &mut scene.reliefs {
        resolve(&mut relief.base, &mut relief.material, relief.mesh.as_mut());
    }
    let has_size = |table: &toml::Value| table.get("field").is_some_and(|field| field.get("size").is_some());
    let relief_sizes = table.get("reliefs").and_then(toml::Value::as_array).into_iter().flatten().map(has_size).collect();
    let field_size = table.get("field").is_some_and(|field| field.get("size").is_some());
    Ok((scene, Given { field_size, relief_sizes, camera: table.contains_key("camera") }))
}

/// One sentence of the parser's words, with the name that was probably meant.
fn explain(message: &str) -> String {
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    // "unknown field `x`, expected one of `a`, `b`": what stands between backticks, in turn.
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match names.split_first() {
        Some((unknown, known)) if message.starts_with("unknown") => match suggest::nearest(unknown, known) {
            Some(nearest) => format!("{message}: did you mean `{nearest}`?"),
            None => message,
        },
        _ => message,
    }
}

/// Applies what the command line says, in the order in which its documentation lists it. The field's size comes later, with the image.
fn apply(scene: &mut Scene, overrides: &SceneOverrides) -> Result<(), SceneFileError> {
    if let Some(path) = &overrides.height {
        scene.base = Base::Image { path: path.clone(), range: None };
    }
    if let Some(path) = &overrides.sequence {
        scene.sequence = Some(Sequence { heights: path.clone(), ..Sequence::default() });
    }
    apply_sequence(scene, overrides)?;
    if overrides.height_range.is_some() {
        match (&mut scene.sequence, &mut scene.base) {
            (Some(Sequence { range, .. }), _) | (None, Base::Image { range, .. }) => *range = overrides.height_range,
            _ => return Err(SceneFileError::RangeWithoutImage),
        }
    }
    if let Some(words) = &overrides.text {
        match &mut scene.base {
            Base::Text(text) => text.text.clone_from(words),
            base => *base = Base::Text(Text { text: words.clone(), ..Text::default() }),
        }
    }
    if let Some(font) = &overrides.font {
        match &mut scene.base {
            Base::Text(text) => text.font = Some(font.clone()),
            _ => return Err(SceneFileError::FontWithoutText),
        }
    }
    if let Some(path) = &overrides.albedo {
        scene.material.albedo = Albedo::Image;
        scene.material.image = Some(path.clone());
    }
    if let Some(depth) = overrides.depth_metres {
        scene.plane.depth_metres = depth;
    }
    if let Some(source) = &overrides.mesh {
        scene.mesh = Some(scene::Mesh { source: source.clone(), tiles: [1.0, 1.0], ..scene::Mesh::default() });
    }
    if let Some(seed) = overrides.seed {
        scene.seed = seed;
    }
    overrides.look(scene);
    Ok(())
}

/// Applies what the command line says about how a series is played.
fn apply_sequence(scene: &mut Scene, overrides: &SceneOverrides) -> Result<(), SceneFileError> {
    let SceneOverrides { sequence_colours, images_per_second, playback, interpolate, .. } = overrides;
    let Some(sequence) = &mut scene.sequence else {
        let nothing = sequence_colours.is_none() && images_per_second.is_none() && playback.is_none() && interpolate.is_none();
        return if nothing { Ok(()) } else { Err(SceneFileError::PlayWithoutSequence) };
    };
    if let Some(path) = sequence_colours {
        sequence.colours = Some(path.clone());
        scene.material.albedo = Albedo::Image;
    }
    sequence.images_per_second = images_per_second.unwrap_or(sequence.images_per_second);
    sequence.playback = playback.unwrap_or(sequence.playback);
    sequence.interpolate = interpolate.unwrap_or(sequence.interpolate);
    Ok(())
}

impl SceneOverrides {
    /// Applies those that only say how the field is seen.
    pub fn look(&self, scene: &mut Scene) {
        if let Some(triangles) = self.mesh_triangles {
            scene.trace.mesh_triangles = triangles;
        }
        scene.trace.shell |= self.shell;
        scene.trace.displaced_depth |= self.displaced_depth;
        if let Some(technique) = self.technique {
            scene.trace.technique = technique;
        }
        if let Some(shadow) = self.shadow {
            scene.trace.shadow = shadow;
        }
        if let Some(threshold) = self.lod {
            scene.lod.threshold = threshold;
        }
        if let Some(keep_exact) = self.lod_keep_exact {
            scene.lod.keep_exact = keep_exact;
        }
        if let Some(shading) = self.shading {
            scene.material.model = shading;
        }
        if let Some([least, most]) = self.samples {
            let trace = &mut scene.trace;
            (trace.pom_samples_min, trace.pom_samples_max) = (least, most);
            // Techniques with one count for all angles take what the others take of a ray that grazes.
            (trace.steep_layers, trace.relief_linear_steps) = (most, most);
        }
        if let Some(counts) = self.pom_counts {
            scene.trace.pom_counts = counts;
        }
        if let Some(bias) = self.relief_depth_bias {
            scene.trace.relief_depth_bias = bias;
        }
        if let Some(leaf) = self.pyramid_leaf {
            scene.trace.pyramid_leaf = leaf;
        }
        if let Some(CameraPlacement { eye, target }) = self.camera {
            let still = Camera { orbit_degrees_per_second: 0.0, swing: None, fly_metres_per_second: [0.0; 3], ..scene.camera };
            scene.camera = Camera { eye, target, ..still };
        }
        if let Some(fov) = self.vertical_fov_degrees {
            scene.camera.vertical_fov_degrees = fov;
        }
        if let Some(half_angle) = self.light_half_angle_degrees {
            scene.light.half_angle_degrees = half_angle;
        }
    }

    /// Whether they say where the field is seen from.
    pub fn moves_camera(&self) -> bool {
        self.camera.is_some() || self.vertical_fov_degrees.is_some()
    }
}

/// The field's size for what the command line says, over an image of this size or none.
fn field_size(size: FieldSize, image: Option<[u32; 2]>) -> [u32; 2] {
    match (size, image) {
        (FieldSize::Exactly(size), _) => size,
        (FieldSize::Width(width), None) => [width, width],
        (FieldSize::Width(width), Some([image_width, image_height])) => {
            let height = (f64::from(width) * f64::from(image_height) / f64::from(image_width)).round();
            // A float beyond u32 becomes the largest, which the adapter's limits refuse.
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is positive")]
            [width, (height as u32).max(1)]
        }
    }
}
