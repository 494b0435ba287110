//! A ray against the bilinear surface: every cell that its projection crosses, one after the other, a quadratic in each.
//! Specification of `shaders/surface/traversal.wgsl`.
//!
//! No pyramid, no skipping, no state but the two borders that come next. It says where the ray first meets the surface and how
//! closely it passes before, so that a test can tell a graze from an error.

use super::{HeightField, Ray};

/// A straight line over the field, in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Lattice position at t = 0.
    pub lattice: [f64; 2],
    /// Lattice displacement while t grows by 1.
    pub travel: [f64; 2],
    /// Height at t = 0.
    pub height: f64,
    /// Height gained while t grows by 1.
    pub rise: f64,
}

impl From<&Ray> for Line {
    fn from(ray: &Ray) -> Self {
        Self { lattice: ray.lattice_at(0.0), travel: ray.travel.map(f64::from), height: ray.height.into(), rise: ray.rise.into() }
    }
}

impl Line {
    /// Lattice position at t.
    pub fn lattice_at(&self, t: f64) -> [f64; 2] {
        [0, 1].map(|axis| self.lattice[axis] + t * self.travel[axis])
    }

    /// Height above the surface at t; negative below it.
    pub fn gap(&self, field: &HeightField, t: f64) -> f64 {
        self.height + self.rise * t - field.bilinear(self.lattice_at(t))
    }

    /// What the line does in each cell from t = `begin` to t = `end`, in order.
    pub fn stretches<'a>(&self, field: &'a HeightField, begin: f64, end: f64) -> Stretches<'a> {
        let from = self.lattice_at(begin);
        let border = [0, 1].map(|axis| if self.travel[axis] < 0.0 { from[axis].ceil() - 1.0 } else { from[axis].floor() + 1.0 });
        Stretches { field, line: *self, border, t: begin, end }
    }

    /// The first t in [begin, end] at which the line is on the surface or below it.
    pub fn meets(&self, field: &HeightField, begin: f64, end: f64) -> Option<f64> {
        self.stretches(field, begin, end).find_map(|stretch| stretch.meets())
    }

    /// The least height above the surface for t in [begin, end], negative where the line dives under it, and the steepest slope
    /// of the cells on the way, in heights for each texel.
    pub fn closest(&self, field: &HeightField, begin: f64, end: f64) -> (f64, f64) {
        let nothing = (self.gap(field, begin), field.steepness(self.lattice_at(begin)));
        self.stretches(field, begin, end)
            .fold(nothing, |(gap, slope), stretch| (gap.min(stretch.lowest()), slope.max(stretch.steepness)))
    }
}

impl HeightField {
    /// The steepest slope of the cell at a lattice position, in heights for each texel: it is along one of the cell's edges on
    /// either axis.
    pub fn steepness(&self, lattice: [f64; 2]) -> f64 {
        let [z00, z10, z01, z11] = self.corners(lattice[0].floor() as i64, lattice[1].floor() as i64);
        steepness([z00, z10, z01, z11])
    }
}

fn steepness([z00, z10, z01, z11]: [f64; 4]) -> f64 {
    let along_u = (z10 - z00).abs().max((z11 - z01).abs());
    let along_v = (z01 - z00).abs().max((z11 - z10).abs());
    along_u.hypot(along_v)
}

/// The part of a line that lies over one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Where it begins.
    pub t: f64,
    /// How long it is.
    pub length: f64,
    /// Its height above the surface is `gap[0] + gap[1] s + gap[2] s²` with s = 0 at its beginning and `length` at its end.
    pub gap: [f64; 3],
    /// The steepest slope of the cell, in heights for each texel.
    pub steepness: f64,
}

impl Stretch {
    /// Height above the surface at s.
    fn at(&self, s: f64) -> f64 {
        self.gap[0] + s * (self.gap[1] + s * self.gap[2])
    }

    /// The s at which the height above the surface turns from falling to rising, where it does so within the stretch.
    pub fn valley(&self) -> Option<f64> {
        let s = -self.gap[1] / (2.0 * self.gap[2]);
        (self.gap[2] > 0.0 && s > 0.0 && s < self.length).then_some(s)
    }

    /// The least height above the surface.
    pub fn lowest(&self) -> f64 {
        let ends = self.at(0.0).min(self.at(self.length));
        self.valley().map_or(ends, |s| ends.min(self.at(s)))
    }

    /// The first t at which it is on the surface or below.
    pub fn meets(&self) -> Option<f64> {
        let [c, b, a] = self.gap;
        if c <= 0.0 {
            return Some(self.t);
        }
        if self.lowest() > 0.0 {
            return None;
        }
        // g falls from c > 0 to 0 or less: the smaller positive root. Neither form subtracts numbers that are nearly equal.
        let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
        let s = if b < 0.0 { 2.0 * c / (root - b) } else { (b + root) / (-2.0 * a) };
        Some(self.t + s.clamp(0.0, self.length))
    }
}

/// The stretches of a line, in order. See [`Line::stretches`].
pub struct Stretches<'a> {
    field: &'a HeightField,
    line: Line,
    /// The lattice line of each axis that comes next.
    border: [f64; 2],
    t: f64,
    end: f64,
}

impl Iterator for Stretches<'_> {
    type Item = Stretch;

    fn next(&mut self) -> Option<Stretch> {
        while self.t < self.end {
            let begin = self.t;
            let crossing = [0, 1].map(|axis| {
                let travel = self.line.travel[axis];
                if travel == 0.0 { f64::INFINITY } else { (self.border[axis] - self.line.lattice[axis]) / travel }
            });
            let end = crossing[0].min(crossing[1]).min(self.end);
            for axis in [0, 1] {
                if crossing[axis] <= end {
                    self.border[axis] += self.line.travel[axis].signum();
                }
            }
            self.t = end.max(begin);
            if end > begin {
                return Some(self.stretch(begin, end));
            }
        }
        None
    }
}

impl Stretches<'_> {
    fn stretch(&self, begin: f64, end: f64) -> Stretch {
        let Line { travel: [dx, dy], height, rise, .. } = self.line;
        let [x, y] = self.line.lattice_at(begin);
        // The middle says which cell it is: the ends are on borders.
        let cell = self.line.lattice_at(0.5 * (begin + end)).map(f64::floor);
        let [u, v] = [x - cell[0], y - cell[1]];
        let corners = self.field.corners(cell[0] as i64, cell[1] as i64);
        let [z00, z10, z01, z11] = corners;
        let (a, b, k) = (z10 - z00, z01 - z00, z00 - z10 - z01 + z11);
        let surface = z00 + a * u + b * v + k * u * v;
        Stretch {
            t: begin,
            length: end - begin,
            gap: [height + rise * begin - surface, rise - a * dx - b * dy - k * (u * dy + v * dx), -k * dx * dy],
            steepness: steepness(corners),
        }
    }
}
