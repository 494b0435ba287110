//! glTF: what is read, and how bad files are refused.

use glam::{Vec2, Vec3, Vec4};
use rilievo::mesh::{Mesh, Unfit, gltf};
use serde_json::json;

use super::write::{GltfFile, SQUARE, SQUARE_UV, square, two_joints};
use crate::support::tolerances::MESH_FRAME;

fn parse(bytes: &[u8]) -> Result<Mesh, String> {
    gltf::parse("test", bytes, &mut |name| Err(format!("needs the file {name}"))).map_err(|Unfit(problem)| problem)
}

/// A file with the square on one node with these keys.
fn file(node: serde_json::Value) -> GltfFile {
    let mut file = GltfFile::new();
    let primitive = square(&mut file);
    file.node(primitive, node);
    file
}

fn close(a: Vec3, b: Vec3) -> bool {
    f64::from(a.distance(b)) < MESH_FRAME
}

#[test]
fn a_square_is_read_as_text_and_as_glb() {
    let (text, beside) = file(json!({})).text_beside("the%20buffer.bin");
    let mut read = |name: &str| {
        assert_eq!(name, "the buffer.bin");
        Ok(beside.clone())
    };
    let apart = gltf::parse("test", &text, &mut read).unwrap();
    for mesh in [parse(&file(json!({})).text()).unwrap(), parse(&file(json!({})).glb()).unwrap(), apart] {
        assert_eq!((mesh.triangle_count(), mesh.vertices.len(), &mesh.skin), (2, 4, &None));
        for vertex in &mesh.vertices {
            // glTF counts v down, as field space does.
            let corner = SQUARE.iter().position(|&corner| vertex.position == Vec3::from(corner)).unwrap();
            assert_eq!(vertex.uv, Vec2::from(SQUARE_UV[corner]));
            assert!(close(vertex.normal, Vec3::Z) && close(vertex.bitangent(), Vec3::NEG_Y), "{vertex:?}");
            assert!(vertex.tangent.distance(Vec4::new(1.0, 0.0, 0.0, -1.0)) < MESH_FRAME as f32, "{vertex:?}");
        }
    }
}

#[test]
fn nodes_put_meshes_in_their_places() {
    let mut file = GltfFile::new();
    let primitive = square(&mut file);
    // A quarter turn about y, on a parent that doubles and moves; and the same mesh mirrored in x.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    file.push("nodes", json!({ "scale": [2.0, 2.0, 2.0], "translation": [0.0, 10.0, 0.0], "children": [1, 2] }));
    file.node(primitive, json!({ "rotation": [0.0, half, 0.0, half] }));
    file.push("nodes", json!({ "mesh": 0, "matrix": [-1.0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }));
    file.push("nodes", json!({ "mesh": 0 }));
    let mesh = parse(&file.glb()).unwrap();
    assert_eq!(mesh.triangle_count(), 4, "the last node is not in the scene");
    let [turned, mirrored] = [&mesh.vertices[..4], &mesh.vertices[4..]];
    for vertex in turned {
        assert!(vertex.position.x.abs() < 1e-6 && (10.0..=12.0).contains(&vertex.position.y), "{vertex:?}");
        assert!(close(vertex.normal, Vec3::X) && close(vertex.tangent.truncate(), Vec3::NEG_Z), "{vertex:?}");
        assert_eq!(vertex.tangent.w, -1.0);
    }
    for vertex in mirrored {
        assert!((-2.0..=0.0).contains(&vertex.position.x), "{vertex:?}");
        assert!(close(vertex.normal, Vec3::Z) && close(vertex.tangent.truncate(), Vec3::NEG_X), "{vertex:?}");
        assert!(close(vertex.bitangent(), Vec3::NEG_Y), "the texture still hangs down");
    }
    for corners in mesh.triangles() {
        let [a, b, c] = corners.map(|corner| corner.position);
        assert!((b - a).cross(c - a).dot(corners[0].normal) > 0.0, "a triangle winds the wrong way");
    }
}

#[test]
fn strips_fans_and_lists_are_the_same() {
    let list = parse(&file(json!({})).glb()).unwrap();
    for (mode, order) in [(5, [0_u8, 2, 1, 3].as_slice()), (6, &[1, 0, 2, 3]), (4, &[0, 2, 1, 1, 2, 3])] {
        let mut file = GltfFile::new();
        let mut primitive = square(&mut file);
        primitive["indices"] = json!(file.accessor(order, 5121, "SCALAR", order.len()));
        primitive["mode"] = json!(mode);
        file.node(primitive, json!({}));
        let mesh = parse(&file.glb()).unwrap();
        let sum = |mesh: &Mesh| {
            mesh.triangles().fold(Vec3::ZERO, |sum, corners| {
                let [a, b, c] = corners.map(|corner| corner.position);
                sum + 0.5 * (b - a).cross(c - a)
            })
        };
        assert_eq!((mesh.triangle_count(), sum(&mesh)), (2, sum(&list)), "mode {mode}");
    }
}

#[test]
fn materials_and_given_frames_are_kept() {
    let mut file = GltfFile::new();
    let mut one = square(&mut file);
    let normal = [0.0, 0.6, 0.8];
    one["attributes"]["NORMAL"] = json!(file.floats(&normal.repeat(4), 3));
    // The sign of a file's tangents does not count.
    one["attributes"]["TANGENT"] = json!(file.floats(&[1.0, 0.0, 0.0, 1.0].repeat(4), 4));
    one["material"] = json!(1);
    let mut two = square(&mut file);
    two["material"] = json!(0);
    let mut three = square(&mut file);
    three["material"] = json!(1);
    let mut points = square(&mut file);
    points["mode"] = json!(0);
    file.json["materials"] = json!([{}, { "name": "skin" }]);
    file.push("meshes", json!({ "primitives": [one, two, points, three] }));
    file.push("nodes", json!({ "mesh": 0 }));
    let mesh = parse(&file.glb()).unwrap();
    let parts: Vec<_> = mesh.parts.iter().map(|part| (part.material.as_str(), part.triangles.clone())).collect();
    assert_eq!(parts, [("skin", 0..4), ("material 0", 4..6)]);
    for vertex in &mesh.vertices[..4] {
        assert!(close(vertex.normal, Vec3::from(normal)), "{vertex:?}");
        assert!(vertex.tangent.distance(Vec4::new(1.0, 0.0, 0.0, -1.0)) < MESH_FRAME as f32, "{vertex:?}");
    }
}

/// Quantised texture coordinates, a stride, and sparse values.
#[test]
fn accessors_of_every_kind_are_read() {
    let mut file = GltfFile::new();
    let mut primitive = square(&mut file);
    let quantised: Vec<u16> =
        SQUARE_UV.iter().flat_map(|uv| [(uv[0] * 65535.0) as u16, (uv[1] * 65535.0) as u16, 9, 9]).collect();
    let uv = file.accessor(bytemuck::cast_slice(&quantised), 5123, "VEC2", 4);
    file.json["accessors"][uv]["normalized"] = json!(true);
    file.json["bufferViews"][uv]["byteStride"] = json!(8);
    primitive["attributes"]["TEXCOORD_0"] = json!(uv);
    let places = file.accessor(&[3], 5121, "SCALAR", 1);
    let values = file.floats(&[1.0, 0.0, 0.5], 3);
    let views = [places, values].map(|accessor| file.json["accessors"][accessor]["bufferView"].clone());
    file.json["accessors"][0]["sparse"] = json!({
        "count": 1, "indices": { "bufferView": views[0], "componentType": 5121 }, "values": { "bufferView": views[1] },
    });
    file.node(primitive, json!({}));
    let mesh = parse(&file.glb()).unwrap();
    for (corner, uv) in SQUARE_UV.iter().enumerate() {
        let expected = if corner == 3 { [1.0, 0.0, 0.5] } else { SQUARE[corner] };
        let found = mesh.vertices.iter().find(|vertex| vertex.position == Vec3::from(expected));
        assert_eq!(found.unwrap().uv, Vec2::from(*uv));
    }
    assert_eq!(mesh.vertices.len(), 6, "where faces meet at an edge, flat normals split it");
}

#[test]
fn bad_files_are_refused_in_a_sentence() {
    /// A change of a good file, and what is then said.
    type Case = (fn(&mut GltfFile), &'static str);
    let cases: &[Case] = &[
        (
            |file| drop(file.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("TEXCOORD_0")),
            "has no texture coordinates in primitive 0 of its meshes (material ``): unwrap it in the program that made it and save them too",
        ),
        (|file| file.json["meshes"][0]["primitives"][0]["mode"] = json!(1), "has no triangles: save a mesh with faces"),
        (|file| file.json["scenes"][0]["nodes"] = json!([]), "has no triangles: save a mesh with faces"),
        (
            |file| file.buffer[4..8].copy_from_slice(&f32::NAN.to_le_bytes()),
            "has a position that is NaN, of vertex 0 (from 0): repair the mesh",
        ),
        (
            |file| file.buffer[4..8].copy_from_slice(&f32::INFINITY.to_le_bytes()),
            "has a position that is infinite, of vertex 0 (from 0): repair the mesh",
        ),
        (|file| file.buffer[80] = 7, "has a triangle with vertex 7, and its last one is 3: save it anew"),
        (
            |file| file.json["accessors"][1]["count"] = json!(3),
            "has 3 texture coordinates for 4 positions in primitive 0 of its meshes (material ``): save it anew",
        ),
        (
            |file| file.json["accessors"][0]["count"] = json!(5),
            "has 5 values where its buffer view 0 has not that many bytes: save it anew",
        ),
        (
            |file| file.json["accessors"][1]["type"] = json!("VEC3"),
            "has an accessor 1 of another kind than it is used as: save it anew",
        ),
        (|file| file.json["accessors"][2]["componentType"] = json!(5126), "has indices that are no whole numbers: save it anew"),
        (
            |file| file.json["bufferViews"][2]["byteOffset"] = json!(1_u64 << 40),
            "has 6 values where its buffer view 2 has not that many bytes: save it anew",
        ),
        (|file| file.json["nodes"][0]["mesh"] = json!(9), "is not valid glTF (nodes[0].mesh: index out of bounds): save it anew"),
        (|file| file.json["nodes"][0]["children"] = json!([0]), "has nodes that are their own ancestors: save it anew"),
        (
            |file| {
                file.json["nodes"] = json!([{ "mesh": 0, "children": [2] }, { "children": [2] }, {}]);
            },
            "has a node 2 with two parents: save it anew",
        ),
        (
            |file| file.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]),
            "needs an extension that is not supported here (extensionsRequired[0] = \"KHR_draco_mesh_compression\"): save it without compression",
        ),
        (
            |file| file.json["nodes"][0]["scale"] = json!([0, 0, 0]),
            "has degenerate triangles only, all without any area: save a mesh with faces",
        ),
    ];
    for (change, expected) in cases {
        let mut file = file(json!({}));
        change(&mut file);
        assert_eq!(parse(&file.glb()).unwrap_err(), *expected);
    }
    let glb = file(json!({})).glb();
    for length in [11, 40, glb.len() - 1] {
        let error = parse(&glb[..length]).unwrap_err();
        assert!(error.contains("damaged") && error.ends_with("save it anew"), "{length} bytes: {error}");
    }
    let error = parse(b"{ \"asset\": 3 }").unwrap_err();
    assert!(error.starts_with("is not valid glTF (") && !error.contains('\n'), "{error}");
    let (text, _) = file(json!({})).text_beside("gone.bin");
    assert_eq!(parse(&text).unwrap_err(), "needs the file gone.bin");
    let (text, _) = file(json!({})).text_beside("https://example.org/a.bin");
    assert_eq!(parse(&text).unwrap_err(), "has a buffer at a https address, and only files are read: save it as one .glb file");
    let (text, buffer) = file(json!({})).text_beside("short.bin");
    let error = gltf::parse("test", &text, &mut |_| Ok(buffer[1..].to_vec())).unwrap_err();
    assert_eq!(error.0, format!("has {} of the {} bytes of its buffer 0: save it anew", buffer.len() - 1, buffer.len()));
}

/// Whatever byte of a file is another, it is read or refused, and nothing panics.
#[test]
fn damaged_files_never_panic() {
    for glb in [file(json!({})).glb(), two_joints().glb()] {
        for i in 0..glb.len() {
            for change in [0x01, 0x02, 0x10, 0x80, 0xff] {
                let mut damaged = glb.clone();
                damaged[i] ^= change;
                if let Ok(mesh) = parse(&damaged) {
                    mesh.posed(0.3);
                }
            }
        }
    }
}
