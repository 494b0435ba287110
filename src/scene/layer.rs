//! How the heights of a source meet what lies beneath it.

use serde::{Deserialize, Serialize};

/// How a layer's heights meet what lies beneath it. With b what lies beneath, v the layer's own value and a its amplitude:
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum LayerBlend {
    /// b + a·v.
    #[default]
    Add = 0,
    /// b·(1 + a·(v − 1)): v where a is 1.
    Multiply = 1,
    /// The lower of b and a·v.
    Min = 2,
    /// The higher of b and a·v.
    Max = 3,
    /// b·(1 − a) + a·v: v alone, to the bit, where a is 1.
    Replace = 4,
}

impl LayerBlend {
    /// Every blend.
    pub const ALL: [Self; 5] = [Self::Add, Self::Multiply, Self::Min, Self::Max, Self::Replace];

    /// What the panel calls it.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Add => "Add",
            Self::Multiply => "Multiply",
            Self::Min => "Lower of both",
            Self::Max => "Higher of both",
            Self::Replace => "Replace",
        }
    }
}

/// A layer of the stack, as composition sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// How its heights meet what lies beneath.
    pub blend: LayerBlend,
    /// What its values are multiplied by, or how much they count.
    pub amplitude: f32,
}
