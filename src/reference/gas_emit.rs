//! Emission in f64: the specification of `shaders/field/gas_emit.wgsl`.
//!
//! A puff adds density, dye and velocity with one profile, (1 − s)² of the squared distance s in radii. Its masses are sums over the
//! cells that it reaches, whatever part of it a wall cuts off; its velocity is that at its middle.

use super::gas::{Grid, State};

/// What one puff adds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Its middle, cells: a cell's north-western corner is at whole numbers.
    pub centre: [f64; 2],
    /// Its radius, cells.
    pub radius: f64,
    /// What it adds to density and dye, summed over all cells.
    pub mass: [f64; 2],
    /// What it adds to the velocity at its middle, m/s.
    pub velocity: [f64; 2],
    /// How fast it turns beside that, 1/s times the length of a cell: m/s at one cell from the middle, clockwise on the screen.
    pub spin: f64,
}

/// (1 − s)² at a position of the grid, in the image of it that is nearest; and the way there from the middle, cells.
fn profile(grid: &Grid, emission: &Emission, position: [f64; 2]) -> (f64, [f64; 2]) {
    let away = [0, 1].map(|axis| {
        let away = position[axis] - emission.centre[axis];
        let size = grid.size[axis] as f64;
        if grid.periodic[axis] { away - size * (away / size).round() } else { away }
    });
    let s = (away[0] * away[0] + away[1] * away[1]) / (emission.radius * emission.radius);
    ((1.0 - s).max(0.0).powi(2), away)
}

/// Adds it.
pub fn emit(grid: &Grid, emission: &Emission, state: &mut State) {
    let at = |x: i64, y: i64, offset: [f64; 2]| profile(grid, emission, [x as f64 + offset[0], y as f64 + offset[1]]);
    let sum: f64 = grid.cells().map(|(x, y)| at(x, y, [0.5, 0.5]).0).sum();
    for (x, y) in grid.cells() {
        let index = grid.index(x, y);
        if sum > 0.0 {
            let share = at(x, y, [0.5, 0.5]).0 / sum;
            (0..2).for_each(|scalar| state.scalars[index][scalar] += emission.mass[scalar] * share);
        }
        if grid.open(0, x) {
            let (weight, away) = at(x, y, [0.0, 0.5]);
            let push = weight * (emission.velocity[0] - emission.spin * away[1]);
            state.velocity[index][0] += push;
            state.leading[index][0] += push;
        }
        if grid.open(1, y) {
            let (weight, away) = at(x, y, [0.5, 0.0]);
            let push = weight * (emission.velocity[1] + emission.spin * away[0]);
            state.velocity[index][1] += push;
            state.leading[index][1] += push;
        }
    }
}
