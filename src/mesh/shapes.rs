//! The shapes of the program's own, with few polygons: the relief is the field's business.
//!
//! Each carries whole tiles of the field, as many as make its texels nearest to square: `tile_metres` is what a tile measures on the
//! plane. Directions that close upon themselves then have no seam. Everywhere u runs to the right and v down, seen from outside with
//! +y up, and `w` is −1.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::{Mesh, Part, Vertex};

/// A shape by name. About 1,100 triangles make a round one, as many as the object of \[POM\] §4 has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// [`plane`]: one tile.
    Plane,
    /// [`cuboid`]: a cube as wide as a tile.
    Box,
    /// [`cylinder`]: as wide and as high as a tile is wide; 1,100 triangles.
    Cylinder,
    /// [`sphere`]: as wide as a tile; 1,088 triangles.
    Sphere,
    /// [`torus`]: as wide as a tile; 1,088 triangles.
    Torus,
}

impl Shape {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Plane, Self::Box, Self::Cylinder, Self::Sphere, Self::Torus];

    /// Its name on the command line and in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plane => "plane",
            Self::Box => "box",
            Self::Cylinder => "cylinder",
            Self::Sphere => "sphere",
            Self::Torus => "torus",
        }
    }

    /// The mesh, for a tile that measures this much on the plane, metres along u and v.
    pub fn mesh(self, tile_metres: [f32; 2]) -> Mesh {
        let width = tile_metres[0];
        match self {
            Self::Plane => plane(tile_metres),
            Self::Box => cuboid(Vec3::splat(width), tile_metres),
            Self::Cylinder => cylinder(0.5 * width, width, [50, 10], tile_metres),
            Self::Sphere => sphere(0.5 * width, [32, 18], tile_metres),
            Self::Torus => torus([0.34 * width, 0.16 * width], [34, 16], tile_metres),
        }
    }
}

/// The plane in y = 0, centred on the origin: one tile, u along +x, v along +z; two triangles.
pub fn plane(size_metres: [f32; 2]) -> Mesh {
    let mut shape = Builder::default();
    let [x, z] = [Vec3::X * size_metres[0], Vec3::Z * size_metres[1]];
    shape.face(-0.5 * (x + z), x, z, Vec3::Y, [1.0, 1.0]);
    shape.finish(Shape::Plane)
}

/// The plane with so many tiles along u and v: one stays where the only one would be, the others surround it.
pub fn repeated_plane(tile_metres: [f32; 2], repeat: [u32; 2]) -> Mesh {
    let mut mesh = plane(tile_metres);
    #[expect(clippy::cast_precision_loss, reason = "as texture coordinates they are f32")]
    let repeat = Vec2::new(repeat[0] as f32, repeat[1] as f32);
    for vertex in &mut mesh.vertices {
        vertex.position *= Vec3::new(repeat.x, 1.0, repeat.y);
        vertex.uv = 0.5 + (vertex.uv - 0.5) * repeat;
    }
    mesh
}

/// A box of this size, centred on the origin: six faces with normals of their own, whole tiles on each; two triangles a face. The
/// sides have v down, top and bottom u along +x.
pub fn cuboid(size_metres: Vec3, tile_metres: [f32; 2]) -> Mesh {
    let mut shape = Builder::default();
    let sides = [
        (Vec3::Z, Vec3::X, Vec3::NEG_Y),
        (Vec3::X, Vec3::NEG_Z, Vec3::NEG_Y),
        (Vec3::NEG_Z, Vec3::NEG_X, Vec3::NEG_Y),
        (Vec3::NEG_X, Vec3::Z, Vec3::NEG_Y),
        (Vec3::Y, Vec3::X, Vec3::Z),
        (Vec3::NEG_Y, Vec3::X, Vec3::NEG_Z),
    ];
    for (normal, right, down) in sides {
        let [along_u, along_v] = [right * size_metres, down * size_metres];
        let origin = 0.5 * (normal * size_metres - along_u - along_v);
        let tiles = [tiles(along_u.length(), tile_metres[0]), tiles(along_v.length(), tile_metres[1])];
        shape.face(origin, along_u, along_v, normal, tiles);
    }
    shape.finish(Shape::Box)
}

/// A cylinder round the y axis, centred on the origin: `[segments, rows]` of quads on its side, with smooth normals, and two caps
/// with edges of their own. u goes round the side from +z by +x; on the caps it runs along +x, and a tile is a tile of the plane.
pub fn cylinder(radius_metres: f32, height_metres: f32, [segments, rows]: [u32; 2], tile_metres: [f32; 2]) -> Mesh {
    let mut shape = Builder::default();
    let (radius, height) = (f64::from(radius_metres), f64::from(height_metres));
    #[expect(clippy::cast_possible_truncation, reason = "metres are f32")]
    let tiles = [tiles((TAU * radius) as f32, tile_metres[0]), tiles(height_metres, tile_metres[1])];
    shape.grid([segments, rows], tiles, |i, j| {
        let (out, right) = around(i, segments);
        (radius * out + DVec3::Y * height * (0.5 - f64::from(j) / f64::from(rows)), out, right)
    });
    for normal in [Vec3::Y, Vec3::NEG_Y] {
        let down = if normal.y > 0.0 { Vec3::Z } else { Vec3::NEG_Z };
        let mut corner = |position: DVec3| {
            let position = position.as_vec3();
            let uv = Vec2::new(position.x / tile_metres[0], position.dot(down) / tile_metres[1]) + 0.5;
            shape.vertex(position, normal, Vec3::X, uv)
        };
        let middle = DVec3::Y * 0.5 * height * f64::from(normal.y);
        let centre = corner(middle);
        let rim: Vec<u32> = (0..segments).map(|i| corner(middle + radius * around(i, segments).0)).collect();
        for i in 0..segments as usize {
            let [from, to] = [rim[i], rim[(i + 1) % rim.len()]];
            shape.indices.extend(if normal.y > 0.0 { [centre, from, to] } else { [centre, to, from] });
        }
    }
    shape.finish(Shape::Cylinder)
}

/// A sphere about the origin, of `[segments, rows]`: u goes round from +z by +x, v from the upper pole to the lower. Toward the poles
/// tiles grow narrow, as on every map of the world; at a pole each segment ends in a triangle whose u is that of its middle.
pub fn sphere(radius_metres: f32, [segments, rows]: [u32; 2], tile_metres: [f32; 2]) -> Mesh {
    let mut shape = Builder::default();
    let radius = f64::from(radius_metres);
    #[expect(clippy::cast_possible_truncation, reason = "metres are f32")]
    let tiles = [tiles((TAU * radius) as f32, tile_metres[0]), tiles((PI * radius) as f32, tile_metres[1])];
    // The rows without the poles' own …
    let first_row = 1;
    shape.grid_between([segments, rows], [first_row, rows - 1], tiles, |i, j| {
        let (out, right) = around(i, segments);
        let angle = PI * f64::from(j) / f64::from(rows);
        let normal = angle.sin() * out + DVec3::Y * angle.cos();
        (radius * normal, normal, right)
    });
    // … and these: a vertex for each segment, all in one place.
    let last_row = (rows - 2) * (segments + 1);
    for i in 0..segments {
        let middle = TAU * (f64::from(i) + 0.5) / f64::from(segments);
        let right = DVec3::new(middle.cos(), 0.0, -middle.sin()).as_vec3();
        #[expect(clippy::cast_possible_truncation, reason = "texture coordinates are f32")]
        let u = tiles[0] * ((f64::from(i) + 0.5) / f64::from(segments)) as f32;
        let upper = shape.vertex(Vec3::Y * radius_metres, Vec3::Y, right, Vec2::new(u, 0.0));
        let lower = shape.vertex(Vec3::NEG_Y * radius_metres, Vec3::NEG_Y, right, Vec2::new(u, tiles[1]));
        shape.indices.extend([upper, i, i + 1]);
        shape.indices.extend([last_row + i, lower, last_row + i + 1]);
    }
    shape.finish(Shape::Sphere)
}

/// A torus round the y axis with radii `[of the ring, of its tube]` and `[segments round the axis, round the tube]`: u goes round the
/// axis from +z by +x; v round the tube, from its inside over the top and down the outside.
pub fn torus(radii_metres: [f32; 2], [segments, sides]: [u32; 2], tile_metres: [f32; 2]) -> Mesh {
    let mut shape = Builder::default();
    let [ring, tube] = radii_metres.map(f64::from);
    #[expect(clippy::cast_possible_truncation, reason = "metres are f32")]
    let tiles = [tiles((TAU * ring) as f32, tile_metres[0]), tiles((TAU * tube) as f32, tile_metres[1])];
    shape.grid([segments, sides], tiles, |i, j| {
        let (out, right) = around(i, segments);
        let angle = PI - TAU * f64::from(j % sides) / f64::from(sides);
        let normal = angle.cos() * out + DVec3::Y * angle.sin();
        (ring * out + tube * normal, normal, right)
    });
    shape.finish(Shape::Torus)
}

/// Whole tiles on this length, as many as make them nearest to their own.
fn tiles(length_metres: f32, tile_metres: f32) -> f32 {
    (length_metres / tile_metres).round().max(1.0)
}

/// Away from the y axis, and to the right along its circle, at the i-th of so many places. The last is the first, to the bit.
fn around(i: u32, count: u32) -> (DVec3, DVec3) {
    let (sin, cos) = (TAU * f64::from(i % count) / f64::from(count)).sin_cos();
    (DVec3::new(sin, 0.0, cos), DVec3::new(cos, 0.0, -sin))
}

/// Vertices and triangles that come to be.
#[derive(Default)]
struct Builder {
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
}

impl Builder {
    fn vertex(&mut self, position: Vec3, normal: Vec3, tangent: Vec3, uv: Vec2) -> u32 {
        self.vertices.push(Vertex { tangent: tangent.extend(-1.0), position, normal, uv });
        #[expect(clippy::cast_possible_truncation, reason = "a shape has a few thousand")]
        let index = (self.vertices.len() - 1) as u32;
        index
    }

    /// Two triangles; u runs along the first edge and v along the second.
    fn face(&mut self, origin: Vec3, along_u: Vec3, along_v: Vec3, normal: Vec3, tiles: [f32; 2]) {
        let tangent = along_u.normalize();
        let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[u, v]: [f32; 2]| {
            self.vertex(origin + u * along_u + v * along_v, normal, tangent, Vec2::new(u * tiles[0], v * tiles[1]))
        });
        self.indices.extend([a, c, b, b, c, d]);
    }

    /// A grid of quads; `at` gives position, normal and tangent of a place in it.
    fn grid(&mut self, counts: [u32; 2], tiles: [f32; 2], at: impl Fn(u32, u32) -> (DVec3, DVec3, DVec3)) {
        self.grid_between(counts, [0, counts[1]], tiles, at);
    }

    /// Some of the rows of a grid: from one line to another.
    fn grid_between(
        &mut self,
        [columns, rows]: [u32; 2],
        [first, last]: [u32; 2],
        tiles: [f32; 2],
        at: impl Fn(u32, u32) -> (DVec3, DVec3, DVec3),
    ) {
        for j in first..=last {
            for i in 0..=columns {
                let (position, normal, tangent) = at(i, j);
                #[expect(clippy::cast_precision_loss, reason = "a shape has a few thousand")]
                let uv = Vec2::new(tiles[0] * i as f32 / columns as f32, tiles[1] * j as f32 / rows as f32);
                let corner = self.vertex(position.as_vec3(), normal.as_vec3(), tangent.as_vec3(), uv);
                if i < columns && j < last {
                    let below = corner + columns + 1;
                    self.indices.extend([corner, below, corner + 1, corner + 1, below, below + 1]);
                }
            }
        }
    }

    fn finish(self, shape: Shape) -> Mesh {
        #[expect(clippy::cast_possible_truncation, reason = "a shape has a few thousand")]
        let triangles = 0..(self.indices.len() / 3) as u32;
        Mesh {
            name: shape.name().to_owned(),
            vertices: self.vertices,
            indices: self.indices,
            parts: vec![Part { material: String::new(), triangles }],
            is_planar: matches!(shape, Shape::Plane | Shape::Box),
            skin: None,
        }
    }
}
