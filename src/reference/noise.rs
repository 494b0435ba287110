//! Noise: procedural heights as functions of place, seed and time. Specification of `shaders/field/noise.wgsl`.
//!
//! Time is f64 here and used as it stands: nothing is reduced, no phase is carried.

use super::{noise_columns, noise_dunes, noise_fractal, noise_gears, noise_scales};
pub use crate::field::noise::Ground;
use crate::field::noise::hash;
use crate::scene::NoisePattern;

/// The centre of a texel, metres from the upper left corner.
pub fn centre(ground: &Ground, x: u32, y: u32) -> [f64; 2] {
    [x, y].map(|texel| (f64::from(texel) + 0.5) * ground.texel_metres)
}

/// The height of a pattern at a texel, 0 to 1.
pub fn height(pattern: &NoisePattern, ground: &Ground, time_seconds: f64, x: u32, y: u32) -> f64 {
    let at = centre(ground, x, y);
    match pattern {
        NoisePattern::Fractal(fractal) => noise_fractal::height(fractal, ground, time_seconds, at),
        NoisePattern::Columns(columns) => noise_columns::height(columns, ground, time_seconds, at),
        NoisePattern::Scales(scales) => noise_scales::height(scales, ground, time_seconds, at),
        NoisePattern::Gears(gears) => noise_gears::height(gears, ground, time_seconds, at),
        NoisePattern::Dunes(dunes) => noise_dunes::height(dunes, ground, time_seconds, at),
    }
}

/// How often something of this size fits each side of the field: a whole number of times where the field wraps, and at most four
/// times a texel, beyond which there is nothing to see.
pub fn cells_across(ground: &Ground, metres: f64) -> [f64; 2] {
    [0, 1].map(|axis| {
        let cells = (ground.metres()[axis] / metres).min(4.0 * f64::from(ground.size[axis]));
        if ground.wraps() { cells.round().max(1.0) } else { cells }
    })
}

/// Gradient noise (Perlin 2002) at a place on a lattice, with time as the third axis. `period`: the cells after which the lattice
/// repeats along the first two. −1.04 to 1.04.
pub fn gradient_noise(at: [f64; 3], period: Option<[i64; 2]>, salt: u32) -> f64 {
    let cell = at.map(f64::floor);
    let inside = [0, 1, 2].map(|axis| at[axis] - cell[axis]);
    let fade = inside.map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
    let mut sum = 0.0;
    for corner in 0..8_u32 {
        let bit = [corner & 1, corner >> 1 & 1, corner >> 2].map(f64::from);
        let weight: f64 = (0..3).map(|axis| if bit[axis] == 1.0 { fade[axis] } else { 1.0 - fade[axis] }).product();
        let point = [0, 1, 2].map(|axis| cell[axis] as i64 + bit[axis] as i64);
        let [x, y] = period.map_or([point[0], point[1]], |period| [0, 1].map(|axis| point[axis].rem_euclid(period[axis])));
        // Cells are counted in 32 bits.
        let hash = hash(x as u32 ^ hash(y as u32 ^ salt)) ^ hash(point[2] as u32 ^ !salt);
        sum += weight * gradient(hash, [0, 1, 2].map(|axis| inside[axis] - bit[axis]));
    }
    sum
}

/// One of the twelve edges of a cube, of which four count twice, times an offset.
fn gradient(hash: u32, [x, y, z]: [f64; 3]) -> f64 {
    let edge = hash.wrapping_mul(0x9e37_79b1) >> 28;
    let [a, b] = [[x, y], [y, z], [z, x], [x, y]][edge as usize / 4];
    (if edge & 1 == 0 { a } else { -a }) + (if edge & 2 == 0 { b } else { -b })
}

/// A smooth pulse of a phase in turns: 1 at whole turns, 0 at halves.
pub fn pulse(turns: f64) -> f64 {
    smooth((2.0 * (turns - turns.floor()) - 1.0).abs())
}

/// From 0 at 0 to 1 at 1, level at both.
pub fn smooth(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The width of an edge: a thousandth of a texel at least, so that there is one.
pub fn edge_metres(ground: &Ground, metres: f32) -> f64 {
    f64::from(metres).max(1e-3 * ground.texel_metres)
}

/// A lattice of things side by side, odd rows half a pitch aside.
pub struct Rows {
    /// From thing to thing, and from row to row, metres.
    pub pitch: [f64; 2],
    /// Things of a row and rows of the field, where it wraps.
    pub period: Option<[i64; 2]>,
    origin: [f64; 2],
}

impl Rows {
    /// Rows of things of this pitch whose rows are `row` pitches apart. Where odd rows stand aside there is an even number of them.
    pub fn new(ground: &Ground, pitch_metres: f32, row: f64, staggered: bool) -> Self {
        let metres = ground.metres();
        let pitch = f64::from(pitch_metres).max(ground.texel_metres / 4.0);
        let rows = if staggered { 2.0 } else { 1.0 };
        let fit = [(metres[0] / pitch).round().max(1.0), (metres[1] / (rows * row * pitch)).round().max(1.0) * rows];
        let (pitch, period) = match ground.wraps() {
            true => ([metres[0] / fit[0], metres[1] / fit[1]], Some(fit.map(|count| count as i64))),
            false => ([pitch, row * pitch], None),
        };
        Self { pitch, period, origin: metres.map(|side| 0.5 * side) }
    }

    /// A place, seen from the thing in the middle of the field.
    pub fn from_origin(&self, at: [f64; 2]) -> [f64; 2] {
        [at[0] - self.origin[0], at[1] - self.origin[1]]
    }

    /// Where a thing is, in pitches and rows from the one in the middle.
    pub fn along(&self, thing: [i64; 2], staggered: bool) -> [f64; 2] {
        let aside = if staggered && thing[1].rem_euclid(2) == 1 { 0.5 } else { 0.0 };
        [thing[0] as f64 + aside, thing[1] as f64]
    }

    /// The phase of a thing, turns: so many waves across the field, its share of chance, and the time's.
    pub fn turns(&self, ground: &Ground, thing: [i64; 2], along: [f64; 2], waves: [i32; 2], disorder: f32) -> f64 {
        let home = self.period.map_or(thing, |period| [0, 1].map(|axis| thing[axis].rem_euclid(period[axis])));
        let waves: f64 = (0..2).map(|axis| f64::from(waves[axis]) * along[axis] * self.pitch[axis] / ground.metres()[axis]).sum();
        let chance = f64::from(hash(home[0] as u32 ^ hash(home[1] as u32 ^ ground.salt)) >> 8) / f64::from(1 << 24);
        waves + f64::from(disorder) * chance
    }
}
