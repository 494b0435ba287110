//! Micropolygons: a mesh's triangles subdivided as finely as is asked, in vertex and index buffers of their own. Shader:
//! `shaders/surface/micropolygon.wgsl`; specification, over a plane: [`crate::reference::trace_mesh`].

use std::ops::Range;

use glam::{Vec2, Vec3};

use super::raster::{RasterVertex, raster_vertices};
use super::ray_map::Placement;
use super::shell;
use crate::gpu::Gpu;
use crate::mesh::Vertex;
use crate::scene::Addressing;

/// A vertex of a micropolygon, as the vertex buffer holds it: 56 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MicroVertex {
    /// Where the reference surface, h = 1, lies, world, metres.
    pub position: [f32; 3],
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// From the surface to the floor of the shell, in units of the depth.
    pub inward: [f32; 3],
    /// How long a tile is along u and along v.
    pub metres_per_uv: [f32; 2],
    /// Unit normal, and the sign of the bitangent, as snorm16.
    pub normal: [i16; 4],
    /// Unit tangent, and 1 at the foot of a wall, as snorm16.
    pub tangent: [i16; 4],
}

impl MicroVertex {
    /// The vertex buffer's layout.
    pub const ATTRIBUTES: [wgpu::VertexAttribute; 6] =
        wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x2, 2 => Float32x3, 3 => Float32x2, 4 => Snorm16x4, 5 => Snorm16x4];

    fn new(position: Vec3, uv: Vec2, inward: Vec3, metres_per_uv: Vec2, normal: Vec3, tangent: Vec3, sign: f32) -> Self {
        let snorm = |value: f32| (value.clamp(-1.0, 1.0) * 32767.0).round() as i16;
        let [normal, tangent] = [normal, tangent].map(Vec3::normalize_or_zero);
        Self {
            position: position.to_array(),
            uv: uv.to_array(),
            inward: inward.to_array(),
            metres_per_uv: metres_per_uv.to_array(),
            normal: [snorm(normal.x), snorm(normal.y), snorm(normal.z), snorm(sign)],
            tangent: [snorm(tangent.x), snorm(tangent.y), snorm(tangent.z), 0],
        }
    }
}

/// Into how many pieces each edge is cut, so that `base` triangles become about so many.
pub fn pieces(triangles: u32, base: usize) -> u32 {
    let pieces = (f64::from(triangles) / base.max(1) as f64).sqrt().round() as u32;
    pieces.max(1)
}

/// What makes a mesh of micropolygons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// About how many triangles.
    pub triangles: u32,
    /// The plane alone, of this size in metres, and what lies beyond its border; otherwise a mesh.
    pub bare_plane: Option<([f32; 2], Addressing)>,
    /// Where that plane lies.
    pub placement: Placement,
}

/// How far the plane alone goes on beyond its border where the field clamps, tiles: a ray that leaves it by more finds nothing. Where
/// it wraps the tile is drawn nine times, and goes on for one.
const BEYOND_TILES: f32 = 4.0;

/// The vertices of a mesh's triangles, each cut into `pieces`² alike; those of one triangle are its own.
pub fn vertices(vertices: &[Vertex], indices: &[u32], pieces: u32) -> Vec<MicroVertex> {
    let corners = raster_vertices(vertices, indices);
    let count = ((pieces + 1) * (pieces + 2) / 2) as usize;
    let mut result = Vec::with_capacity(indices.len() / 3 * count);
    for triangle in indices.chunks_exact(3) {
        let triangle: [&RasterVertex; 3] = [0, 1, 2].map(|i| &corners[triangle[i] as usize]);
        for row in 0..=pieces {
            for place in 0..=pieces - row {
                let weights = [pieces - row - place, place, row].map(|part| part as f32 / pieces as f32);
                result.push(blend(triangle, weights));
            }
        }
    }
    result
}

/// A point of a triangle. Points of an edge come out alike, to the bit, from both triangles that share it: the order of a sum of two
/// does not count.
fn blend(triangle: [&RasterVertex; 3], weights: [f32; 3]) -> MicroVertex {
    let sum = |of: &dyn Fn(&RasterVertex) -> Vec3| -> Vec3 {
        (0..3).filter(|&i| weights[i] != 0.0).map(|i| weights[i] * of(triangle[i])).sum()
    };
    let uv = sum(&|vertex| Vec3::new(vertex.u, vertex.v, 0.0)).truncate();
    let metres = sum(&|vertex| Vec2::from(vertex.metres_per_uv).extend(0.0)).truncate();
    MicroVertex::new(
        sum(&|vertex| vertex.position.into()),
        uv,
        sum(&|vertex| vertex.inward.into()),
        metres,
        sum(&|vertex| vertex.normal.into()),
        sum(&|vertex| vertex.tangent.into()),
        triangle[0].handedness,
    )
}

/// Which edges of each triangle are borders of the mesh: the first from its first corner to its second.
pub fn borders(vertices: &[Vertex], indices: &[u32]) -> Vec<[bool; 3]> {
    let of = |(corners, triangle): (&[u32], shell::ShellTriangle)| {
        let [a, b, c] = triangle.vertices;
        [0, 1, 2].map(|i| {
            let edge = [corners[i], corners[(i + 1) % 3]];
            let is = |bit, other: [u32; 2]| triangle.borders & bit != 0 && edge.iter().all(|end| other.contains(end));
            is(1, [a, b]) || is(2, [b, c]) || is(4, [a, c])
        })
    };
    indices.chunks_exact(3).zip(shell::triangles(vertices, indices)).map(of).collect()
}

/// The vertices of walls over borders: for each border `pieces` + 1 pairs, on top and at the foot.
pub fn wall_vertices(vertices: &[Vertex], indices: &[u32], borders: &[[bool; 3]], pieces: u32) -> Vec<MicroVertex> {
    let corners = raster_vertices(vertices, indices);
    let mut result = Vec::new();
    for (triangle, borders) in indices.chunks_exact(3).zip(borders) {
        let triangle: [&RasterVertex; 3] = [0, 1, 2].map(|i| &corners[triangle[i] as usize]);
        for i in (0..3).filter(|&i| borders[i]) {
            let [a, b] = [triangle[i], triangle[(i + 1) % 3]];
            let along = Vec3::from(b.position) - Vec3::from(a.position);
            for place in 0..=pieces {
                let mut weights = [0.0; 3];
                (weights[i], weights[(i + 1) % 3]) = ((pieces - place) as f32 / pieces as f32, place as f32 / pieces as f32);
                let top = blend(triangle, weights);
                let outward = along.cross(-Vec3::from(top.inward));
                let [position, inward] = [top.position, top.inward].map(Vec3::from);
                let top = MicroVertex::new(position, top.uv.into(), inward, top.metres_per_uv.into(), outward, along, 1.0);
                let mut foot = top;
                foot.tangent[3] = i16::MAX;
                result.extend([top, foot]);
            }
        }
    }
    result
}

/// The indices of so many walls whose vertices begin at `first`: two triangles for each of `pieces` pieces.
pub fn wall_indices(first: u32, walls: u32, pieces: u32) -> Vec<u32> {
    let quad = move |wall: u32, place: u32| {
        let top = first + 2 * (wall * (pieces + 1) + place);
        [top, top + 1, top + 2, top + 2, top + 1, top + 3]
    };
    (0..walls).flat_map(|wall| (0..pieces).flat_map(move |place| quad(wall, place))).collect()
}

/// The indices of so many triangles, each cut into `pieces`² alike.
pub fn indices(base: u32, pieces: u32) -> Vec<u32> {
    let count = (pieces + 1) * (pieces + 2) / 2;
    let mut result = Vec::with_capacity(3 * base as usize * (pieces * pieces) as usize);
    for triangle in 0..base {
        let mut here = triangle * count;
        for row in 0..pieces {
            let width = pieces - row + 1;
            for place in 0..width - 1 {
                let [a, b, above] = [here + place, here + place + 1, here + width + place];
                result.extend([a, b, above]);
                if place + 2 < width {
                    result.extend([b, above + 1, above]);
                }
            }
            here += width;
        }
    }
    result
}

/// The plane alone: a grid of `pieces`² quads over its tile, and a frame of long ones beyond its border where the field clamps: the
/// height does not change there on the way out, so that they are exact.
pub fn bare_plane(
    size_metres: [f32; 2],
    addressing: Addressing,
    pieces: u32,
    placement: &Placement,
) -> (Vec<MicroVertex>, Vec<u32>) {
    let mut lines: Vec<f32> = (0..=pieces).map(|i| i as f32 / pieces as f32).collect();
    if addressing == Addressing::Clamp {
        lines.insert(0, -BEYOND_TILES);
        lines.push(1.0 + BEYOND_TILES);
    }
    let size = Vec2::from(size_metres);
    let [up, tangent] = [placement.up, placement.u].map(|axis| axis.as_vec3());
    let vertex = |u: f32, v: f32| {
        let position = Vec3::new((u - 0.5) * size.x, 0.0, (v - 0.5) * size.y);
        let position = placement.world(position.as_dvec3()).as_vec3();
        MicroVertex::new(position, Vec2::new(u, v), -up, size, up, tangent, -1.0)
    };
    let vertices = lines.iter().flat_map(|&v| lines.iter().map(move |&u| vertex(u, v))).collect();
    let width = lines.len() as u32;
    let quad = |corner: u32| [corner, corner + width, corner + 1, corner + 1, corner + width, corner + width + 1];
    let indices = (0..width - 1).flat_map(|j| (0..width - 1).flat_map(move |i| quad(j * width + i))).collect();
    (vertices, indices)
}

/// Micropolygons on the GPU.
pub struct Micropolygons {
    plan: Plan,
    pieces: u32,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// Those of the surface; the walls' come after them.
    triangles: u32,
    borders: Vec<[bool; 3]>,
    /// How many walls stand over the triangles before each.
    walls_before: Vec<u32>,
}

impl Micropolygons {
    /// Makes them for a mesh as it is now, or for the plane alone, as the plan says.
    pub fn new(gpu: &Gpu, plan: Plan, mesh: (&[Vertex], &[u32])) -> Self {
        let base = if plan.bare_plane.is_some() { 2 } else { mesh.1.len() / 3 };
        let pieces = pieces(plan.triangles, base);
        let borders = if plan.bare_plane.is_some() { Vec::new() } else { borders(mesh.0, mesh.1) };
        let mut walls_before = vec![0];
        for edges in &borders {
            let walls = edges.iter().filter(|&&edge| edge).count() as u32;
            walls_before.push(walls_before.last().map_or(0, |before| before + walls));
        }
        let (mut own_vertices, mut own_indices) = match plan.bare_plane {
            Some((size, addressing)) => bare_plane(size, addressing, pieces, &plan.placement),
            None => (vertices(mesh.0, mesh.1, pieces), indices(base as u32, pieces)),
        };
        let triangles = (own_indices.len() / 3) as u32;
        let walls = walls_before.last().copied().unwrap_or_default();
        own_indices.extend(wall_indices(own_vertices.len() as u32, walls, pieces));
        own_vertices.extend(wall_vertices(mesh.0, mesh.1, &borders, pieces));
        let buffer = |label, contents: &[u8], usage| {
            let size = contents.len().max(16) as u64;
            let usage = usage | wgpu::BufferUsages::COPY_DST;
            let buffer =
                gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false });
            gpu.queue.write_buffer(&buffer, 0, contents);
            buffer
        };
        Self {
            plan,
            pieces,
            vertices: buffer("micropolygon vertices", bytemuck::cast_slice(&own_vertices), wgpu::BufferUsages::VERTEX),
            indices: buffer("micropolygon indices", bytemuck::cast_slice(&own_indices), wgpu::BufferUsages::INDEX),
            triangles,
            borders,
            walls_before,
        }
    }

    /// What they were made for.
    pub fn plan(&self) -> Plan {
        self.plan
    }

    /// Moves the mesh's vertices, of which there are as many as before.
    pub fn pose(&self, gpu: &Gpu, mesh: (&[Vertex], &[u32])) {
        let mut own = vertices(mesh.0, mesh.1, self.pieces);
        own.extend(wall_vertices(mesh.0, mesh.1, &self.borders, self.pieces));
        gpu.queue.write_buffer(&self.vertices, 0, bytemuck::cast_slice(&own));
    }

    /// The micropolygons of some of the mesh's triangles; of the plane alone, all.
    pub fn of(&self, base: &Range<u32>) -> Range<u32> {
        let each = self.pieces * self.pieces;
        if self.plan.bare_plane.is_some() { 0..self.triangles } else { base.start * each..base.end * each }
    }

    /// Those of the walls over the borders of some of the mesh's triangles.
    pub fn walls_of(&self, base: &Range<u32>) -> Range<u32> {
        let before = |triangle: u32| self.walls_before.get(triangle as usize).copied().unwrap_or_default();
        let first = |triangle: u32| self.triangles + 2 * self.pieces * before(triangle);
        first(base.start)..first(base.end)
    }

    /// How many there are, walls apart.
    pub fn triangle_count(&self) -> u32 {
        self.triangles
    }

    /// Draws some of them, that many times.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, triangles: &Range<u32>, instances: u32) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(3 * triangles.start..3 * triangles.end, 0, 0..instances);
    }

    /// Bytes of GPU memory that they take.
    pub fn memory_bytes(&self) -> u64 {
        self.vertices.size() + self.indices.size()
    }
}
