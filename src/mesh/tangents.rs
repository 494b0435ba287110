//! What a file may leave out: normals, and tangents the MikkTSpace way (M. Mikkelsen, *Simulation of Wrinkled Surfaces Revisited*,
//! 2008), as the programs that bake normal maps compute them.

use std::collections::HashMap;

use bevy_mikktspace::{Geometry, TangentSpace};
use glam::{DVec3, Vec2, Vec3, Vec4};

/// How positions change with u and with v over a triangle: metres for a whole tile. `None` where the texture coordinates have no
/// area.
pub fn gradients(positions: [Vec3; 3], uvs: [Vec2; 3]) -> Option<[DVec3; 2]> {
    let [a, b, c] = positions.map(Vec3::as_dvec3);
    let [p, q, r] = uvs.map(Vec2::as_dvec2);
    let (edges, turns) = ([b - a, c - a], [q - p, r - p]);
    let area = turns[0].perp_dot(turns[1]);
    // Below the rounding of f32 coordinates there is none.
    let longest = turns[0].length_squared().max(turns[1].length_squared());
    (area.abs() > 1e-7 * longest)
        .then(|| [(turns[1].y * edges[0] - turns[0].y * edges[1]) / area, (turns[0].x * edges[1] - turns[1].x * edges[0]) / area])
}

/// Normals of every corner: the mean of the faces that meet there at an angle of less than the crease's, weighted by their angles.
/// A cosine above 1 leaves every face flat.
pub fn normals(positions: &[Vec3], triangles: &[[u32; 3]], crease_cosine: f32) -> Vec<[Vec3; 3]> {
    let faces: Vec<Vec3> = triangles
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(|i| positions[i as usize].as_dvec3());
            (b - a).cross(c - a).normalize_or_zero().as_vec3()
        })
        .collect();
    if crease_cosine > 1.0 {
        return faces.into_iter().map(|face| [face; 3]).collect();
    }
    // Vertices that differ in their texture coordinates alone are one place: it is the position that counts.
    let mut meeting: HashMap<[u32; 3], Vec<(usize, f32)>> = HashMap::new();
    for (face, corners) in triangles.iter().enumerate() {
        let corners = corners.map(|i| positions[i as usize]);
        for i in 0..3 {
            let [here, next, last] = [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]];
            let angle = (next - here).angle_between(last - here);
            meeting.entry(place(here)).or_default().push((face, if angle.is_finite() { angle } else { 0.0 }));
        }
    }
    let smooth = |face: usize, position: Vec3| {
        let near = meeting[&place(position)].iter().filter(|(other, _)| faces[face].dot(faces[*other]) >= crease_cosine);
        let sum: Vec3 = near.map(|&(other, angle)| angle * faces[other]).sum();
        sum.try_normalize().unwrap_or(faces[face])
    };
    triangles.iter().enumerate().map(|(face, corners)| corners.map(|i| smooth(face, positions[i as usize]))).collect()
}

/// A position by its bits; −0 is 0.
fn place(position: Vec3) -> [u32; 3] {
    (position + Vec3::ZERO).to_array().map(f32::to_bits)
}

/// Tangents of every corner, with the sign of the bitangent in w.
pub fn tangents(positions: &[Vec3], normals: &[[Vec3; 3]], uvs: &[Vec2], triangles: &[[u32; 3]]) -> Vec<[Vec4; 3]> {
    let mut corners = Corners { positions, normals, uvs, triangles, tangents: vec![[Vec4::ZERO; 3]; triangles.len()] };
    // It fails for meshes of nothing only; those have no corners to be filled.
    let result = bevy_mikktspace::generate_tangents(&mut corners);
    debug_assert!(result.is_ok() || triangles.is_empty());
    corners.tangents
}

/// Some frame where the texture coordinates give none.
pub fn any_tangent(normal: Vec3) -> Vec4 {
    normal.any_orthonormal_vector().extend(-1.0)
}

struct Corners<'a> {
    positions: &'a [Vec3],
    normals: &'a [[Vec3; 3]],
    uvs: &'a [Vec2],
    triangles: &'a [[u32; 3]],
    tangents: Vec<[Vec4; 3]>,
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.positions[self.triangles[face][corner] as usize].to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.normals[face][corner].to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.uvs[self.triangles[face][corner] as usize].to_array()
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let tangent = space.map(|space| Vec4::from_array(space.tangent_encoded()));
        // What it leaves at nothing has no texture area about it.
        let usable = tangent.filter(|tangent| tangent.truncate().length_squared() > 0.5);
        self.tangents[face][corner] = usable.unwrap_or_else(|| any_tangent(self.normals[face][corner]));
    }
}
