//! Fur and grass: a dense field of strands, each a thin ridge that rises from its root to a pointed tip ([Steep], fig. 3).
//!
//! A height field holds no overhang, so that what is combed lies down by rising along the comb and ending in a step: tips
//! overlap the roots of the next like shingles. Everything repeats with the plane, so that the field wraps without a seam.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::noise::{hash_cell, hash_u32, smoothstep};

/// Side of the cells that hold at most one daisy each, metres.
pub const DAISY_METRES: f32 = 0.0625;

/// Mean distances from root to root, metres.
const HAIR_METRES: f64 = 0.000_6;
const BLADE_METRES: f64 = 0.0021;

/// A ridge over the plane.
struct Strand {
    /// Where it grows, metres.
    root: [f64; 2],
    /// Where it leans, radians from +u toward +v.
    angle: f64,
    /// How far its tip is from its root, metres.
    reach_metres: f64,
    /// Half its width at the root, metres.
    half_width_metres: f64,
    /// Height of its root and of its tip.
    heights: [f64; 2],
}

/// The heights that strands make, row by row.
struct Canvas {
    size: [u32; 2],
    texel_metres: f64,
    heights: Vec<f32>,
}

impl Canvas {
    fn draw(&mut self, strand: &Strand) {
        let (sin, cos) = strand.angle.sin_cos();
        let reach = strand.reach_metres / self.texel_metres;
        // Thinner ones would fall between the texels of a coarse field.
        let half_width = (strand.half_width_metres / self.texel_metres).max(0.75);
        let root = strand.root.map(|metres| metres / self.texel_metres - 0.5);
        let tip = [root[0] + reach * cos, root[1] + reach * sin];
        let span = |axis: usize| {
            let (low, high) = (root[axis].min(tip[axis]), root[axis].max(tip[axis]));
            (low - half_width).floor() as i64..=(high + half_width).ceil() as i64
        };
        for y in span(1) {
            for x in span(0) {
                let [dx, dy] = [x as f64 - root[0], y as f64 - root[1]];
                let share = (dx * cos + dy * sin) / reach;
                let aside = (dy * cos - dx * sin).abs() / (half_width * (1.0 - 0.8 * share * share).max(0.2));
                if !(0.0..=1.0).contains(&share) || aside >= 1.0 {
                    continue;
                }
                let [low, high] = strand.heights;
                let height = (low + (high - low) * share.powf(0.8)) * (1.0 - 0.22 * aside * aside);
                let [column, row] = [(x, 0), (y, 1)].map(|(at, axis)| at.rem_euclid(i64::from(self.size[axis])) as usize);
                let texel = &mut self.heights[row * self.size[0] as usize + column];
                *texel = texel.max(height as f32);
            }
        }
    }

    /// A strand from every cell of a grid with this spacing; `strand` makes it from its root in uv and random numbers.
    fn grow(&mut self, spacing_metres: f64, salt: u32, strand: impl Fn([f64; 2], [f64; 4]) -> Strand) {
        let extent = self.size.map(|texels| f64::from(texels) * self.texel_metres);
        let count = extent.map(|metres| (metres / spacing_metres).round().max(1.0));
        for y in 0..count[1] as i32 {
            for x in 0..count[0] as i32 {
                let random = |offset: u32| hash_cell([x, y], salt.wrapping_add(offset));
                let uv = [(f64::from(x) + random(0)) / count[0], (f64::from(y) + random(1)) / count[1]];
                let mut grown = strand(uv, [random(2), random(3), random(4), random(5)]);
                grown.root = [uv[0] * extent[0], uv[1] * extent[1]];
                self.draw(&grown);
            }
        }
    }
}

/// Short fur, combed, in tufts.
pub(super) fn fur(size: [u32; 2], texel_metres: f64, seed: u64) -> Vec<f32> {
    let salt = salt(seed);
    let mut canvas = Canvas { size, texel_metres, heights: vec![0.05; size[0] as usize * size[1] as usize] };
    canvas.grow(HAIR_METRES, salt, |[u, v], random| {
        let tuft = periodic_noise([u, v], 26, salt.wrapping_add(16));
        let long = periodic_noise([u, v], 7, salt.wrapping_add(17));
        // Tips of a tuft lean together.
        let comb = FRAC_PI_2 + 0.55 * (TAU * (u + 0.12 * (TAU * v).sin())).sin() + 0.35 * (TAU * (2.0 * v - u)).cos();
        let tip = 0.48 + 0.26 * long + 0.18 * tuft + 0.08 * random[0];
        Strand {
            root: [0.0; 2],
            angle: comb + 1.1 * (tuft - 0.5) + 0.5 * (random[1] - 0.5),
            reach_metres: 0.0055 * (0.7 + 0.6 * random[2]),
            half_width_metres: 0.000_27 * (0.7 + 0.6 * random[3]),
            heights: [0.45 * tip - 0.12, tip],
        }
    });
    canvas.heights
}

/// A lawn with daisies, mown in stripes.
pub(super) fn grass(size: [u32; 2], texel_metres: f64, seed: u64) -> Vec<f32> {
    let salt = salt(seed);
    let mut canvas = Canvas { size, texel_metres, heights: vec![0.03; size[0] as usize * size[1] as usize] };
    canvas.grow(BLADE_METRES, salt, |[u, v], random| {
        let clump = periodic_noise([u, v], 16, salt.wrapping_add(16));
        // Four stripes, each laid over by the roller that passed it.
        let stripe = (TAU * 2.0 * u).sin().signum();
        let tip = 0.45 + 0.25 * clump + 0.25 * random[0];
        Strand {
            root: [0.0; 2],
            angle: stripe * FRAC_PI_2 + 2.6 * (random[1] - 0.5),
            reach_metres: 0.011 * (0.5 + random[2]),
            half_width_metres: 0.0011 * (0.6 + 0.6 * random[3]),
            heights: [0.15 * tip, tip],
        }
    });
    daisies(&mut canvas);
    canvas.heights
}

/// Whether a cell of [`DAISY_METRES`] has a daisy; its centre within the cell, its radius in metres and its height. Twin of the
/// function in `shaders/surface/albedo_grass.wgsl`.
fn daisy(cell: [i32; 2]) -> Option<([f64; 2], f64, f64)> {
    let random = |salt: u32| hash_cell(cell, salt);
    let centre = [0.2 + 0.6 * random(102), 0.2 + 0.6 * random(103)];
    (random(101) < 0.4).then_some((centre, 0.0065 + 0.0030 * random(104), 0.82 + 0.10 * random(105)))
}

/// Raises the daisies' heads above the grass: a disc in the middle, petals around it.
fn daisies(canvas: &mut Canvas) {
    let side = f64::from(DAISY_METRES);
    let [width, height] = canvas.size;
    for y in 0..height {
        for x in 0..width {
            let at = [x, y].map(|texel| (f64::from(texel) + 0.5) * canvas.texel_metres / side);
            let cell = at.map(|at| at.floor() as i32);
            let Some((centre, radius, top)) = daisy(cell) else { continue };
            let [dx, dy] = [0, 1].map(|axis| (at[axis] - f64::from(cell[axis]) - centre[axis]) * side);
            let share = dx.hypot(dy) / radius;
            let petal = 0.5 + 0.5 * (17.0 * dy.atan2(dx)).cos();
            if share > 0.88 + 0.12 * petal {
                continue;
            }
            let disc = 1.0 - smoothstep(0.24, 0.34, share);
            let head = top - 0.06 * share * share - 0.03 * (1.0 - petal) * smoothstep(0.3, 0.7, share) + 0.02 * disc;
            let texel = &mut canvas.heights[y as usize * width as usize + x as usize];
            *texel = texel.max(head.min(1.0) as f32);
        }
    }
}

fn salt(seed: u64) -> u32 {
    hash_u32(seed as u32 ^ hash_u32((seed >> 32) as u32))
}

/// Smooth value noise in [0, 1) with `cells` features a side, which repeats with uv.
fn periodic_noise(uv: [f64; 2], cells: i32, salt: u32) -> f64 {
    let at = uv.map(|at| at * f64::from(cells));
    let low = at.map(f64::floor);
    let [s, t] = [0, 1].map(|axis| smoothstep(0.0, 1.0, at[axis] - low[axis]));
    let value =
        |dx: i32, dy: i32| hash_cell([(low[0] as i32 + dx).rem_euclid(cells), (low[1] as i32 + dy).rem_euclid(cells)], salt);
    let north = value(0, 0) * (1.0 - s) + value(1, 0) * s;
    let south = value(0, 1) * (1.0 - s) + value(1, 1) * s;
    north * (1.0 - t) + south * t
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fields() -> [(&'static str, Vec<f32>); 2] {
        [("fur", fur([192, 96], 0.25 / 192.0, 3)), ("grass", grass([192, 96], 0.5 / 192.0, 3))]
    }

    #[test]
    fn heights_are_heights_and_dense() {
        for (name, heights) in fields() {
            assert!(heights.iter().all(|height| (0.0..=1.0).contains(height)), "{name}");
            let bare = heights.iter().filter(|height| **height <= 0.05).count();
            assert!(bare * 20 < heights.len(), "{name}: {bare} of {} texels are bare", heights.len());
        }
    }

    /// Steps over the border are those of any other place: a seam would show where the field wraps.
    #[test]
    fn they_repeat_without_a_seam() {
        for (name, heights) in fields() {
            let step = |x: usize| {
                let rows = (0..96).map(|y| (heights[y * 192 + x] - heights[y * 192 + (x + 1) % 192]).abs());
                rows.sum::<f32>() / 96.0
            };
            let inside = (0..191).map(step).fold(0.0, f32::max);
            assert!(step(191) <= inside, "{name}: {} at the border, {inside} at most within", step(191));
        }
    }

    #[test]
    fn another_seed_grows_other_strands() {
        assert!(fur([64, 64], 0.001, 1) != fur([64, 64], 0.001, 2));
        assert!(grass([64, 64], 0.001, 1) != grass([64, 64], 0.001, 2));
    }
}
