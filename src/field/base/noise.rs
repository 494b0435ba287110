//! Hashes and noise, the same bits on every machine: additions, products and roots alone, apart from the sines of gradients.

use std::f64::consts::TAU;

pub(super) fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// PCG's output function (O'Neill 2014); the twin of `hash_u32` in `shaders/common/noise.wgsl`.
pub(super) fn hash_u32(x: u32) -> u32 {
    let state = x.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// A number in [0, 1) for a lattice point and a salt; the twin of `hash_cell` in `shaders/common/noise.wgsl`.
pub(crate) fn hash_cell(cell: [i32; 2], salt: u32) -> f64 {
    let mixed = hash_u32(cell[0] as u32 ^ hash_u32(cell[1] as u32 ^ hash_u32(salt)));
    f64::from(mixed >> 8) / 16_777_216.0
}

/// Value noise in [0, 1), with features of size 1.
pub(super) fn value_noise(x: f64, y: f64, salt: u32) -> f64 {
    let (i, j) = (x.floor(), y.floor());
    let cell = [i as i32, j as i32];
    // Quintic, so that slopes have no creases.
    let fade = |t: f64| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let (s, t) = (fade(x - i), fade(y - j));
    let corner = |dx, dy| hash_cell([cell[0].wrapping_add(dx), cell[1].wrapping_add(dy)], salt);
    let (low, high) = (corner(0, 0) + s * (corner(1, 0) - corner(0, 0)), corner(0, 1) + s * (corner(1, 1) - corner(0, 1)));
    low + t * (high - low)
}

/// Octaves of value noise, in [0, 1).
pub(super) fn fractal_noise(x: f64, y: f64, salt: u32, octaves: u32) -> f64 {
    let (mut sum, mut total, mut weight, mut at) = (0.0, 0.0, 1.0, [x, y]);
    for octave in 0..octaves {
        sum += weight * value_noise(at[0], at[1], salt.wrapping_add(octave));
        total += weight;
        weight *= 0.5;
        at = next_octave(at);
    }
    sum / total
}

/// Gradient noise (Perlin 1985, with the quintic of 2002) in about [−1, 1], zero at lattice points.
pub(super) fn gradient_noise(x: f64, y: f64, salt: u32) -> f64 {
    let (i, j) = (x.floor(), y.floor());
    let (u, v) = (x - i, y - j);
    let corner = |dx: i32, dy: i32| {
        let angle = TAU * hash_cell([(i as i32).wrapping_add(dx), (j as i32).wrapping_add(dy)], salt);
        angle.cos() * (u - f64::from(dx)) + angle.sin() * (v - f64::from(dy))
    };
    let fade = |t: f64| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let (s, t) = (fade(u), fade(v));
    let (low, high) = (corner(0, 0) + s * (corner(1, 0) - corner(0, 0)), corner(0, 1) + s * (corner(1, 1) - corner(0, 1)));
    1.4 * (low + t * (high - low))
}

/// Octaves of gradient noise, in about [−1, 1].
pub(super) fn gradient_octaves(x: f64, y: f64, salt: u32, octaves: u32) -> f64 {
    let (mut sum, mut weight, mut at) = (0.0, 0.5, [x, y]);
    for octave in 0..octaves {
        sum += weight * gradient_noise(at[0], at[1], salt.wrapping_add(octave));
        weight *= 0.5;
        at = next_octave(at);
    }
    sum
}

/// Ridges: octaves folded at zero, each the rougher the higher the ground (Musgrave's ridged multifractal), in about [0, 1].
pub(super) fn ridged_octaves(x: f64, y: f64, salt: u32, octaves: u32) -> f64 {
    let (mut sum, mut weight, mut share, mut at) = (0.0, 0.5, 1.0, [x, y]);
    for octave in 0..octaves {
        let crest = 1.0 - gradient_noise(at[0], at[1], salt.wrapping_add(octave)).abs();
        let crest = crest * crest * share;
        sum += weight * crest;
        share = (1.6 * crest).clamp(0.0, 1.0);
        weight *= 0.5;
        at = next_octave(at);
    }
    sum
}

/// Twice as fine, and turned by an angle whose tangent is 3/4: octaves share no axis, so the lattice does not show.
pub(super) fn next_octave([x, y]: [f64; 2]) -> [f64; 2] {
    [1.6 * x - 1.2 * y + 17.3, 1.2 * x + 1.6 * y + 5.1]
}
