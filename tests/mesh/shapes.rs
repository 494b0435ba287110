//! The program's own shapes: closed, of the analytic size, with frames as field space wants them.

use std::collections::HashMap;
use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use rilievo::mesh::{Mesh, MeshSource, Shape, Vertex, shapes, tangents};

use crate::support::tolerances::{MESH_FRAME, MESH_LENGTH};

/// A tile that is no square and divides nothing evenly.
const TILE: [f32; 2] = [0.7, 0.45];

fn closed() -> Vec<Mesh> {
    let mut meshes: Vec<Mesh> = [Shape::Box, Shape::Cylinder, Shape::Sphere, Shape::Torus].map(|shape| shape.mesh(TILE)).into();
    meshes.push(shapes::cuboid(Vec3::new(1.0, 2.0, 0.5), TILE));
    meshes.push(shapes::sphere(2.0, [3, 2], TILE));
    meshes.push(shapes::cylinder(0.3, 2.0, [3, 1], TILE));
    meshes.push(shapes::torus([1.0, 0.4], [3, 3], TILE));
    meshes
}

fn place(position: Vec3) -> [u32; 3] {
    (position + Vec3::ZERO).to_array().map(f32::to_bits)
}

/// How often an edge is walked from one place to another.
fn edges(mesh: &Mesh) -> HashMap<[[u32; 3]; 2], u32> {
    let mut edges = HashMap::new();
    for corners in mesh.triangles() {
        for i in 0..3 {
            *edges.entry([place(corners[i].position), place(corners[(i + 1) % 3].position)]).or_insert(0) += 1;
        }
    }
    edges
}

fn area_and_volume(mesh: &Mesh) -> [f64; 2] {
    mesh.triangles().fold([0.0, 0.0], |[area, volume], corners| {
        let [a, b, c] = corners.map(|corner| corner.position.as_dvec3());
        [area + 0.5 * (b - a).cross(c - a).length(), volume + a.dot(b.cross(c)) / 6.0]
    })
}

#[test]
fn closed_shapes_are_watertight() {
    for mesh in closed() {
        let edges = edges(&mesh);
        for (&[from, to], &count) in &edges {
            assert_eq!((count, edges.get(&[to, from])), (1, Some(&1)), "{}: an edge is open or doubled", mesh.name);
        }
    }
}

#[test]
fn areas_and_volumes_are_those_of_the_shapes() {
    let (w, r) = (f64::from(TILE[0]), 0.5 * f64::from(TILE[0]));
    let [ring, tube] = [0.34 * w, 0.16 * w];
    // Inscribed polyhedra: a polygon of n sides loses 2π²/(3n²) of a circle's area; the coarsest direction has 16.
    let loss = 4.0 * PI * PI / (3.0 * 16.0 * 16.0);
    for (shape, area, volume, loss) in [
        (Shape::Box, 6.0 * w * w, w * w * w, 1e-6),
        (Shape::Cylinder, 2.0 * PI * r * w + 2.0 * PI * r * r, PI * r * r * w, loss),
        (Shape::Sphere, 4.0 * PI * r * r, 4.0 / 3.0 * PI * r * r * r, loss),
        (Shape::Torus, 4.0 * PI * PI * ring * tube, 2.0 * PI * PI * ring * tube * tube, loss),
    ] {
        let [own_area, own_volume] = area_and_volume(&shape.mesh(TILE));
        for (own, exact) in [(own_area, area), (own_volume, volume)] {
            let short = 1.0 - own / exact;
            assert!((-1e-6..loss).contains(&short), "{}: {own} where the shape has {exact}", shape.name());
        }
    }
}

#[test]
fn a_round_shape_has_about_eleven_hundred_triangles() {
    for (shape, count) in
        [(Shape::Plane, 2), (Shape::Box, 12), (Shape::Cylinder, 1100), (Shape::Sphere, 1088), (Shape::Torus, 1088)]
    {
        let mesh = shape.mesh([1.0, 1.0]);
        assert_eq!(mesh.triangle_count(), count, "{}", shape.name());
        assert_eq!(mesh.parts.len(), 1);
        assert_eq!(mesh.parts[0].triangles, 0..count as u32);
        assert_eq!(mesh.is_planar, matches!(shape, Shape::Plane | Shape::Box));
        assert_eq!(mesh.bytes(), (48 * mesh.vertices.len() + 12 * count) as u64);
    }
}

/// The plane is the one of the crate's conventions.
#[test]
fn the_plane_is_the_field() {
    let mesh = shapes::plane(TILE);
    for vertex in &mesh.vertices {
        let expected = Vec3::new((vertex.uv.x - 0.5) * TILE[0], 0.0, (vertex.uv.y - 0.5) * TILE[1]);
        assert!(vertex.position.distance(expected) < 1e-7, "{vertex:?}");
        assert_eq!((vertex.normal, vertex.tangent), (Vec3::Y, Vec3::X.extend(-1.0)));
        assert_eq!(vertex.bitangent(), Vec3::Z);
    }
    let [u, v] = mesh.metres_per_tile();
    assert!((u - TILE[0]).abs() < 1e-6 && (v - TILE[1]).abs() < 1e-6, "{u} {v}");
}

/// Unit, at right angles, left-handed, and the normal on the side that the triangle winds about.
fn assert_frame(vertex: &Vertex, what: &str) {
    let (normal, tangent) = (vertex.normal, vertex.tangent.truncate());
    let off = [normal.length() - 1.0, tangent.length() - 1.0, normal.dot(tangent)];
    assert!(off.iter().all(|value| f64::from(value.abs()) < MESH_FRAME), "{what}: {vertex:?}");
    assert!(
        f64::from((tangent.cross(vertex.bitangent()) + normal).length()) < 2.0 * MESH_FRAME,
        "{what}: not left-handed: {vertex:?}"
    );
}

#[test]
fn frames_run_along_the_texture() {
    // The coarsest have corners whose frames no facet agrees with.
    let fine = closed().into_iter().filter(|mesh| mesh.is_planar || mesh.triangle_count() > 1000);
    for mesh in fine.chain([shapes::plane(TILE)]) {
        for corners in mesh.triangles() {
            let positions = corners.map(|corner| corner.position);
            let face = (positions[1] - positions[0]).cross(positions[2] - positions[0]);
            let [along_u, along_v] = tangents::gradients(positions, corners.map(|corner| corner.uv)).unwrap();
            for corner in corners {
                assert_frame(&corner, &mesh.name);
                assert!(corner.normal.dot(face) > 0.0, "{}: a triangle winds the wrong way", mesh.name);
                assert_eq!(corner.tangent.w, -1.0);
                assert!(corner.tangent.truncate().as_dvec3().dot(along_u) > 0.0, "{}: the tangent leads back", mesh.name);
                assert!(corner.bitangent().as_dvec3().dot(along_v) > 0.0, "{}: the bitangent leads back", mesh.name);
                if mesh.name == "sphere" && corner.normal.y.abs() == 1.0 {
                    let turn = corner.tangent.truncate().as_dvec3().dot(along_u.normalize());
                    assert!(turn > 0.99999, "cos {turn}: a pole's tangent is that of its triangle");
                }
            }
        }
    }
}

/// What the shapes state analytically is what MikkTSpace computes, up to their facets.
#[test]
fn frames_are_those_of_mikktspace() {
    for mesh in closed().into_iter().take(4).chain([shapes::plane(TILE)]) {
        let triangles: Vec<[u32; 3]> = mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        let positions: Vec<Vec3> = mesh.vertices.iter().map(|vertex| vertex.position).collect();
        let uvs: Vec<_> = mesh.vertices.iter().map(|vertex| vertex.uv).collect();
        let normals: Vec<[Vec3; 3]> = mesh.triangles().map(|corners| corners.map(|corner| corner.normal)).collect();
        let computed = tangents::tangents(&positions, &normals, &uvs, &triangles);
        for (corners, computed) in mesh.triangles().zip(computed) {
            for (corner, computed) in corners.iter().zip(computed) {
                assert_eq!(computed.w, corner.tangent.w, "{}", mesh.name);
                let turn = computed.truncate().dot(corner.tangent.truncate());
                // On the faces of sphere and torus u leads up to half a segment of 11° aside; beside a seam on one side alone.
                let limit = if matches!(mesh.name.as_str(), "sphere" | "torus") { 0.99 } else { 0.999 };
                assert!(turn > limit, "{}: cos {turn} at {corner:?}", mesh.name);
            }
        }
    }
}

#[test]
fn texels_are_near_square_and_tiles_whole() {
    for tile in [[1.0, 1.0], TILE, [0.2, 0.1]] {
        for shape in [Shape::Box, Shape::Cylinder, Shape::Sphere, Shape::Torus] {
            let mesh = shape.mesh(tile);
            let [u, v] = mesh.metres_per_tile();
            // Rounding to whole tiles stretches one by half at the most; a sphere's average is π/4 of its equator.
            for (own, wanted) in [(u, tile[0]), (v, tile[1])] {
                let stretch = f64::from(own / wanted);
                assert!((0.5..=1.6).contains(&stretch), "{}: a tile of {wanted} m is {own} m", shape.name());
            }
        }
    }
    for shape in [Shape::Cylinder, Shape::Sphere, Shape::Torus] {
        let mesh = shape.mesh(TILE);
        let most =
            mesh.vertices.iter().filter(|vertex| vertex.normal.y.abs() < 0.9).map(|vertex| vertex.uv.x).fold(0.0, f32::max);
        assert!(most >= 1.0 && (most.fract() == 0.0 || shape == Shape::Cylinder), "{}: {most} tiles", shape.name());
    }
}

#[test]
fn a_mesh_is_fitted_and_tiled() {
    let mesh = shapes::cuboid(Vec3::new(2.0, 4.0, 4.0), [1.0, 1.0]);
    let fitted = mesh.clone().fitted(1.5);
    let bounds = fitted.bounds();
    assert!(bounds.centre().length() < 1e-6);
    assert!((DVec3::from(bounds.size()) - DVec3::new(1.0, 2.0, 2.0)).length() < MESH_LENGTH);
    let tiled = mesh.clone().tiled([2.0, 3.0]);
    assert!(mesh.vertices.iter().zip(&tiled.vertices).all(|(a, b)| b.uv.x == 2.0 * a.uv.x && b.uv.y == 3.0 * a.uv.y));
}

#[test]
fn a_source_is_a_name_or_a_file() {
    for shape in Shape::ALL {
        assert_eq!(shape.name().parse(), Ok(MeshSource::Shape(shape)));
    }
    for file in ["a.obj", "b/c.GLB", "d.gltf", "plane.obj"] {
        assert_eq!(file.parse(), Ok(MeshSource::File(file.into())));
    }
    let error = "shpere".parse::<MeshSource>().unwrap_err();
    assert_eq!(
        error,
        "unknown mesh `shpere`: did you mean `sphere`, of plane, box, cylinder, sphere and torus? (the name of a file ends in .obj, .gltf or .glb)"
    );
    let mut source = MeshSource::File("soldier.glb".into());
    source.resolve(std::path::Path::new("scenes/war"));
    assert_eq!(source.to_string(), "scenes/war/soldier.glb");
    #[derive(serde::Deserialize)]
    struct Holds {
        mesh: MeshSource,
    }
    assert_eq!(toml::from_str::<Holds>("mesh = 'torus'").unwrap().mesh, MeshSource::Shape(Shape::Torus));
    assert!(toml::from_str::<Holds>("mesh = 'tours'").is_err_and(|error| error.message().contains("did you mean `torus`")));
}
