//! Shadows after \[Steep\]. Specification of `shaders/surface/shadow_steep.wgsl`.

use super::{HeightField, Ray};

/// The share of the light that arrives: 0 where one of the layers, `count` to the whole height range, is under the surface.
pub fn shadow(field: &HeightField, ray: &Ray, count: f64) -> f64 {
    let surface = field.bilinear(ray.lattice_at(0.0));
    let mut layers = (1..).map(|layer| f64::from(layer) / count).take_while(|t| surface + t < 1.0);
    if layers.any(|t| field.bilinear(ray.lattice_at(t)) > surface + t) { 0.0 } else { 1.0 }
}
