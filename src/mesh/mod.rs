//! Triangle meshes that carry a height field: plain data on the CPU, with a tangent frame in every vertex.
//!
//! [`shapes`] makes the simple ones; [`obj`] and [`gltf`] read the text and bytes of files ([`crate::io::mesh_file`] opens them);
//! [`skin`] moves the ones that are animated. What a file lacks is computed: normals, and tangents the MikkTSpace way
//! ([`tangents`]).
//!
//! # Conventions
//!
//! - Metres, right-handed, +y up; triangles wind counter-clockwise seen from outside.
//! - Texture coordinates are those of field space: `u` right, `v` *down* the image. glTF has them so; OBJ counts up, and its reader
//!   turns them over.
//! - The tangent points along growing `u`; `w` times (normal × tangent) is the bitangent, along growing `v`. Field space is
//!   left-handed, so `w` is **−1** wherever the texture is not mirrored: on every shape of this program, without exception. A file's
//!   own `w` is not read, since exporters disagree on what it means; it follows from the texture coordinates.

mod assemble;
pub mod gltf;
pub mod obj;
pub mod shapes;
pub mod skin;
mod source;
pub mod tangents;

use std::ops::Range;

use glam::{Mat4, Vec2, Vec3, Vec4};

pub use shapes::Shape;
pub use skin::Skin;
pub use source::MeshSource;

/// The most triangles that a file may have: a 1.5-million-triangle model (\[POM\] §4) fits more than twice, and so do its buffers
/// into what every adapter allows.
pub const TRIANGLES_MAX: usize = 1 << 22;

/// A triangle mesh with texture coordinates and tangent frames. See the module's conventions.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// The shape's name, or the file's.
    pub name: String,
    /// The vertices; of an animated mesh, as they are at time 0.
    pub vertices: Vec<Vertex>,
    /// Three for each triangle.
    pub indices: Vec<u32>,
    /// The materials in order, each with its triangles; together they are all of them.
    pub parts: Vec<Part>,
    /// Every face is flat and its frame constant, as those of the plane and the box.
    pub is_planar: bool,
    /// What moves it, if anything does.
    pub skin: Option<Skin>,
}

/// A vertex: 48 bytes without gaps, as a vertex buffer holds it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Vertex {
    /// Unit vector along growing `u` in xyz; the sign of the bitangent in w.
    pub tangent: Vec4,
    /// Position, metres.
    pub position: Vec3,
    /// Unit normal, outward.
    pub normal: Vec3,
    /// Texture coordinates: 1 is a whole tile of the field.
    pub uv: Vec2,
}

/// The triangles that share a material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The material's name in the file, by which a scene gives it settings of its own; empty where there is none.
    pub material: String,
    /// The triangles: three times these are the places in [`Mesh::indices`].
    pub triangles: Range<u32>,
}

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Its lowest corner, metres.
    pub low: Vec3,
    /// Its highest corner, metres.
    pub high: Vec3,
}

/// Why there is no mesh in what a file says: what is the matter and what to do about it, to follow the file's name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Unfit(pub String);

impl Vertex {
    /// The unit vector along growing `v`.
    pub fn bitangent(&self) -> Vec3 {
        self.tangent.w * self.normal.cross(self.tangent.truncate())
    }
}

impl Bounds {
    /// The smallest box around these points. Around none it is empty: its lowest corner lies above its highest.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        let nothing = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };
        points.into_iter().fold(nothing, |bounds, point| Self { low: bounds.low.min(point), high: bounds.high.max(point) })
    }

    /// Its middle.
    pub fn centre(&self) -> Vec3 {
        0.5 * (self.low + self.high)
    }

    /// Its extents.
    pub fn size(&self) -> Vec3 {
        self.high - self.low
    }
}

impl Mesh {
    /// How many triangles it has.
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }

    /// The corners of every triangle.
    pub fn triangles(&self) -> impl Iterator<Item = [Vertex; 3]> + '_ {
        self.indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|i| self.vertices[corners[i] as usize]))
    }

    /// Bytes of its vertex and index buffers.
    pub fn bytes(&self) -> u64 {
        (size_of_val(self.vertices.as_slice()) + size_of_val(self.indices.as_slice())) as u64
    }

    /// The box around it, at time 0 if it is animated.
    pub fn bounds(&self) -> Bounds {
        Bounds::around(self.vertices.iter().map(|vertex| vertex.position))
    }

    /// Metres that a whole tile measures along u and along v, on the average over the area: what the field's own extent is on the
    /// plane. A triangle whose texture coordinates have no area does not count.
    pub fn metres_per_tile(&self) -> [f32; 2] {
        let mut sum = [0.0_f64; 3];
        for corners in self.triangles() {
            let Some([along_u, along_v]) = tangents::gradients(corners.map(|c| c.position), corners.map(|c| c.uv)) else {
                continue;
            };
            let [a, b, c] = corners.map(|corner| corner.position.as_dvec3());
            let area = (b - a).cross(c - a).length();
            sum = [sum[0] + area * along_u.length(), sum[1] + area * along_v.length(), sum[2] + area];
        }
        #[expect(clippy::cast_possible_truncation, reason = "metres are f32")]
        let mean = |total: f64| (total / sum[2]) as f32;
        [mean(sum[0]), mean(sum[1])]
    }

    /// The same mesh with more tiles along u and v (factors above 0).
    #[must_use]
    pub fn tiled(mut self, factors: [f32; 2]) -> Self {
        let bind = self.skin.as_mut().map(|skin| skin.bind.as_mut_slice()).unwrap_or_default();
        for vertex in self.vertices.iter_mut().chain(bind) {
            vertex.uv *= Vec2::from(factors);
        }
        self
    }

    /// The same mesh, scaled alike in all directions and moved so that its bounds are centred on the origin and its farthest vertex
    /// lies at this distance, metres.
    #[must_use]
    pub fn fitted(mut self, radius_metres: f32) -> Self {
        let centre = self.bounds().centre();
        let largest = self.vertices.iter().map(|vertex| vertex.position.distance(centre)).fold(0.0, f32::max);
        let scale = radius_metres / largest;
        for vertex in &mut self.vertices {
            vertex.position = scale * (vertex.position - centre);
        }
        if let Some(skin) = &mut self.skin {
            skin.place(scale, centre);
        }
        self
    }

    /// The same mesh, turned and moved.
    #[must_use]
    pub fn moved(mut self, world_from_own: Mat4) -> Self {
        for vertex in &mut self.vertices {
            *vertex = skin::moved(vertex, world_from_own);
        }
        if let Some(skin) = &mut self.skin {
            skin.move_by(world_from_own);
        }
        self
    }

    /// Its vertices at a time, seconds; an animation begins anew when it ends. Without one they are always the same.
    pub fn posed(&self, time_seconds: f64) -> Vec<Vertex> {
        match &self.skin {
            Some(skin) => skin.posed(time_seconds),
            None => self.vertices.clone(),
        }
    }
}
