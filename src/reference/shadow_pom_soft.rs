//! Soft shadows after \[POM\] §3.2. Specification of `shaders/surface/shadow_pom_soft.wgsl`, which derives the formula.

use super::{HeightField, Ray};

/// How a point's light is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Samples along the way to the light: five eighths look for the blocker, three eighths for its edge.
    pub count: u32,
    /// How fast a blocker darkens: the inverse of the light's height over the horizon's tangent, 1 / strength.
    pub strength: f64,
}

/// The share of the light that arrives.
pub fn shadow(field: &HeightField, ray: &Ray, sampling: Sampling) -> f64 {
    let surface = field.bilinear(ray.lattice_at(0.0));
    let span = 1.0 - surface;
    if span <= 0.0 {
        return 1.0;
    }
    // Half a texel away: nearer ones say no more than the slope.
    let near = 0.5 / f64::from(ray.travel[0]).hypot(f64::from(ray.travel[1])).max(1e-6);
    // How much steeper than the light one sees the surface at t: above 0 it stands in the way.
    let excess = |t: f64| (field.bilinear(ray.lattice_at(t)) - surface - t) / t.max(near);

    // Look for the strongest blocker, then between it and the sample before for its edge.
    let edge = sampling.count * 3 / 8;
    let borders = if edge >= 2 { 2 } else { 0 };
    let coarse = sampling.count - edge;
    let place = |i: u32| span * ((f64::from(i) - 0.5) / f64::from(coarse)).max(0.0).powf(1.5);
    let (mut most, mut at, mut before) = (-1.0, 0.0, 0.0);
    for i in 1..=coarse {
        if excess(place(i)) > most {
            (most, at, before) = (excess(place(i)), place(i), place(i - 1));
        }
    }
    for _ in 0..edge - borders {
        let middle = 0.5 * (before + at);
        if excess(middle) > most {
            (most, at) = (excess(middle), middle);
        } else {
            before = middle;
        }
    }
    // The bilinear profile has its ridges on the borders of cells: those around the best sample, on the faster axis.
    let axis = usize::from(ray.travel[1].abs() > ray.travel[0].abs());
    let (origin, travel) = (f64::from(ray.lattice[axis]), f64::from(ray.travel[axis]));
    if travel.abs() >= 1e-6 {
        let border = ray.lattice_at(at)[axis].floor();
        for border in [border, border + 1.0].into_iter().take(borders as usize) {
            most = most.max(excess(((border - origin) / travel).max(0.0)));
        }
    }
    1.0 - (sampling.strength * most).clamp(0.0, 1.0)
}
