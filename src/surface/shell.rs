//! Shell: a mesh's triangles as prisms of three tetrahedra. Shader: `shaders/surface/shell.wgsl`, where the split is drawn up;
//! specification: [`crate::reference::shell`].

use std::collections::HashMap;

use glam::Vec3;

use crate::mesh::Vertex;

/// The most triangles of a shell. Each is drawn as twelve, and each pixel in front of one traces it anew: a shell is for the
/// low-polygon objects that relief mapping is for.
pub const TRIANGLES_MAX: usize = 100_000;

/// A tetrahedron with less volume, six times, than this share of the product of three of its edges is flat: an f32 knows its frame no
/// more.
pub const FLAT: f64 = 1e-4;

/// A triangle of a shell. Twin of the WGSL struct.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ShellTriangle {
    /// Its vertices, in an order that both triangles of an edge agree on.
    pub vertices: [u32; 3],
    /// Which edges are borders of the mesh: 1 the first two vertices', 2 the last two's, 4 the first's and the last's.
    pub borders: u32,
}

/// Which vertices are at the same place, as the number of the first of them: seams split vertices, not the surface.
fn welded(vertices: &[Vertex]) -> Vec<u32> {
    let mut first = HashMap::new();
    vertices
        .iter()
        .zip(0..)
        // Adding zero turns −0 into 0.
        .map(|(vertex, index)| *first.entry(vertex.position.to_array().map(|x| (x + 0.0).to_bits())).or_insert(index))
        .collect()
}

/// The triangles of a shell, in the order of the mesh; one of which two corners are at the same place has no prism, and is left as
/// three times the same vertex, which draws nothing.
pub fn triangles(vertices: &[Vertex], indices: &[u32]) -> Vec<ShellTriangle> {
    let welded = welded(vertices);
    let place = |vertex: u32| welded[vertex as usize];
    let edge = |a: u32, b: u32| (place(a).min(place(b)), place(a).max(place(b)));
    let mut uses: HashMap<(u32, u32), u32> = HashMap::new();
    let mut triangles: Vec<ShellTriangle> = indices
        .chunks_exact(3)
        .map(|corners| {
            let mut vertices = [corners[0], corners[1], corners[2]];
            vertices.sort_by_key(|&vertex| place(vertex));
            let [a, b, c] = vertices;
            if place(a) == place(b) || place(b) == place(c) {
                return ShellTriangle { vertices: [a; 3], borders: 0 };
            }
            for edge in [edge(a, b), edge(b, c), edge(a, c)] {
                *uses.entry(edge).or_default() += 1;
            }
            ShellTriangle { vertices, borders: 0 }
        })
        .collect();
    for triangle in &mut triangles {
        let [a, b, c] = triangle.vertices;
        let is_border = |a: u32, b: u32| u32::from(uses.get(&edge(a, b)) == Some(&1));
        triangle.borders = is_border(a, b) | is_border(b, c) << 1 | is_border(a, c) << 2;
    }
    triangles
}

/// Normals of one place whose cosine is above this are the same.
const SAME_NORMAL: f32 = 0.999;

/// The longest way inward, in depths: at a sharp spike the mitre would run away.
const INWARD_MAX: f32 = 4.0;

/// From each vertex to the floor of the shell, in units of the depth: a depth inward from each of the faces that meet at its place, as
/// a mitre, so that prisms of neighbouring faces share their side and leave no gap.
pub fn inward(vertices: &[Vertex]) -> Vec<Vec3> {
    let welded = welded(vertices);
    let mut normals: HashMap<u32, Vec<Vec3>> = HashMap::new();
    for (vertex, &place) in vertices.iter().zip(&welded) {
        let normals = normals.entry(place).or_default();
        if normals.iter().all(|normal| normal.dot(vertex.normal) < SAME_NORMAL) {
            normals.push(vertex.normal);
        }
    }
    let mitre = |normals: &[Vec3]| {
        let Some(middle) = normals.iter().sum::<Vec3>().try_normalize() else { return Vec3::ZERO };
        let cosine = normals.iter().map(|normal| normal.dot(middle)).sum::<f32>() / normals.len() as f32;
        -middle * (1.0 / cosine.max(1.0 / INWARD_MAX))
    };
    welded.iter().map(|place| normals.get(place).map_or(Vec3::ZERO, |normals| mitre(normals))).collect()
}
