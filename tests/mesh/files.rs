//! Meshes from disk: the sentence names the file.

use std::fs;

use rilievo::io::mesh_file::load;
use rilievo::mesh::{MeshSource, Shape};
use serde_json::json;

use super::write::{GltfFile, square};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

fn gltf_beside(name: &str) -> (Vec<u8>, Vec<u8>) {
    let mut file = GltfFile::new();
    let primitive = square(&mut file);
    file.node(primitive, json!({}));
    file.text_beside(name)
}

#[test]
fn a_mesh_comes_from_its_source() {
    let shape = load(&MeshSource::Shape(Shape::Plane), [2.0, 3.0]).unwrap();
    assert_eq!(shape.bounds().size().to_array(), [2.0, 0.0, 3.0]);
    let directory = tempfile::tempdir().unwrap();
    let (text, buffer) = gltf_beside("two.bin");
    for (name, bytes) in [("one.OBJ", TRIANGLE.as_bytes()), ("two.gltf", &text), ("two.bin", &buffer)] {
        fs::write(directory.path().join(name), bytes).unwrap();
    }
    for (file, triangles) in [("one.OBJ", 1), ("two.gltf", 2)] {
        let mesh = load(&MeshSource::File(directory.path().join(file)), [1.0, 1.0]).unwrap();
        assert_eq!((mesh.triangle_count(), mesh.name.as_str()), (triangles, &file[..3]));
    }
}

#[test]
fn bad_files_are_refused_in_a_sentence() {
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name);
    fs::create_dir(at("folder.obj")).unwrap();
    fs::write(at("empty.glb"), "").unwrap();
    fs::write(at("flat.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    fs::write(at("apart.gltf"), gltf_beside("gone.bin").0).unwrap();
    let error = |name: &str| load(&MeshSource::File(at(name)), [1.0, 1.0]).unwrap_err().to_string();
    let path = |name: &str| at(name).display().to_string();
    assert_eq!(error("none.obj"), format!("cannot read the mesh {}: there is no such file, check the path", path("none.obj")));
    assert_eq!(error("folder.obj"), format!("cannot read the mesh {}: it is a directory, name a file in it", path("folder.obj")));
    assert_eq!(error("empty.glb"), format!("the mesh {} is empty: save the mesh anew", path("empty.glb")));
    assert_eq!(
        error("flat.obj"),
        format!(
            "the mesh {} has in line 4 a face without texture coordinates: unwrap the mesh in the program that made it and save them too",
            path("flat.obj")
        )
    );
    assert_eq!(
        error("apart.gltf"),
        format!(
            "the mesh {} needs the file gone.bin beside it, but cannot read the mesh {}: there is no such file, check the path",
            path("apart.gltf"),
            path("gone.bin")
        )
    );
}
