//! From what a file says to a [`Mesh`]: checked, without triangles of nothing, with what was missing computed.

use std::collections::HashMap;

use glam::{Vec2, Vec3, Vec4};

use super::skin::{Influence, Skin};
use super::{Mesh, Part, TRIANGLES_MAX, Unfit, Vertex, tangents};

/// Triangles of one material with what a file gives for their vertices.
#[derive(Default)]
pub(super) struct Piece {
    pub material: String,
    pub positions: Vec<Vec3>,
    /// One for each position, or none at all: then they are computed.
    pub normals: Vec<Vec3>,
    pub uvs: Vec<Vec2>,
    /// One for each position, or none at all: then they are computed. The w does not count.
    pub tangents: Vec<Vec3>,
    /// One for each position, if anything moves.
    pub influences: Vec<Influence>,
    pub triangles: Vec<[u32; 3]>,
    /// Computed normals are smooth across edges whose faces turn by less than the angle of this cosine; above 1 across none.
    pub crease_cosine: f32,
    /// What moves it mirrors it, so that its triangles wind the other way in the end.
    pub is_mirrored: bool,
}

/// Counts what will have to be held, before it is.
pub(super) fn check_count(triangles: usize) -> Result<(), Unfit> {
    if triangles <= TRIANGLES_MAX {
        return Ok(());
    }
    Err(Unfit(format!(
        "has {triangles} triangles, more than the {TRIANGLES_MAX} that can be shown: simplify it, the relief adds detail"
    )))
}

/// The mesh of these pieces. `skin` comes without vertices and gets them here.
pub(super) fn assemble(name: &str, pieces: Vec<Piece>, skin: Option<Skin>) -> Result<Mesh, Unfit> {
    let total: usize = pieces.iter().map(|piece| piece.triangles.len()).sum();
    if total == 0 {
        return Err(Unfit("has no triangles: save a mesh with faces".to_owned()));
    }
    check_count(total)?;
    let mut mesh = Mesh {
        name: name.to_owned(),
        vertices: Vec::new(),
        indices: Vec::new(),
        parts: Vec::new(),
        is_planar: false,
        skin: None,
    };
    let mut influences = Vec::new();
    let mut without_texture = 0;
    for mut piece in by_material(pieces) {
        piece.check()?;
        piece.drop_degenerate();
        without_texture += piece.add_to(&mut mesh, &mut influences);
    }
    let kept = mesh.triangle_count();
    if kept == 0 {
        return Err(Unfit("has degenerate triangles only, all without any area: save a mesh with faces".to_owned()));
    }
    if without_texture == kept {
        return Err(Unfit("has texture coordinates without any area: unwrap it in the program that made it".to_owned()));
    }
    if kept < total {
        log::warn!("{name}: {} of {total} triangles are degenerate, without any area, and are left out", total - kept);
    }
    if without_texture > 0 {
        log::warn!(
            "{name}: {without_texture} of {kept} triangles have texture coordinates without any area: the relief is level there"
        );
    }
    if let Some(mut skin) = skin {
        skin.bind = std::mem::take(&mut mesh.vertices);
        skin.influences = influences;
        mesh.vertices = skin.posed(0.0);
        mesh.skin = Some(skin);
    }
    if let Some(vertex) = mesh.vertices.iter().find(|vertex| !vertex.position.is_finite()) {
        return Err(Unfit(format!("is moved to {} by its nodes: repair their transforms", vertex.position)));
    }
    Ok(mesh)
}

/// The pieces, those of one material beside one another, in the order in which materials first appear.
fn by_material(pieces: Vec<Piece>) -> Vec<Piece> {
    let mut order: HashMap<String, usize> = HashMap::new();
    let mut keyed: Vec<(usize, Piece)> = Vec::new();
    for piece in pieces {
        let count = order.len();
        keyed.push((*order.entry(piece.material.clone()).or_insert(count), piece));
    }
    keyed.sort_by_key(|(material, _)| *material);
    keyed.into_iter().map(|(_, piece)| piece).collect()
}

impl Piece {
    /// Refuses what cannot be drawn, and forgets normals and tangents that are none.
    pub(super) fn check(&mut self) -> Result<(), Unfit> {
        if let Some(i) = self.positions.iter().position(|position| !position.is_finite()) {
            let kind = if self.positions[i].is_nan() { "NaN" } else { "infinite" };
            return Err(Unfit(format!("has a position that is {kind}, of vertex {i} (from 0): repair the mesh")));
        }
        if let Some(i) = self.uvs.iter().position(|uv| !uv.is_finite()) {
            return Err(Unfit(format!(
                "has a texture coordinate that is no finite number, of vertex {i} (from 0): unwrap it anew"
            )));
        }
        let count = self.positions.len();
        if let Some(index) = self.triangles.iter().flatten().find(|&&index| index as usize >= count) {
            return Err(Unfit(format!(
                "has a triangle with vertex {index}, and its last one is {}: save it anew",
                count as i64 - 1
            )));
        }
        // A vector of no length has no direction: compute them all rather than some, lest edges crack.
        let is_usable = |vector: &Vec3| vector.is_finite() && vector.length_squared() > 1e-12;
        if !self.normals.iter().all(is_usable) {
            log::warn!("some normals have no direction: all normals of material `{}` are computed anew", self.material);
            self.normals.clear();
        }
        if !self.tangents.iter().all(is_usable) {
            log::warn!("some tangents have no direction: all tangents of material `{}` are computed anew", self.material);
            self.tangents.clear();
        }
        Ok(())
    }

    /// Leaves out triangles without an area: those less high than the rounding of their edges.
    fn drop_degenerate(&mut self) {
        let positions = &self.positions;
        self.triangles.retain(|corners| {
            let [a, b, c] = corners.map(|i| positions[i as usize].as_dvec3());
            let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
            (b - a).cross(c - a).length() > f64::from(f32::EPSILON) * longest
        });
    }

    /// Adds its triangles; returns how many of them have texture coordinates without an area.
    fn add_to(self, mesh: &mut Mesh, influences: &mut Vec<Influence>) -> usize {
        let Self { positions, uvs, triangles, .. } = &self;
        let corners_of = |corners: &[u32; 3]| (corners.map(|i| positions[i as usize]), corners.map(|i| uvs[i as usize]));
        let gradients: Vec<_> = triangles
            .iter()
            .map(|triangle| {
                let (positions, uvs) = corners_of(triangle);
                tangents::gradients(positions, uvs)
            })
            .collect();
        let normals = if self.normals.is_empty() {
            tangents::normals(positions, triangles, self.crease_cosine)
        } else {
            triangles.iter().map(|corners| corners.map(|i| self.normals[i as usize].normalize())).collect()
        };
        let frames: Vec<[Vec4; 3]> = if self.tangents.is_empty() {
            tangents::tangents(positions, &normals, uvs, triangles)
        } else {
            self.given_tangents(&normals, &gradients)
        };

        #[expect(clippy::cast_possible_truncation, reason = "at most three times TRIANGLES_MAX")]
        let first = (mesh.indices.len() / 3) as u32;
        // Corners of one vertex that came out alike are one vertex again.
        let mut places: HashMap<(u32, [u32; 7]), u32> = HashMap::with_capacity(positions.len());
        for ((corners, normals), frames) in triangles.iter().zip(&normals).zip(&frames) {
            let mut triangle = [0, 1, 2].map(|i| {
                // −0 becomes 0, lest it tell vertices apart.
                let (normal, tangent) = (normals[i] + Vec3::ZERO, frames[i] + Vec4::ZERO);
                let [x, y, z] = normal.to_array();
                let [t, u, v, w] = tangent.to_array();
                let vertices = &mut mesh.vertices;
                *places.entry((corners[i], [x, y, z, t, u, v, w].map(f32::to_bits))).or_insert_with(|| {
                    let source = corners[i] as usize;
                    vertices.push(Vertex { tangent, position: positions[source], normal, uv: uvs[source] });
                    influences.extend(self.influences.get(source));
                    #[expect(clippy::cast_possible_truncation, reason = "at most three times TRIANGLES_MAX")]
                    let place = (vertices.len() - 1) as u32;
                    place
                })
            });
            if self.is_mirrored {
                triangle.swap(1, 2);
            }
            mesh.indices.extend(triangle);
        }
        #[expect(clippy::cast_possible_truncation, reason = "at most three times TRIANGLES_MAX")]
        let end = (mesh.indices.len() / 3) as u32;
        match mesh.parts.last_mut() {
            Some(last) if last.material == self.material => last.triangles.end = end,
            _ if first == end => {}
            _ => mesh.parts.push(Part { material: self.material, triangles: first..end }),
        }
        gradients.iter().filter(|gradients| gradients.is_none()).count()
    }

    /// The file's tangents, at right angles to the normals; the sign of the bitangent follows from how the triangles about a vertex
    /// lie in the texture.
    fn given_tangents(&self, normals: &[[Vec3; 3]], gradients: &[Option<[glam::DVec3; 2]>]) -> Vec<[Vec4; 3]> {
        let mut signs = vec![0.0_f64; self.positions.len()];
        for ((corners, normals), gradients) in self.triangles.iter().zip(normals).zip(gradients) {
            let Some([along_u, along_v]) = gradients else { continue };
            for i in 0..3 {
                // Negative where (u, v, normal) is left-handed; by the triangle, since a tangent may be far from its own u.
                signs[corners[i] as usize] += along_u.cross(*along_v).dot(normals[i].as_dvec3()).signum();
            }
        }
        let frame = |corner: u32, normal: Vec3| {
            let given = self.tangents[corner as usize];
            let sign = if signs[corner as usize] > 0.0 { 1.0 } else { -1.0 };
            let across = (given - given.dot(normal) * normal).try_normalize();
            across.map_or_else(|| tangents::any_tangent(normal), |tangent| tangent.extend(sign))
        };
        let triangle = |(corners, normals): (&[u32; 3], &[Vec3; 3])| [0, 1, 2].map(|i| frame(corners[i], normals[i]));
        self.triangles.iter().zip(normals).map(triangle).collect()
    }
}
