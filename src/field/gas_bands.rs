//! Gas in bands: what it starts from, and what its rows return to. Made on the CPU, once.
//!
//! Winds blow along u, east and west by turns, fastest at the equator, as on the gas giants; bright and dark gas lies between them.
//! Vortices that turn with the shear they lie in last; those that turn against it are torn. All of them come from one function of
//! the seed, so that nothing has a seam along u.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::base::{gradient_octaves_3, hash_cell};
use crate::reference::gas::{Grid, State};
use crate::reference::gas_force::Row;
use crate::scene::{Gas, GasBands};

/// The bands of one scene.
pub struct Bands<'a> {
    bands: &'a GasBands,
    salt: u32,
}

/// A vortex of the start.
struct Storm {
    /// Its middle: u in turns, v in heights of the field.
    at: [f64; 2],
    /// Half its extent along u and v, metres.
    half: [f64; 2],
    /// Speed at its edge, m/s, clockwise on the screen.
    speed: f64,
    /// Its dye.
    dye: f64,
}

fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl<'a> Bands<'a> {
    /// The bands of a seed.
    pub fn new(bands: &'a GasBands, seed: u64) -> Self {
        Self { bands, salt: (seed as u32) ^ ((seed >> 32) as u32).rotate_left(11) }
    }

    fn random(&self, index: i32, of: i32) -> f64 {
        hash_cell([index, of], self.salt)
    }

    /// Where a place along v lies among the bands: whole numbers are pairs. Bands differ in width.
    fn phase(&self, v: f64) -> f64 {
        let sway = |index: i32| (TAU * (f64::from(index) * v + self.random(index, 1))).sin() / f64::from(index).powi(2);
        f64::from(self.bands.pairs) * (v + 0.026 * (sway(1) + sway(2) + sway(3)))
    }

    /// How much of the wind is left near the borders along v.
    fn alive(&self, v: f64) -> f64 {
        smoothstep(0.0, f64::from(self.bands.calm_border).max(1e-9), v.min(1.0 - v))
    }

    /// The wind at a place along v, 0 to 1, m/s.
    pub fn wind(&self, v: f64) -> f64 {
        let from_equator = (v - 0.5) * PI;
        let jet = (-(from_equator / 0.16).powi(2)).exp();
        let turns = (TAU * self.phase(v)).sin() * (0.35 + 0.65 * from_equator.cos());
        f64::from(self.bands.wind_metres_per_second) * self.alive(v) * (jet + 0.45 * turns * (1.0 - jet))
    }

    /// Density and dye of a place along v.
    pub fn gas(&self, v: f64) -> [f64; 2] {
        let phase = self.phase(v);
        let wave = (TAU * phase + 0.4 * (2.0 * TAU * phase).sin()).cos();
        // Each half pair has a colour of its own, and passes over into the next where the winds are fastest.
        let half = 2.0 * phase + 0.5;
        let index = half.floor() as i32;
        let own = |index: i32| {
            let bright = index.rem_euclid(2) == 0;
            let drawn = self.random(index, 2);
            if bright { 0.52 + 0.42 * drawn } else { 0.06 + 0.36 * drawn }
        };
        let dye = own(index) + (own(index + 1) - own(index)) * smoothstep(0.55, 1.0, half - half.floor());
        let polar = smoothstep(0.30, 0.47, (v - 0.5).abs());
        [0.55 * wave * (1.0 - 0.75 * polar), dye + (0.36 - dye) * polar]
    }

    /// What each of so many rows returns to.
    pub fn rows(&self, gas: &Gas, rows: usize, height_metres: f64) -> Vec<Row> {
        let step = f64::from(gas.step_seconds);
        let pull = |rate: f64| 1.0 - (-rate * step).exp();
        (0..rows)
            .map(|row| {
                let v = (row as f64 + 0.5) / rows as f64;
                let [density, dye] = self.gas(v);
                // Where the wind dies away so does all else, within a second or two.
                let calm = pull(2.0 * (1.0 - self.alive(v)));
                Row {
                    wind: self.wind(v),
                    density,
                    dye,
                    wind_pull: pull(f64::from(self.bands.wind_pull_per_second)).max(calm),
                    calm_pull: calm,
                    gas_pull: pull(f64::from(self.bands.gas_pull_per_second)).max(0.2 * calm),
                    turn: turn(gas, v, height_metres),
                }
            })
            .collect()
    }

    /// The state that a grid of cells of this size starts from.
    pub fn start(&self, grid: &Grid, cell_metres: f64) -> State {
        let size = grid.size.map(|side| side as f64);
        let height_metres = size[1] * cell_metres;
        let storms = self.storms(size[0] * cell_metres, height_metres);
        // Noise upon a cylinder whose girth is the field's width: without a seam along u.
        let noise = |uv: [f64; 2], scale: f64, salt: u32, octaves: u32| {
            let girth = scale * size[0] / size[1];
            let at = DVec3::new((TAU * uv[0]).cos() * girth / TAU, uv[1] * scale, (TAU * uv[0]).sin() * girth / TAU);
            gradient_octaves_3(at, self.salt.wrapping_add(salt), octaves)
        };
        let away = |uv: [f64; 2], storm: &Storm| {
            let u = uv[0] - storm.at[0];
            let metres = [(u - u.round()) * size[0] * cell_metres, (uv[1] - storm.at[1]) * height_metres];
            (metres[0] / storm.half[0]).hypot(metres[1] / storm.half[1])
        };
        // The stream function at corners: its slopes, taken over a cell, are a velocity without divergence to the last bit.
        let eddy_metres = height_metres / 13.0;
        let stream = |x: i64, y: i64| {
            let uv = [x as f64 / size[0], y as f64 / size[1]];
            let eddies = 0.5 * f64::from(self.bands.eddies_metres_per_second) * eddy_metres * noise(uv, 13.0, 11, 2);
            let vortices: f64 = storms
                .iter()
                .map(|storm| (storm, away(uv, storm)))
                .map(|(storm, far)| 0.82 * storm.speed * storm.half[1] * (-far * far).exp())
                .sum();
            self.alive(uv[1]) * (eddies + vortices)
        };
        let stream: Vec<f64> = (0..=grid.size[1] as i64)
            .flat_map(|y| (0..grid.size[0] as i64).map(move |x| (x, y)))
            .map(|(x, y)| stream(x, y))
            .collect();
        let corner = |x: i64, y: i64| stream[y as usize * grid.size[0] + x.rem_euclid(grid.size[0] as i64) as usize];
        let velocity: Vec<[f64; 2]> = grid
            .cells()
            .map(|(x, y)| {
                let wind = self.wind((y as f64 + 0.5) / size[1]);
                let u = wind + (corner(x, y + 1) - corner(x, y)) / cell_metres;
                let v = -(corner(x + 1, y) - corner(x, y)) / cell_metres;
                [if grid.open(0, x) { u } else { 0.0 }, if grid.open(1, y) { v } else { 0.0 }]
            })
            .collect();
        let scalars = grid
            .cells()
            .map(|(x, y)| {
                let uv = [(x as f64 + 0.5) / size[0], (y as f64 + 0.5) / size[1]];
                let stray = noise(uv, 7.0, 31, 4) + 0.6 * noise([uv[0], uv[1] * 2.5], 14.0, 41, 3);
                let width = 0.5 / f64::from(self.bands.pairs);
                let v = uv[1] + f64::from(self.bands.waviness) * width * stray * self.alive(uv[1]);
                let [mut density, mut dye] = self.gas(v);
                density += 0.2 * noise([uv[0], uv[1] * 3.0], 12.0, 51, 3);
                dye += 0.13 * noise([uv[0], uv[1] * 2.5], 9.0, 61, 3);
                let ragged = 0.12 * noise(uv, 40.0, 71, 3);
                for storm in &storms {
                    let far = away(uv, storm) + ragged;
                    let inside = 1.0 - smoothstep(0.75, 1.15, far);
                    density += (0.6 - density) * inside * (0.8 + 0.2 * (5.0 * far).cos());
                    dye += (storm.dye - dye) * inside;
                }
                [density, dye.clamp(0.0, 1.0)]
            })
            .collect();
        State { leading: velocity.clone(), velocity, scalars }
    }

    /// The vortices of the start. The first is the largest, and red; the others are white ovals in a row or brown ones.
    fn storms(&self, width_metres: f64, height_metres: f64) -> Vec<Storm> {
        (0..self.bands.storms as i32)
            .map(|index| {
                let great = index == 0;
                let wanted = if great { 0.63 } else { 0.18 + 0.66 * self.random(index, 5) };
                // Between two winds, where the shear turns a vortex most: the steepest place nearby.
                let shear = |v: f64| (self.wind(v + 0.004) - self.wind(v - 0.004)) / (0.008 * height_metres);
                // Bright gas shows the great one best.
                let fit = |v: f64| shear(v).abs() * if great { self.gas(v)[1] } else { 1.0 };
                let at = (-30..=30)
                    .map(|step| wanted + 0.0018 * f64::from(step))
                    .max_by(|a, b| fit(*a).total_cmp(&fit(*b)))
                    .unwrap_or(wanted);
                let size = if great { 1.0 } else { 0.14 + 0.30 * self.random(index, 6).powi(2) };
                let along = size * f64::from(self.bands.storm_radius_metres);
                let across = if great { 0.56 } else { 0.68 };
                let turning = shear(at);
                Storm {
                    at: [if great { 0.42 } else { self.random(index, 7) }, at],
                    half: [along, across * along],
                    // ∂u/∂v above 0 turns against the clock on the screen. A patch keeps this shape in a shear a sixth of its
                    // own vorticity [Moore]; a weaker one is drawn out to a thread.
                    speed: -turning.signum()
                        * (3.0 * turning.abs() * across * along + 0.2 * f64::from(self.bands.wind_metres_per_second)),
                    dye: if great {
                        0.02
                    } else if self.random(index, 8) < 0.7 {
                        0.97
                    } else {
                        0.12
                    },
                }
            })
            .filter(|storm| storm.half[0] < 0.4 * width_metres)
            .collect()
    }
}

/// The angle by which the planet's turning turns a velocity in a step, at a place along v.
pub fn turn(gas: &Gas, v: f64, height_metres: f64) -> f64 {
    f64::from(gas.beta) * (v - 0.5) * height_metres * f64::from(gas.step_seconds)
}
