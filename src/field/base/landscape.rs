//! A landscape: an island of mountains, with gullies that run down their slopes and a fjord between them.
//!
//! Erosion is imitated, not simulated, so that it stays a function of the place: on top of smooth mountains each octave adds furrows
//! that run along the slope of everything coarser, deep where it is steep.

use glam::DVec2;

use super::noise::{gradient_octaves, hash_cell, hash_u32, smoothstep};

/// Octaves of furrows: from a twelfth of the landscape down to some texels.
const FURROW_OCTAVES: u32 = 5;

/// Height of the sea, which is level.
const SEA_LEVEL: f64 = 0.05;

/// A landscape of one seed.
pub(super) struct Landscape {
    salt: u32,
}

impl Landscape {
    pub(super) fn new(seed: u64) -> Self {
        Self { salt: hash_u32(seed as u32 ^ hash_u32((seed >> 32) as u32 ^ 0x51ed)) }
    }

    /// The heights of a field of this size, row by row.
    pub(super) fn heights(&self, [width, height]: [u32; 2]) -> Vec<f32> {
        // Positions are in widths of the plane. The smooth mountains once, with a border, for their slopes by differences.
        let at = |x: i64, y: i64| DVec2::new(x as f64 + 0.5, y as f64 + 0.5) / f64::from(width);
        let down = f64::from(height) / f64::from(width);
        let (columns, rows) = (i64::from(width), i64::from(height));
        let smooth: Vec<f64> =
            (-1..=rows).flat_map(|y| (-1..=columns).map(move |x| (x, y))).map(|(x, y)| self.mountain(at(x, y), down)).collect();
        let row = width as usize + 2;
        let of_texel = |x: usize, y: usize| {
            let here = (y + 1) * row + x + 1;
            let rise = |step: usize| (smooth[here + step] - smooth[here - step]) * 0.5 * f64::from(width);
            self.carve(at(x as i64, y as i64), smooth[here], DVec2::new(rise(1), rise(row))) as f32
        };
        (0..height as usize).flat_map(|y| (0..width as usize).map(move |x| (x, y))).map(|(x, y)| of_texel(x, y)).collect()
    }

    /// The height at a place where the smooth mountains have this height and slope.
    fn carve(&self, at: DVec2, mut height: f64, mut slope: DVec2) -> f64 {
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
        let rough = gradient_octaves(at.x * 60.0, at.y * 60.0, self.salt.wrapping_add(80), 3);
        (height + 0.006 * rough * smoothstep(0.08, 0.3, height)).clamp(SEA_LEVEL, 1.0)
    }

    /// The smooth mountains, on a plane that is `down` widths high. Its border is sea, so that nothing ends there.
    fn mountain(&self, at: DVec2, down: f64) -> f64 {
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
        let land = 0.035 + valley * (0.13 + 0.66 * ranges * smoothstep(0.0, 0.9, swell) + 0.14 * swell);
        let from_border = at.min(DVec2::new(1.0, down) - at).min_element();
        let coast = smoothstep(0.03, 0.22, from_border + 0.12 * noise(4.0, 50, 4)) * smoothstep(0.0, 0.05, from_border);
        land * coast + (SEA_LEVEL - 0.05) * (1.0 - coast)
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
    fn it_is_an_island_with_heights_that_use_their_range() {
        let heights = Landscape::new(1).heights([96, 64]);
        let highest = heights.iter().copied().fold(0.0, f32::max);
        assert!(highest > 0.5, "the highest peak has {highest}");
        let count = |of: f32| heights.iter().filter(|height| (**height - of).abs() < 1e-6).count();
        assert!(count(1.0) * 100 < heights.len(), "{} of {} are cut off", count(1.0), heights.len());
        let sea = count(SEA_LEVEL as f32);
        assert!(sea * 8 > heights.len() && sea * 3 < heights.len() * 2, "{sea} of {} are sea", heights.len());
        for (index, height) in heights.iter().enumerate() {
            let (x, y) = (index % 96, index / 96);
            if x == 0 || x == 95 || y == 0 || y == 63 {
                assert!((height - SEA_LEVEL as f32).abs() < 1e-6, "{x}, {y}: {height}");
            }
        }
    }
}
