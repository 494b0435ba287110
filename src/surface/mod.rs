//! How the field is seen: techniques, shadows, shading.

pub mod albedo_image;
pub mod channels;
pub mod choice;
pub mod display;
pub mod facet;
pub mod level_of_detail;
pub mod light_probe;
pub mod micropolygon;
pub mod outline;
pub mod probe;
pub mod raster;
pub mod ray_map;
pub mod reliefs;
pub mod shell;
pub mod stage;
#[expect(clippy::module_inception, reason = "the stem rule: this pass's shader is shaders/surface/surface.wgsl")]
pub mod surface;
pub mod view;

pub use channels::Channels;
pub use choice::{Albedo, Shading, Shadow, Shows, Technique};
pub use display::{Display, Split};
pub use light_probe::LightProbe;
pub use probe::Probe;
pub use stage::{Seen, Stage};
pub use surface::Surface;
pub use view::{View, ViewSet};

use crate::field;
use crate::gpu::{Binding, BindingLayout, Gpu};
use crate::scene::{Addressing, Background, Scene};

/// What a picture is made with: the parts that are chosen, not computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Choice {
    /// How the ray of a pixel finds the surface.
    pub technique: Technique,
    /// How much of the light a point sees.
    pub shadow: Shadow,
    /// The colour of the undisturbed surface.
    pub albedo: Albedo,
    /// What light does to it.
    pub shading: Shading,
    /// Whether the exact traversal runs beside the technique: what the view of errors shows. A part of its own, since an
    /// adapter that runs both sides of every branch would pay for it in every picture.
    pub with_truth: bool,
    /// Whether the traversal ends at a level of the pyramid, in place of the technique.
    pub caps_level: bool,
    /// Whether anything looks less closely where a pixel sees much of the surface.
    pub detail: bool,
    /// Whether there are balls.
    pub balls: bool,
    /// Whether the material mirrors its surroundings.
    pub reflects: bool,
    /// Whether shallow water covers the ground.
    pub covered: bool,
    /// Whether other reliefs cast their shadows on it.
    pub reliefs: bool,
    /// Whether stamps may leave gloss and heat.
    pub marks: bool,
    /// Whether there may be anything on the material: posts, or what was ever pressed into the relief.
    pub stamped: bool,
    /// Whether the field wraps; none where one pipeline serves fields that do and fields that do not.
    pub wraps: Option<bool>,
    /// How many lights shine.
    pub lights: u32,
    /// Whether the sky is behind everything, not a studio.
    pub sky_behind: bool,
    /// Whether a number is shown instead of the picture.
    pub views: bool,
}

impl Choice {
    /// The cheapest.
    pub const PLAIN: Self = Self::tracing(Technique::Normal, Shadow::None);

    /// A technique and a shadow, where nobody looks at colours.
    pub const fn tracing(technique: Technique, shadow: Shadow) -> Self {
        Self {
            technique,
            shadow,
            albedo: Albedo::Plain,
            shading: Shading::Phong,
            with_truth: false,
            caps_level: false,
            detail: false,
            balls: false,
            reflects: false,
            covered: false,
            reliefs: false,
            marks: false,
            stamped: true,
            wraps: None,
            lights: 1,
            sky_behind: false,
            views: false,
        }
    }

    /// A scene's.
    pub fn of(scene: &Scene) -> Self {
        let (trace, material) = (&scene.trace, &scene.material);
        let (detail, balls) = (scene.lod.filters(), !scene.balls.is_empty());
        let reflects = material.reflection > 0.0;
        let marks = scene.shots.is_some() || scene.explosions.is_some() || !scene.tracks.is_empty();
        Self {
            albedo: material.albedo,
            shading: material.model,
            detail,
            balls,
            reflects,
            covered: scene.shallow_water.is_some(),
            reliefs: reliefs::are_seen(scene),
            marks,
            wraps: Some(scene.field.addressing == Addressing::Wrap),
            // Validation refuses more lights than there is room for.
            lights: scene.all_lights().len() as u32,
            sky_behind: scene.light.background == Background::Sky,
            ..Self::tracing(trace.technique, trace.shadow)
        }
    }

    /// For what stands in a scene and is no relief.
    pub fn beside(scene: &Scene) -> Self {
        let choice = Self::of(scene);
        Self { reliefs: choice.reliefs, ..choice.behind() }
    }

    /// For what is behind it.
    #[must_use]
    pub const fn behind(self) -> Self {
        Self { lights: self.lights, sky_behind: self.sky_behind, ..Self::PLAIN }
    }

    /// Whether it reads the pyramid: \[PDM\] does, and the view that ends the traversal at a level of it.
    pub const fn reads_pyramid(self) -> bool {
        matches!(self.technique, Technique::Pyramid) || self.caps_level
    }

    /// The same for a view of what it traces.
    #[must_use]
    pub const fn showing(self, shows: Shows) -> Self {
        let views = !matches!(shows, Shows::Picture | Shows::LevelCap);
        Self { with_truth: matches!(shows, Shows::Error), caps_level: matches!(shows, Shows::LevelCap), views, ..self }
    }
}

/// The WGSL parts of everything that traces, `entries` being those with its entry points, under `shaders/surface`. `filters_r32float` says whether the
/// adapter does.
pub fn parts(filters_r32float: bool, choice: Choice, entries: &[&str]) -> Vec<String> {
    let sampled = if filters_r32float { "common/height_filtered" } else { "common/height_loaded" };
    let Choice { technique, shadow, albedo, shading, with_truth, caps_level, .. } = choice;
    let stems = [
        if caps_level { "level_cap" } else { technique.stem() },
        shadow.stem(),
        "sky",
        "reliefs",
        "balls",
        "matter",
        "transparent",
        albedo.stem(),
        "shallows",
        shading.stem(),
        "shade",
        if with_truth { "truth_exact" } else { "truth_none" },
        "views",
        "channel",
    ];
    let mut parts: Vec<String> = [
        "common/view",
        "common/noise",
        "common/material",
        "common/heat",
        "surface/ray",
        "common/range",
        "common/field",
        sampled,
        "surface/frame",
        "surface/level_of_detail",
        "surface/ray_map",
        "surface/traversal",
        "surface/light_disc",
        "surface/march",
    ]
    .map(str::to_owned)
    .to_vec();
    parts.extend(stems.iter().chain(entries).map(|stem| format!("surface/{stem}")));
    parts
}

/// The `override`s that Rust owns in a composition of [`parts`], besides those of its entry points.
pub(crate) fn constants(choice: Choice) -> Vec<(&'static str, f64)> {
    let switches = [
        ("DETAIL", choice.detail),
        ("BALLS", choice.balls),
        ("REFLECTS", choice.reflects),
        ("RELIEFS", choice.reliefs),
        ("MARKS", choice.marks),
        ("STAMPED", choice.stamped),
        ("SKY_BEHIND", choice.sky_behind),
        ("VIEWS", choice.views),
        ("COVERED", choice.covered),
    ];
    let mut constants = switches.map(|(name, on)| (name, f64::from(u8::from(on)))).to_vec();
    constants.push(("LIGHTS", f64::from(choice.lights)));
    constants.extend(choice.wraps.map(|wraps| ("WRAPS", f64::from(u8::from(wraps)))));
    constants.extend(field::material::CONSTANTS);
    constants.extend(field::bounds::CONSTANTS);
    constants.extend(match choice.albedo {
        Albedo::Brick => vec![
            ("BRICK_LENGTH", f64::from(field::base::BRICK_METRES[0])),
            ("BRICK_HEIGHT", f64::from(field::base::BRICK_METRES[1])),
            ("BRICK_JOINT", f64::from(field::base::BRICK_JOINT_METRES)),
        ],
        Albedo::Facade => {
            let [plate, door] = [field::base::facade::PLATE_METRES, field::base::facade::DOOR_METRES];
            vec![
                ("FACADE_WIDTH", f64::from(field::base::facade::FACADE_METRES[0])),
                ("FACADE_HEIGHT", f64::from(field::base::facade::FACADE_METRES[1])),
                ("FACADE_PLATE_LEFT", f64::from(plate[0])),
                ("FACADE_PLATE_UPPER", f64::from(plate[1])),
                ("FACADE_PLATE_RIGHT", f64::from(plate[2])),
                ("FACADE_PLATE_LOWER", f64::from(plate[3])),
                ("FACADE_DOOR_LEFT", f64::from(door[0])),
                ("FACADE_DOOR_UPPER", f64::from(door[1])),
                ("FACADE_DOOR_RIGHT", f64::from(door[2])),
                ("FACADE_DOOR_LOWER", f64::from(door[3])),
                ("FACADE_PLANK", f64::from(field::base::facade::PLANK_METRES)),
                ("BRICK_LENGTH", f64::from(field::base::BRICK_METRES[0])),
                ("BRICK_HEIGHT", f64::from(field::base::BRICK_METRES[1])),
                ("BRICK_JOINT", f64::from(field::base::BRICK_JOINT_METRES)),
            ]
        }
        Albedo::Cobble => vec![("COBBLE_SIZE", f64::from(field::base::COBBLE_METRES))],
        Albedo::Grass => vec![("DAISY_CELL", f64::from(field::base::DAISY_METRES))],
        Albedo::Plain
        | Albedo::Bronze
        | Albedo::Fur
        | Albedo::Gas
        | Albedo::Glass
        | Albedo::Image
        | Albedo::Planet
        | Albedo::Snow
        | Albedo::Sand
        | Albedo::Terrain
        | Albedo::Water => Vec::new(),
    });
    constants
}

/// Bind group layout 1 of everything that traces: the field, and what lies over it.
pub(crate) fn field_layout(gpu: &Gpu) -> BindingLayout {
    BindingLayout::new(
        gpu,
        "field",
        wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE,
        &[
            Binding::Float(gpu.filters_r32float()),
            Binding::Float(false),
            Binding::Float(true),
            Binding::Uint,
            Binding::Float(true),
            Binding::Float(true),
            Binding::Float(false),
        ],
    )
}

/// Binds a field to [`field_layout`].
pub(crate) fn bind_field(gpu: &Gpu, layout: &BindingLayout, field: &field::Field) -> wgpu::BindGroup {
    layout.bind(
        gpu,
        &[
            wgpu::BindingResource::TextureView(&field.height.view),
            wgpu::BindingResource::TextureView(&field.pyramid.view),
            wgpu::BindingResource::TextureView(&field.normal.view),
            wgpu::BindingResource::TextureView(&field.material.view),
            wgpu::BindingResource::TextureView(&field.albedo_map.view),
            wgpu::BindingResource::TextureView(&field.cover.view),
            wgpu::BindingResource::TextureView(&field.bounds.view),
        ],
    )
}
