//! Pyramid: upper bounds of the bilinear surface over ever larger nodes. Specification of `shaders/field/pyramid.wgsl`.

use super::HeightField;

/// One level of the pyramid.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Width and height, nodes.
    pub size: [u32; 2],
    /// The bounds, row by row.
    pub bounds: Vec<f32>,
}

/// Every level, finest first: level 0 bounds the cells, each by the maximum of its four corners; a node above bounds its
/// children. Sizes are halved and rounded down, to 1 at the least, until both are 1.
pub fn pyramid(field: &HeightField) -> Vec<Level> {
    let [width, height] = field.size;
    let cell = |x: u32, y: u32| {
        let corners = field.corners(i64::from(x), i64::from(y));
        // The corners are f32, and so is the largest of them.
        corners.into_iter().fold(f64::MIN, f64::max) as f32
    };
    let bounds = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| cell(x, y)).collect();
    let mut levels = vec![Level { size: field.size, bounds }];
    loop {
        let below = &levels[levels.len() - 1];
        if below.size == [1, 1] {
            return levels;
        }
        let above = parents(below);
        levels.push(above);
    }
}

/// The level above: every child raises the bound of its parent.
fn parents(below: &Level) -> Level {
    let size = below.size.map(|size| (size / 2).max(1));
    let mut bounds = vec![f32::MIN; (size[0] * size[1]) as usize];
    for (child, bound) in below.bounds.iter().enumerate() {
        let child = [child as u32 % below.size[0], child as u32 / below.size[0]];
        let [x, y] = [parent(child[0], size[0]), parent(child[1], size[1])];
        let parent = &mut bounds[(y * size[0] + x) as usize];
        *parent = parent.max(*bound);
    }
    Level { size, bounds }
}

/// The parent of a node of an axis, on a level of `size` nodes: the last one takes the remainder.
pub fn parent(node: u32, size: u32) -> u32 {
    (node / 2).min(size - 1)
}
