//! What carries the relief, and what stands beside it.

use serde::{Deserialize, Serialize};

use super::exactly;
use crate::mesh::MeshSource;

/// The mesh that carries the relief.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// A shape's name (plane, box, cylinder, sphere, torus), or a file: OBJ, glTF or GLB.
    pub source: MeshSource,
    /// Distance of its farthest vertex from its middle, metres: it is scaled and centred so; absent: it stays as it is.
    #[serde(default)]
    pub radius_metres: Option<f32>,
    /// How often the field repeats along u and v beyond what the mesh's own texture coordinates say.
    #[serde(default = "once", deserialize_with = "exactly")]
    pub tiles: [f32; 2],
    /// What differs for the materials of a file.
    #[serde(default)]
    pub materials: Vec<MeshMaterial>,
}

/// What differs for one material of a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshMaterial {
    /// Its name in the file.
    pub name: String,
    /// Depth of h = 0, metres.
    #[serde(default)]
    pub depth_metres: Option<f32>,
    /// Samples of the searching techniques seen head-on and edge-on.
    #[serde(default)]
    pub samples: Option<[u32; 2]>,
}

/// A ball beside the relief.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ball {
    /// Its centre, metres.
    #[serde(deserialize_with = "exactly")]
    pub centre: [f32; 3],
    /// Its radius, metres.
    pub radius_metres: f32,
    /// Its colour, linear.
    #[serde(default = "red", deserialize_with = "exactly")]
    pub colour: [f32; 3],
}

fn once() -> [f32; 2] {
    [1.0, 1.0]
}

fn red() -> [f32; 3] {
    [0.62, 0.05, 0.035]
}
