//! Advection in f64: the specification of `shaders/field/gas_advect.wgsl`.
//!
//! MacCormack's scheme after \[Selle\]: carry everything forward by a semi-Lagrangian step, carry the result back, and take half of
//! what the round trip lost as a correction; then clamp to the extrema of the four values that the first step interpolated. Paths
//! are traced with the midpoint rule, in the velocity; what is carried as velocity is the leading one.

use super::gas::{Grid, State};

/// Two numbers a cell.
type Pairs<'a> = &'a [[f64; 2]];

/// What is sampled, and where in a cell it stands: from the cell's north-western corner, cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum At {
    /// The velocity along u, at the middle of the western face.
    West,
    /// The velocity along v, at the middle of the northern face.
    North,
    /// A scalar, at the centre.
    Centre(usize),
}

impl At {
    /// Where it stands.
    pub fn offset(self) -> [f64; 2] {
        match self {
            Self::West => [0.0, 0.5],
            Self::North => [0.5, 0.0],
            Self::Centre(_) => [0.5, 0.5],
        }
    }

    /// Its value of a cell, where a state holds pairs of numbers.
    pub fn load(self, grid: &Grid, pairs: Pairs<'_>, x: i64, y: i64) -> f64 {
        match self {
            Self::West => grid.u(pairs, x, y),
            Self::North => grid.v(pairs, x, y),
            Self::Centre(scalar) => pairs[grid.index(x, y)][scalar],
        }
    }

    /// The four values around a position, and the weights of the later ones along each axis.
    pub fn stencil(self, grid: &Grid, pairs: Pairs<'_>, position: [f64; 2]) -> ([f64; 4], [f64; 2]) {
        let lattice = [0, 1].map(|axis| position[axis] - self.offset()[axis]);
        let [x, y] = lattice.map(|along| along.floor() as i64);
        let weights = lattice.map(|along| along - along.floor());
        ([(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].map(|(x, y)| self.load(grid, pairs, x, y)), weights)
    }

    /// The bilinear interpolant at a position, cells.
    pub fn sample(self, grid: &Grid, pairs: Pairs<'_>, position: [f64; 2]) -> f64 {
        let (corners, [right, down]) = self.stencil(grid, pairs, position);
        let along = |a: f64, b: f64, weight: f64| a + (b - a) * weight;
        along(along(corners[0], corners[1], right), along(corners[2], corners[3], right), down)
    }
}

/// The velocity at a position, m/s.
fn flow(grid: &Grid, state: &State, position: [f64; 2]) -> [f64; 2] {
    [At::West, At::North].map(|at| at.sample(grid, &state.velocity, position))
}

/// Where the flow leads from a position in `courant` cells per m/s: forward, or backward if that is negative.
pub fn follow(grid: &Grid, courant: f64, state: &State, position: [f64; 2]) -> [f64; 2] {
    let moved = |by: f64, velocity: [f64; 2]| [0, 1].map(|axis| position[axis] + by * velocity[axis]);
    let middle = moved(0.5 * courant, flow(grid, state, position));
    moved(courant, flow(grid, state, middle))
}

/// Evaluates something for everything that a cell holds.
fn everywhere(grid: &Grid, velocity: &[[f64; 2]], of: impl Fn(At, i64, i64) -> f64) -> State {
    let all = |a: At, b: At| grid.cells().map(|(x, y)| [of(a, x, y), of(b, x, y)]).collect();
    State { velocity: velocity.to_vec(), leading: all(At::West, At::North), scalars: all(At::Centre(0), At::Centre(1)) }
}

/// What a state holds of something that the flow carries.
fn carried(at: At, state: &State) -> Pairs<'_> {
    match at {
        At::West | At::North => &state.leading,
        At::Centre(_) => &state.scalars,
    }
}

/// Whether it is the velocity across a wall, which is nothing.
fn walled(grid: &Grid, at: At, x: i64, y: i64) -> bool {
    match at {
        At::West => !grid.open(0, x),
        At::North => !grid.open(1, y),
        At::Centre(_) => false,
    }
}

/// The position of what a cell holds.
fn place(at: At, x: i64, y: i64) -> [f64; 2] {
    [x as f64 + at.offset()[0], y as f64 + at.offset()[1]]
}

/// The semi-Lagrangian step: everything is what it was where the flow comes from.
pub fn semi_lagrangian(grid: &Grid, courant: f64, state: &State) -> State {
    everywhere(grid, &state.velocity, |at, x, y| {
        let from = follow(grid, -courant, state, place(at, x, y));
        if walled(grid, at, x, y) { 0.0 } else { at.sample(grid, carried(at, state), from) }
    })
}

/// The corrected and limited step.
pub fn maccormack(grid: &Grid, courant: f64, state: &State) -> State {
    let ahead = semi_lagrangian(grid, courant, state);
    everywhere(grid, &state.velocity, |at, x, y| {
        if walled(grid, at, x, y) {
            return 0.0;
        }
        let here = place(at, x, y);
        let back = at.sample(grid, carried(at, &ahead), follow(grid, courant, state, here));
        let corrected = at.load(grid, carried(at, &ahead), x, y) + 0.5 * (at.load(grid, carried(at, state), x, y) - back);
        let (corners, _) = at.stencil(grid, carried(at, state), follow(grid, -courant, state, here));
        let (low, high) = corners.iter().fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(*value), high.max(*value)));
        corrected.clamp(low, high)
    })
}
