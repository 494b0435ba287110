//! OBJ: what is read, and how bad files are refused.

use glam::{Vec2, Vec3, Vec4};
use rilievo::mesh::{Mesh, Part, Unfit, obj};

use crate::support::tolerances::MESH_FRAME;

/// A square that faces +z, its texture upright; a comment, an object and a group.
const SQUARE: &str =
    "# a square\no square\ng front\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n";

fn parse(text: &str) -> Result<Mesh, String> {
    obj::parse("test", text.as_bytes()).map_err(|Unfit(problem)| problem)
}

fn square(faces: &str) -> Result<Mesh, String> {
    parse(&format!("{SQUARE}{faces}"))
}

#[test]
fn a_square_is_read() {
    for faces in [
        "f 1/1/1 2/2/1 3/3/1 4/4/1",
        "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1",
        "f -4/-4/-1 -3/-3/-1 -2/-2/-1 -1/-1/-1\r\n",
        "f 1/1 2/2 3/3 4/4",
        "s 1\nf 1/1/ \\\n 2/2/ 3/3 4/4 # the face",
        "mtllib none.mtl\nl 1 2\np 3\nf 1/1/1 2/2/1 3/3/1 4/4/1",
    ] {
        let mesh = square(faces).unwrap();
        assert_eq!((mesh.triangle_count(), mesh.vertices.len()), (2, 4), "{faces}");
        for vertex in &mesh.vertices {
            // OBJ counts v up, field space down.
            assert_eq!(vertex.uv, Vec2::new(vertex.position.x, 1.0 - vertex.position.y));
            assert!(vertex.normal.distance(Vec3::Z) < MESH_FRAME as f32, "{vertex:?}");
            assert!(vertex.tangent.distance(Vec4::new(1.0, 0.0, 0.0, -1.0)) < MESH_FRAME as f32, "{vertex:?}");
        }
        assert_eq!(mesh.parts, [Part { material: String::new(), triangles: 0..2 }]);
        assert_eq!(mesh.skin, None);
    }
    // Some editors write a byte order mark before the first position.
    let (_, positions) = SQUARE.split_once("front\n").unwrap();
    assert_eq!(parse(&format!("\u{feff}{positions}f 1/1 2/2 3/3 4/4")), square("f 1/1 2/2 3/3 4/4"));
}

/// Names in another encoding do not matter.
#[test]
fn bytes_that_are_no_text_are_passed_over() {
    let mut bytes = b"# caf\xe9\n".to_vec();
    bytes.extend(SQUARE.as_bytes());
    bytes.extend(b"usemtl \xff\nf 1/1/1 2/2/1 3/3/1 4/4/1");
    assert_eq!(obj::parse("test", &bytes).unwrap().triangle_count(), 2);
}

#[test]
fn triangles_are_grouped_by_material() {
    let mesh = square("usemtl a\nf 1/1 2/2 3/3\nusemtl b c\nf 1/1 3/3 4/4\nusemtl a\nf 2/2 3/3 4/4").unwrap();
    let parts: Vec<_> = mesh.parts.iter().map(|part| (part.material.as_str(), part.triangles.clone())).collect();
    assert_eq!(parts, [("a", 0..2), ("b c", 2..3)]);
}

/// One face without normals, and those of all are computed.
#[test]
fn normals_are_given_for_all_or_computed_for_all() {
    let text = SQUARE.replace("vn 0 0 1", "vn 0 1 1");
    let [given, mixed] = ["f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1", "f 1/1/1 2/2/1 3/3/1\nf 1/1 3/3 4/4"]
        .map(|faces| parse(&format!("{text}{faces}")).unwrap());
    let tilted = Vec3::new(0.0, 1.0, 1.0).normalize();
    assert!(given.vertices.iter().all(|vertex| vertex.normal.distance(tilted) < MESH_FRAME as f32));
    assert!(mixed.vertices.iter().all(|vertex| vertex.normal.distance(Vec3::Z) < MESH_FRAME as f32));
}

/// A mirrored texture has the other sign.
#[test]
fn a_mirrored_texture_turns_the_bitangent() {
    let text = SQUARE.replace("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1", "vt 1 0\nvt 0 0\nvt 0 1\nvt 1 1");
    for vertex in parse(&format!("{text}f 1/1/1 2/2/1 3/3/1 4/4/1")).unwrap().vertices {
        assert!(vertex.tangent.distance(Vec4::new(-1.0, 0.0, 0.0, 1.0)) < MESH_FRAME as f32, "{vertex:?}");
        assert!(vertex.bitangent().distance(Vec3::NEG_Y) < 2.0 * MESH_FRAME as f32);
    }
}

/// A concave quad is cut where both halves face alike, a convex one along its shorter diagonal.
#[test]
fn quads_are_cut_well() {
    // An arrowhead: its third corner lies inside the triangle of the others, so that the shorter diagonal would turn a half over.
    let arrow = "v 10 0 0\nv -1 1 0\nv 0 0 0\nv -1 -1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    for face in ["f 1/1 2/2 3/3 4/4", "f 2/2 3/3 4/4 1/1"] {
        let mesh = parse(&format!("{arrow}{face}")).unwrap();
        for corners in mesh.triangles() {
            let [a, b, c] = corners.map(|corner| corner.position);
            assert!((b - a).cross(c - a).z > 0.0, "{face}");
        }
    }
    let kite = "v 0 0 0\nv 1 -1 0\nv 9 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4";
    let mesh = parse(kite).unwrap();
    let shared =
        mesh.vertices.iter().enumerate().filter(|(i, _)| mesh.indices.iter().filter(|&&j| j as usize == *i).count() == 2);
    assert!(shared.map(|(_, vertex)| vertex.position.x).eq([1.0, 1.0]), "the diagonal is the shorter one");
}

/// A cube without normals keeps its edges; a prism of 24 sides becomes smooth.
#[test]
fn computed_normals_are_smooth_but_at_creases() {
    let sides = |count: usize| {
        let mut text = String::new();
        for i in 0..count {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / count as f64).sin_cos();
            text += &format!("v {cos} 0 {}\nv {cos} 1 {}\nvt {} 0\nvt {} 1\n", -sin, -sin, i, i);
        }
        for i in 0..count {
            let [a, b] = [2 * i + 1, 2 * ((i + 1) % count) + 1];
            text += &format!("f {a}/{a} {b}/{b} {}/{} {}/{}\n", b + 1, b + 1, a + 1, a + 1);
        }
        parse(&text).unwrap()
    };
    for vertex in sides(24).vertices {
        let out = Vec3::new(vertex.position.x, 0.0, vertex.position.z);
        assert!(vertex.normal.distance(out) < 1e-5, "{vertex:?}");
    }
    for vertex in sides(4).vertices {
        let out = Vec3::new(vertex.position.x, 0.0, vertex.position.z);
        assert!((vertex.normal.dot(out) - std::f32::consts::FRAC_1_SQRT_2).abs() < 1e-5, "{vertex:?}");
    }
}

#[test]
fn bad_files_are_refused_in_a_sentence() {
    let face = "f 1/1/1 2/2/1 3/3/1";
    for (text, expected) in [
        (SQUARE.to_owned(), "has no triangles: save a mesh with faces"),
        (
            format!("{SQUARE}f 1 2 3"),
            "has in line 13 a face without texture coordinates: unwrap the mesh in the program that made it and save them too",
        ),
        (
            format!("{SQUARE}{face}\nf 1//1 2//1 3//1"),
            "has in line 14 a face without texture coordinates: unwrap the mesh in the program that made it and save them too",
        ),
        (format!("{SQUARE}f 1/1 2/2"), "has in line 13 a face of 2 vertices, and it takes three: repair the mesh"),
        (format!("{SQUARE}f 1/1 2/2 5/3"), "has in line 13 a face with position 5, and there are 4 so far: save the mesh anew"),
        (format!("{SQUARE}f 1/1 2/2 0/3"), "has in line 13 a face with position 0, and there are 4 so far: save the mesh anew"),
        (
            format!("{SQUARE}f 1/1 2/-5 3/3"),
            "has in line 13 a face with texture coordinate -5, and there are 4 so far: save the mesh anew",
        ),
        (
            format!("{SQUARE}f 1/1/2 2/2/1 3/3/1"),
            "has in line 13 a face with normal 2, and there are 1 so far: save the mesh anew",
        ),
        (format!("{SQUARE}f a/1 2/2 3/3"), "has in line 13 `a` where the number of a position must be: a face is `f V/VT/VN …`"),
        ("v 1 2\n".to_owned(), "has in line 1 too few numbers: a position is `v X Y Z`"),
        ("v 1 2 x\n".to_owned(), "has in line 1 `x` where a number must be: a position is `v X Y Z`"),
        ("\nv 1 nan 2\n".to_owned(), "has in line 2 the position [1, NaN, 2], which is not finite: repair the mesh"),
        ("v 1 1e99 2\n".to_owned(), "has in line 1 the position [1, inf, 2], which is not finite: repair the mesh"),
        (
            format!("{}{face}", SQUARE.replace("vt 1 0", "vt inf 0")),
            "has a texture coordinate that is no finite number, of vertex 1 (from 0): unwrap it anew",
        ),
        (format!("{SQUARE}f 1/1 1/1 2/2"), "has degenerate triangles only, all without any area: save a mesh with faces"),
        (
            format!("{}{face}", SQUARE.replace("vt 1 1", "vt 0.5 0")),
            "has texture coordinates without any area: unwrap it in the program that made it",
        ),
    ] {
        assert_eq!(parse(&text).unwrap_err(), expected);
    }
}

#[test]
fn some_degenerate_triangles_are_left_out() {
    // One of a line, one of a point, one less high than rounding.
    let mesh = square("v 2 0 0\nv 3 1e-9 0\nf 1/1 2/2 3/3\nf 1/1 2/2 5/3\nf 1/1 1/2 1/3\nf 1/1 2/2 6/3\nf 1/1 3/3 4/4").unwrap();
    assert_eq!(mesh.triangle_count(), 2);
    assert!(mesh.vertices.iter().all(|vertex| vertex.position.x <= 1.0));
}

#[test]
fn more_triangles_than_can_be_shown_are_refused() {
    // A polygon counts as the triangles that it makes.
    let polygon = "f".to_owned() + &" 1/1".repeat((1 << 19) + 2) + "\n";
    let error = parse(&format!("{SQUARE}{}", polygon.repeat(9))).unwrap_err();
    assert_eq!(error, "has 4718592 triangles, more than the 4194304 that can be shown: simplify it, the relief adds detail");
}
