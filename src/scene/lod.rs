//! Level of detail: how much of the effect a pixel gets that sees much of the surface at once.

use serde::{Deserialize, Serialize};

use super::Range;

/// Mip levels that a threshold may be: beyond the last, fields have none.
pub const LOD_THRESHOLD: Range = Range::from_to(0.0, 16.0, "mip levels");

/// Level of detail (\[POM\] §3.3). A pixel's mip level is the log₂ of its longer side on the surface, in texels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Lod {
    /// The mip level beyond which normal mapping alone is left, and nothing is marched. Over the level before, the one becomes the
    /// other; until then searches take fewer samples the larger the pixel is, and traversals stop at cells a fraction of it. Absent:
    /// every pixel gets the full effect. \[POM\] uses 4.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threshold: Option<f32>,
    /// Whether `exact` stays exact all the same. Else it, too, stops at cells an eighth of a pixel (\[PDM\] §3.4).
    pub keep_exact: bool,
    /// Whether light falls on what a pixel sees of the surface, not on one point of it, where `threshold` is absent: by means of
    /// normals and heights, roughness for the differences that they average away, and no shadows smaller than itself. With a
    /// threshold it always does.
    pub filter: bool,
}

impl Lod {
    /// The threshold of \[POM\]'s examples.
    pub const USUAL_THRESHOLD: f32 = 4.0;

    /// Whether light falls on what a pixel sees of the surface.
    pub fn filters(&self) -> bool {
        self.filter || self.threshold.is_some()
    }
}

impl Default for Lod {
    fn default() -> Self {
        Self { threshold: None, keep_exact: true, filter: false }
    }
}
