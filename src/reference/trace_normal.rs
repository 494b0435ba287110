//! Normal mapping: the surface stays at the polygon. Specification of `shaders/surface/trace_normal.wgsl`.

use super::{Hit, Ray};

/// Where the ray starts.
pub fn trace(ray: &Ray) -> Hit {
    Hit::on(ray, 0.0, 1)
}
