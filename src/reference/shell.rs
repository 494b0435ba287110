//! Shell: a mesh's prisms, three tetrahedra each, in which world and field space are affine to one another. Specification of
//! `shaders/surface/shell.wgsl`.
//!
//! Every tetrahedron is asked, none is skipped, and a ray's way through each is a straight line over the field in f64.

use glam::{DMat3, DVec3};

use super::HeightField;
use super::traversal::Line;
use crate::mesh::Vertex;
use crate::surface::shell;

/// A tetrahedron of a shell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tetrahedron {
    /// Its corners, world, metres.
    pub corners: [DVec3; 4],
    /// Their lattice positions and heights.
    pub field: [DVec3; 4],
}

/// Every tetrahedron of a mesh's shell, `depth_metres` deep, over a field of this size.
pub fn tetrahedra(vertices: &[Vertex], indices: &[u32], field_size: [u32; 2], depth_metres: f32) -> Vec<Tetrahedron> {
    let inward = shell::inward(vertices);
    let size = glam::DVec2::new(f64::from(field_size[0]), f64::from(field_size[1]));
    let depth = f64::from(depth_metres);
    let mut all = Vec::new();
    for triangle in shell::triangles(vertices, indices) {
        let [a, b, c] = triangle.vertices.map(|index| index as usize);
        if a == b {
            continue;
        }
        let corner = |vertex: usize, is_low: bool| {
            let Vertex { position, uv, .. } = vertices[vertex];
            let lattice = uv.as_dvec2() * size - 0.5;
            let world = position.as_dvec3();
            if is_low { (world + depth * inward[vertex].as_dvec3(), lattice.extend(0.0)) } else { (world, lattice.extend(1.0)) }
        };
        let (upper, lower) = ([a, b, c].map(|v| corner(v, false)), [a, b, c].map(|v| corner(v, true)));
        for corners in [
            [upper[0], lower[0], lower[1], lower[2]],
            [upper[0], upper[1], lower[1], lower[2]],
            [upper[0], upper[1], upper[2], lower[2]],
        ] {
            let tetrahedron = Tetrahedron { corners: corners.map(|corner| corner.0), field: corners.map(|corner| corner.1) };
            if !tetrahedron.is_flat() {
                all.push(tetrahedron);
            }
        }
    }
    all
}

impl Tetrahedron {
    /// Barycentric coordinates of the last three corners, the matrix that a displacement from the first is multiplied with.
    fn weights(&self) -> DMat3 {
        let [origin, a, b, c] = self.corners;
        DMat3::from_cols(a - origin, b - origin, c - origin).inverse()
    }

    /// Whether it holds nothing.
    fn is_flat(&self) -> bool {
        let [origin, a, b, c] = self.corners;
        let (a, b, c) = (a - origin, b - origin, c - origin);
        a.dot(b.cross(c)).abs() < shell::FLAT * a.length() * b.length() * c.length()
    }

    /// Lattice position and height of a world point, by the tetrahedron's affine map.
    pub fn field_of(&self, world: DVec3) -> DVec3 {
        let [origin, a, b, c] = self.field;
        origin + DMat3::from_cols(a - origin, b - origin, c - origin) * (self.weights() * (world - self.corners[0]))
    }

    /// World point of a lattice position and height.
    pub fn world_of(&self, field: DVec3) -> DVec3 {
        let [origin, a, b, c] = self.field;
        let weights = DMat3::from_cols(a - origin, b - origin, c - origin).inverse() * (field - origin);
        let [origin, a, b, c] = self.corners;
        origin + DMat3::from_cols(a - origin, b - origin, c - origin) * weights
    }

    /// Where a ray enters and leaves, in units of its direction; none where it misses.
    pub fn way(&self, eye: DVec3, direction: DVec3) -> Option<[f64; 2]> {
        let weights = self.weights();
        let (start, slope) = (weights * (eye - self.corners[0]), weights * direction);
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        let sides = [
            (1.0 - start.x - start.y - start.z, -slope.x - slope.y - slope.z),
            (start.x, slope.x),
            (start.y, slope.y),
            (start.z, slope.z),
        ];
        for (weight, slope) in sides {
            if slope > 0.0 {
                enter = enter.max(-weight / slope);
            } else if slope < 0.0 {
                leave = leave.min(-weight / slope);
            } else if weight < 0.0 {
                return None;
            }
        }
        (enter < leave && leave.is_finite()).then_some([enter, leave])
    }

    /// The stretch of a ray between two of its parameters as a line over the field, from t = 0 to t = 1.
    pub fn line(&self, eye: DVec3, direction: DVec3, [enter, leave]: [f64; 2]) -> Line {
        let (start, end) = (self.field_of(eye + enter * direction), self.field_of(eye + leave * direction));
        let travel = end - start;
        Line { lattice: [start.x, start.y], travel: [travel.x, travel.y], height: start.z, rise: travel.z }
    }
}

/// The first point of a ray that is in the solid: the tetrahedron's place in the list, and how far along the ray.
pub fn first_hit(field: &HeightField, all: &[Tetrahedron], eye: DVec3, direction: DVec3) -> Option<(usize, f64)> {
    let hits = all.iter().enumerate().filter_map(|(index, tetrahedron)| {
        let way = tetrahedron.way(eye, direction)?;
        let line = tetrahedron.line(eye, direction, way);
        // A field of zeros lies on the floor itself, where rounding may leave a gap.
        let on_floor = (line.height + line.rise).abs() < 1e-9 && line.rise < 0.0;
        let t = line.meets(field, 0.0, 1.0).or(on_floor.then_some(1.0))?;
        Some((index, way[0] + t * (way[1] - way[0])))
    });
    hits.min_by(|a, b| a.1.total_cmp(&b.1))
}
