//! Steep parallax mapping (\[Steep\]): equal layers, the first of them that is not above the surface. Specification of
//! `shaders/surface/trace_steep.wgsl`.

use super::{HeightField, Hit, Ray, march};

/// The first layer that is not above the surface.
pub fn trace(field: &HeightField, ray: &Ray, layers: f64) -> Hit {
    march::first_under(field, ray, layers)
}
