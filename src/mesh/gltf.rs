//! glTF 2.0, as text or GLB: every mesh of the scene, where its nodes put it; skins and the first animation.
//!
//! Texture coordinates are `TEXCOORD_0`, whose v already runs down the image. A primitive without normals is flat, as the format
//! wants it. Strips and fans become triangles; points and lines are left out with a note, and so are morph targets, further
//! animations, and joints beyond the fourth of a vertex.

mod accessor;
mod rig;

use ::gltf as format;
use format::mesh::{Mode, Semantic};
use glam::{Mat4, Vec2, Vec3, Vec4};

use self::accessor::Buffers;
use self::rig::Rig;
use super::assemble::{Piece, assemble, check_count};
use super::skin::{Influence, moved};
use super::{Mesh, Unfit, Vertex};

/// The mesh in the bytes of such a file. `read` gives the bytes of another file that it names, a path relative to it.
///
/// # Errors
///
/// The file is damaged, or needs what this reader lacks; another file that it names cannot be read; or the mesh is not one to carry a
/// height field.
pub fn parse(name: &str, bytes: &[u8], read: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>) -> Result<Mesh, Unfit> {
    let file = open(bytes)?;
    let buffers = Buffers::load(&file, read)?;
    let mut rig = Rig::new(&file, &buffers)?;
    let mut reader = Reader { name, buffers: &buffers, pieces: Vec::new(), triangles: 0 };
    for (index, node) in rig.nodes_with_meshes(&file) {
        reader.node(&node, &mut rig, index)?;
    }
    let skin = rig.finish();
    assemble(name, reader.pieces, skin)
}

/// The file, valid as far as the crate checks it, and beyond: it looks up positions before it has checked that they are there, and
/// never checks what an animation moves.
fn open(bytes: &[u8]) -> Result<format::Gltf, Unfit> {
    let format::Gltf { document, blob } = format::Gltf::from_slice_without_validation(bytes).map_err(|error| explain(&error))?;
    let root = document.into_json();
    let used = root.meshes.iter().flat_map(|mesh| &mesh.primitives).flat_map(|primitive| primitive.attributes.values());
    if let Some(missing) = used.map(|index| index.value()).find(|&index| index >= root.accessors.len()) {
        return Err(Unfit(format!("uses an accessor {missing}, and there is none: save it anew")));
    }
    let channels = root.animations.iter().flat_map(|animation| &animation.channels);
    for (number, target) in channels.map(|channel| &channel.target).enumerate() {
        if target.node.value() >= root.nodes.len() || target.path == format::json::validation::Checked::Invalid {
            return Err(Unfit(format!("has a channel {number} of its animations that moves nothing: save it anew")));
        }
    }
    let document = format::Document::from_json(root).map_err(|error| explain(&error))?;
    Ok(format::Gltf { document, blob })
}

struct Reader<'a> {
    name: &'a str,
    buffers: &'a Buffers,
    pieces: Vec<Piece>,
    triangles: usize,
}

impl Reader<'_> {
    /// The primitives of a node's mesh, each in the node's place, or hung on what moves it.
    fn node(&mut self, node: &format::Node, rig: &mut Rig, index: usize) -> Result<(), Unfit> {
        let Some(mesh) = node.mesh() else { return Ok(()) };
        let joints = match node.skin() {
            Some(skin) => Some(rig.joints_of(&skin, self.buffers)?),
            None => None,
        };
        for primitive in mesh.primitives() {
            if matches!(primitive.mode(), Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
                log::warn!("{}: the points or lines of mesh {} are left out, only triangles count", self.name, mesh.index());
                continue;
            }
            if primitive.morph_targets().len() > 0 {
                log::warn!("{}: the morph targets of mesh {} are left out", self.name, mesh.index());
            }
            let mut piece = self.piece(&primitive)?;
            if let Some((first, count)) = joints {
                piece.influences = self.influences(&primitive, first, count, piece.positions.len())?;
            } else if rig.is_animated() {
                let joint = rig.rigid_joint(index);
                piece.influences = vec![Influence::whole(joint); piece.positions.len()];
                piece.is_mirrored = rig.file_from_node(index).determinant() < 0.0;
            } else {
                put(&mut piece, rig.file_from_node(index));
            }
            self.pieces.push(piece);
        }
        Ok(())
    }

    fn piece(&mut self, primitive: &format::Primitive) -> Result<Piece, Unfit> {
        let mesh = self.mesh_name(primitive);
        let read = |semantic: &Semantic, width: usize| match primitive.get(semantic) {
            Some(accessor) => self.buffers.vectors(&accessor, width).map(Some),
            None => Ok(None),
        };
        let positions: Vec<Vec3> = read(&Semantic::Positions, 3)?
            .ok_or_else(|| Unfit(format!("has no positions in {mesh}: save it anew")))?
            .into_iter()
            .map(Vec4::truncate)
            .collect();
        let uvs = read(&Semantic::TexCoords(0), 2)?.ok_or_else(|| {
            Unfit(format!("has no texture coordinates in {mesh}: unwrap it in the program that made it and save them too"))
        })?;
        let normals = read(&Semantic::Normals, 3)?;
        let tangents = read(&Semantic::Tangents, 4)?;
        for (what, count) in [
            ("texture coordinates", Some(uvs.len())),
            ("normals", normals.as_ref().map(Vec::len)),
            ("tangents", tangents.as_ref().map(Vec::len)),
        ] {
            if let Some(count) = count.filter(|&count| count != positions.len()) {
                let positions = positions.len();
                return Err(Unfit(format!("has {count} {what} for {positions} positions in {mesh}: save it anew")));
            }
        }
        let order: Vec<u32> = match primitive.indices() {
            Some(accessor) => self.buffers.indices(&accessor)?,
            #[expect(
                clippy::cast_possible_truncation,
                reason = "a buffer of four billion positions does not fit a file that is read"
            )]
            None => (0..positions.len() as u32).collect(),
        };
        let triangles: Vec<[u32; 3]> = match primitive.mode() {
            Mode::TriangleStrip => {
                let turned = |(i, t): (usize, &[u32])| if i % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] };
                order.windows(3).enumerate().map(turned).collect()
            }
            Mode::TriangleFan => order.get(1..).unwrap_or_default().windows(2).map(|edge| [order[0], edge[0], edge[1]]).collect(),
            _ => order.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        };
        self.triangles += triangles.len();
        check_count(self.triangles)?;
        let mut piece = Piece {
            material: material_name(primitive),
            positions,
            normals: normals.unwrap_or_default().into_iter().map(Vec4::truncate).collect(),
            uvs: uvs.into_iter().map(|uv| Vec2::new(uv.x, uv.y)).collect(),
            tangents: tangents.unwrap_or_default().into_iter().map(Vec4::truncate).collect(),
            triangles,
            // The format: "when normals are not specified, client implementations must calculate flat normals".
            crease_cosine: f32::INFINITY,
            ..Piece::default()
        };
        // Before a matrix makes NaN of an infinity.
        piece.check()?;
        Ok(piece)
    }

    /// What the vertices of a skinned primitive hang on.
    fn influences(
        &self,
        primitive: &format::Primitive,
        first: u32,
        count: usize,
        vertices: usize,
    ) -> Result<Vec<Influence>, Unfit> {
        let mesh = self.mesh_name(primitive);
        let read = |semantic: Semantic, what: &str| {
            let accessor = primitive.get(&semantic);
            let accessor = accessor.ok_or_else(|| Unfit(format!("has a skin but no {what} in {mesh}: save it anew")))?;
            let values = self.buffers.vectors(&accessor, 4)?;
            match values.len() == vertices {
                true => Ok(values),
                false => Err(Unfit(format!("has {} {what} for {vertices} positions in {mesh}: save it anew", values.len()))),
            }
        };
        if primitive.get(&Semantic::Joints(1)).is_some() {
            log::warn!("{}: joints beyond the fourth of a vertex are left out in {mesh}", self.name);
        }
        let (joints, weights) = (read(Semantic::Joints(0), "joints")?, read(Semantic::Weights(0), "weights")?);
        let influence = |(joints, weights): (Vec4, Vec4)| {
            let sum = weights.element_sum();
            // What hangs on nothing hangs on its first joint.
            let weights = if sum.is_finite() && sum > 1e-6 { weights / sum } else { Vec4::X };
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "they are 8 or 16 bit integers")]
            let joints = joints.to_array().map(|joint| joint as u32);
            for (joint, weight) in joints.into_iter().zip(weights.to_array()) {
                if weight != 0.0 && joint as usize >= count {
                    return Err(Unfit(format!("has a vertex on joint {joint} of {count} (from 0) in {mesh}: save it anew")));
                }
            }
            // A joint without weight may be anything: it becomes the first.
            let joints = joints.map(|joint| first + if (joint as usize) < count { joint } else { 0 });
            Ok(Influence { joints, weights: weights.to_array() })
        };
        joints.into_iter().zip(weights).map(influence).collect()
    }

    fn mesh_name(&self, primitive: &format::Primitive) -> String {
        format!("primitive {} of its meshes (material `{}`)", primitive.index(), material_name(primitive))
    }
}

/// A material's name, or its number where it has none.
fn material_name(primitive: &format::Primitive) -> String {
    let material = primitive.material();
    match (material.name(), material.index()) {
        (Some(name), _) => name.to_owned(),
        (None, Some(index)) => format!("material {index}"),
        (None, None) => String::new(),
    }
}

/// Moves a piece that stands still to its place.
fn put(piece: &mut Piece, place: Mat4) {
    piece.is_mirrored = false;
    for i in 0..piece.positions.len() {
        let normal = piece.normals.get(i).copied().unwrap_or(Vec3::Y);
        let tangent = piece.tangents.get(i).copied().unwrap_or(Vec3::X);
        let vertex = moved(&Vertex { tangent: tangent.extend(1.0), position: piece.positions[i], normal, uv: Vec2::ZERO }, place);
        piece.positions[i] = vertex.position;
        if let Some(own) = piece.normals.get_mut(i) {
            *own = vertex.normal;
        }
        if let Some(own) = piece.tangents.get_mut(i) {
            *own = vertex.tangent.truncate();
        }
    }
    // A mirrored triangle winds the other way: turned here, before anything is computed from it.
    if place.determinant() < 0.0 {
        piece.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    }
}

/// The crate's error as a sentence.
fn explain(error: &format::Error) -> Unfit {
    let one_line = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    Unfit(match error {
        format::Error::Validation(errors) => {
            let unsupported = errors.iter().find(|(_, error)| *error == format::json::validation::Error::Unsupported);
            match (unsupported, errors.first()) {
                (Some((path, _)), _) => {
                    format!("needs an extension that is not supported here ({path}): save it without compression")
                }
                (None, Some((path, error))) => {
                    format!("is not valid glTF ({path}: {}): save it anew", one_line(error.to_string()).to_lowercase())
                }
                (None, None) => "is not valid glTF: save it anew".to_owned(),
            }
        }
        format::Error::Deserialize(error) => {
            format!("is not valid glTF ({}): save it anew", one_line(error.to_string()))
        }
        format::Error::Binary(error) => {
            format!("is a truncated or damaged GLB file ({}): save it anew", one_line(error.to_string()))
        }
        other => format!("is a truncated or damaged glTF file ({}): save it anew", one_line(other.to_string())),
    })
}
