//! Parallax mapping with offset limiting (\[Welsh\]). Specification of `shaders/surface/trace_parallax_limited.wgsl`.

use super::{HeightField, Hit, Ray, march};

/// Where the ray has travelled, over the polygon, as far as the offset of [`super::trace_parallax`] times the cosine of its angle.
pub fn trace(field: &HeightField, ray: &Ray, cosine: f64) -> Hit {
    let gap = march::gap(field, ray, 0.0);
    if gap <= 0.0 {
        return Hit::on(ray, 0.0, 1);
    }
    let t = cosine * gap / -f64::from(ray.rise);
    // A level ray has a cosine of 0 over a rise of 0: NaN, which lies in no range.
    if (0.0..=f64::from(ray.t_end)).contains(&t) { Hit::on(ray, t, 1) } else { Hit::end(ray, 1) }
}
