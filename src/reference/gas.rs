//! The gas in f64: its grid, its state, and one step of it from the parts that have a specification each.
//!
//! The grid is staggered: cell (i, j) holds its scalars at its centre, the velocity along u at its western face and the velocity
//! along v at its northern one. An axis repeats, or is closed by walls that the gas slides along: nothing crosses the outermost
//! faces, and whatever is read beyond a wall is what lies before it.

use super::gas_advect;
use super::gas_emit::{self, Emission};
use super::gas_force::{self, Forces};
use super::gas_project;

/// The cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Columns and rows.
    pub size: [usize; 2],
    /// Whether each axis repeats.
    pub periodic: [bool; 2],
}

impl Grid {
    /// How many cells there are.
    pub fn count(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// A coordinate of an axis, brought into the grid.
    pub fn address(&self, axis: usize, at: i64) -> usize {
        let size = self.size[axis] as i64;
        (if self.periodic[axis] { at.rem_euclid(size) } else { at.clamp(0, size - 1) }) as usize
    }

    /// The index of a cell, or of what stands for it beyond the border.
    pub fn index(&self, x: i64, y: i64) -> usize {
        self.address(1, y) * self.size[0] + self.address(0, x)
    }

    /// Whether something can cross the face before a cell of an axis.
    pub fn open(&self, axis: usize, at: i64) -> bool {
        self.periodic[axis] || (at > 0 && at < self.size[axis] as i64)
    }

    /// The velocity along u at the western face of a cell.
    pub fn u(&self, velocity: &[[f64; 2]], x: i64, y: i64) -> f64 {
        if self.open(0, x) { velocity[self.index(x, y)][0] } else { 0.0 }
    }

    /// The velocity along v at the northern face of a cell.
    pub fn v(&self, velocity: &[[f64; 2]], x: i64, y: i64) -> f64 {
        if self.open(1, y) { velocity[self.index(x, y)][1] } else { 0.0 }
    }

    /// Each cell, row by row.
    pub fn cells(&self) -> impl Iterator<Item = (i64, i64)> + use<> {
        let [width, height] = self.size.map(|side| side as i64);
        (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
    }

    /// What flows out of each cell: the divergence in cells.
    pub fn divergence(&self, velocity: &[[f64; 2]]) -> Vec<f64> {
        self.cells()
            .map(|(x, y)| {
                self.u(velocity, x + 1, y) - self.u(velocity, x, y) + self.v(velocity, x, y + 1) - self.v(velocity, x, y)
            })
            .collect()
    }
}

/// Part of a projection's correction by which the carried velocity leads.
pub const LEAD: f64 = 0.5;

/// What a gas is at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Velocity at the western and at the northern face, m/s.
    pub velocity: Vec<[f64; 2]>,
    /// What the flow carries as its velocity, m/s: the velocity led by [`LEAD`] of what the last projection took from it.
    ///
    /// A step that carries, then projects, is off by the pressure that acts meanwhile, and a steady vortex loses energy by ½·dt of
    /// its own rate, as by a viscosity. Leading by all of it is second order, but a first step without a past then gains energy
    /// (1 in 1,000 at 64²); half loses a third as much and never gains. After \[Zehnder\], who reflect about the projection.
    pub leading: Vec<[f64; 2]>,
    /// Density and dye at the centre.
    pub scalars: Vec<[f64; 2]>,
}

/// Half the sum of the squared velocities of the faces.
pub fn kinetic_energy(velocity: &[[f64; 2]]) -> f64 {
    0.5 * velocity.iter().map(|[u, v]| u * u + v * v).sum::<f64>()
}

/// One step: what is emitted, then the flow carries all, forces act on it, and the projection takes its divergence.
pub fn step(grid: &Grid, forces: &Forces, courant: f64, emitted: &[Emission], state: &State) -> State {
    let mut start = state.clone();
    emitted.iter().for_each(|emission| gas_emit::emit(grid, emission, &mut start));
    let carried = gas_advect::maccormack(grid, courant, &start);
    let pushed = gas_force::apply(grid, forces, &carried);
    gas_project::project(grid, &pushed)
}
