//! Bounds: between which heights the bilinear surface lies over ever larger nodes. Specification of `shaders/field/bounds.wgsl`.

use super::HeightField;
use crate::field::bounds::{HIGH_STEPS, LOW_STEPS, level_count, level_size};

/// One level: its nodes are squares of cells, cut off at the field's end.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Width and height, nodes.
    pub size: [u32; 2],
    /// Both ends of each range, row by row: steps of the lower and of the upper one.
    pub steps: Vec<[u32; 2]>,
}

/// Every level from 1 to the one of a single node, each from the cells themselves.
pub fn bounds(field: &HeightField) -> Vec<Level> {
    let [width, height] = field.size;
    let cells: Vec<[f32; 2]> = (0..height)
        .flat_map(|y| (0..width).map(move |x| [x, y]))
        .map(|[x, y]| {
            let corners = field.corners(i64::from(x), i64::from(y));
            // The corners are f32, and so are the ends of their range.
            [corners.into_iter().fold(f64::MAX, f64::min) as f32, corners.into_iter().fold(f64::MIN, f64::max) as f32]
        })
        .collect();
    (1..=level_count(field.size))
        .map(|level| {
            let size = level_size(field.size, level);
            let mut steps = vec![[LOW_STEPS, 0]; (size[0] * size[1]) as usize];
            for (cell, [low, high]) in (0..).zip(&cells) {
                let [x, y] = [cell % width, cell / width].map(|cell: u32| cell >> level);
                let node = &mut steps[(y * size[0] + x) as usize];
                // The kernel's own rounding: a product that is rounded onto a step stays there.
                *node =
                    [node[0].min((low * LOW_STEPS as f32).floor() as u32), node[1].max((high * HIGH_STEPS as f32).ceil() as u32)];
            }
            Level { size, steps }
        })
        .collect()
}
