//! Composition: relief and waves become the height field proper, clamped to [0, 1]. Specification of
//! `shaders/field/compose.wgsl`.

/// The height field, and how many of its texels were out of range: NaN becomes 0, ±Inf the bound that it exceeds.
///
/// `wave` is the displacement in units of `amplitude`; without waves the amplitude is 0 and it is not looked at. The sum is
/// made in f32, as the kernel makes it: the bound that it is held to is the rounding of one product and one sum.
pub fn compose(relief: &[f32], wave: &[f32], amplitude: f32) -> (Vec<f32>, u32) {
    let mut clipped = 0;
    let heights = relief
        .iter()
        .enumerate()
        .map(|(texel, relief)| {
            let value = if amplitude == 0.0 { *relief } else { relief + amplitude * wave[texel] };
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
