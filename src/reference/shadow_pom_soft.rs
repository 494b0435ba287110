//! Soft shadows after \[POM\] §3.2. Specification of `shaders/surface/shadow_pom_soft.wgsl`, which derives the formula.

use super::{HeightField, Ray};

/// How a point's light is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Samples along the way to the light: three quarters look for the blocker, one quarter for its edge.
    pub count: u32,
    /// How fast a blocker darkens: the inverse of the light's height over the horizon's tangent, 1 / strength.
    pub strength: f64,
}

/// The share of the light that arrives.
pub fn shadow(field: &HeightField, ray: &Ray, sampling: Sampling) -> f64 {
    let surface = field.bilinear(ray.lattice_at(0.0));
    let span = 1.0 - surface;
    // How much steeper than the light one sees the surface at t: above 0 it stands in the way.
    let excess = |t: f64| (field.bilinear(ray.lattice_at(t)) - surface) / t - 1.0;

    let edge = sampling.count / 4;
    let coarse = sampling.count - edge;
    let place = |i: u32| span * ((f64::from(i) - 0.5) / f64::from(coarse)).max(0.0).powf(1.5);
    if span <= 0.0 {
        return 1.0;
    }
    let (mut most, mut at, mut before) = (0.0, 0.0, 0.0);
    for i in 1..=coarse {
        if excess(place(i)) > most {
            (most, at, before) = (excess(place(i)), place(i), place(i - 1));
        }
    }
    if most > 0.0 {
        for _ in 0..edge {
            let middle = 0.5 * (before + at);
            if excess(middle) > most {
                (most, at) = (excess(middle), middle);
            } else {
                before = middle;
            }
        }
    }
    1.0 - (sampling.strength * most).clamp(0.0, 1.0)
}
