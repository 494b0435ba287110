//! Drifted snow: long soft dunes, ripples of wind across them, a grain that only the light sees. Where the field wraps, so does it.

use super::noise::{hash_cell, smoothstep};

/// How high above h = 0 the snow lies at least, in heights: what presses it has room.
const FLOOR: f64 = 0.55;

/// The height at a point of a plane of this extent, metres; the plane repeats.
pub(super) fn height(at: [f64; 2], extent: [f64; 2], depth_metres: f64, seed: u64) -> f64 {
    let salt = (seed as u32).wrapping_mul(7919).wrapping_add(91);
    // Features of so many metres, a whole number of them in the plane.
    let octave = |metres: [f64; 2], number: u32| {
        let cells = [0, 1].map(|axis| (extent[axis] / metres[axis]).round().max(1.0));
        tiled_noise(
            [0, 1].map(|axis| at[axis] / extent[axis] * cells[axis]),
            cells.map(|cells| cells as i32),
            salt.wrapping_add(number),
        )
    };
    let dunes = 0.6 * octave([2.6, 2.0], 0) + 0.3 * octave([1.1, 0.9], 1) + 0.1 * octave([0.5, 0.45], 2);
    // Ripples stand across the wind and die out in the lee.
    let ripples = octave([0.34, 0.08], 3) * smoothstep(0.35, 0.75, octave([1.4, 1.1], 4));
    let metres = 0.12 * (dunes - 0.5) + 0.006 * ripples + 0.0012 * octave([0.03, 0.03], 5);
    (FLOOR + (1.0 - FLOOR) * 0.5 + metres / depth_metres).clamp(FLOOR, 1.0)
}

/// Value noise in [0, 1) whose lattice repeats after so many cells.
fn tiled_noise(at: [f64; 2], cells: [i32; 2], salt: u32) -> f64 {
    let low = at.map(f64::floor);
    let fade = |t: f64| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let [s, t] = [0, 1].map(|axis| fade(at[axis] - low[axis]));
    let corner = |dx: i32, dy: i32| {
        let cell = [(low[0] as i32 + dx).rem_euclid(cells[0]), (low[1] as i32 + dy).rem_euclid(cells[1])];
        hash_cell(cell, salt)
    };
    let mix = |low: f64, high: f64, share: f64| low + (high - low) * share;
    mix(mix(corner(0, 0), corner(1, 0), s), mix(corner(0, 1), corner(1, 1), s), t)
}
