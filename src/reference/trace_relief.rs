//! Relief mapping (\[Policarpo\]): a linear search, then a binary search between its last two samples. Specification of
//! `shaders/surface/trace_relief.wgsl`.

use super::{HeightField, Hit, Ray};

/// The share of its offset that depth bias leaves to a ray of this cosine.
pub fn bias(cosine: f64) -> f64 {
    1.0 - (1.0 - cosine).powi(8)
}

/// Where a ray whose offset is shortened to a `share` meets the surface, on the true ray at the same lattice position.
pub fn trace(field: &HeightField, ray: &Ray, linear_steps: f64, binary_steps: u32, share: f64) -> Hit {
    // Only the offset is shortened: the surface is asked at `share · t`, the height at t.
    let gap = |t: f64| ray.height_at(t) - field.bilinear(ray.lattice_at(share * t));
    let end = f64::from(ray.t_end);
    let mut steps = 1;
    let mut above = 0.0;
    let mut under = 0.0;
    while gap(under) > 0.0 {
        if under == end {
            return Hit::end(ray, steps);
        }
        above = under;
        under = (f64::from(steps) / linear_steps * end).min(end);
        steps += 1;
    }
    if under > above {
        for _ in 0..binary_steps {
            let middle = 0.5 * (above + under);
            if gap(middle) > 0.0 {
                above = middle;
            } else {
                under = middle;
            }
            steps += 1;
        }
    }
    Hit::on(ray, share * under, steps)
}
