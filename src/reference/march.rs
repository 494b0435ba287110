//! March: samples at equal distances down a ray, up to the first that is not above the surface, and how many of them.
//! Specification of `shaders/surface/march.wgsl`.

use super::{HeightField, Hit, Ray};

/// Where a ray goes under the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct March {
    /// The last sample above the surface: its parameter and its height above it. `None` where the ray starts under it.
    pub above: Option<(f64, f64)>,
    /// The first sample that is not above it. `None` where the ray reached its end.
    pub under: Option<(f64, f64)>,
    /// Samples taken.
    pub steps: u32,
}

/// Height of a ray above the surface at t.
pub fn gap(field: &HeightField, ray: &Ray, t: f64) -> f64 {
    ray.height_at(t) - field.bilinear(ray.lattice_at(t))
}

/// Samples 1/`samples` of the way apart, the last one at the end.
pub fn march(field: &HeightField, ray: &Ray, samples: f64) -> March {
    let end = f64::from(ray.t_end);
    let mut above = None;
    for index in 0_u32.. {
        let t = (f64::from(index) / samples * end).min(end);
        let gap = gap(field, ray, t);
        let steps = index + 1;
        if gap <= 0.0 {
            return March { above, under: Some((t, gap)), steps };
        }
        if t == end {
            return March { above, under: None, steps };
        }
        above = Some((t, gap));
    }
    unreachable!("t reaches the end after as many steps as there are samples")
}

/// The first sample that is not above the surface, as a hit.
pub fn first_under(field: &HeightField, ray: &Ray, samples: f64) -> Hit {
    let found = march(field, ray, samples);
    found.under.map_or(Hit::end(ray, found.steps), |(t, _)| Hit::on(ray, t, found.steps))
}

/// Cosine between a ray and the normal of its polygon, from what it travels along u and v and what it falls.
pub fn cosine(travel_metres: [f64; 2], fall_metres: f64) -> f64 {
    let length = travel_metres[0].hypot(travel_metres[1]).hypot(fall_metres);
    if length == 0.0 { 0.0 } else { fall_metres.abs() / length }
}

/// Samples by the angle, a real number: `range[1]` seen edge-on, `range[0]` seen head-on.
///
/// \[POM\] eq. 1 prints it the other way round; its text and \[Zink\]'s interpolation mean this.
pub fn samples_by_angle(cosine: f64, range: [f64; 2]) -> f64 {
    (range[1] + (range[0] - range[1]) * cosine.clamp(0.0, 1.0)).max(1.0)
}

/// Samples by texels (\[Zink\], "Algorithm Metrics"): as many as the offset crosses, within a range.
pub fn samples_by_texels(ray: &Ray, range: [f64; 2]) -> f64 {
    let travel = ray.travel.map(f64::from);
    let crossed = travel[0].hypot(travel[1]) * f64::from(ray.t_end);
    crossed.max(range[0]).min(range[1]).max(1.0)
}
