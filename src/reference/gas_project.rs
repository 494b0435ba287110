//! Projection in f64: the specification of `shaders/field/gas_project.wgsl`.
//!
//! A V-cycle of cell-centred geometric multigrid solves L p = div for the divergence of a velocity, and takes p's slope from it. Each
//! further cycle starts from the divergence that the velocity then has, so that what is left is of the velocity's rounding and not
//! of a large pressure's.
//!
//! A coarse level is the same rectangle in half as many cells along each axis, all of one size whether they divide or not: with
//! cells that are unions of two and a narrow or a wide last one, V-cycles on odd sizes converge half as fast. L exchanges between
//! neighbours by the length of their face over the distance of their centres. Residuals are summed into the coarse cells by area,
//! corrections interpolated linearly between their centres. Two Jacobi sweeps go before and three after, weighted by Chebyshev's
//! polynomials over the upper three quarters of the spectrum: unlike sweeps in two colours they ask for no even size where the
//! field repeats. The coarsest level is solved exactly, by its pseudo-inverse.

use std::f64::consts::FRAC_1_SQRT_2;

use super::gas::{Grid, LEAD, State};

/// V-cycles of a step.
pub const CYCLES: usize = 3;

/// The most cells of the level that is solved exactly.
pub const COARSEST_CELLS: usize = 256;

/// Weights of the sweeps before the coarser level's correction: one over the nodes of Chebyshev's polynomial on \[½, 2\], the
/// eigenvalues that the coarser level cannot see.
pub const BEFORE: [f64; 2] = [1.0 / (1.25 - 0.75 * FRAC_1_SQRT_2), 1.0 / (1.25 + 0.75 * FRAC_1_SQRT_2)];

/// Weights of those after it; cos 30° is half the root of 3.
pub const AFTER: [f64; 3] =
    [1.0 / (1.25 + 0.75 * 0.866_025_403_784_438_6), 1.0 / 1.25, 1.0 / (1.25 - 0.75 * 0.866_025_403_784_438_6)];

/// One level: the grid anew in fewer cells, all of one size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level {
    /// Its cells.
    pub size: [usize; 2],
    /// Cells of the finest level.
    pub finest: [usize; 2],
    /// Whether each axis repeats.
    pub periodic: [bool; 2],
}

impl Level {
    /// The finest.
    pub fn finest(grid: &Grid) -> Self {
        Self { size: grid.size, finest: grid.size, periodic: grid.periodic }
    }

    /// The next coarser one: half as many cells along each axis, rounded down while there are many, for fewer levels; rounded up
    /// where there are few, since three cells merged into one leave too much for the sweeps.
    pub fn coarser(&self) -> Self {
        Self { size: self.size.map(|side| if side < 8 { side.div_ceil(2) } else { side / 2 }), ..*self }
    }

    /// All levels, from the finest to the first that is solved exactly; there are two at least.
    pub fn all(grid: &Grid) -> Vec<Self> {
        let mut levels = vec![Self::finest(grid), Self::finest(grid).coarser()];
        while let Some(last) = levels.last().filter(|last| last.size[0] * last.size[1] > COARSEST_CELLS) {
            levels.push(last.coarser());
        }
        levels
    }

    /// Side of its cells along an axis, finest cells.
    pub fn side(&self, axis: usize) -> f64 {
        self.finest[axis] as f64 / self.size[axis] as f64
    }

    /// The neighbour along an axis, if there is another cell that way.
    fn neighbour(&self, axis: usize, at: usize, by: i64) -> Option<usize> {
        let (size, to) = (self.size[axis] as i64, at as i64 + by);
        let inside = (0..size).contains(&to);
        (inside || (self.periodic[axis] && size > 1)).then(|| to.rem_euclid(size) as usize)
    }

    fn index(&self, [x, y]: [usize; 2]) -> usize {
        y * self.size[0] + x
    }

    fn cells(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [width, height] = self.size;
        (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
    }

    /// The neighbours of a cell, and what it exchanges with each for a unit of difference.
    pub fn exchanges(&self, cell: [usize; 2]) -> Vec<(usize, f64)> {
        let mut found = Vec::new();
        for (axis, by) in [(0, -1), (0, 1), (1, -1), (1, 1)] {
            if let Some(to) = self.neighbour(axis, cell[axis], by) {
                let mut neighbour = cell;
                neighbour[axis] = to;
                found.push((self.index(neighbour), self.side(1 - axis) / self.side(axis)));
            }
        }
        found
    }

    /// b − L p.
    fn residual(&self, p: &[f64], b: &[f64]) -> Vec<f64> {
        self.cells()
            .map(|cell| {
                let here = self.index(cell);
                b[here] - self.exchanges(cell).iter().map(|(there, by)| by * (p[*there] - p[here])).sum::<f64>()
            })
            .collect()
    }

    /// One Jacobi sweep.
    fn sweep(&self, weight: f64, p: &[f64], b: &[f64]) -> Vec<f64> {
        let residual = self.residual(p, b);
        self.cells()
            .map(|cell| {
                let here = self.index(cell);
                let diagonal: f64 = self.exchanges(cell).iter().map(|(_, by)| by).sum();
                if diagonal > 0.0 { p[here] - weight * residual[here] / diagonal } else { p[here] }
            })
            .collect()
    }

    /// The sums of a fine level's residuals over this level's cells; a fine cell across a border is shared out by area.
    fn restrict(&self, fine: &Level, residual: &[f64]) -> Vec<f64> {
        // The part of a fine cell that lies in a coarse one, along an axis.
        let part = |axis: usize, cell: usize, fine_cell: usize| {
            let ratio = fine.size[axis] as f64 / self.size[axis] as f64;
            let (start, end) = (cell as f64 * ratio, (cell + 1) as f64 * ratio);
            (end.min(fine_cell as f64 + 1.0) - start.max(fine_cell as f64)).max(0.0)
        };
        let first = |axis: usize, cell: usize| cell * fine.size[axis] / self.size[axis];
        self.cells()
            .map(|cell| {
                let range = [0, 1].map(|axis| first(axis, cell[axis])..(first(axis, cell[axis]) + 4).min(fine.size[axis]));
                let mut sum = 0.0;
                for y in range[1].clone() {
                    for x in range[0].clone() {
                        sum += part(0, cell[0], x) * part(1, cell[1], y) * residual[fine.index([x, y])];
                    }
                }
                sum
            })
            .collect()
    }

    /// This level's p, linear between its centres, at the centre of a cell of the finer one.
    fn prolong(&self, fine: &Level, p: &[f64], cell: [usize; 2]) -> f64 {
        let along = [0, 1].map(|axis| {
            let at = (cell[axis] as f64 + 0.5) * self.size[axis] as f64 / fine.size[axis] as f64 - 0.5;
            let inside = |at: i64| {
                let size = self.size[axis] as i64;
                (if self.periodic[axis] { at.rem_euclid(size) } else { at.clamp(0, size - 1) }) as usize
            };
            let weight = at - at.floor();
            [(inside(at.floor() as i64), 1.0 - weight), (inside(at.floor() as i64 + 1), weight)]
        });
        along[1]
            .iter()
            .flat_map(|(y, down)| along[0].iter().map(move |(x, right)| ([*x, *y], right * down)))
            .map(|(at, weight)| weight * p[self.index(at)])
            .sum()
    }

    /// The symmetric pseudo-inverse of L, row by row: what solves it with the mean of p at 0.
    pub fn pseudo_inverse(&self) -> Vec<f64> {
        let n = self.size[0] * self.size[1];
        // −L + J/n is positive definite, and its inverse is the pseudo-inverse of −L, plus J/n. Gauss and Jordan without pivots.
        let mean = 1.0 / n as f64;
        let mut rows: Vec<Vec<f64>> = self
            .cells()
            .map(|cell| {
                let here = self.index(cell);
                let mut row = vec![mean; 2 * n];
                row[n..].fill(0.0);
                row[n + here] = 1.0;
                for (there, by) in self.exchanges(cell) {
                    row[there] -= by;
                    row[here] += by;
                }
                row
            })
            .collect();
        for pivot in 0..n {
            let scale = 1.0 / rows[pivot][pivot];
            rows[pivot].iter_mut().for_each(|value| *value *= scale);
            let of_pivot = rows[pivot].clone();
            for (index, row) in rows.iter_mut().enumerate().filter(|(index, _)| *index != pivot) {
                let _ = index;
                let factor = row[pivot];
                row.iter_mut().zip(&of_pivot).for_each(|(value, by)| *value -= factor * by);
            }
        }
        rows.iter().flat_map(|row| row[n..].iter().map(|value| mean - value).collect::<Vec<_>>()).collect()
    }
}

/// Solves L p = b of a level approximately, from p = 0.
fn v_cycle(levels: &[Level], b: &[f64]) -> Vec<f64> {
    let (level, coarser) = (levels[0], &levels[1..]);
    let Some(coarse) = coarser.first() else {
        let inverse = level.pseudo_inverse();
        return inverse.chunks_exact(b.len()).map(|row| row.iter().zip(b).map(|(by, b)| by * b).sum()).collect();
    };
    let mut p = vec![0.0; b.len()];
    BEFORE.iter().for_each(|weight| p = level.sweep(*weight, &p, b));
    let correction = v_cycle(coarser, &coarse.restrict(&level, &level.residual(&p, b)));
    for cell in level.cells() {
        p[level.index(cell)] += coarse.prolong(&level, &correction, cell);
    }
    AFTER.iter().for_each(|weight| p = level.sweep(*weight, &p, b));
    p
}

/// Takes most of its divergence from a velocity.
pub fn cycle(grid: &Grid, velocity: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let p = v_cycle(&Level::all(grid), &grid.divergence(velocity));
    grid.cells()
        .map(|(x, y)| {
            let here = p[grid.index(x, y)];
            let u = if grid.open(0, x) { grid.u(velocity, x, y) - (here - p[grid.index(x - 1, y)]) } else { 0.0 };
            let v = if grid.open(1, y) { grid.v(velocity, x, y) - (here - p[grid.index(x, y - 1)]) } else { 0.0 };
            [u, v]
        })
        .collect()
}

/// Takes its divergence from a state that forces acted on, in [`CYCLES`] cycles, and sets its leading velocity.
pub fn project(grid: &Grid, pushed: &State) -> State {
    let velocity = (0..CYCLES).fold(pushed.leading.clone(), |velocity, _| cycle(grid, &velocity));
    let lead = |now: &[f64; 2], before: &[f64; 2]| [0, 1].map(|axis| now[axis] + LEAD * (now[axis] - before[axis]));
    let leading = velocity.iter().zip(&pushed.leading).map(|(now, before)| lead(now, before)).collect();
    State { velocity, leading, scalars: pushed.scalars.clone() }
}
