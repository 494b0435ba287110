//! Shell: a mesh's triangles as prisms of three tetrahedra. Shader: `shaders/surface/shell.wgsl`, where the split is drawn up;
//! specification: [`crate::reference::shell`].

use std::collections::HashMap;

use glam::{DVec3, Vec3};

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

/// A ball deep in a closed mesh: every way to it leads through the floor of the shell, where a ray ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Core {
    /// World, metres.
    pub centre: Vec3,
    /// Metres; 0 where there is none.
    pub radius: f32,
}

/// The core of a shell `depth_metres` deep: as large as fits about the mean of the vertices. There is none where the mesh has a border,
/// its floor does not go once round that point, as that of a torus, or is turned inside out.
pub fn core(vertices: &[Vertex], indices: &[u32], depth_metres: f32) -> Core {
    let is_open = triangles(vertices, indices).iter().any(|triangle| triangle.borders != 0);
    if is_open || vertices.is_empty() {
        return Core::default();
    }
    let tops: Vec<DVec3> = vertices.iter().map(|vertex| vertex.position.as_dvec3()).collect();
    let depth = f64::from(depth_metres);
    let floors: Vec<DVec3> = tops.iter().zip(inward(vertices)).map(|(top, way)| *top + depth * way.as_dvec3()).collect();
    let centre = (tops.iter().sum::<DVec3>() / tops.len() as f64).as_vec3();
    let faces = |corners: &[DVec3]| -> Vec<[DVec3; 3]> {
        let from_centre = |index: &u32| corners[*index as usize] - centre.as_dvec3();
        indices.chunks_exact(3).map(|face| [from_centre(&face[0]), from_centre(&face[1]), from_centre(&face[2])]).collect()
    };
    let (tops, floors) = (faces(&tops), faces(&floors));
    let turns = winding_number(&floors);
    if turns.abs() != 1.0 || turns != winding_number(&tops) {
        return Core::default();
    }
    let radius = floors.iter().map(distance_to).fold(f64::INFINITY, f64::min);
    // Smaller by far more than rounding, in the shader as here.
    Core { centre, radius: (0.999 * radius) as f32 }
}

/// How far a triangle is from the origin.
fn distance_to(&[a, b, c]: &[DVec3; 3]) -> f64 {
    let edges = [(a, b), (b, c), (c, a)];
    let to_edge = |(from, to): (DVec3, DVec3)| {
        let along = to - from;
        let share = -from.dot(along) / along.length_squared();
        // An edge without length is one point.
        let share = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) };
        (from + share * along).length()
    };
    let nearest = edges.map(to_edge).into_iter().fold(f64::INFINITY, f64::min);
    let normal = (b - a).cross(c - a);
    let is_over = edges.iter().all(|(from, to)| from.cross(*to).dot(normal) >= 0.0);
    match normal.try_normalize() {
        Some(normal) if is_over => nearest.min(normal.dot(a).abs()),
        _ => nearest,
    }
}

/// How often a closed surface goes round the origin, from the solid angles of its faces (Van Oosterom and Strackee 1983); NaN where it
/// goes through it.
fn winding_number(faces: &[[DVec3; 3]]) -> f64 {
    let half_angle = |[a, b, c]: &[DVec3; 3]| {
        let [la, lb, lc] = [a.length(), b.length(), c.length()];
        let scale = la * lb * lc + a.dot(*b) * lc + b.dot(*c) * la + c.dot(*a) * lb;
        a.dot(b.cross(*c)).atan2(scale)
    };
    let turns = faces.iter().map(half_angle).sum::<f64>() / std::f64::consts::TAU;
    if (turns - turns.round()).abs() < 1e-3 { turns.round() } else { f64::NAN }
}
