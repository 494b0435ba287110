//! Small files of meshes, made by the tests that read them.

use glam::{Mat4, Quat, Vec3};
use serde_json::{Value, json};

/// A glTF file that grows: its JSON and its one buffer.
pub struct GltfFile {
    pub json: Value,
    pub buffer: Vec<u8>,
}

impl GltfFile {
    /// An empty file.
    pub fn new() -> Self {
        let json = json!({
            "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }],
            "nodes": [], "meshes": [], "accessors": [], "bufferViews": [], "buffers": [],
        });
        Self { json, buffer: Vec::new() }
    }

    /// Adds to a list; returns the place in it.
    pub fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().expect("it is a list");
        list.push(value);
        list.len() - 1
    }

    /// Adds an accessor for these bytes, of the given component type, kind and count.
    pub fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": self.buffer.len(), "byteLength": bytes.len() });
        self.buffer.extend_from_slice(bytes);
        let view = self.push("bufferViews", view);
        self.push("accessors", json!({ "bufferView": view, "componentType": component, "type": kind, "count": count }))
    }

    /// Adds floats, `width` to an element.
    pub fn floats(&mut self, values: &[f32], width: usize) -> usize {
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"].get(width - 1).copied().unwrap_or("MAT4");
        self.accessor(bytemuck::cast_slice(values), 5126, kind, values.len() / width)
    }

    /// Adds positions with the extremes that the format demands.
    pub fn positions(&mut self, values: &[[f32; 3]]) -> usize {
        let place = self.floats(values.as_flattened(), 3);
        self.json["accessors"][place]["min"] = json!([-1e3, -1e3, -1e3]);
        self.json["accessors"][place]["max"] = json!([1e3, 1e3, 1e3]);
        place
    }

    /// Adds a primitive of a mesh of its own on a node of its own with these keys; returns the node.
    pub fn node(&mut self, primitive: Value, mut node: Value) -> usize {
        let mesh = self.push("meshes", json!({ "primitives": [primitive] }));
        node["mesh"] = json!(mesh);
        self.push("nodes", node)
    }

    /// As a text that holds its buffer.
    pub fn text(mut self) -> Vec<u8> {
        self.json["buffers"] = json!([{ "byteLength": self.buffer.len(), "uri": format!("data:application/octet-stream;base64,{}", base64(&self.buffer)) }]);
        serde_json::to_vec(&self.json).expect("it is JSON")
    }

    /// As a text that names a file for its buffer, and the buffer.
    pub fn text_beside(mut self, name: &str) -> (Vec<u8>, Vec<u8>) {
        self.json["buffers"] = json!([{ "byteLength": self.buffer.len(), "uri": name }]);
        (serde_json::to_vec(&self.json).expect("it is JSON"), self.buffer)
    }

    /// As a GLB.
    pub fn glb(mut self) -> Vec<u8> {
        self.json["buffers"] = json!([{ "byteLength": self.buffer.len() }]);
        let mut text = serde_json::to_vec(&self.json).expect("it is JSON");
        text.resize(text.len().next_multiple_of(4), b' ');
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        let mut bytes = b"glTF".to_vec();
        let word = |bytes: &mut Vec<u8>, value: usize| bytes.extend((value as u32).to_le_bytes());
        word(&mut bytes, 2);
        word(&mut bytes, 12 + 8 + text.len() + 8 + self.buffer.len());
        word(&mut bytes, text.len());
        bytes.extend(b"JSON");
        bytes.extend(&text);
        word(&mut bytes, self.buffer.len());
        bytes.extend(b"BIN\0");
        bytes.extend(&self.buffer);
        bytes
    }
}

/// A square of two triangles in the plane z = 0, facing +z, v down.
pub const SQUARE: [[f32; 3]; 4] = [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
/// Its texture coordinates, the first on top.
pub const SQUARE_UV: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
/// Its triangles.
pub const SQUARE_INDICES: [u16; 6] = [0, 2, 1, 1, 2, 3];

/// Adds the square's accessors: a primitive without normals and tangents.
pub fn square(file: &mut GltfFile) -> Value {
    let position = file.positions(&SQUARE);
    let uv = file.floats(SQUARE_UV.as_flattened(), 2);
    let indices = file.accessor(bytemuck::cast_slice(&SQUARE_INDICES), 5123, "SCALAR", 6);
    json!({ "attributes": { "POSITION": position, "TEXCOORD_0": uv }, "indices": indices })
}

/// A strip of three rows of vertices along y = 0, 1, 2 on two joints: the lower row hangs on the first, the upper on the second, the
/// middle on both. The second joint sits at y = 1 and turns a quarter about z in one second.
pub fn two_joints() -> GltfFile {
    let mut file = GltfFile::new();
    let positions: Vec<[f32; 3]> = (0..3).flat_map(|y| [0.0, 1.0].map(|x| [x, y as f32, 0.0])).collect();
    let uvs: Vec<f32> = positions.iter().flat_map(|p| [p[0], 1.0 - 0.5 * p[1]]).collect();
    let position = file.positions(&positions);
    let uv = file.floats(&uvs, 2);
    let normal = file.floats(&[0.0, 0.0, 1.0].repeat(6), 3);
    let indices = file.accessor(bytemuck::cast_slice(&[0_u16, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5]), 5123, "SCALAR", 12);
    let joints = file.accessor(&[0, 1, 0, 0].repeat(6), 5121, "VEC4", 6);
    let weights: Vec<f32> = [1.0, 1.0, 0.5, 0.5, 0.0, 0.0].iter().flat_map(|&w| [w, 1.0 - w, 0.0, 0.0]).collect();
    let weights = file.floats(&weights, 4);
    let bind: Vec<f32> =
        [Mat4::IDENTITY, Mat4::from_translation(Vec3::NEG_Y)].iter().flat_map(|matrix| matrix.to_cols_array()).collect();
    let bind = file.floats(&bind, 16);
    let times = file.floats(&[0.0, 1.0], 1);
    let turn = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2);
    let turns = file.floats(&[Quat::IDENTITY.to_array(), turn.to_array()].concat(), 4);
    let primitive = json!({
        "attributes": { "POSITION": position, "NORMAL": normal, "TEXCOORD_0": uv, "JOINTS_0": joints, "WEIGHTS_0": weights },
        "indices": indices,
    });
    // The place of the skinned node itself does not count.
    file.node(primitive, json!({ "skin": 0, "translation": [50.0, 0.0, 0.0] }));
    file.push("nodes", json!({ "children": [2] }));
    file.push("nodes", json!({ "translation": [0.0, 1.0, 0.0] }));
    file.json["scenes"] = json!([{ "nodes": [0, 1] }]);
    file.json["skins"] = json!([{ "joints": [1, 2], "inverseBindMatrices": bind }]);
    file.json["animations"] = json!([{
        "channels": [{ "sampler": 0, "target": { "node": 2, "path": "rotation" } }],
        "samplers": [{ "input": times, "output": turns }],
    }]);
    file
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for group in bytes.chunks(3) {
        let bits = (0..3).fold(0_u32, |bits, i| bits << 8 | u32::from(group.get(i).copied().unwrap_or(0)));
        for i in 0..4 {
            text.push(if i <= group.len() { char::from(LETTERS[(bits >> (18 - 6 * i) & 63) as usize]) } else { '=' });
        }
    }
    text
}
