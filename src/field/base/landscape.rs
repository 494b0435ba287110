//! A landscape: mountains with gullies that run down their slopes, over a valley floor.
//!
//! Erosion is imitated, not simulated, so that it stays a function of the place: on top of smooth mountains each octave adds furrows
//! that run along the slope of everything coarser, deep where it is steep.

use glam::DVec2;

use super::noise::{gradient_octaves, hash_cell, hash_u32, smoothstep};

/// Octaves of furrows: from a twelfth of the landscape down to some texels.
const FURROW_OCTAVES: u32 = 5;

/// A landscape of one seed.
pub(super) struct Landscape {
    salt: u32,
}

impl Landscape {
    pub(super) fn new(seed: u64) -> Self {
        Self { salt: hash_u32(seed as u32 ^ hash_u32((seed >> 32) as u32 ^ 0x51ed)) }
    }

    /// Height at a position in widths of the plane.
    pub(super) fn height(&self, u: f64, v: f64) -> f64 {
        let at = DVec2::new(u, v);
        let (mut height, mut slope) = self.mountains(at);
        let (mut frequency, mut strength) = (11.0, 0.060);
        for octave in 0..FURROW_OCTAVES {
            let (furrow, gradient) = furrows(at * frequency, slope, self.salt.wrapping_add(100 + octave));
            // Level ground holds no gully; in the valleys what came down has filled them.
            let deep = strength * smoothstep(0.15, 1.3, slope.length()) * smoothstep(0.06, 0.30, height);
            height += deep * (furrow - 0.25);
            slope += deep * frequency * gradient;
            frequency *= 1.95;
            strength *= 0.50;
        }
        let rough = gradient_octaves(u * 60.0, v * 60.0, self.salt.wrapping_add(80), 3);
        (height + 0.006 * rough * smoothstep(0.08, 0.3, height)).clamp(0.0, 1.0)
    }

    /// The smooth mountains, and their gradient by differences.
    fn mountains(&self, at: DVec2) -> (f64, DVec2) {
        let step = 2e-4;
        let height = |offset: DVec2| self.mountain(at + offset);
        let here = height(DVec2::ZERO);
        let slope = DVec2::new(height(DVec2::X * step) - here, height(DVec2::Y * step) - here) / step;
        (here, slope)
    }

    fn mountain(&self, at: DVec2) -> f64 {
        let noise =
            |scale: f64, salt: u32, octaves| gradient_octaves(at.x * scale, at.y * scale, self.salt.wrapping_add(salt), octaves);
        let warp = 0.10 * DVec2::new(noise(1.7, 10, 2), noise(1.7, 20, 2));
        let warped = at + warp;
        let fold = |scale: f64, salt: u32| {
            1.0 - 1.7 * gradient_octaves(warped.x * scale, warped.y * scale, self.salt.wrapping_add(salt), 2).abs()
        };
        let ranges = fold(2.3, 30).max(0.0).powi(2);
        let swell = 0.5 + 0.9 * noise(1.3, 40, 2);
        // A valley winds through from the near left to the far right.
        let course = at.y - 0.62 + 0.45 * (at.x - 0.5) - 0.16 * (5.0 * at.x + 0.6).sin();
        let valley = smoothstep(0.03, 0.34, course.abs());
        0.055 + valley * (0.13 + 0.62 * ranges * smoothstep(0.0, 0.9, swell) + 0.14 * swell)
    }
}

/// Furrows that run along `slope`, in about [−1, 1], and their gradient: waves across the slope, each with its own phase about a
/// jittered centre, blended by distance. So they branch where neighbours disagree, as gullies do.
fn furrows(at: DVec2, slope: DVec2, salt: u32) -> (f64, DVec2) {
    let across = slope.perp().normalize_or(DVec2::X) * 4.6;
    let home = at.floor();
    let (mut sum, mut gradient, mut total) = (0.0, DVec2::ZERO, 1e-9);
    for dy in -1..=1 {
        for dx in -1..=1 {
            let cell = home + DVec2::new(f64::from(dx), f64::from(dy));
            let index = [cell.x as i32, cell.y as i32];
            let jitter = DVec2::new(hash_cell(index, salt), hash_cell(index, salt.wrapping_add(50))) - 0.5;
            let offset = at - (cell + 0.5 + 0.5 * jitter);
            let weight = (1.0 - offset.length_squared() / 1.5).max(0.0).powi(3);
            let (sine, cosine) = offset.dot(across).sin_cos();
            sum += weight * cosine;
            gradient -= weight * sine * across;
            total += weight;
        }
    }
    (sum / total, gradient / total)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn furrows_run_down_the_slope() {
        // Along the slope they hardly change, across it they do.
        let along = DVec2::new(0.6, 0.8);
        let change = |step: DVec2| -> f64 {
            (0..400)
                .map(|i| {
                    let at = DVec2::new(f64::from(i) * 0.137, f64::from(i) * 0.071);
                    (furrows(at + step, along, 5).0 - furrows(at, along, 5).0).abs()
                })
                .sum::<f64>()
        };
        assert!(change(0.2 * along) < 0.4 * change(0.2 * along.perp()));
    }

    #[test]
    fn heights_use_their_range() {
        let landscape = Landscape::new(1);
        let heights: Vec<f64> =
            (0..64 * 64).map(|i| landscape.height(f64::from(i % 64) / 64.0, f64::from(i / 64) / 64.0)).collect();
        let (low, high) = heights.iter().fold((1.0_f64, 0.0_f64), |(low, high), height| (low.min(*height), high.max(*height)));
        assert!(low < 0.1 && high > 0.7, "from {low} to {high}");
        let clipped = heights.iter().filter(|height| **height == 0.0 || **height == 1.0).count();
        assert!(clipped * 50 < heights.len(), "{clipped} of {} lie on a bound", heights.len());
    }
}
