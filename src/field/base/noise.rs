//! Hashes and noise, the same bits on every machine: additions, products and roots alone, apart from the sines of gradients.

use std::f64::consts::TAU;

use glam::DVec3;

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

/// A number in [0, 1) for a lattice point in space and a salt.
pub(super) fn hash_cell_3(cell: [i32; 3], salt: u32) -> f64 {
    hash_cell([cell[0], cell[1]], hash_u32(cell[2] as u32 ^ salt))
}

/// Gradient noise in space, in about [−1, 1].
fn gradient_noise_3(position: DVec3, salt: u32) -> f64 {
    let floor = position.floor();
    let cell = floor.as_ivec3().to_array();
    let inside = position - floor;
    let corner = |dx: i32, dy: i32, dz: i32| {
        let at = [cell[0].wrapping_add(dx), cell[1].wrapping_add(dy), cell[2].wrapping_add(dz)];
        // A gradient of the cube's twelve edges (Perlin 2002).
        let edge = (hash_cell_3(at, salt) * 12.0) as u32;
        let offset = inside - DVec3::new(f64::from(dx), f64::from(dy), f64::from(dz));
        let sign = |bit: u32| if edge & bit == 0 { 1.0 } else { -1.0 };
        let [a, b] = match edge / 4 {
            0 => [offset.x, offset.y],
            1 => [offset.y, offset.z],
            _ => [offset.z, offset.x],
        };
        sign(1) * a + sign(2) * b
    };
    let fade = |t: f64| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let [s, t, r] = inside.to_array().map(fade);
    let mix = |a: f64, b: f64, share: f64| a + share * (b - a);
    let layer = |dz| mix(mix(corner(0, 0, dz), corner(1, 0, dz), s), mix(corner(0, 1, dz), corner(1, 1, dz), s), t);
    mix(layer(0), layer(1), r)
}

/// Octaves of it, in about [−1, 1].
pub(crate) fn gradient_octaves_3(position: DVec3, salt: u32, octaves: u32) -> f64 {
    let (mut sum, mut weight, mut at) = (0.0, 0.5, position);
    for octave in 0..octaves {
        sum += weight * gradient_noise_3(at, salt.wrapping_add(octave));
        weight *= 0.5;
        // Twice as fine, and turned a little, so that the lattices of octaves share no plane.
        at = 2.0 * DVec3::new(0.8 * at.x - 0.6 * at.y, 0.6 * at.x + 0.8 * at.y, at.z) + DVec3::new(7.1, 3.7, 11.3);
    }
    sum
}
