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
        /// Parallax occlusion mapping: a linear search, then the ray against the last linear segment (\[POM\] §3.1).
        Pom = "pom", "trace_pom", "Parallax occlusion mapping";
        /// Exact intersection with the bilinear surface, through the pyramid of cell bounds.
        Exact = "exact", "trace_exact", "Exact";
    }
}

choices! {
    /// How much of the light a point sees: a file that defines `fn shadow(ray: Ray) -> f32`, the visibility.
    Shadow {
        /// Nothing blocks the light.
        None = "none", "shadow_none", "None";
        /// Weighted samples along the light ray (\[POM\] §3.2).
        PomSoft = "pom-soft", "shadow_pom_soft", "POM soft";
        /// Any hit of the exact traversal.
        Hard = "hard", "shadow_hard", "Hard (exact)";
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
        /// A picture.
        Image = "image", "albedo_image", "Image";
        /// Rock, dust and ice of a planet without air.
        Planet = "planet", "albedo_planet", "Planet";
        /// Grass, forest, rock and snow, by height and slope.
        Terrain = "terrain", "albedo_terrain", "Terrain";
        /// Clear water over a floor.
        Water = "water", "albedo_water", "Water";
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
}

impl Shows {
    /// Every view, in the order in which a key cycles them.
    pub const ALL: &'static [Self] = &[Self::Picture, Self::Height, Self::Normal, Self::Visibility, Self::Steps];

    /// What the panel calls it.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Picture => "Picture",
            Self::Height => "Height",
            Self::Normal => "Normals",
            Self::Visibility => "Visibility of the light",
            Self::Steps => "Steps a pixel",
        }
    }
}
