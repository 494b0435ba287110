//! Level of detail in f64: the footprint from two rays a little apart. Specification of `shaders/surface/level_of_detail.wgsl`.

use super::{HeightField, ray_map};
use crate::camera::Camera;
use crate::surface::ray_map::Target;

/// The mip level of a pixel, 0 or more: log₂ of the longer of the texel distances to its neighbours on the right and below, by
/// the slopes in its centre. None where the pixel does not look down upon the plane.
pub fn level(camera: &Camera, image_size: [u32; 2], target: &Target, pixel: [f64; 2]) -> Option<f64> {
    // f64 has digits enough to lose half of them.
    const APART: f64 = 1e-5;
    let at = |x: f64, y: f64| Some(ray_map::ray(camera, image_size, target, [pixel[0] + x, pixel[1] + y])?.lattice);
    let slope = |x: f64, y: f64| {
        let (after, before) = (at(x, y)?, at(-x, -y)?);
        Some((after[0] - before[0]).hypot(after[1] - before[1]) / (2.0 * APART))
    };
    Some(slope(APART, 0.0)?.max(slope(0.0, APART)?).log2().max(0.0))
}

/// How far a pixel of this level is flattened to normal mapping: 0 not at all, 1 wholly.
pub fn flattened(level: f64, threshold: f64) -> f64 {
    (level - (threshold - 1.0)).clamp(0.0, 1.0)
}

/// The level of the mean heights at which a traversal stops in a pixel of this level.
pub fn trace_level(level: f64) -> f64 {
    (level - 3.0).max(0.0)
}

/// The height of the plane on which normal mapping is left: above the mean by two fifths of the way to the greatest.
pub fn plane(field: &HeightField) -> f64 {
    let mean = field.heights.iter().map(|height| f64::from(*height)).sum::<f64>() / field.heights.len() as f64;
    mean + 0.4 * (field.range[1] - mean)
}

/// The samples that are left of a count in a pixel of this level.
pub fn samples(count: f64, level: f64) -> f64 {
    (count * (-0.5 * level).exp2()).max(count.min(4.0))
}

/// The exponent of a highlight on normals whose mean has this length (Toksvig 2005).
pub fn shininess(exponent: f64, mean_length: f64) -> f64 {
    1.0 / (1.0 / exponent + (1.0 - mean_length) / mean_length)
}
