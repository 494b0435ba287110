//! Level of detail: what a scene asks of it, as the shaders take it. Shader: `shaders/surface/level_of_detail.wgsl`.
//! Specification: [`crate::reference::level_of_detail`].

use super::Technique;
use crate::scene::Scene;

/// Part of the [`View`](super::View).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "the WGSL twin in shaders/common/view.wgsl documents the fields, and one place is enough")]
pub struct ViewDetail {
    pub threshold: f32,
    pub traces: u32,
    pub filters: u32,
    pub pad: u32,
}

impl ViewDetail {
    /// A threshold that no pixel reaches.
    const NEVER: f32 = 1e30;

    /// What `scene` asks for.
    pub fn new(scene: &Scene) -> Self {
        let kept = scene.trace.technique == Technique::Exact && scene.lod.keep_exact;
        let threshold = scene.lod.threshold.filter(|_| !kept);
        Self {
            threshold: threshold.unwrap_or(Self::NEVER),
            traces: u32::from(threshold.is_some()),
            filters: u32::from(scene.lod.filters()),
            pad: 0,
        }
    }
}

impl Default for ViewDetail {
    fn default() -> Self {
        Self { threshold: Self::NEVER, traces: 0, filters: 0, pad: 0 }
    }
}
