//! A planet without air: plains, highlands and craters upon a sphere, mapped by longitude and latitude.
//!
//! Everything is a function of the point on the sphere, so nothing has a seam and nothing is pinched where meridians meet. At the
//! poles themselves the relief is level, at one height for both: a row of the field is one point there, and where the field wraps the
//! two poles are neighbours.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::noise::{gradient_octaves_3, hash_cell, hash_u32, smoothstep};

/// How many craters, from the largest to the smallest.
const CRATERS: i32 = 640;

/// Height of the poles.
const POLE_HEIGHT: f64 = 0.5;

/// Angle from a pole within which the relief becomes level, radians.
const POLE_ANGLE: f64 = 0.035;

/// A planet of one seed.
pub(super) struct Planet {
    salt: u32,
    craters: Vec<Crater>,
}

/// A bowl with a rim, and a peak in the middle if it is large.
struct Crater {
    centre: DVec3,
    /// Radius of the rim, radians.
    radius: f64,
    /// How much of it time has left, 0 to 1.
    fresh: f64,
}

impl Planet {
    pub(super) fn new(seed: u64) -> Self {
        let salt = hash_u32(seed as u32 ^ hash_u32((seed >> 32) as u32 ^ 0x9e37));
        let random = |index: i32, of: u32| hash_cell([index, 7], salt.wrapping_add(of));
        let craters = (0..CRATERS)
            .map(|index| {
                let (z, longitude) = (2.0 * random(index, 1) - 1.0, TAU * random(index, 2));
                let across = (1.0 - z * z).sqrt();
                // Numbers fall with the square of the radius, as on the moon.
                let radius = 0.024 / (f64::from(index + 1) / f64::from(CRATERS)).sqrt().max(0.055);
                let centre = DVec3::new(across * longitude.cos(), z, across * longitude.sin());
                Crater { centre, radius: radius * (0.8 + 0.4 * random(index, 3)), fresh: 0.35 + 0.65 * random(index, 4) }
            })
            .collect();
        Self { salt, craters }
    }

    /// Height at texture coordinates: longitude along u, from the north pole down along v.
    pub(super) fn height(&self, u: f64, v: f64) -> f64 {
        let (longitude, from_north) = (TAU * u, PI * v);
        let at = DVec3::new(from_north.sin() * longitude.cos(), from_north.cos(), from_north.sin() * longitude.sin());
        let noise = |scale: f64, salt: u32, octaves| gradient_octaves_3(at * scale, self.salt.wrapping_add(salt), octaves);
        let warp = DVec3::new(noise(1.6, 10, 3), noise(1.6, 20, 3), noise(1.6, 30, 3));
        let lands = gradient_octaves_3(at * 1.5 + 0.55 * warp, self.salt.wrapping_add(40), 7);
        // Plains of old lava below, rough highlands above.
        let high = smoothstep(-0.16, 0.10, lands);
        let rough = 0.05 * noise(9.0, 60, 5) * (0.35 + high);
        let mut height = 0.50 + 0.14 * (high - 0.5) + 0.20 * lands * (0.35 + 0.65 * high) + rough;
        for crater in &self.craters {
            let reach = 2.2 * crater.radius;
            let cosine = at.dot(crater.centre);
            // A cosine leaves most of them without the price of an angle.
            if cosine > 1.0 - 0.5 * reach * reach {
                let angle = cosine.clamp(-1.0, 1.0).acos();
                height += crater.profile(angle / crater.radius, noise(14.0, 70, 3));
            }
        }
        let from_pole = from_north.min(PI - from_north);
        POLE_HEIGHT + (height.clamp(0.0, 1.0) - POLE_HEIGHT) * smoothstep(0.0, POLE_ANGLE, from_pole)
    }
}

impl Crater {
    /// Height added at a distance from the middle, in radii.
    fn profile(&self, distance: f64, roughness: f64) -> f64 {
        let distance = distance * (1.0 + 0.10 * roughness);
        let depth = self.fresh * (1.5 * self.radius).clamp(0.035, 0.20);
        // A floor below, a wall that steepens toward the rim, and a blanket of what was thrown out.
        let bowl = if distance < 1.0 { -1.0 + 1.35 * smoothstep(0.35, 1.0, distance) } else { 0.0 };
        let blanket = if distance < 1.0 { 0.0 } else { 0.35 * (1.0 - smoothstep(1.0, 2.1, distance)).powi(2) };
        let peak = if self.radius > 0.09 { 0.55 * (1.0 - smoothstep(0.0, 0.22, distance)) } else { 0.0 };
        depth * (bowl + blanket + peak)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_no_seam_and_no_pinch() {
        let planet = Planet::new(3);
        for step in 0..200 {
            let v = (f64::from(step) + 0.5) / 200.0;
            assert!((planet.height(0.0, v) - planet.height(1.0, v)).abs() < 1e-9, "the seam at v = {v}");
        }
        // Both poles are one height, and round a pole the relief changes no faster than elsewhere.
        for u in [0.0, 0.13, 0.5, 0.77] {
            assert_eq!([planet.height(u, 0.0), planet.height(u, 1.0)], [POLE_HEIGHT; 2]);
        }
        let steepest = |v: f64| {
            let rise = |step: i32| {
                let u = f64::from(step) / 720.0;
                (planet.height(u + 1.0 / 720.0, v) - planet.height(u, v)).abs() / (TAU / 720.0 * (PI * v).sin())
            };
            (0..720).map(rise).fold(0.0, f64::max)
        };
        let equator = steepest(0.5).max(steepest(0.35)).max(steepest(0.62));
        for v in [0.004, 0.01, 0.02, 0.98, 0.995] {
            assert!(steepest(v) < 1.5 * equator, "at v = {v} {} for {equator}", steepest(v));
        }
    }

    #[test]
    fn heights_use_their_range() {
        let planet = Planet::new(0);
        let heights: Vec<f64> =
            (0..64 * 32).map(|i| planet.height(f64::from(i % 64) / 64.0, (f64::from(i / 64) + 0.5) / 32.0)).collect();
        let (low, high) = heights.iter().fold((1.0_f64, 0.0_f64), |(low, high), height| (low.min(*height), high.max(*height)));
        assert!(low < 0.30 && high > 0.62, "from {low} to {high}");
        let clipped = heights.iter().filter(|height| **height == 0.0 || **height == 1.0).count();
        assert!(clipped < 10, "{clipped} of {} lie on a bound", heights.len());
    }
}
