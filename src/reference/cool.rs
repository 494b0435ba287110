//! Heat and glow: the specification of `shaders/field/cool.wgsl`, and of what `shaders/common/material.wgsl` makes of a heat.

use crate::field::material::{GLOWING_MOMENTS, MOMENTS, MOMENTS_PER_FALL, Marks};

/// Moments since a heat, at a moment of the clock; none where it is cold.
pub fn age(heat: u16, moment: f64) -> Option<f64> {
    let since = moment - f64::from(heat.checked_sub(1)?);
    // The clock starts over, and is never so far ahead of a heat that rounding could mean it.
    Some(if since < -400.0 { since + f64::from(MOMENTS) } else { since.max(0.0) })
}

/// How brightly a heat glows, of 1.
pub fn glow(heat: u16, moment: f64) -> f64 {
    age(heat, moment).filter(|age| *age < GLOWING_MOMENTS).map_or(0.0, |age| (-age / MOMENTS_PER_FALL).exp())
}

/// What is left of marks: the heat that still glows.
pub fn cool(marks: Marks, moment: f64) -> Marks {
    let glows = age(marks.heat, moment).is_some_and(|age| age < GLOWING_MOMENTS);
    Marks { heat: if glows { marks.heat } else { 0 }, ..marks }
}
