//! The wave equation in f64: the specification of `shaders/field/wave.wgsl`.
//!
//! (1 + γ/2)·u⁺ = 2u − (1 − γ/2)·u⁻ + C²·L(u), with L the sum of the differences to the neighbours that a texel exchanges with.
//! It knows borders and obstacles by their definitions, not by the mask that the shader reads.

use crate::field::wave::Impulse;
use crate::scene::Boundary;

/// A wave on a lattice of texels.
#[derive(Clone, Debug, PartialEq)]
pub struct Wave {
    /// Width and height, texels.
    pub size: [usize; 2],
    /// What it meets at the border.
    pub boundary: Boundary,
    /// Where obstacles stand, row by row.
    pub closed: Vec<bool>,
    /// C², the squared Courant number.
    pub courant_squared: f64,
    /// γ, the damping of a step.
    pub damping: f64,
    /// What the sponge of an absorbing border adds to γ at the border; it falls with the square of the distance.
    pub sponge_damping: f64,
    /// Width of the sponge, texels.
    pub sponge_texels: f64,
    /// u now, row by row.
    pub current: Vec<f64>,
    /// u one step ago.
    pub previous: Vec<f64>,
}

impl Wave {
    /// Still water without damping, sponge or obstacles.
    pub fn still(size: [usize; 2], boundary: Boundary, courant_squared: f64) -> Self {
        let count = size[0] * size[1];
        Self {
            size,
            boundary,
            closed: vec![false; count],
            courant_squared,
            damping: 0.0,
            sponge_damping: 0.0,
            sponge_texels: 0.0,
            current: vec![0.0; count],
            previous: vec![0.0; count],
        }
    }

    /// The index of a texel; where the wave is periodic, of its image in the field.
    fn index(&self, x: i64, y: i64) -> Option<usize> {
        let [width, height] = self.size.map(|size| size as i64);
        let (x, y) = match self.boundary {
            Boundary::Periodic => (x.rem_euclid(width), y.rem_euclid(height)),
            _ if x < 0 || y < 0 || x >= width || y >= height => return None,
            _ => (x, y),
        };
        Some((y * width + x) as usize)
    }

    /// The neighbours that a texel exchanges with: those that are neither beyond a border nor in an obstacle.
    fn neighbours(&self, x: i64, y: i64) -> impl Iterator<Item = usize> + '_ {
        [(-1, 0), (1, 0), (0, -1), (0, 1)]
            .into_iter()
            .filter_map(move |(dx, dy)| self.index(x + dx, y + dy))
            .filter(|neighbour| !self.closed[*neighbour])
    }

    /// Texels to the nearest border.
    fn inward(&self, x: i64, y: i64) -> i64 {
        x.min(y).min(self.size[0] as i64 - 1 - x).min(self.size[1] as i64 - 1 - y)
    }

    /// Whether the texel moves: it is no obstacle and no border that is held at 0.
    pub fn is_free(&self, x: i64, y: i64) -> bool {
        let held = matches!(self.boundary, Boundary::Fixed | Boundary::Absorbing) && self.inward(x, y) == 0;
        self.index(x, y).is_some_and(|index| !self.closed[index] && !held)
    }

    /// Advances by one step.
    pub fn step(&mut self) {
        let mut next = vec![0.0; self.current.len()];
        for y in 0..self.size[1] as i64 {
            for x in 0..self.size[0] as i64 {
                if !self.is_free(x, y) {
                    continue;
                }
                let index = y as usize * self.size[0] + x as usize;
                let u = self.current[index];
                let laplacian: f64 = self.neighbours(x, y).map(|neighbour| self.current[neighbour] - u).sum();
                let mut damping = self.damping;
                if self.boundary == Boundary::Absorbing {
                    let depth = (1.0 - self.inward(x, y) as f64 / self.sponge_texels).max(0.0);
                    damping += self.sponge_damping * depth * depth;
                }
                next[index] = (2.0 * u - (1.0 - damping / 2.0) * self.previous[index] + self.courant_squared * laplacian)
                    / (1.0 + damping / 2.0);
            }
        }
        self.previous = std::mem::replace(&mut self.current, next);
    }

    /// Adds an impulse to u and u⁻ alike.
    pub fn splash(&mut self, impulse: &Impulse) {
        let (radius, strength) = (f64::from(impulse.radius()), f64::from(impulse.strength()));
        let centre = impulse.centre().map(f64::from);
        let around = |axis: usize| (centre[axis] - radius).ceil() as i64..=(centre[axis] + radius).floor() as i64;
        let mut covered = Vec::new();
        for y in around(1) {
            for x in around(0) {
                let s = ((x as f64 - centre[0]).powi(2) + (y as f64 - centre[1]).powi(2)) / (radius * radius);
                let (wrapped_x, wrapped_y) = match self.boundary {
                    Boundary::Periodic => (x.rem_euclid(self.size[0] as i64), y.rem_euclid(self.size[1] as i64)),
                    _ => (x, y),
                };
                if s < 1.0 && self.is_free(wrapped_x, wrapped_y) {
                    covered.push((wrapped_y as usize * self.size[0] + wrapped_x as usize, s));
                }
            }
        }
        let dent: f64 = covered.iter().map(|(_, s)| (1.0 - s).powi(2)).sum();
        let ring: f64 = covered.iter().map(|(_, s)| (1.0 - s).powi(2) * s).sum();
        if ring <= 1e-6 * dent {
            return;
        }
        for (index, s) in covered {
            let added = strength * (1.0 - s).powi(2) * (1.0 - dent / ring * s);
            self.current[index] += added;
            self.previous[index] += added;
        }
    }

    /// The energy that an undamped wave conserves: ½Σ(u − u⁻)² + ½C²Σ∇u·∇u⁻, each pair of neighbours once.
    pub fn energy(&self) -> f64 {
        let mut energy = 0.0;
        for y in 0..self.size[1] as i64 {
            for x in 0..self.size[0] as i64 {
                let here = y as usize * self.size[0] + x as usize;
                energy += 0.5 * (self.current[here] - self.previous[here]).powi(2);
                if self.closed[here] {
                    continue;
                }
                let ahead = [(1, 0), (0, 1)].into_iter().filter_map(|(dx, dy)| self.index(x + dx, y + dy));
                for there in ahead.filter(|there| !self.closed[*there]) {
                    let slope = |u: &[f64]| u[there] - u[here];
                    energy += 0.5 * self.courant_squared * slope(&self.current) * slope(&self.previous);
                }
            }
        }
        energy
    }

    /// The mean of u over all texels.
    pub fn mean(&self) -> f64 {
        self.current.iter().sum::<f64>() / self.current.len() as f64
    }
}
