//! Facets: a mesh's triangles as they are drawn flat. Shader: `shaders/surface/facet.wgsl`.

use std::ops::Range;

use glam::{DMat3, DVec3, Vec3};

use super::probe::{Hit, Ray};
use super::ray_map::Placement;
use crate::mesh::{Mesh, Vertex, tangents};

/// Triangles that lie in one plane with one affine map from texture coordinates: rays to them come from exact linear forms.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// The triangles, in the order of the mesh.
    pub triangles: Range<u32>,
    /// Where the texture coordinates ½ lie, and the axes.
    pub placement: Placement,
    /// Extent of a whole tile along u and v, metres.
    pub tile_metres: [f64; 2],
}

/// How far two charts' numbers may be apart to be the same: a mesh's positions are f32.
const SAME_METRES: f64 = 1e-5;

/// The charts of a run of triangles of a planar mesh. A triangle whose texture coordinates have no area is left out.
pub fn charts(mesh: &Mesh, triangles: Range<u32>) -> Vec<Chart> {
    let mut charts: Vec<Chart> = Vec::new();
    for (index, corners) in (0..).zip(mesh.triangles()) {
        if !triangles.contains(&index) {
            continue;
        }
        let Some(chart) = chart(index, corners) else { continue };
        match charts.last_mut() {
            Some(last) if last.triangles.end == index && last.is_like(&chart) => last.triangles.end += 1,
            _ => charts.push(chart),
        }
    }
    charts
}

fn chart(index: u32, corners: [Vertex; 3]) -> Option<Chart> {
    let [along_u, along_v] = tangents::gradients(corners.map(|corner| corner.position), corners.map(|corner| corner.uv))?;
    let [first, ..] = corners;
    let to_middle = (DVec3::splat(0.5) - first.uv.as_dvec2().extend(0.5)).truncate();
    let origin = first.position.as_dvec3() + to_middle.x * along_u + to_middle.y * along_v;
    let up = first.normal.as_dvec3().normalize();
    let placement = Placement { origin, u: along_u.normalize(), v: along_v.normalize(), up };
    Some(Chart { triangles: index..index + 1, placement, tile_metres: [along_u.length(), along_v.length()] })
}

impl Chart {
    fn is_like(&self, other: &Self) -> bool {
        let near = |a: DVec3, b: DVec3| a.distance(b) < SAME_METRES;
        let (one, two) = (&self.placement, &other.placement);
        near(one.origin, two.origin) && near(one.u, two.u) && near(one.v, two.v) && near(one.up, two.up)
    }
}

/// The ray in field space that a ray in the world becomes at the first triangle whose outside it meets, for a pointer: the surface
/// counts as flat there. None where it meets none.
pub fn pick(
    vertices: &[Vertex],
    indices: &[u32],
    field_size: [u32; 2],
    depth_metres: f64,
    eye: DVec3,
    direction: DVec3,
) -> Option<Ray> {
    let met = indices.chunks_exact(3).filter_map(|corners| {
        let corners = [0, 1, 2].map(|i| vertices[corners[i] as usize]);
        let [a, b, c] = corners.map(|corner| corner.position.as_dvec3());
        let (edges, normal) = (DMat3::from_cols(b - a, c - a, -direction), (b - a).cross(c - a));
        if normal.dot(direction) >= 0.0 {
            return None;
        }
        let weights = edges.inverse() * (eye - a);
        let inside = weights.x >= 0.0 && weights.y >= 0.0 && weights.x + weights.y <= 1.0 && weights.z > 0.0;
        inside.then_some((weights, corners, normal.normalize()))
    });
    let (weights, corners, normal) = met.min_by(|one, other| one.0.z.total_cmp(&other.0.z))?;
    let [along_u, along_v] = tangents::gradients(corners.map(|corner| corner.position), corners.map(|corner| corner.uv))?;
    let uvs = corners.map(|corner| corner.uv.as_dvec2());
    let uv = uvs[0] + weights.x * (uvs[1] - uvs[0]) + weights.y * (uvs[2] - uvs[0]);
    let size = field_size.map(f64::from);
    let field_from_world = DMat3::from_cols(along_u / size[0], along_v / size[1], normal * depth_metres).inverse();
    let way = field_from_world * direction;
    let lattice = [uv.x * size[0] - 0.5, uv.y * size[1] - 0.5];
    Some(Ray {
        lattice: lattice.map(|at| (at - at.floor()) as f32),
        travel: [(way.x / -way.z) as f32, (way.y / -way.z) as f32],
        height: 1.0,
        rise: -1.0,
        cell: lattice.map(|at| at.floor() as i32),
        t_end: 1.0,
        ends: Hit::HIT,
    })
}

/// Metres that a tile measures along u and along v at every vertex: the mean of its triangles, by area.
pub fn metres_per_uv(vertices: &[Vertex], indices: &[u32]) -> Vec<[f32; 2]> {
    let mut sums = vec![[0.0_f64; 3]; vertices.len()];
    for corners in indices.chunks_exact(3) {
        let triangle = [0, 1, 2].map(|i| vertices[corners[i] as usize]);
        let positions = triangle.map(|corner| corner.position);
        let Some([along_u, along_v]) = tangents::gradients(positions, triangle.map(|corner| corner.uv)) else { continue };
        let area = f64::from(doubled_area(positions));
        for &corner in corners {
            let sum = &mut sums[corner as usize];
            *sum = [sum[0] + area * along_u.length(), sum[1] + area * along_v.length(), sum[2] + area];
        }
    }
    let mean = |[u, v, area]: [f64; 3]| if area > 0.0 { [(u / area) as f32, (v / area) as f32] } else { [1.0, 1.0] };
    sums.into_iter().map(mean).collect()
}

fn doubled_area([a, b, c]: [Vec3; 3]) -> f32 {
    (b - a).cross(c - a).length()
}
