//! Meshes by name, or from an OBJ or glTF file.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::height_image::explain;
use crate::mesh::{Mesh, MeshSource, Unfit, gltf, obj};

/// No file of a mesh is larger: the largest mesh that can be shown, with everything that a vertex may have, takes less.
const BYTES_MAX: u64 = 1 << 30;

/// Why there is no mesh.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("cannot read the mesh {}: {}", path.display(), explain(cause))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// It holds no mesh that could carry a height field.
    #[error("the mesh {} {problem}", path.display())]
    Unfit {
        /// The file.
        path: PathBuf,
        /// What is the matter, and what to do about it.
        problem: Unfit,
    },
}

/// A shape on which a tile of the field measures `tile_metres`, as it does on the plane; or a file's mesh, as it is.
///
/// # Errors
///
/// The file is missing, unreadable, of another kind, damaged or too large; or its mesh lacks texture coordinates, triangles or
/// finite positions.
pub fn load(source: &MeshSource, tile_metres: [f32; 2]) -> Result<Mesh, MeshError> {
    match source {
        MeshSource::Shape(shape) => Ok(shape.mesh(tile_metres)),
        MeshSource::File(path) => read(path),
    }
}

fn read(path: &Path) -> Result<Mesh, MeshError> {
    let unfit = |problem| MeshError::Unfit { path: path.to_owned(), problem };
    let bytes = bytes(path)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let is_obj = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"));
    if bytes.is_empty() {
        return Err(unfit(Unfit("is empty: save the mesh anew".to_owned())));
    }
    let mesh = if is_obj {
        obj::parse(&name, &bytes)
    } else {
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut beside = |other: &str| {
            self::bytes(&folder.join(other)).map_err(|error| format!("needs the file {other} beside it, but {error}"))
        };
        gltf::parse(&name, &bytes, &mut beside)
    };
    mesh.map_err(unfit)
}

/// The whole of a regular file.
fn bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    let unreadable = |cause| MeshError::Unreadable { path: path.to_owned(), cause };
    let unfit = |problem: String| MeshError::Unfit { path: path.to_owned(), problem: Unfit(problem) };
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(unreadable(ErrorKind::IsADirectory.into()));
    }
    if !metadata.is_file() {
        return Err(unfit("is not a regular file: save the mesh to one first".to_owned()));
    }
    if metadata.len() > BYTES_MAX {
        return Err(unfit(format!("has {} bytes, more than the {BYTES_MAX} that are read: simplify it", metadata.len())));
    }
    std::fs::read(path).map_err(unreadable)
}
