//! Showing a gas in f64: the specification of `shaders/field/gas_show.wgsl`.

use super::gas::{Grid, State};

/// Density, dye, vorticity (1/s, clockwise on the screen) and velocity along u (m/s) at the centre of a cell. Beyond a wall lies what
/// lies before it.
fn of_cell(grid: &Grid, state: &State, turning_per_speed: f64, [x, y]: [i64; 2]) -> [f64; 4] {
    let [x, y] = [grid.address(0, x) as i64, grid.address(1, y) as i64];
    let inside = |axis: usize, at: i64| grid.address(axis, at) as i64;
    // Means of the two faces of a cell: the velocity along each axis at its centre.
    let along_u = |x: i64, y: i64| 0.5 * (grid.u(&state.velocity, x, y) + grid.u(&state.velocity, x + 1, y));
    let along_v = |x: i64, y: i64| 0.5 * (grid.v(&state.velocity, x, y) + grid.v(&state.velocity, x, y + 1));
    let slope = 0.5 * (along_v(inside(0, x + 1), y) - along_v(inside(0, x - 1), y))
        - 0.5 * (along_u(x, inside(1, y + 1)) - along_u(x, inside(1, y - 1)));
    let [density, dye] = state.scalars[grid.index(x, y)];
    [density, dye, slope * turning_per_speed, along_u(x, y)]
}

/// Weights of Catmull and Rom's spline at a fraction between the second and the third of four.
fn spline(t: f64) -> [f64; 4] {
    [
        0.5 * (-t + 2.0 * t * t - t * t * t),
        0.5 * (2.0 - 5.0 * t * t + 3.0 * t * t * t),
        0.5 * (t + 4.0 * t * t - 3.0 * t * t * t),
        0.5 * (t * t * t - t * t),
    ]
}

/// The same at a texel of the field, where a cell covers `coarsening` texels along each axis.
pub fn shown(grid: &Grid, state: &State, coarsening: usize, turning_per_speed: f64, texel: [usize; 2]) -> [f64; 4] {
    let at = texel.map(|along| (along as f64 + 0.5) / coarsening as f64 - 0.5);
    let weights = at.map(|along| spline(along - along.floor()));
    let mut sum = [0.0; 4];
    for (row, down) in weights[1].iter().enumerate() {
        for (column, across) in weights[0].iter().enumerate() {
            let cell = [at[0].floor() as i64 - 1 + column as i64, at[1].floor() as i64 - 1 + row as i64];
            let of_cell = of_cell(grid, state, turning_per_speed, cell);
            (0..4).for_each(|channel| sum[channel] += across * down * of_cell[channel]);
        }
    }
    sum
}
