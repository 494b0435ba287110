//! Parallax mapping with offset limiting (\[Welsh\]). Specification of `shaders/surface/trace_parallax_limited.wgsl`.

use super::{HeightField, Hit, Ray, trace_parallax};
use crate::surface::probe;

/// Where the ray has travelled, over the polygon, as far as the offset of [`super::trace_parallax`] times the cosine of its angle.
pub fn trace(field: &HeightField, ray: &Ray, cosine: f64) -> Hit {
    let whole = trace_parallax::trace(field, ray);
    if whole.status == probe::Hit::HIT { Hit::on(ray, cosine * whole.t, 1) } else { whole }
}
