//! The terrain of scene `relief`: all that is hard to trace, side by side.

use std::f64::consts::TAU;

use super::noise::{gradient_octaves, hash_cell, hash_u32, ridged_octaves, smoothstep};

/// A landscape that is hard to trace: ridges, terraces, a stair, columns, and spikes a few texels thin.
pub(super) struct Terrain {
    salt: u32,
    spikes: Vec<[f64; 4]>,
}

impl Terrain {
    pub(super) fn new(seed: u64) -> Self {
        let salt = hash_u32(seed as u32 ^ hash_u32((seed >> 32) as u32));
        let random = |index: i32, salt_offset| hash_cell([index, 0], salt.wrapping_add(salt_offset));
        // Along a ring round the middle, where they stand before the plain.
        let spikes = (0..17)
            .map(|index| {
                let angle = TAU * (f64::from(index) + 0.6 * random(index, 1)) / 17.0;
                let radius = 0.30 + 0.13 * random(index, 2);
                let base = 0.008 + 0.010 * random(index, 3);
                [0.5 + radius * angle.cos(), 0.5 + radius * angle.sin(), base, 0.62 + 0.38 * random(index, 4)]
            })
            .collect();
        Self { salt, spikes }
    }

    /// Height at a position in widths of the plane.
    pub(super) fn height(&self, u: f64, v: f64) -> f64 {
        let noise =
            |scale: f64, salt: u32, octaves| gradient_octaves(u * scale, v * scale, self.salt.wrapping_add(salt), octaves);
        let warp = [0.16 * noise(2.3, 20, 3), 0.16 * noise(2.3, 30, 3)];
        let (x, y) = (u + warp[0], v + warp[1]);
        // A massif in the middle, a plain round it.
        let from_middle = (x - 0.49).hypot(1.15 * (y - 0.47));
        let massif = 1.0 - smoothstep(0.06, 0.47, from_middle);
        let ridges = ridged_octaves(x * 4.1, y * 4.1, self.salt.wrapping_add(40), 7);
        let plain = 0.10 + 0.05 * noise(3.0, 60, 5) + 0.012 * noise(34.0, 70, 3);
        let land = plain + massif * (0.16 + 0.70 * ridges * (0.45 + 0.55 * massif));
        // Terraces on one flank: level treads, steep risers.
        let tread = 0.062;
        let step = (land / tread).floor();
        let terraced = tread * (step + smoothstep(0.74, 0.96, land / tread - step));
        let flank = smoothstep(0.02, 0.10, (u - 0.53) + 0.9 * (v - 0.58)) * smoothstep(0.12, 0.17, land);
        let mut height = land + (terraced - land) * flank;
        height = height.max(stair(u, v)).max(columns(u, v));
        for [x, y, base, top] in &self.spikes {
            let distance = (u - x).hypot(v - y);
            if distance < *base {
                height = height.max(top * (1.0 - distance / base));
            }
        }
        height
    }
}

/// A stepped pyramid in the lower left corner.
fn stair(u: f64, v: f64) -> f64 {
    let distance = (u - 0.17).abs().max((v - 0.83).abs());
    let step = 0.014;
    if distance > 9.0 * step { 0.0 } else { 0.78 - 0.075 * (distance / step).floor() }
}

/// A field of columns in the upper right corner, each of its own height.
fn columns(u: f64, v: f64) -> f64 {
    let (x, y) = ((u - 0.70) / 0.038, (v - 0.06) / 0.038);
    if !(0.0..6.0).contains(&x) || !(0.0..6.0).contains(&y) {
        return 0.0;
    }
    let cell = [x.floor() as i32, y.floor() as i32];
    let from_centre = (x - x.floor() - 0.5).hypot(y - y.floor() - 0.5);
    if from_centre < 0.36 { 0.38 + 0.55 * hash_cell(cell, 91) } else { 0.16 }
}
