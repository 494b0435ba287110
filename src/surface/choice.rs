//! What one can choose: techniques, shadows and albedos, each a WGSL part that defines the same function.
//!
//! Choosing is choosing the file that is concatenated; adding one is one stem and one line in a list below.

use serde::{Deserialize, Serialize};

/// Declares an enum whose variants have a name on the command line and in scenes, a stem under `shaders/surface`, and a label.
macro_rules! choices {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $text:literal, $stem:literal, $label:literal;)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub enum $name {
            $($(#[$variant_doc])* #[serde(rename = $text)] $variant,)+
        }

        impl $name {
            /// Every choice there is, in the order of the lists that users see.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// Its name on the command line, in scenes and in files.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $text),+ }
            }

            /// The stem of its WGSL part, `shaders/surface/STEM.wgsl`.
            pub const fn stem(self) -> &'static str {
                match self { $(Self::$variant => $stem),+ }
            }

            /// What the panel calls it.
            pub const fn label(self) -> &'static str {
                match self { $(Self::$variant => $label),+ }
            }

            /// The choice of this name.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|choice| choice.name() == name)
            }
        }
    };
}

choices! {
    /// How the ray of a pixel finds the surface: a file that defines `fn trace(ray: Ray) -> Hit`.
    Technique {
        /// Blinn's bump mapping: the surface stays where the polygon is, only its normal changes.
        Normal = "normal", "trace_normal", "Normal mapping (Blinn)";
        /// Parallax mapping: one sample says how far the texture shifts (\[Kaneko\]).
        Parallax = "parallax", "trace_parallax", "Parallax (Kaneko)";
        /// Parallax mapping whose shift is never longer than the surface is deep (\[Welsh\]).
        ParallaxLimited = "parallax-limited", "trace_parallax_limited", "Parallax, limited (Welsh)";
        /// Equal layers, and the first of them below the surface (\[Steep\]).
        Steep = "steep", "trace_steep", "Steep parallax";
        /// Relief mapping: a linear search, then a binary one (\[Policarpo\]).
        Relief = "relief", "trace_relief", "Relief mapping (Policarpo)";
        /// The linear search of parallax occlusion mapping alone (\[POM\] fig. 4).
        PomLinear = "pom-linear", "trace_pom_linear", "POM, linear search alone";
        /// Parallax occlusion mapping: a linear search, then the ray against the last linear segment (\[POM\] §3.1).
        Pom = "pom", "trace_pom", "Parallax occlusion mapping";
        /// Pyramidal displacement mapping: down a pyramid of bounds to a column, then half a pixel's refinement (\[PDM\]).
        Pyramid = "pyramid", "trace_pyramid", "Pyramidal displacement";
        /// The micropolygon mesh that the papers compare with, displaced in the vertex stage (\[POM\] §4, \[PDM\] fig. 20).
        Mesh = "mesh", "trace_mesh", "Micropolygon mesh";
        /// Exact intersection with the bilinear surface, through the pyramid of cell bounds.
        Exact = "exact", "trace_exact", "Exact";
    }
}

choices! {
    /// How much of the light a point sees: a file that defines `fn shadow(ray: Ray) -> f32`, the visibility.
    Shadow {
        /// Nothing blocks the light.
        None = "none", "shadow_none", "None";
        /// Layers of equal height toward the light, without interpolation (\[Steep\]).
        Steep = "steep", "shadow_steep", "Steep";
        /// Any hit of the exact traversal.
        Hard = "hard", "shadow_hard", "Hard (exact)";
        /// Weighted samples along the light ray (\[POM\] §3.2).
        PomSoft = "pom-soft", "shadow_pom_soft", "POM soft";
        /// The light's disc in three slices, the horizon of each through the pyramid.
        Cone = "cone", "shadow_cone", "Cone (soft)";
        /// An exact ray to each of many points of the light's disc: the truth.
        Area = "area", "shadow_area", "Area (truth)";
    }
}

choices! {
    /// What light does at the surface: a file that defines `fn light(…) -> vec3f` and what surroundings add.
    Shading {
        /// Blinn–Phong, as the papers have it.
        Phong = "phong", "light_phong", "Blinn–Phong";
        /// GGX microfacets over a matt base.
        Ggx = "ggx", "light_ggx", "Physically based (GGX)";
    }
}

choices! {
    /// The colour of the undisturbed surface: a file that defines `fn matter_at(point: SurfacePoint) -> Matter`.
    Albedo {
        /// One colour, and another where the slope is steep.
        Plain = "plain", "albedo_plain", "Plain";
        /// Bricks in running bond.
        Brick = "brick", "albedo_brick", "Brick";
        /// Cast bronze, rubbed bright where it stands out.
        Bronze = "bronze", "albedo_bronze", "Bronze";
        /// Rounded stones.
        Cobble = "cobble", "albedo_cobble", "Cobble";
        /// Plaster over bricks, steel, planks.
        Facade = "facade", "albedo_facade", "Façade";
        /// A leopard's coat, dark toward the roots.
        Fur = "fur", "albedo_fur", "Fur";
        /// The clouds of a gas planet, by what the gas carries and how it flows.
        Gas = "gas", "albedo_gas", "Gas";
        /// A lawn with daisies, dark toward the roots.
        Grass = "grass", "albedo_grass", "Grass";
        /// A picture.
        Image = "image", "albedo_image", "Image";
        /// Rock, dust and ice of a planet without air.
        Planet = "planet", "albedo_planet", "Planet";
        /// Snow that sparkles.
        Snow = "snow", "albedo_snow", "Snow";
        /// Sand, winnowed pale on the crests.
        Sand = "sand", "albedo_sand", "Sand";
        /// Grass, forest, rock and snow, by height and slope.
        Terrain = "terrain", "albedo_terrain", "Terrain";
        /// Clear water over a floor.
        Water = "water", "albedo_water", "Water";
        /// Clear glass over a table.
        Glass = "glass", "albedo_glass", "Glass";
    }
}

/// What the picture shows: the final image, or one of the numbers behind it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Shows {
    /// The lit surface.
    #[default]
    Picture = 0,
    /// The height field's value.
    Height = 1,
    /// The normal as shaded.
    Normal = 2,
    /// The share of the light that arrives.
    Visibility = 3,
    /// The samples or nodes of the view ray, as heat: 64 and more are the brightest.
    Steps = 4,
    /// How far the view ray moved along the surface, in depths of the field: grey is nowhere, red to the right, green up.
    UvOffset = 5,
    /// The level of the pyramid at which the view ray found the surface, as heat.
    Level = 6,
    /// How far the point that the technique found lies from the one of the exact traversal, as heat.
    Error = 7,
    /// The picture, where the traversal ends at a chosen level of the pyramid and takes its bounds for the surface, as boxes
    /// (\[PDM\] fig. 18).
    LevelCap = 8,
    /// The mip level of the pixel, as heat.
    MipLevel = 16,
    /// The picture, the bluer the lower the level of detail (\[POM\] fig. 12): deep blue is normal mapping alone.
    LodTint = 17,
}

impl Shows {
    /// Every view, in the order in which a key cycles them.
    pub const ALL: &'static [Self] = &[
        Self::Picture,
        Self::Height,
        Self::Normal,
        Self::UvOffset,
        Self::Visibility,
        Self::Steps,
        Self::Level,
        Self::LevelCap,
        Self::MipLevel,
        Self::LodTint,
        Self::Error,
    ];

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Picture => "final",
            Self::Height => "height",
            Self::Normal => "normals",
            Self::UvOffset => "uv-offset",
            Self::Visibility => "visibility",
            Self::Steps => "steps",
            Self::Level => "pyramid-level",
            Self::LevelCap => "level-cap",
            Self::Error => "error",
            Self::MipLevel => "mip-level",
            Self::LodTint => "lod-tint",
        }
    }

    /// Whether it is a picture, which is tone-mapped: numbers are shown as they are.
    pub const fn is_picture(self) -> bool {
        matches!(self, Self::Picture | Self::LevelCap | Self::LodTint)
    }

    /// What the brightest heat of the view stands for, where it has one; `gain` is that of the view of errors.
    pub fn heat_top(self, gain: f32) -> Option<f32> {
        match self {
            Self::Steps => Some(Self::STEPS_TOP as f32),
            Self::Level | Self::MipLevel => Some(Self::LEVELS_TOP as f32),
            Self::Error => Some(1.0 / gain),
            Self::Picture | Self::Height | Self::Normal | Self::Visibility | Self::UvOffset | Self::LevelCap | Self::LodTint => {
                None
            }
        }
    }

    /// The unit of what it shows, where it shows a number.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Steps => "height samples or nodes",
            Self::Level | Self::MipLevel => "levels",
            Self::Error => "texels",
            Self::Height => "of the depth",
            Self::Visibility => "of the light",
            Self::Picture | Self::Normal | Self::UvOffset | Self::LevelCap | Self::LodTint => "",
        }
    }

    /// Steps that are the brightest heat.
    pub const STEPS_TOP: u32 = 64;

    /// Levels that are the brightest heat: a field of 4,096 texels has as many.
    pub const LEVELS_TOP: u32 = 12;

    /// The view of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|shows| shows.name() == name)
    }

    /// What the panel calls it.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Picture => "Picture",
            Self::Height => "Height",
            Self::Normal => "Normals",
            Self::UvOffset => "Offset of the texture",
            Self::Visibility => "Visibility of the light",
            Self::Steps => "Steps a pixel",
            Self::Level => "Level of the pyramid",
            Self::LevelCap => "Cap of the level",
            Self::Error => "Error against exact",
            Self::MipLevel => "Mip level",
            Self::LodTint => "Level of detail in blue",
        }
    }
}
