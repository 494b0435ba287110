//! Bases: the heights that a field starts from, made on the CPU once.
//!
//! Procedural bases are functions of the position in metres and of the seed, so that another field size is a finer look at the
//! same relief. Their layouts are shared with the albedos that colour them (`shaders/surface/albedo_brick.wgsl`, `…_cobble.wgsl`
//! and `…_grass.wgsl`).

mod strands;

use std::f64::consts::TAU;

pub use strands::DAISY_METRES;

use super::wave;
use crate::scene::{Addressing, Base, Boundary, Scene};

/// Length and height of a brick with its joint, metres: the metric format of 215 × 65 mm.
pub const BRICK_METRES: [f32; 2] = [0.225, 0.075];

/// Width of the joint between bricks, metres.
pub const BRICK_JOINT_METRES: f32 = 0.010;

/// Mean distance from cobble to cobble, metres.
pub const COBBLE_METRES: f32 = 0.1;

/// The heights of a procedural base, row by row; `None` for an image, which the caller loads.
pub fn heights(scene: &Scene) -> Option<Vec<f32>> {
    let [width, height] = scene.field.size;
    let texel_metres = scene.texel_metres();
    let plane_metres = f64::from(scene.plane.width_metres);
    let depth_metres = f64::from(scene.plane.depth_metres);
    let fill = |function: &dyn Fn(f64, f64) -> f64| {
        let mut heights = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            for x in 0..width {
                let at = |texel: u32| (f64::from(texel) + 0.5) * texel_metres;
                heights.push(function(at(x), at(y)).clamp(0.0, 1.0) as f32);
            }
        }
        heights
    };
    match &scene.base {
        Base::Flat { height: level } => Some(vec![*level; width as usize * height as usize]),
        Base::Bricks {} => Some(fill(&|x, y| 1.0 - bricks_depth_metres(x, y) / depth_metres)),
        Base::Cobbles {} => {
            // Where the field wraps, so do the stones.
            let tile = (scene.field.addressing == Addressing::Wrap).then(|| scene.plane_size_metres());
            Some(fill(&|x, y| 1.0 - cobbles_depth_metres(x, y, tile) / depth_metres))
        }
        Base::Terrain {} => {
            let terrain = Terrain::new(scene.seed);
            Some(fill(&|x, y| terrain.height(x / plane_metres, y / plane_metres)))
        }
        Base::Fur {} => Some(strands::fur(scene.field.size, texel_metres, scene.seed)),
        Base::Grass {} => Some(strands::grass(scene.field.size, texel_metres, scene.seed)),
        Base::Image { .. } => None,
    }
}

/// The height that the undisturbed surface has in most places: the water line of a pool.
pub fn rest_height(base: &Base) -> f32 {
    match base {
        Base::Flat { height } => *height,
        Base::Bricks {} | Base::Cobbles {} | Base::Terrain {} | Base::Fur {} | Base::Grass {} | Base::Image { .. } => 1.0,
    }
}

/// The texel of [`crate::field::Material`] where a post stands: its third byte is full.
pub const POST_MATERIAL: u32 = 0x00ff_0000;

/// The texels on which the posts of a scene stand, with the height of their tops.
pub fn posts(scene: &Scene) -> Vec<(usize, f32)> {
    let Some(wave) = &scene.wave else { return Vec::new() };
    let [width, height] = scene.field.size;
    let plane_metres = scene.plane_size_metres();
    let periodic = wave.boundary == Boundary::Periodic;
    let mut posts = Vec::new();
    for obstacle in &wave.obstacles {
        for y in 0..height {
            for x in 0..width {
                let uv = [(f64::from(x) + 0.5) / f64::from(width), (f64::from(y) + 0.5) / f64::from(height)];
                if wave::stands_on(obstacle, uv, plane_metres, periodic) {
                    posts.push((y as usize * width as usize + x as usize, obstacle.top));
                }
            }
        }
    }
    posts
}

/// Depth below the face of the wall, metres: rounded arrises, rough faces, recessed joints.
fn bricks_depth_metres(x: f64, y: f64) -> f64 {
    let [length, height] = BRICK_METRES.map(f64::from);
    let course = (y / height).floor();
    let along = x / length + 0.5 * course.rem_euclid(2.0);
    let brick = [along.floor() as i32, course as i32];
    let inside = [along - along.floor(), y / height - course];
    let border = |inside: f64, size: f64| (0.5 - (inside - 0.5).abs()) * size - 0.5 * f64::from(BRICK_JOINT_METRES);
    let from_edge = border(inside[0], length).min(border(inside[1], height));
    // No two bricks are laid alike, nor quite in the plane.
    let set_back = 0.0016 * hash_cell(brick, 13) + 0.0012 * (hash_cell(brick, 14) - 0.5) * (inside[0] - 0.5);
    let rough = 0.0009 * fractal_noise(x * 70.0, y * 70.0, 15, 5) + 0.0012 * pits(x, y);
    let arris = 0.0030;
    let rounded = 1.0 - smoothstep(-0.2 * arris, arris, from_edge + 0.0016 * (fractal_noise(x * 110.0, y * 110.0, 16, 2) - 0.5));
    let joint = 0.0085 + 0.0016 * fractal_noise(x * 240.0, y * 240.0, 17, 3);
    let face = set_back + rough;
    face + (joint - face) * rounded
}

/// Small holes that the fire left in the clay, 0 to 1.
fn pits(x: f64, y: f64) -> f64 {
    smoothstep(0.66, 0.80, fractal_noise(x * 210.0, y * 210.0, 18, 2))
}

/// Depth below the tops of the stones, metres; where a field of this extent is a `tile` that repeats, a whole number fits it.
fn cobbles_depth_metres(x: f64, y: f64, tile: Option<[f64; 2]>) -> f64 {
    let spacing = f64::from(COBBLE_METRES);
    let cells = tile.map(|tile| tile.map(|extent| (extent / spacing).round().max(1.0)));
    let scale = |axis: usize| tile.zip(cells).map_or(1.0 / spacing, |(tile, cells)| cells[axis] / tile[axis]);
    let position = [x * scale(0), y * scale(1)];
    let home_of = |cell: [i32; 2]| match cells {
        Some(cells) => [0, 1].map(|axis| cell[axis].rem_euclid(cells[axis] as i32)),
        None => cell,
    };
    let home = position.map(|coordinate| coordinate.floor() as i32);
    let (mut nearest, mut second, mut stone) = (f64::INFINITY, f64::INFINITY, home);
    for dy in -1..=1 {
        for dx in -1..=1 {
            let at = [home[0] + dx, home[1] + dy];
            let cell = home_of(at);
            let centre = |axis: usize, salt| f64::from(at[axis]) + 0.5 + 0.55 * (hash_cell(cell, salt) - 0.5);
            let distance = (position[0] - centre(0, 41)).hypot(position[1] - centre(1, 42));
            if distance < nearest {
                (second, nearest, stone) = (nearest, distance, cell);
            } else {
                second = second.min(distance);
            }
        }
    }
    let gap = second - nearest;
    let dome = 0.25 * spacing * (1.0 - smoothstep(0.02, 0.55, gap)).powi(2);
    let rough = 0.0016 * fractal_noise(x * 90.0, y * 90.0, 44, 4);
    0.006 * hash_cell(stone, 45) + dome + rough
}

/// A landscape that is hard to trace: ridges, terraces, a stair, columns, and spikes a few texels thin.
struct Terrain {
    salt: u32,
    spikes: Vec<[f64; 4]>,
}

impl Terrain {
    fn new(seed: u64) -> Self {
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
    fn height(&self, u: f64, v: f64) -> f64 {
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

fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// PCG's output function (O'Neill 2014); the twin of `hash_u32` in `shaders/common/noise.wgsl`.
fn hash_u32(x: u32) -> u32 {
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
fn value_noise(x: f64, y: f64, salt: u32) -> f64 {
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
fn fractal_noise(x: f64, y: f64, salt: u32, octaves: u32) -> f64 {
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
fn gradient_noise(x: f64, y: f64, salt: u32) -> f64 {
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
fn gradient_octaves(x: f64, y: f64, salt: u32, octaves: u32) -> f64 {
    let (mut sum, mut weight, mut at) = (0.0, 0.5, [x, y]);
    for octave in 0..octaves {
        sum += weight * gradient_noise(at[0], at[1], salt.wrapping_add(octave));
        weight *= 0.5;
        at = next_octave(at);
    }
    sum
}

/// Ridges: octaves folded at zero, each the rougher the higher the ground (Musgrave's ridged multifractal), in about [0, 1].
fn ridged_octaves(x: f64, y: f64, salt: u32, octaves: u32) -> f64 {
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
fn next_octave([x, y]: [f64; 2]) -> [f64; 2] {
    [1.6 * x - 1.2 * y + 17.3, 1.2 * x + 1.6 * y + 5.1]
}
