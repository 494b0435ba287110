//! Forces in f64: the specification of `shaders/field/gas_force.wgsl`.
//!
//! Viscosity, the confinement of vorticity after \[Fedkiw\], buoyancy, the turning of the planet, and the slow return of a row to its
//! wind and to its kind of gas.

use super::gas::{Grid, State};

/// What a row of cells tends to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Row {
    /// Its wind along u, m/s.
    pub wind: f64,
    /// Its density.
    pub density: f64,
    /// Its dye.
    pub dye: f64,
    /// Part of the way to the wind that a step goes.
    pub wind_pull: f64,
    /// Part of the velocity along v that a step takes.
    pub calm_pull: f64,
    /// Part of the way to density and dye that a step goes.
    pub gas_pull: f64,
    /// The angle that the planet's turning turns a velocity by in a step, radians.
    pub turn: f64,
}

/// What acts on a gas in one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    /// ν·dt/dx².
    pub viscosity: f64,
    /// ε·dt.
    pub confinement: f64,
    /// Speed that a unit of density above its row's gains upward, against v, m/s.
    pub buoyancy: f64,
    /// No component is faster, m/s.
    pub speed_limit: f64,
    /// A slope of |vorticity| below which confinement fades, m/s: see `CONFINEMENT_FLOOR` in `field::gas_source`.
    pub confinement_floor: f64,
    /// What each row tends to.
    pub rows: Vec<Row>,
}

/// The vorticity at the north-western corner of a cell, times the length of a cell: m/s. None along a wall that the gas slides on.
pub fn vorticity(grid: &Grid, velocity: &[[f64; 2]], x: i64, y: i64) -> f64 {
    if !(grid.open(0, x) && grid.open(1, y)) {
        return 0.0;
    }
    grid.v(velocity, x, y) - grid.v(velocity, x - 1, y) - (grid.u(velocity, x, y) - grid.u(velocity, x, y - 1))
}

/// The confinement's push on one face, where `along` runs from one of its corners to the other and `across` through it:
/// the mean vorticity of its ends times the unit slope of |vorticity| along it.
fn confinement(forces: &Forces, ends: [f64; 2], before: [f64; 2], after: [f64; 2]) -> f64 {
    let along = ends[1].abs() - ends[0].abs();
    let across = 0.25 * (after[0].abs() + after[1].abs() - before[0].abs() - before[1].abs());
    let steep = (along * along + across * across + forces.confinement_floor.powi(2)).sqrt();
    forces.confinement * 0.5 * (ends[0] + ends[1]) * along / steep
}

/// All of them at once, on the state as the flow carried it: on its leading velocity.
pub fn apply(grid: &Grid, forces: &Forces, state: &State) -> State {
    let velocity = &state.leading;
    let u = |x, y| grid.u(velocity, x, y);
    let v = |x, y| grid.v(velocity, x, y);
    let spin = |x, y| vorticity(grid, velocity, x, y);
    let row = |y: i64| forces.rows[grid.address(1, y)];
    let excess = |x: i64, y: i64| state.scalars[grid.index(x, y)][0] - row(y).density;
    let limit = |speed: f64| speed.clamp(-forces.speed_limit, forces.speed_limit);
    let mut next = state.clone();
    for (x, y) in grid.cells() {
        let index = grid.index(x, y);
        let here = row(y);
        next.leading[index][0] = if grid.open(0, x) {
            let across = 0.25 * (v(x - 1, y) + v(x, y) + v(x - 1, y + 1) + v(x, y + 1));
            let spread = u(x - 1, y) + u(x + 1, y) + u(x, y - 1) + u(x, y + 1) - 4.0 * u(x, y);
            let confined = confinement(
                forces,
                [spin(x, y), spin(x, y + 1)],
                [spin(x - 1, y), spin(x - 1, y + 1)],
                [spin(x + 1, y), spin(x + 1, y + 1)],
            );
            let turned = u(x, y) * here.turn.cos() + across * here.turn.sin();
            limit(turned + here.wind_pull * (here.wind - u(x, y)) + forces.viscosity * spread + confined)
        } else {
            0.0
        };
        next.leading[index][1] = if grid.open(1, y) {
            let across = 0.25 * (u(x, y - 1) + u(x, y) + u(x + 1, y - 1) + u(x + 1, y));
            let spread = v(x - 1, y) + v(x + 1, y) + v(x, y - 1) + v(x, y + 1) - 4.0 * v(x, y);
            let confined = confinement(
                forces,
                [spin(x, y), spin(x + 1, y)],
                [spin(x, y - 1), spin(x + 1, y - 1)],
                [spin(x, y + 1), spin(x + 1, y + 1)],
            );
            let turned = v(x, y) * here.turn.cos() - across * here.turn.sin();
            let lift = forces.buoyancy * 0.5 * (excess(x, y - 1) + excess(x, y));
            limit(turned - here.calm_pull * v(x, y) + forces.viscosity * spread - confined - lift)
        } else {
            0.0
        };
        let [density, dye] = state.scalars[index];
        next.scalars[index] = [density + here.gas_pull * (here.density - density), dye + here.gas_pull * (here.dye - dye)];
    }
    next
}
