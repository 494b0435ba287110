//! Exact: where the ray first meets the bilinear surface. Specification of `shaders/surface/trace_exact.wgsl`.

use super::traversal::Line;
use super::{HeightField, Hit, Ray};

/// The first point of a view ray that is on the surface. There is one: the ray ends on the floor, h = 0, and the surface is
/// nowhere below.
pub fn trace(field: &HeightField, ray: &Ray) -> Hit {
    let floor = f64::from(ray.t_end);
    // Above the highest texel there is nothing to meet.
    let begin = (f64::from(ray.height) - field.range[1]).max(0.0);
    Hit::on(ray, Line::from(ray).meets(field, begin, floor).unwrap_or(floor), 1)
}
