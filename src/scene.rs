//! A scene: all that determines the picture, as plain data.
//!
//! The same value serves panel, command line, files and tests. Files are TOML; a field that is absent has its default, a field
//! that is unknown is an error. [`Scene::validate`] says in one sentence what is out of range.

mod bodies;
mod framing;
mod gas;
mod layer;
mod lights;
mod lod;
mod noise;
mod reliefs;
mod sequence;
pub mod shallow_water;
mod stamping;
mod swing;
mod techniques;
mod text;
mod validate;

use std::path::PathBuf;

use serde::{Deserialize, Deserializer, Serialize};

use crate::surface::{Albedo, Shading, Shadow, Technique};

pub use bodies::{Ball, Mesh, MeshMaterial};
pub use gas::{GAS_CELLS_MIN, GAS_VISCOSITY_MAX, Gas, GasBands, GasBorder, GasEmitters};
pub use layer::{Layer, LayerBlend};
pub use lights::{Background, DirectionalLight, LIGHTS_MAX};
pub use lod::{LOD_THRESHOLD, Lod};
pub use noise::{
    ColumnShape, Columns, Dunes, Fold, FractalNoise, GEARS_MAX, Gear, Gears, Noise, NoisePattern, OCTAVES_MAX, Scales,
};
pub use reliefs::{RELIEFS_MAX, Relief};
pub use sequence::{Between, IMAGES_PER_SECOND, Playback, Sequence};
pub use shallow_water::{Body, Border, Drops, Plunger, ShallowWater, Spring, Swell};
pub use stamping::{Explosions, Healing, Imprint, Shots, Struck, Track, TrackMaker};
pub use swing::Swing;
pub use techniques::{PomCounts, PyramidLeaf};
pub use text::{Text, TextRelief, check_text};
pub use validate::{
    COURANT_SQUARED_MAX, DEPTH_METRES, LIGHT_HALF_ANGLE_DEGREES, MESH_TRIANGLES, Range, SAMPLES_MAX, SceneError,
    VERTICAL_FOV_DEGREES, check_camera,
};

/// The version of the scene format that this program reads and writes.
pub const VERSION: u32 = 1;

/// All that determines the picture. See the module's documentation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// The format's version, [`VERSION`]. The one key that has no default.
    pub version: u32,
    /// Its name, as `rilievo scenes` lists it.
    #[serde(default)]
    pub name: String,
    /// One sentence: what it shows and what to try.
    #[serde(default)]
    pub description: String,
    /// Seed of everything random in it.
    #[serde(default)]
    pub seed: u64,
    /// The height field's size and what lies beyond its border.
    #[serde(default)]
    pub field: FieldSettings,
    /// The plane that carries the field.
    #[serde(default)]
    pub plane: Plane,
    /// The height that the field starts from.
    #[serde(default)]
    pub base: Base,
    /// A gas over it, if any.
    pub gas: Option<Gas>,
    /// Waves over the base, if any.
    #[serde(default)]
    pub wave: Option<Wave>,
    /// Shallow water over it, if any.
    #[serde(default)]
    pub shallow_water: Option<ShallowWater>,
    /// Procedural heights over the base, if any.
    #[serde(default)]
    pub noise: Option<Noise>,
    /// A numbered series of images over those, if any.
    #[serde(default)]
    pub sequence: Option<Sequence>,
    /// Seeded shots at the surface, if any.
    #[serde(default)]
    pub shots: Option<Shots>,
    /// Seeded charges that go off in it, if any.
    #[serde(default)]
    pub explosions: Option<Explosions>,
    /// Tracks that are laid in it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tracks: Vec<Track>,
    /// Texts and images that are pressed into it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub imprints: Vec<Imprint>,
    /// Whether it closes to its base.
    #[serde(default)]
    pub healing: Option<Healing>,
    /// How the surface is traced.
    #[serde(default)]
    pub trace: Trace,
    /// How closely it is looked at from afar.
    #[serde(default)]
    pub lod: Lod,
    /// The light.
    #[serde(default)]
    pub light: Light,
    /// Other lights, three at most.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lights: Vec<DirectionalLight>,
    /// What the surface is made of.
    #[serde(default)]
    pub material: Material,
    /// The mesh that carries the relief; absent: the plane.
    #[serde(default)]
    pub mesh: Option<Mesh>,
    /// Balls beside the relief, which cast shadows upon it and are mirrored in it.
    #[serde(default)]
    pub balls: Vec<Ball>,
    /// Still reliefs beside it, seven at most.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reliefs: Vec<Relief>,
    /// Where it is seen from.
    #[serde(default)]
    pub camera: Camera,
}

/// Size and addressing of the height field.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FieldSettings {
    /// Width and height, texels.
    #[serde(deserialize_with = "exactly")]
    pub size: [u32; 2],
    /// What lies beyond the border.
    pub addressing: Addressing,
}

/// What lies beyond the border of the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Addressing {
    /// The field again.
    Wrap,
    /// Its border texels, for ever.
    Clamp,
}

/// The plane that carries the field, in the world's y = 0, centred on the origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Plane {
    /// Extent of the field along x, metres. The extent along z follows from the field's aspect: texels are square.
    pub width_metres: f32,
    /// How often the plane shows the field along u and v. One copy stays where the only one would be, the others surround it:
    /// uv leaves 0 to 1, and all that says where a uv lies holds as it stands.
    #[serde(deserialize_with = "exactly")]
    pub repeat: [u32; 2],
    /// Depth of h = 0 below the plane, metres.
    pub depth_metres: f32,
}

/// The height that the field starts from. Bases without parameters are structs without fields: of a unit variant serde would
/// accept any key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, tag = "kind", rename_all = "kebab-case")]
pub enum Base {
    /// One height everywhere: still water, a blank wall.
    Flat {
        /// The height, 0 to 1.
        height: f32,
    },
    /// A wall of bricks in running bond, the same that the `brick` albedo colours.
    Bricks {},
    /// Rounded stones, the same that the `cobble` albedo colours.
    Cobbles {},
    /// A brick wall, plastered, with a steel plate and a door of planks: the same that the `facade` albedo colours.
    Facade {},
    /// Drifted snow, the same that the `snow` albedo colours.
    Snow {},
    /// Hills with terraces, steps and spikes: a field that is hard to trace.
    Terrain {},
    /// Sand that rises from the sea in the south to dunes in the north.
    Beach {},
    /// Short fur, combed, the same that the `fur` albedo colours.
    Fur {},
    /// A lawn with daisies, the same that the `grass` albedo colours.
    Grass {},
    /// Mountains with gullies over a valley: a landscape to look at, the same that the `terrain` albedo colours.
    Landscape {},
    /// Plains, highlands and craters by longitude and latitude, for a sphere; the same that the `planet` albedo colours.
    Planet {},
    /// A carved panel that continues itself.
    Ornament {},
    /// What a depth camera sees of a table with a vase, fruit and books: heights, and colours for albedo `image`.
    StillLife {},
    /// A sign: text in relief.
    Text(Text),
    /// An image's heights.
    Image {
        /// A PNG or EXR file.
        path: PathBuf,
        /// The heights in the file that become 0 and 1; absent: they stand as they are.
        #[serde(default, deserialize_with = "exactly_or_none")]
        range: Option<[f32; 2]>,
    },
}

/// A wave equation over the base.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Wave {
    /// Speed of the waves, metres a second.
    pub speed_metres_per_second: f32,
    /// Courant number C = c·dt/dx, which sets the time step. C² must be at most 0.49.
    pub courant: f32,
    /// Damping rate, 1/s: an undisturbed wave falls by e^(−rate/2) a second.
    pub damping_per_second: f32,
    /// What happens at the border of the field.
    pub boundary: Boundary,
    /// Width of the absorbing layer where the boundary is `absorbing`, texels.
    pub sponge_texels: u32,
    /// Height that a wave of amplitude 1 adds.
    pub amplitude: f32,
    /// How it meets what lies beneath it.
    pub blend: LayerBlend,
    /// Rain upon it, if any.
    pub rain: Option<Rain>,
    /// Posts that reflect it.
    pub obstacles: Vec<Obstacle>,
}

/// What a wave meets at the border of the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Boundary {
    /// The opposite border.
    Periodic,
    /// A wall that keeps the sign of a reflection (Neumann).
    Reflecting,
    /// A held border, which inverts a reflection (Dirichlet).
    Fixed,
    /// A sponge, which swallows it.
    Absorbing,
}

/// Seeded drops upon the water.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Rain {
    /// Mean number of drops a second.
    pub drops_per_second: f32,
    /// Radius of a drop's impulse, metres.
    pub radius_metres: f32,
    /// Depth of the dent that a drop makes, in units of the wave's amplitude.
    pub strength: f32,
}

/// A post that stands in the water and reflects waves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Obstacle {
    /// Its centre, uv.
    #[serde(deserialize_with = "exactly")]
    pub centre: [f32; 2],
    /// Half its extent along u and v, metres.
    #[serde(deserialize_with = "exactly")]
    pub half_extent_metres: [f32; 2],
    /// Radius of its corners, metres: as large as the half extent makes it round.
    #[serde(default)]
    pub corner_metres: f32,
    /// Height of its top, 0 to 1.
    #[serde(default = "one")]
    pub top: f32,
}

/// How the surface is traced.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Trace {
    /// The technique that finds the surface.
    pub technique: Technique,
    /// The shadow upon it.
    pub shadow: Shadow,
    /// Layers of `steep`.
    pub steep_layers: u32,
    /// Samples of the linear search of `relief`.
    pub relief_linear_steps: u32,
    /// Samples of its binary search.
    pub relief_binary_steps: u32,
    /// Whether `relief` shortens the offset of rays that graze (\[POM\] fig. 2).
    pub relief_depth_bias: bool,
    /// How `pom` and `pom-linear` choose their counts.
    pub pom_counts: PomCounts,
    /// Samples of `pom` and `pom-linear` seen head-on (\[POM\] eq. 1, n_min), or the fewest.
    pub pom_samples_min: u32,
    /// Samples of `pom` and `pom-linear` seen edge-on (\[POM\] eq. 1, n_max).
    pub pom_samples_max: u32,
    /// What `pyramid` makes of a leaf.
    pub pyramid_leaf: PyramidLeaf,
    /// About how many triangles `mesh` has.
    pub mesh_triangles: u32,
    /// Samples of `pom-soft` along the light ray; layers of `steep` from height 0 to 1.
    pub shadow_samples: u32,
    /// Strength of `pom-soft`: how fast a blocker darkens.
    pub shadow_strength: f32,
    /// Points of the light's disc to which `area` sends a ray each.
    pub area_samples: u32,
    /// Nodes that one ray of `pyramid`, `exact`, `hard`, `cone` and `area` may visit before it gives up and says so.
    pub step_cap: u32,
    /// Rays along each side of a pixel; the picture is their mean. Channels other than colour take one.
    pub supersampling: u32,
    /// Whether the depth of a pixel is that of the relief, so that surfaces intersect as they should; else it is the polygon's.
    pub displaced_depth: bool,
    /// Whether the relief is a solid with a silhouette of its own, which ends at the borders of its mesh.
    pub shell: bool,
}

/// A directional light and its surroundings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Light {
    /// Direction toward the light: degrees from +x toward +z.
    pub azimuth_degrees: f32,
    /// Direction toward the light: degrees above the plane.
    pub elevation_degrees: f32,
    /// Half the angle that its disc spans, degrees: how soft `cone` and `area` shadows are. The sun's is 0.27.
    pub half_angle_degrees: f32,
    /// Its colour, linear.
    #[serde(deserialize_with = "exactly")]
    pub colour: [f32; 3],
    /// Its irradiance over π: a white surface that faces it has this radiance.
    pub intensity: f32,
    /// Radiance of the sky overhead, linear.
    #[serde(deserialize_with = "exactly")]
    pub sky: [f32; 3],
    /// Radiance from below the horizon, linear.
    #[serde(deserialize_with = "exactly")]
    pub ground: [f32; 3],
    /// Degrees a second that the light travels round the vertical.
    pub turn_degrees_per_second: f32,
    /// Whether the relief hides it from itself.
    pub casts_shadow: bool,
    /// What is behind everything.
    pub background: Background,
}

/// What the surface is made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Material {
    /// Its colours.
    pub albedo: Albedo,
    /// A PNG image over the field, for albedo `image`.
    pub image: Option<PathBuf>,
    /// Tint of the albedo, linear.
    #[serde(deserialize_with = "exactly")]
    pub tint: [f32; 3],
    /// What light does to it.
    pub model: Shading,
    /// Strength of the highlight, 0 to 1; of `ggx` ½ is the 4 % of most dielectrics.
    pub specular: f32,
    /// Exponent of the highlight of `phong`.
    pub shininess: f32,
    /// How rough it is to `ggx`, 0 a mirror, 1 matt.
    pub roughness: f32,
    /// How metallic it is to `ggx`, 0 to 1.
    pub metallic: f32,
    /// How much of the sky it mirrors, of what Fresnel allows, 0 to 1.
    pub reflection: f32,
    /// Index of refraction, where it is transparent.
    pub refractive_index: f32,
}

/// Where the surface is seen from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Camera {
    /// The eye, metres.
    #[serde(deserialize_with = "exactly")]
    pub eye: [f64; 3],
    /// The point in the middle of the picture, metres.
    #[serde(deserialize_with = "exactly")]
    pub target: [f64; 3],
    /// Vertical field of view, degrees.
    pub vertical_fov_degrees: f64,
    /// Nearest visible distance, metres.
    pub near_metres: f64,
    /// Degrees a second that the eye travels round the vertical through the target.
    pub orbit_degrees_per_second: f64,
    /// How it swings about that, if it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub swing: Option<Swing>,
    /// Metres a second that eye and target travel along x, y and z.
    #[serde(deserialize_with = "exactly")]
    pub fly_metres_per_second: [f64; 3],
}

fn one() -> f32 {
    1.0
}

/// Reads an array of this very length: serde's own would stop after as many as it needs.
fn exactly<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(deserializer: D) -> Result<[T; N], D::Error> {
    array(Vec::deserialize(deserializer)?)
}

fn exactly_or_none<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
    deserializer: D,
) -> Result<Option<[T; N]>, D::Error> {
    // What no TOML has, JSON writes as null: in journals, states and manifests.
    Option::<Vec<T>>::deserialize(deserializer)?.map(array).transpose()
}

fn array<E: serde::de::Error, T, const N: usize>(values: Vec<T>) -> Result<[T; N], E> {
    let count = values.len();
    values.try_into().map_err(|_| E::custom(format!("{count} values where there must be {N}")))
}

impl Scene {
    /// In how many seconds what glows on it falls to 1/e; none where nothing glows.
    pub fn cooling_seconds(&self) -> Option<f64> {
        self.explosions.as_ref().map(|explosions| f64::from(explosions.cooling_seconds))
    }
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            version: VERSION,
            name: String::new(),
            description: String::new(),
            seed: 0,
            field: FieldSettings::default(),
            plane: Plane::default(),
            base: Base::default(),
            gas: None,
            wave: None,
            shallow_water: None,
            noise: None,
            sequence: None,
            shots: None,
            explosions: None,
            tracks: Vec::new(),
            imprints: Vec::new(),
            healing: None,
            trace: Trace::default(),
            lod: Lod::default(),
            light: Light::default(),
            lights: Vec::new(),
            material: Material::default(),
            mesh: None,
            balls: Vec::new(),
            reliefs: Vec::new(),
            camera: Camera::default(),
        }
    }
}

impl Default for FieldSettings {
    fn default() -> Self {
        Self { size: [512, 512], addressing: Addressing::Clamp }
    }
}

impl Default for Plane {
    fn default() -> Self {
        Self { width_metres: 1.0, repeat: [1, 1], depth_metres: 0.1 }
    }
}

impl Default for Base {
    fn default() -> Self {
        Self::Flat { height: 1.0 }
    }
}

impl Default for Wave {
    fn default() -> Self {
        Self {
            speed_metres_per_second: 0.35,
            courant: 0.6,
            damping_per_second: 0.8,
            boundary: Boundary::Reflecting,
            sponge_texels: 48,
            amplitude: 0.2,
            blend: LayerBlend::Add,
            rain: None,
            obstacles: Vec::new(),
        }
    }
}

impl Default for Rain {
    fn default() -> Self {
        Self { drops_per_second: 24.0, radius_metres: 0.02, strength: 1.0 }
    }
}

impl Default for Trace {
    fn default() -> Self {
        Self {
            technique: Technique::Exact,
            shadow: Shadow::Hard,
            // [Steep] leaves the count open: that of `pom` seen edge-on.
            steep_layers: 50,
            // A thousandth of the depth: 16 · 2⁶ parts of it.
            relief_linear_steps: 16,
            relief_binary_steps: 6,
            relief_depth_bias: false,
            pom_counts: PomCounts::default(),
            pom_samples_min: 8,
            pom_samples_max: 50,
            mesh_triangles: 131_072,
            pyramid_leaf: PyramidLeaf::default(),
            shadow_samples: 16,
            shadow_strength: 4.0,
            area_samples: 64,
            step_cap: 4096,
            supersampling: 1,
            displaced_depth: false,
            shell: false,
        }
    }
}

impl Default for Light {
    fn default() -> Self {
        Self {
            azimuth_degrees: 215.0,
            elevation_degrees: 40.0,
            half_angle_degrees: 1.5,
            colour: [1.0, 0.95, 0.88],
            intensity: 1.35,
            sky: [0.30, 0.37, 0.47],
            ground: [0.13, 0.10, 0.08],
            turn_degrees_per_second: 0.0,
            casts_shadow: true,
            background: Background::Studio,
        }
    }
}

impl Default for Material {
    fn default() -> Self {
        Self {
            albedo: Albedo::Plain,
            image: None,
            tint: [1.0, 1.0, 1.0],
            model: Shading::Phong,
            specular: 0.2,
            shininess: 32.0,
            roughness: 0.5,
            metallic: 0.0,
            reflection: 0.0,
            refractive_index: 1.5,
        }
    }
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            eye: [0.0, 1.15, 1.05],
            target: [0.0, -0.04, 0.04],
            vertical_fov_degrees: 45.0,
            near_metres: 0.01,
            orbit_degrees_per_second: 0.0,
            swing: None,
            fly_metres_per_second: [0.0; 3],
        }
    }
}
