//! Where a mesh comes from, as a scene or the command line says it in one word.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::Shape;
use crate::suggest;

/// The endings of files that hold meshes.
const ENDINGS: [&str; 3] = ["obj", "gltf", "glb"];

/// A shape by name, or a file that ends in .obj, .gltf or .glb.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum MeshSource {
    /// One of the program's own.
    Shape(Shape),
    /// A file.
    File(PathBuf),
}

impl MeshSource {
    /// Lets a relative path begin in `folder`.
    pub fn resolve(&mut self, folder: &Path) {
        if let Self::File(path) = self {
            *path = folder.join(&path);
        }
    }
}

impl Default for MeshSource {
    fn default() -> Self {
        Self::Shape(Shape::Plane)
    }
}

impl FromStr for MeshSource {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ending = Path::new(text).extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
        if ENDINGS.contains(&ending.as_str()) {
            return Ok(Self::File(text.into()));
        }
        match Shape::ALL.into_iter().find(|shape| shape.name() == text) {
            Some(shape) => Ok(Self::Shape(shape)),
            None => {
                let names = Shape::ALL.map(Shape::name);
                Err(format!("{} (the name of a file ends in .obj, .gltf or .glb)", suggest::unknown("mesh", text, &names)))
            }
        }
    }
}

impl TryFrom<String> for MeshSource {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<MeshSource> for String {
    fn from(source: MeshSource) -> Self {
        source.to_string()
    }
}

impl std::fmt::Display for MeshSource {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Shape(shape) => f.write_str(shape.name()),
            Self::File(path) => path.display().fmt(f),
        }
    }
}
