//! No shadow. Specification of `shaders/surface/shadow_none.wgsl`.

use super::Ray;

/// The share of the light that arrives: all of it.
pub fn shadow(_ray: &Ray) -> f64 {
    1.0
}
