//! The linear search of parallax occlusion mapping alone (\[POM\] fig. 4). Specification of
//! `shaders/surface/trace_pom_linear.wgsl`.

use super::{HeightField, Hit, Ray, march};

/// The first of the samples, 1/`samples` of the way apart, that is not above the surface.
pub fn trace(field: &HeightField, ray: &Ray, samples: f64) -> Hit {
    march::first_under(field, ray, samples)
}
