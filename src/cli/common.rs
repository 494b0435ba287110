//! What every mode takes.

use std::path::PathBuf;

use clap::Args;

use super::Verbosity;
use super::display::DisplayOptions;
use super::values::{
    Detail, backend, camera, depth, field, fov, height_range, light_angle, lod, mesh, mesh_triangles, non_empty, playback,
    playback_help, pom_counts, pom_counts_help, pyramid_leaf, pyramid_leaf_help, sample_range, sequence_rate, shading,
    shading_help, shadow, shadow_help, sign, size, switch, technique, technique_help, whole_u64,
};
use crate::gpu::Preference;
use crate::io::scene_file::{CameraPlacement, FieldSize, SceneOverrides};
use crate::mesh::MeshSource;
use crate::scene::{Playback, PomCounts, PyramidLeaf};
use crate::surface::{Shading, Shadow, Technique};

/// What every mode that shows a scene takes.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CommonOptions {
    /// A scene's name, or a file that ends in .toml or lies behind a path
    #[arg(long, value_name = "NAME|FILE.toml", default_value = "ripples", help_heading = "Scene")]
    pub scene: String,

    #[arg(long, value_name = "T", value_parser = technique, help = technique_help(), help_heading = "Scene")]
    pub(super) technique: Option<Technique>,

    #[arg(long, value_name = "S", value_parser = shadow, help = shadow_help(), help_heading = "Scene")]
    pub(super) shadow: Option<Shadow>,

    #[arg(long, value_name = "M", value_parser = shading, help = shading_help(), help_heading = "Scene")]
    shading: Option<Shading>,

    /// Fewest and most samples of a ray: of pom and pom-linear head-on and edge-on; MAX is also the layers of steep and the
    /// linear steps of relief [default: the scene's]
    #[arg(long, value_name = "MIN,MAX", value_parser = sample_range, allow_hyphen_values = true, help_heading = "Scene")]
    samples: Option<[u32; 2]>,

    #[arg(long, value_name = "HOW", value_parser = pom_counts, help = pom_counts_help(), help_heading = "Scene")]
    pom_counts: Option<PomCounts>,

    /// Whether relief shortens the offset of rays that graze: on or off [default: the scene's]
    #[arg(long, value_name = "SWITCH", value_parser = switch, help_heading = "Scene")]
    relief_bias: Option<bool>,

    #[arg(long, value_name = "LEAF", value_parser = pyramid_leaf, help = pyramid_leaf_help(), help_heading = "Scene")]
    pyramid_leaf: Option<PyramidLeaf>,

    /// Mip level beyond which normal mapping alone is left and nothing is marched, 4 in the papers; or off. exact stays exact
    /// unless --lod-exact or the scene says otherwise [default: the scene's]
    #[arg(long, value_name = "THRESHOLD|off", value_parser = lod, allow_negative_numbers = true, help_heading = "Scene")]
    lod: Option<Detail>,

    /// Whether exact stays exact under level of detail, or stops at cells an eighth of a pixel: on or off [default: the scene's]
    #[arg(long, value_name = "SWITCH", value_parser = switch, help_heading = "Scene")]
    lod_exact: Option<bool>,

    /// Seed of everything random [default: the scene's]
    #[arg(long, value_name = "N", value_parser = whole_u64, allow_negative_numbers = true, help_heading = "Scene")]
    seed: Option<u64>,

    /// Size of the picture or window, pixels
    #[arg(long = "size", value_name = "WxH", value_parser = size, default_value = "960x600", allow_hyphen_values = true)]
    pub image_size: [u32; 2],

    /// Size of the height field, texels; N alone keeps the aspect of an image [default: the image's, or else the scene's]
    #[arg(long, value_name = "N|WxH", value_parser = field, allow_negative_numbers = true, help_heading = "Scene")]
    field: Option<FieldSize>,

    /// A PNG or EXR file whose heights replace the scene's starting height [default: none, the scene's own]
    #[arg(long, value_name = "IMAGE", help_heading = "Scene")]
    height: Option<PathBuf>,

    /// The values in the image, or in the series, that become heights 0 and 1 [default: 0,1]
    #[arg(long, value_name = "LO,HI", value_parser = height_range, allow_hyphen_values = true, help_heading = "Scene")]
    height_range: Option<[f32; 2]>,

    /// A numbered series of PNG or EXR files played as heights: a folder, or a pattern like depth_%05d.png or depth_*.png; the
    /// first one's size is the field's [default: none, the scene's own]
    #[arg(long, value_name = "PATTERN|DIR", conflicts_with = "height", help_heading = "Scene")]
    sequence: Option<PathBuf>,

    /// As many PNG files, named likewise, whose colours lie over the series' heights [default: none, the scene's albedo]
    #[arg(long, value_name = "PATTERN|DIR", help_heading = "Scene")]
    sequence_colour: Option<PathBuf>,

    /// Images of the series a second [default: the scene's, 30 unless its file says otherwise]
    #[arg(long, value_name = "N", value_parser = sequence_rate, allow_negative_numbers = true, help_heading = "Scene")]
    sequence_rate: Option<f32>,

    #[arg(long, value_name = "HOW", value_parser = playback, help = playback_help(), help_heading = "Scene")]
    sequence_playback: Option<Playback>,

    /// Whether the series' images fade into one another: on or off [default: the scene's, off unless its file says otherwise]
    #[arg(long, value_name = "SWITCH", value_parser = switch, help_heading = "Scene")]
    sequence_interpolate: Option<bool>,

    /// Text in relief, as large as fits, that replaces the scene's starting height; \n begins another line [default: none, the scene's own]
    #[arg(long, value_name = "STRING", value_parser = sign, allow_hyphen_values = true, help_heading = "Scene")]
    #[arg(conflicts_with_all = ["height", "height_range"])]
    text: Option<String>,

    /// A TTF or OTF file for the text [default: the scene's, the program's own unless its file says otherwise]
    #[arg(long, value_name = "FILE", conflicts_with_all = ["height", "height_range"], help_heading = "Scene")]
    font: Option<PathBuf>,

    /// A PNG file whose colours lie over the whole field [default: none, the scene's albedo]
    #[arg(long, value_name = "IMAGE", help_heading = "Scene")]
    albedo: Option<PathBuf>,

    /// Depth of height 0 below the plane, metres [default: the scene's]
    #[arg(long, value_name = "METRES", value_parser = depth, allow_negative_numbers = true, help_heading = "Scene")]
    depth: Option<f32>,

    /// What carries the relief: plane, box, cylinder, sphere, torus, or an OBJ, glTF or GLB file [default: the scene's]
    #[arg(long, value_name = "NAME|FILE", value_parser = mesh, help_heading = "Scene")]
    mesh: Option<MeshSource>,

    /// About how many triangles the technique mesh draws [default: the scene's]
    #[arg(long, value_name = "N", value_parser = mesh_triangles, allow_negative_numbers = true, help_heading = "Scene")]
    mesh_triangles: Option<u32>,

    /// Draw the relief as a solid with a silhouette of its own, which ends at its mesh's borders [default: the scene's]
    #[arg(long, help_heading = "Scene")]
    shell: bool,

    /// Write the relief's depth instead of the polygon's, so that surfaces intersect as they should [default: the scene's]
    #[arg(long, help_heading = "Scene")]
    displaced_depth: bool,

    /// Eye and target, metres; replaces every camera motion [default: the scene's, which shows the whole plane, or the whole mesh of a
    /// file]
    #[arg(long, value_name = "EX,EY,EZ,TX,TY,TZ", value_parser = camera, allow_hyphen_values = true, help_heading = "Scene")]
    camera: Option<CameraPlacement>,

    /// Vertical field of view, degrees [default: the scene's, 45 unless its file says otherwise]
    #[arg(long, value_name = "DEGREES", value_parser = fov, allow_negative_numbers = true, help_heading = "Scene")]
    fov: Option<f64>,

    /// Half the angle that the light's disc spans, degrees, for the shadows cone and area [default: the scene's]
    #[arg(long, value_name = "DEGREES", value_parser = light_angle, allow_negative_numbers = true, help_heading = "Scene")]
    light_angle: Option<f32>,

    /// What is shown of it.
    #[command(flatten)]
    pub display: DisplayOptions,

    /// Which machine, and how much it tells.
    #[command(flatten)]
    pub machine: MachineOptions,
}

impl CommonOptions {
    /// What the arguments change in the scene.
    pub fn overrides(&self) -> SceneOverrides {
        SceneOverrides {
            height: self.height.clone(),
            height_range: self.height_range,
            sequence: self.sequence.clone(),
            sequence_colours: self.sequence_colour.clone(),
            images_per_second: self.sequence_rate,
            playback: self.sequence_playback,
            interpolate: self.sequence_interpolate,
            text: self.text.clone(),
            font: self.font.clone(),
            albedo: self.albedo.clone(),
            field: self.field,
            depth_metres: self.depth,
            mesh: self.mesh.clone(),
            mesh_triangles: self.mesh_triangles,
            shell: self.shell,
            displaced_depth: self.displaced_depth,
            technique: self.technique,
            shadow: self.shadow,
            lod: self.lod.map(|detail| detail.0),
            lod_keep_exact: self.lod_exact,
            shading: self.shading,
            samples: self.samples,
            pom_counts: self.pom_counts,
            relief_depth_bias: self.relief_bias,
            pyramid_leaf: self.pyramid_leaf,
            seed: self.seed,
            camera: self.camera,
            vertical_fov_degrees: self.fov,
            light_half_angle_degrees: self.light_angle,
        }
    }
}

/// Which adapter, and how much to tell.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct MachineOptions {
    /// Use the adapter whose name contains this, in any case [default: $WGPU_ADAPTER_NAME, or else the best there is]
    #[arg(long, value_name = "SUBSTRING", value_parser = non_empty, help_heading = "Machine")]
    pub adapter: Option<String>,

    /// vulkan, metal, dx12 or gl [default: $WGPU_BACKEND, or else all of them]
    #[arg(long, value_name = "BACKEND", value_parser = backend, help_heading = "Machine")]
    pub backend: Option<wgpu::Backends>,

    /// Tell more on stderr; $RUST_LOG chooses freely [default: notes and warnings]
    #[arg(short, long, conflicts_with = "quiet", help_heading = "Machine")]
    verbose: bool,

    /// Tell nothing on stderr but errors [default: notes and warnings]
    #[arg(short, long, help_heading = "Machine")]
    quiet: bool,
}

impl MachineOptions {
    /// The adapters that may be used, hardware first; the environment completes what the arguments leave open.
    pub fn preference(&self) -> Preference {
        Preference { name: self.adapter.clone(), backend: self.backend, ..Preference::default() }.with_environment()
    }

    pub(super) fn verbosity(&self) -> Verbosity {
        match (self.quiet, self.verbose) {
            (true, _) => Verbosity::Quiet,
            (_, true) => Verbosity::Verbose,
            _ => Verbosity::Normal,
        }
    }
}
