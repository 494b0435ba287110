//! Bricks and cobbles: functions of the position in metres. Their layouts are shared with the albedos that colour them
//! (`shaders/surface/albedo_brick.wgsl` and `…_cobble.wgsl`).

use super::noise::{fractal_noise, hash_cell, smoothstep};

/// Length and height of a brick with its joint, metres: the metric format of 215 × 65 mm.
pub const BRICK_METRES: [f32; 2] = [0.225, 0.075];

/// Width of the joint between bricks, metres.
pub const BRICK_JOINT_METRES: f32 = 0.010;

/// Mean distance from cobble to cobble, metres.
pub const COBBLE_METRES: f32 = 0.1;

/// Depth below the face of the wall, metres: rounded arrises, rough faces, recessed joints. Where a field of this extent is a `tile`
/// that repeats and a whole number of bricks fits it, one across its border is the same brick on both sides.
pub(super) fn bricks_depth_metres(x: f64, y: f64, tile: Option<[f64; 2]>) -> f64 {
    let [length, height] = BRICK_METRES.map(f64::from);
    let course = (y / height).floor();
    let along = x / length + 0.5 * course.rem_euclid(2.0);
    let mut brick = [along.floor() as i32, course as i32];
    if let Some([wide, high]) = tile {
        let count = |extent: f64, size: f64| ((extent / size).round() as i32).max(1);
        brick = [brick[0].rem_euclid(count(wide, length)), brick[1].rem_euclid(count(high, height))];
    }
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
pub(super) fn cobbles_depth_metres(x: f64, y: f64, tile: Option<[f64; 2]>) -> f64 {
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
