//! Shallow water in f64: the specification of `shaders/field/shallow_water.wgsl`.
//!
//! h_t + ∇·(h u) = rain − seepage, (h u)_t + ∇·(h u⊗u) + g h ∇(h + b) = −g n² |u| u / h^⅓, with depth h and velocity u over a bed b:
//! each direction by turns, x first in even steps and y first in odd ones (Strang), by the midpoint rule: a half step in first order,
//! then minmod slopes of what it gives. HLLC fluxes (\[Toro\]) of
//! hydrostatically reconstructed states (\[Audusse\]), mass fluxes that never take more than there is, velocities of thin films
//! desingularised (\[KP\]), and friction point-implicit.

use crate::scene::Border;

/// What water obeys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Gravity, m/s².
    pub gravity: f64,
    /// Manning's n, s/m^⅓.
    pub manning: f64,
    /// Depth under which a velocity is no quotient any more, metres.
    pub dry_metres: f64,
    /// No component of a velocity exceeds this, m/s.
    pub speed_cap: f64,
    /// Share of a texel that the fastest wave may cross in a step.
    pub courant: f64,
    /// West, east, north, south.
    pub borders: [Border; 4],
    /// Level of the sea beyond its borders, metres above b = 0, and what the swell adds to it now.
    pub sea: [f64; 2],
    /// What falls, m/s.
    pub rain: f64,
    /// What the ground takes, m/s.
    pub seepage: f64,
    /// Foam that breaking makes, 1/s.
    pub foam_gain: f64,
    /// What foam loses, 1/s.
    pub foam_loss: f64,
}

/// One texel in a line along the direction of a sweep.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Cell {
    depth: f64,
    along: f64,
    across: f64,
    foam: f64,
    bed: f64,
}

/// What passes a face, and what presses on the cells before and behind it.
#[derive(Clone, Copy, Debug, Default)]
struct Face {
    mass: f64,
    pressed: [f64; 2],
    across: f64,
    foam: f64,
    speed: f64,
}

/// Water on a lattice of texels.
#[derive(Clone, Debug, PartialEq)]
pub struct Water {
    /// Width and height, texels.
    pub size: [usize; 2],
    /// Side of a texel, metres.
    pub texel_metres: f64,
    /// What it obeys.
    pub rules: Rules,
    /// Depth, metres, row by row.
    pub depth: Vec<f64>,
    /// Depth times velocity, m²/s.
    pub flow: Vec<[f64; 2]>,
    /// Share of the surface that is foam.
    pub foam: Vec<f64>,
    /// Height of the bed, metres.
    pub bed: Vec<f64>,
    /// Steps done.
    pub steps: u64,
    /// The fastest wave, m/s.
    pub speed: f64,
}

/// The smaller of two slopes of one sign.
fn minmod(before: f64, after: f64) -> f64 {
    if before * after <= 0.0 { 0.0 } else { before.abs().min(after.abs()).copysign(before) }
}

impl Rules {
    fn velocity(&self, flow: f64, depth: f64) -> f64 {
        let kept = 2.0 * depth / (depth * depth + (depth * depth).max(self.dry_metres * self.dry_metres));
        (kept * flow).clamp(-self.speed_cap, self.speed_cap)
    }
}

/// Depth, surface, velocities and foam at one end of a cell.
#[derive(Clone, Copy)]
struct End {
    depth: f64,
    surface: f64,
    along: f64,
    across: f64,
    foam: f64,
}

impl Water {
    /// Ends of a cell, and the pull of its own bed between them.
    fn ends(&self, before: &Cell, cell: &Cell, after: &Cell) -> ([End; 2], f64) {
        let slope = |of: fn(&Cell) -> f64| minmod(of(cell) - of(before), of(after) - of(cell));
        let surface_slope = slope(|cell| cell.depth + cell.bed);
        let depth_slope = slope(|cell| cell.depth);
        let [along, across, foam] = [slope(|cell| cell.along), slope(|cell| cell.across), slope(|cell| cell.foam)];
        let ends = [-0.5, 0.5].map(|side| {
            let depth = cell.depth + side * depth_slope;
            let lack = (-depth).max(0.0);
            End {
                depth: depth + lack,
                surface: cell.depth + cell.bed + side * surface_slope + lack,
                along: cell.along + side * along,
                across: cell.across + side * across,
                foam: cell.foam + side * foam,
            }
        });
        let pull = 0.5 * self.rules.gravity * (ends[0].depth + ends[1].depth) * (ends[1].surface - ends[0].surface);
        (ends, pull)
    }

    /// What passes between the second and the third of four cells; each face takes its part of `stocks`, the depths of those two before.
    fn face(&self, cells: [&Cell; 4], stocks: [f64; 2], ratio: f64, closed: bool) -> Face {
        let g = self.rules.gravity;
        let [_, left_cell, right_cell, _] = cells;
        let ([_, left], left_pull) = self.ends(cells[0], left_cell, right_cell);
        let ([right, _], right_pull) = self.ends(left_cell, right_cell, cells[3]);
        let sill = (left.surface - left.depth).max(right.surface - right.depth);
        let depths = [(left.surface - sill).max(0.0), (right.surface - sill).max(0.0)];
        let [hl, hr] = depths;
        let [ul, ur] = [left.along, right.along];
        let [cl, cr] = depths.map(|depth| (g * depth).sqrt());
        let middle = 0.5 * (ul + ur) + cl - cr;
        let celerity = (0.5 * (cl + cr) + 0.25 * (ul - ur)).max(0.0);
        let mut low = (ul - (g * left.depth).sqrt()).min(middle - celerity);
        let mut high = (ur + (g * right.depth).sqrt()).max(middle + celerity);
        if hl <= 0.0 {
            (low, high) = (ur - 2.0 * cr, ur + cr);
        } else if hr <= 0.0 {
            (low, high) = (ul - cl, ul + 2.0 * cl);
        }
        let speed = if hl + hr > 0.0 { low.abs().max(high.abs()) } else { 0.0 };
        let low = low.min(0.0);
        let high = high.max(0.0);
        let share = if high - low > 0.0 { low / (high - low) } else { 0.0 };
        let flows = [hl * ul, hr * ur];
        let mass = flows[0] + share * ((flows[0] - flows[1]) + high * (hr - hl));
        let pressure = 0.5 * g * (hl - hr) * (hl + hr);
        let carried = flows[0] * ul + share * ((flows[0] * ul - flows[1] * ur + pressure) + high * (flows[1] - flows[0]));
        // No face takes more than its share of what there is: the shares of a cell's two faces are 1 together.
        let left_share = 0.5 + 0.5 * (left_cell.along * ratio).clamp(-1.0, 1.0);
        let right_share = 0.5 - 0.5 * (right_cell.along * ratio).clamp(-1.0, 1.0);
        let allowed = mass.clamp(-right_share * stocks[1] / ratio, left_share * stocks[0] / ratio);
        let allowed = if closed { 0.0 } else { allowed };
        let scale = if mass == 0.0 || closed { 1.0 } else { allowed / mass };
        let upwind = if allowed >= 0.0 { &left } else { &right };
        let from_left = scale * carried + (1.0 - scale) * if mass < 0.0 { -pressure } else { 0.0 };
        Face {
            mass: allowed,
            pressed: [from_left + 0.5 * left_pull, from_left + pressure - 0.5 * right_pull],
            across: allowed * upwind.across,
            foam: allowed * upwind.foam,
            speed,
        }
    }

    /// A cell after what passed its two faces.
    fn moved(&self, cell: &Cell, before: &Face, after: &Face, ratio: f64) -> Cell {
        let depth = (cell.depth - ratio * (after.mass - before.mass)).max(0.0);
        let along = cell.depth * cell.along - ratio * (after.pressed[0] - before.pressed[1]);
        let across = cell.depth * cell.across - ratio * (after.across - before.across);
        let foam = cell.depth * cell.foam - ratio * (after.foam - before.foam);
        Cell {
            depth,
            along: self.rules.velocity(along, depth),
            across: self.rules.velocity(across, depth),
            foam: if depth > self.rules.dry_metres { (foam / depth).clamp(0.0, 1.0) } else { cell.foam },
            bed: cell.bed,
        }
    }

    /// One direction. What it makes of thin films' velocities goes to the next one as it is: through a flow they would be desingularised
    /// once more.
    fn sweep(&mut self, axis: usize, velocity: &mut [[f64; 2]], dt: f64) {
        let ratio = dt / self.texel_metres;
        let [width, height] = self.size;
        let (length, lines, stride, line_stride) = if axis == 0 { (width, height, 1, width) } else { (height, width, width, 1) };
        for number in 0..lines {
            let index = |at: usize| number * line_stride + at * stride;
            let line = self.line(axis, velocity, &index, length);
            let is_closed = |face: usize| {
                let border = if face == 0 {
                    Some(0)
                } else if face == length {
                    Some(1)
                } else {
                    None
                };
                border.is_some_and(|end| self.rules.borders[2 * axis + end] == Border::Wall)
            };
            // The midpoint rule. Half a step ahead, in first order: a cell and its neighbour twice have no slopes.
            let first: Vec<Face> = (0..length + 5)
                .map(|face| {
                    let (left, right) = (&line[face], &line[face + 1]);
                    let closed = face > 1 && is_closed(face - 2);
                    self.face([left, left, right, right], [left.depth, right.depth], 0.5 * ratio, closed)
                })
                .collect();
            let mut ahead = line.clone();
            for at in 1..length + 5 {
                ahead[at] = self.moved(&line[at], &first[at - 1], &first[at], 0.5 * ratio);
            }
            let faces: Vec<Face> = (0..=length)
                .map(|face| {
                    let cells = [0, 1, 2, 3].map(|cell| &ahead[face + 1 + cell]);
                    self.face(cells, [line[face + 2].depth, line[face + 3].depth], ratio, is_closed(face))
                })
                .collect();
            for at in 0..length {
                let cell = self.moved(&line[at + 3], &faces[at], &faces[at + 1], ratio);
                self.depth[index(at)] = cell.depth;
                velocity[index(at)] = if axis == 0 { [cell.along, cell.across] } else { [cell.across, cell.along] };
                self.foam[index(at)] = cell.foam;
            }
            self.speed = faces.iter().fold(self.speed, |speed, face| speed.max(face.speed));
        }
    }

    /// A line along an axis, with three cells beyond each border.
    fn line(&self, axis: usize, velocity: &[[f64; 2]], index: &dyn Fn(usize) -> usize, length: usize) -> Vec<Cell> {
        let n = length as i64;
        (-3..n + 3)
            .map(|at| {
                let end = usize::from(at >= n);
                let border = self.rules.borders[2 * axis + end];
                let outside = at < 0 || at >= n;
                let mirrored = if at < 0 { -1 - at } else { 2 * n - 1 - at };
                let source = if !outside {
                    at
                } else {
                    match border {
                        Border::Periodic => at.rem_euclid(n),
                        Border::Wall => mirrored.clamp(0, n - 1),
                        Border::Open | Border::Sea => at.clamp(0, n - 1),
                    }
                };
                let i = index(source as usize);
                let mut cell = Cell {
                    depth: self.depth[i],
                    along: velocity[i][axis],
                    across: velocity[i][1 - axis],
                    foam: self.foam[i],
                    bed: self.bed[i],
                };
                if outside && border == Border::Wall {
                    cell.along = -cell.along;
                }
                if outside && border == Border::Open {
                    // Out, not in.
                    cell.along = if end == 0 { cell.along.min(0.0) } else { cell.along.max(0.0) };
                }
                if outside && border == Border::Sea {
                    let [level, rise] = self.rules.sea;
                    cell.depth = (level + rise - cell.bed).max(0.0);
                    let inward = if end == 0 { 1.0 } else { -1.0 };
                    cell.along =
                        inward * rise * (self.rules.gravity / cell.depth.max(rise.abs()).max(self.rules.dry_metres)).sqrt();
                    cell.across = 0.0;
                    cell.foam = 0.0;
                }
                cell
            })
            .collect()
    }

    /// Advances by one step of this length, seconds, stable or not.
    pub fn step(&mut self, dt: f64) {
        let before = self.depth.clone();
        self.speed = 0.0;
        let first = (self.steps % 2) as usize;
        let mut velocity: Vec<_> =
            self.flow.iter().zip(&self.depth).map(|(flow, depth)| flow.map(|flow| self.rules.velocity(flow, *depth))).collect();
        self.sweep(first, &mut velocity, dt);
        self.sweep(1 - first, &mut velocity, dt);
        for ((flow, depth), velocity) in self.flow.iter_mut().zip(&self.depth).zip(velocity) {
            *flow = velocity.map(|velocity| velocity * depth);
        }
        for (i, depth) in before.into_iter().enumerate() {
            self.settle(i, depth, dt);
        }
        self.steps += 1;
    }

    /// Rain, seepage, friction and foam.
    fn settle(&mut self, i: usize, before: f64, dt: f64) {
        let rules = self.rules;
        let depth = (self.depth[i] + dt * (rules.rain - rules.seepage)).max(0.0);
        let [u, v] = self.flow[i].map(|flow| rules.velocity(flow, depth));
        let drag = rules.gravity * rules.manning.powi(2) * depth.max(rules.dry_metres).powf(-4.0 / 3.0);
        let kept = 2.0 / (1.0 + (1.0 + 4.0 * dt * drag * u.hypot(v)).sqrt());
        self.flow[i] = [u, v].map(|u| kept * u * depth);
        let celerity = (rules.gravity * depth).sqrt();
        let rate = (self.depth[i] - before) / dt;
        let steepness = ((rate / celerity.max(1e-12) - 0.15) / 0.35).clamp(0.0, 1.0);
        let foam = self.foam[i] + dt * rules.foam_gain * steepness;
        self.foam[i] = (foam / (1.0 + dt * rules.foam_loss)).clamp(0.0, 1.0);
        self.depth[i] = depth;
        self.speed = self.speed.max(u.abs().max(v.abs()) * kept + celerity);
    }

    /// The fastest wave that could start from this state, m/s: |u| + 2√(g h), for a front may run onto dry ground.
    pub fn measure(&mut self) {
        let rules = self.rules;
        self.speed = (0..self.depth.len())
            .map(|i| {
                let [u, v] = self.flow[i].map(|flow| rules.velocity(flow, self.depth[i]).abs());
                u.max(v) + 2.0 * (rules.gravity * self.depth[i]).sqrt()
            })
            .fold(0.0, f64::max);
    }

    /// Advances by `seconds` in as few equal steps as are stable, at most `cap`; what is left over, seconds.
    pub fn advance(&mut self, seconds: f64, cap: u32) -> f64 {
        let mut left = seconds;
        for _ in 0..cap {
            if left <= 0.0 {
                break;
            }
            let longest = self.rules.courant * self.texel_metres / self.speed.max(1e-9);
            let steps = (left / longest).ceil().max(1.0);
            let dt = left / steps;
            self.step(dt);
            left = if steps == 1.0 { 0.0 } else { left - dt };
        }
        left
    }
}
