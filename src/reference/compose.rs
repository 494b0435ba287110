//! Composition: what lies beneath and the layers over it become one height, clamped to [0, 1] at the top. Specification of
//! `shaders/field/compose.wgsl`.

use crate::scene::{Layer, LayerBlend};

/// The height of one texel before it is clamped: what lies beneath, and each layer with its value, from the ground up.
///
/// Made in f32, as the kernel makes it: the bound that it is held to is the rounding of one product and one sum a layer.
pub fn blend(beneath: f32, layers: &[(Layer, f32)]) -> f32 {
    layers.iter().fold(beneath, |below, &(Layer { blend, amplitude }, value)| match blend {
        LayerBlend::Add => below + amplitude * value,
        LayerBlend::Multiply => below * (1.0 + amplitude * (value - 1.0)),
        LayerBlend::Min => below.min(amplitude * value),
        LayerBlend::Max => below.max(amplitude * value),
        LayerBlend::Replace => below * (1.0 - amplitude) + amplitude * value,
    })
}

/// Heights as the field holds them, and how many of them were out of range: NaN becomes 0, ±Inf the bound that it exceeds.
pub fn clamped(heights: impl IntoIterator<Item = f32>) -> (Vec<f32>, u32) {
    let mut clipped = 0;
    let heights = heights
        .into_iter()
        .map(|value| {
            let (height, touched) = into_range(value);
            clipped += u32::from(touched);
            height
        })
        .collect();
    (heights, clipped)
}

/// A value clamped to [0, 1], and whether it was out of range. −0 is in range and becomes 0.
pub fn into_range(value: f32) -> (f32, bool) {
    if value.is_nan() || value < 0.0 {
        (0.0, true)
    } else if value > 1.0 {
        (1.0, true)
    } else {
        (value.abs(), false)
    }
}
