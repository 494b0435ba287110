//! Parallax occlusion mapping: a linear search, then the ray against the last linear segment of the profile (\[POM\] §3.1).
//! Specification of `shaders/surface/trace_pom.wgsl`.

use super::{HeightField, Hit, Ray};

/// The number of samples, a real number: `range[1]` seen edge-on, `range[0]` seen head-on.
///
/// \[POM\] eq. 1 prints it the other way round; its text and \[Zink\]'s interpolation mean this.
pub fn samples(travel_metres: [f64; 2], depth_metres: f64, range: [f64; 2]) -> f64 {
    let cosine = depth_metres / (travel_metres[0].powi(2) + travel_metres[1].powi(2) + depth_metres.powi(2)).sqrt();
    (range[1] + (range[0] - range[1]) * cosine.clamp(0.0, 1.0)).max(1.0)
}

/// Where the ray meets the profile that is linear between samples 1/`samples` apart, the last one at the floor.
pub fn trace(field: &HeightField, ray: &Ray, samples: f64) -> Hit {
    let floor = f64::from(ray.t_end);
    let gap = |t: f64| ray.height_at(t) - field.bilinear(ray.lattice_at(t));
    let mut above = (0.0, gap(0.0));
    if above.1 <= 0.0 {
        return Hit::on(ray, 0.0, 1);
    }
    for step in 1_u32.. {
        let t = (f64::from(step) / samples * floor).min(floor);
        let below = (t, gap(t));
        if below.1 <= 0.0 {
            let share = above.1 / (above.1 - below.1);
            return Hit::on(ray, above.0 + share * (below.0 - above.0), step + 1);
        }
        if t == floor {
            // The field is nowhere under 0: only rounding leaves a gap here.
            return Hit::on(ray, t, step + 1);
        }
        above = below;
    }
    unreachable!("t reaches the floor after as many steps as there are samples")
}
