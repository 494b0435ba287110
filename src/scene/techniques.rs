//! What single techniques let one choose.

use serde::{Deserialize, Serialize};

/// How `pom` and `pom-linear` choose how many samples a ray takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum PomCounts {
    /// By the angle between ray and surface (\[POM\] eq. 1).
    #[default]
    Angle = 0,
    /// One for each texel that the parallax offset crosses (\[Zink\], "Algorithm Metrics").
    Texels = 1,
}

impl PomCounts {
    /// Every choice there is, in the order of the lists that users see.
    pub const ALL: &'static [Self] = &[Self::Angle, Self::Texels];

    /// Its name on the command line and in scenes.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Angle => "angle",
            Self::Texels => "texels",
        }
    }

    /// What the panel calls it.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Angle => "By the angle",
            Self::Texels => "By crossed texels",
        }
    }
}

/// What `pyramid` makes of the column that a ray meets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum PyramidLeaf {
    /// The surface is the column itself: blocks (\[PDM\] fig. 14, top).
    Nearest = 0,
    /// The ray against the bilinear surface half a pixel before and behind it (\[PDM\] §3.3).
    #[default]
    Refined = 1,
}

impl PyramidLeaf {
    /// Every choice there is, in the order of the lists that users see.
    pub const ALL: &'static [Self] = &[Self::Nearest, Self::Refined];

    /// Its name on the command line and in scenes.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nearest => "nearest",
            Self::Refined => "refined",
        }
    }

    /// What the panel calls it.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Nearest => "Nearest texel",
            Self::Refined => "Half-pixel refinement",
        }
    }
}
