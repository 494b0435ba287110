//! Hard shadows: whether anything is in the way to the light. Specification of `shaders/surface/shadow_hard.wgsl`.

use super::traversal::Line;
use super::{HeightField, Ray};

/// The way from the surface at the ray's lattice position toward the light, to where nothing is higher.
///
/// It starts upon the surface, whatever the ray's own height: a technique that finds the surface only nearly would shadow
/// itself.
pub fn way_to_light(field: &HeightField, ray: &Ray) -> (Line, f64) {
    let line = Line::from(ray);
    let height = field.bilinear(line.lattice);
    (Line { height, ..line }, field.range[1] - height)
}

/// The share of the light that arrives: 0 where the surface rises above the ray on its way, else 1.
pub fn shadow(field: &HeightField, ray: &Ray) -> f64 {
    let (line, end) = way_to_light(field, ray);
    if escapes(field, &line, end) { 1.0 } else { 0.0 }
}

/// Whether a line that starts upon the surface is nowhere under it before `end`.
pub fn escapes(field: &HeightField, line: &Line, end: f64) -> bool {
    let mut stretches = line.stretches(field, 0.0, end);
    // The first stretch starts upon the surface, above nothing: its slope decides.
    let blocked = stretches.next().is_some_and(|mut first| {
        first.gap[0] = 0.0;
        first.lowest() < 0.0
    }) || stretches.any(|stretch| stretch.lowest() < 0.0);
    !blocked
}
