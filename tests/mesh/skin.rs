//! Meshes that move: skins, keyframes, and parts that move as a whole.

use glam::{Mat4, Quat, Vec3, Vec4};
use rilievo::mesh::skin::{Interpolation, Property, Track};
use rilievo::mesh::{Mesh, gltf};
use serde_json::json;

use super::write::{GltfFile, square, two_joints};
use crate::support::tolerances::{MESH_FRAME, MESH_LENGTH};

fn parse(file: GltfFile) -> Mesh {
    gltf::parse("test", &file.glb(), &mut |name| Err(name.to_owned())).unwrap()
}

fn close(a: Vec3, b: Vec3) -> bool {
    f64::from(a.distance(b)) < MESH_LENGTH
}

/// The upper joint turns about (0, 1, 0): by 90° in a second, and anew after it.
#[test]
fn a_skin_follows_its_joints() {
    let mesh = parse(two_joints());
    let skin = mesh.skin.as_ref().unwrap();
    assert_eq!(skin.duration_seconds, 1.0);
    assert_eq!(mesh.vertices, mesh.posed(0.0));
    for (vertex, bound) in mesh.vertices.iter().zip(&skin.bind) {
        assert!(close(vertex.position, bound.position), "at rest the joints are where they were bound");
    }
    for time in [0.0_f64, 0.25, 0.5, 0.999, 1.5, -0.5, 1e6 + 0.75] {
        let turn = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2 * (time.rem_euclid(1.0)) as f32);
        let upper = Mat4::from_translation(Vec3::Y) * Mat4::from_quat(turn) * Mat4::from_translation(Vec3::NEG_Y);
        let pose = skin.pose(time);
        assert_eq!(pose.len(), 2);
        assert!(pose[0].abs_diff_eq(Mat4::IDENTITY, 1e-6) && pose[1].abs_diff_eq(upper, 1e-5), "at {time} s");
        for (vertex, bound) in mesh.posed(time).iter().zip(&skin.bind) {
            let p = bound.position;
            let expected = match p.y {
                0.0 => p,
                1.0 => 0.5 * (p + upper.transform_point3(p)),
                _ => upper.transform_point3(p),
            };
            assert!(close(vertex.position, expected), "at {time} s: {} becomes {}", p, vertex.position);
            assert!(close(vertex.normal, Vec3::Z) && close(vertex.bitangent(), vertex.tangent.truncate().cross(Vec3::Z)));
            assert!(f64::from((vertex.tangent.truncate().length() - 1.0).abs()) < MESH_FRAME);
            assert_eq!((vertex.uv, vertex.tangent.w), (bound.uv, -1.0));
        }
    }
}

#[test]
fn a_fitted_skin_moves_in_its_new_place() {
    let mesh = parse(two_joints());
    let fitted = mesh.clone().fitted(10.0);
    let (centre, scale) = (mesh.bounds().centre(), 10.0 / 1.25_f32.sqrt());
    for time in [0.0, 0.5] {
        for (own, vertex) in fitted.posed(time).iter().zip(mesh.posed(time)) {
            assert!(f64::from(own.position.distance(scale * (vertex.position - centre))) < 10.0 * MESH_LENGTH, "at {time} s");
            assert!(close(own.normal, vertex.normal));
        }
    }
    assert_eq!(
        fitted.vertices.iter().map(|vertex| vertex.position.length()).fold(0.0, f32::max),
        fitted.posed(0.0)[0].position.length()
    );
    let tiled = fitted.tiled([2.0, 1.0]);
    assert!(tiled.posed(0.5).iter().zip(&tiled.vertices).all(|(a, b)| a.uv == b.uv));
}

/// A part without a skin moves with its node, and one that is mirrored winds the right way.
#[test]
fn a_part_moves_as_a_whole() {
    let mut file = GltfFile::new();
    let primitive = square(&mut file);
    file.node(primitive, json!({ "scale": [-1.0, 1.0, 1.0] }));
    let times = file.floats(&[1.0, 2.0, 4.0], 1);
    let moves = file.floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 5.0, 0.0], 3);
    file.json["animations"] = json!([{
        "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }],
        "samplers": [{ "input": times, "output": moves, "interpolation": "LINEAR" }],
    }]);
    let mesh = parse(file);
    for (time, expected) in [(0.0, [0.0, 0.0]), (1.5, [0.5, 0.0]), (3.0, [1.0, 2.5]), (4.5, [0.0, 0.0])] {
        let posed = mesh.posed(time);
        for (vertex, bound) in posed.iter().zip(&mesh.skin.as_ref().unwrap().bind) {
            let place = Vec3::new(expected[0] - bound.position.x, expected[1] + bound.position.y, 0.0);
            assert!(close(vertex.position, place) && close(vertex.normal, Vec3::Z), "at {time} s: {vertex:?}");
            assert!(close(vertex.bitangent(), Vec3::NEG_Y) && vertex.tangent.w == 1.0);
        }
    }
    for corners in mesh.triangles() {
        let [a, b, c] = corners.map(|corner| corner.position);
        assert!((b - a).cross(c - a).z > 0.0, "a triangle winds the wrong way");
    }
}

#[test]
fn keyframes_are_interpolated_as_the_format_says() {
    let track = |property, interpolation, values: &[[f32; 4]]| Track {
        node: 0,
        property,
        interpolation,
        times: vec![1.0, 3.0],
        values: values.iter().map(|&value| Vec4::from_array(value)).collect(),
    };
    let step = track(Property::Scale, Interpolation::Step, &[[1.0; 4], [2.0; 4]]);
    let linear = track(Property::Scale, Interpolation::Linear, &[[1.0; 4], [2.0; 4]]);
    for (time, held, straight) in
        [(0.0, 1.0, 1.0), (1.0, 1.0, 1.0), (2.0, 1.0, 1.5), (2.9, 1.0, 1.95), (3.0, 2.0, 2.0), (9.0, 2.0, 2.0)]
    {
        assert_eq!(step.sample(time).x, held);
        assert!((linear.sample(time).x - straight).abs() < 1e-6);
    }
    // A cubic is reproduced: x³ − x on [1, 3] has the slopes 3x² − 1.
    let f = |x: f32| x * x * x - x;
    let slope = |x: f32| 3.0 * x * x - 1.0;
    let key = |x: f32| [[slope(x); 4], [f(x); 4], [slope(x); 4]];
    let cubic = track(Property::Translation, Interpolation::Cubic, &[key(1.0), key(3.0)].concat());
    for time in [1.0, 1.3, 2.0, 2.8, 3.0] {
        assert!((cubic.sample(time).y - f(time)).abs() < 1e-4, "at {time}");
    }
    assert_eq!((cubic.sample(0.0).x, cubic.sample(5.0).x), (f(1.0), f(3.0)));
    // A rotation takes the shorter arc, whichever sign its quaternion has, at an even pace.
    let turn = Quat::from_rotation_x(1.2);
    for sign in [1.0, -1.0] {
        let rotation = track(Property::Rotation, Interpolation::Linear, &[Quat::IDENTITY.to_array(), (turn * sign).to_array()]);
        let half = Quat::from_vec4(rotation.sample(2.0));
        assert!(half.angle_between(Quat::from_rotation_x(0.6)) < 1e-3, "{half}");
    }
}

#[test]
fn bad_animations_are_refused() {
    /// A change of a good file, and what is then said.
    type Case = (fn(&mut GltfFile), &'static str);
    let cases: &[Case] = &[
        (
            |file| {
                let times = file.floats(&[1.0, 1.0], 1);
                file.json["animations"][0]["samplers"][0]["input"] = json!(times);
            },
            "has keyframes in channel 0 of its animation that make no motion: save it anew",
        ),
        (
            |file| file.json["animations"][0]["samplers"][0]["interpolation"] = json!("CUBICSPLINE"),
            "has keyframes in channel 0 of its animation that make no motion: save it anew",
        ),
        (
            |file| file.json["nodes"][2] = json!({ "matrix": Mat4::IDENTITY.to_cols_array() }),
            "animates a node 2 that is given as a matrix: save it anew",
        ),
        (
            |file| {
                let joints = file.accessor(&[0, 2, 0, 0].repeat(6), 5121, "VEC4", 6);
                file.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = json!(joints);
            },
            "has a vertex on joint 2 of 2 (from 0) in primitive 0 of its meshes (material ``): save it anew",
        ),
        (
            |file| {
                let one = file.floats(&Mat4::IDENTITY.to_cols_array(), 16);
                file.json["skins"][0]["inverseBindMatrices"] = json!(one);
            },
            "has a skin 0 of 2 joints with 1 bind matrices: save it anew",
        ),
        (
            |file| drop(file.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("WEIGHTS_0")),
            "has a skin but no weights in primitive 0 of its meshes (material ``): save it anew",
        ),
    ];
    for (change, expected) in cases {
        let mut file = two_joints();
        change(&mut file);
        let error = gltf::parse("test", &file.glb(), &mut |name| Err(name.to_owned())).unwrap_err();
        assert_eq!(error.0, *expected);
    }
}
