//! Parallax occlusion mapping: a linear search, then the ray against the last linear segment of the profile (\[POM\] §3.1).
//! Specification of `shaders/surface/trace_pom.wgsl`.

use super::{HeightField, Hit, Ray, march};

/// Where the ray meets the profile that is linear between samples 1/`samples` of the way apart.
pub fn trace(field: &HeightField, ray: &Ray, samples: f64) -> Hit {
    let found = march::march(field, ray, samples);
    match (found.above, found.under) {
        (Some((above, gap_above)), Some((under, gap_under))) => {
            let share = gap_above / (gap_above - gap_under);
            Hit::on(ray, above + share * (under - above), found.steps)
        }
        (None, Some(_)) => Hit::on(ray, 0.0, found.steps),
        (_, None) => Hit::end(ray, found.steps),
    }
}
