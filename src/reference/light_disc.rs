//! The light's disc in field space. Specification of `shaders/surface/light_disc.wgsl`, for a flat polygon.

use std::f64::consts::TAU;

use super::Ray;
use super::traversal::Line;

/// A direction lower above the reference surface than this, as a sine, has no light.
const LEVEL: f64 = 1e-4;

/// A light that is a disc of directions, as rays from one point see it.
///
/// Everything is in metres, with the light's azimuth as x, and y level at right angles to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightDisc {
    /// Cosine and sine of the centre's elevation.
    pub elevation: [f64; 2],
    /// Tangent of half the angle that the disc spans.
    pub radius: f64,
    /// The direction of x in the lattice, and of y: cells a metre.
    axes: [[f64; 2]; 2],
    depth_metres: f64,
}

/// How metres relate to field space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Width and height of a cell, metres.
    pub cell_metres: [f64; 2],
    /// Depth of height 0 below height 1, metres.
    pub depth_metres: f64,
}

impl LightDisc {
    /// The disc of this radius round the light that the ray points to.
    pub fn new(ray: &Ray, scale: &Scale, radius: f64) -> Self {
        let metres = [0, 1].map(|axis| f64::from(ray.travel[axis]) * scale.cell_metres[axis]);
        let level = metres[0].hypot(metres[1]);
        let [x, y] = if level > 0.0 { metres.map(|part| part / level) } else { [1.0, 0.0] };
        let length = level.hypot(scale.depth_metres);
        Self {
            elevation: [level / length, scale.depth_metres / length],
            radius,
            axes: [[x, y], [-y, x]].map(|axis| [0, 1].map(|part| axis[part] / scale.cell_metres[part])),
            depth_metres: scale.depth_metres,
        }
    }

    /// The same disc at another elevation, whose tangent is `up` over `level`.
    pub fn tilted(self, level: f64, up: f64) -> Self {
        let length = level.hypot(up);
        Self { elevation: [level / length, up / length], ..self }
    }

    /// The direction of a point of the disc, a above its centre and b beside it: along x, along y, up.
    pub fn direction(&self, [a, b]: [f64; 2]) -> [f64; 3] {
        let [cosine, sine] = self.elevation;
        [cosine - self.radius * a * sine, self.radius * b, sine + self.radius * a * cosine]
    }

    /// Whether a point of the disc is above the reference surface's horizon.
    pub fn shines(&self, point: [f64; 2]) -> bool {
        self.direction(point)[2] > LEVEL
    }

    /// The a of the reference surface's own horizon; −1 where the whole disc is above it.
    pub fn horizon(&self) -> f64 {
        let [cosine, sine] = self.elevation;
        ((LEVEL - sine) / (self.radius * cosine)).clamp(-1.0, 1.0)
    }

    /// The line from a lattice position and a height in a direction of the disc, by the height that it climbs.
    pub fn line(&self, lattice: [f64; 2], height: f64, [x, y, up]: [f64; 3]) -> Line {
        let travel = [0, 1].map(|axis| (x * self.axes[0][axis] + y * self.axes[1][axis]) * self.depth_metres / up);
        Line { lattice, travel, height, rise: 1.0 }
    }
}

/// Point `index` of `count` that cover the disc evenly: a spiral whose turns are golden sections (Vogel 1979).
pub fn point(index: u32, count: u32) -> [f64; 2] {
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    let radius = ((f64::from(index) + 0.5) / f64::from(count)).sqrt();
    let (sine, cosine) = (TAU * (golden * f64::from(index)).fract()).sin_cos();
    [radius * cosine, radius * sine]
}

/// The share of a disc that a straight edge leaves visible, x radii beyond its centre.
pub fn ramp(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    0.5 + (x * (1.0 - x * x).sqrt() + x.asin()) / std::f64::consts::PI
}
