//! Parallax mapping (\[Kaneko\]): as far down the ray as the surface is deep where the ray starts. Specification of
//! `shaders/surface/trace_parallax.wgsl`.

use super::{HeightField, Hit, Ray, march};

/// Where the ray is as high as the surface under its start.
pub fn trace(field: &HeightField, ray: &Ray) -> Hit {
    let gap = march::gap(field, ray, 0.0);
    if gap <= 0.0 {
        return Hit::on(ray, 0.0, 1);
    }
    let t = gap / -f64::from(ray.rise);
    if (0.0..=f64::from(ray.t_end)).contains(&t) { Hit::on(ray, t, 1) } else { Hit::end(ray, 1) }
}
