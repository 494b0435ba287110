//! Micropolygons: as many as were asked for, without gaps, and in pictures where the reference has them.

use std::collections::HashMap;

use rilievo::camera::Camera;
use rilievo::clock::{Clock, Pace};
use rilievo::frame::{Frame, FrameInput, Start};
use rilievo::mesh::{Mesh, Shape};
use rilievo::modes::capture::{PICTURE_FORMAT, read_channels};
use rilievo::reference::{HeightField, ray_map, trace_mesh};
use rilievo::scene::{Addressing, Scene};
use rilievo::stroke::Strokes;
use rilievo::surface::channels::Channel;
use rilievo::surface::micropolygon::{MicroVertex, bare_plane, borders, indices, pieces, vertices};
use rilievo::surface::ray_map::{Placement, Target};
use rilievo::surface::{Channels, Choice, Display, Shadow, Technique};

use crate::support::fields::{ADDRESSINGS, Kind};
use crate::support::gpu::gpu;
use crate::support::tolerances;

#[test]
fn there_are_as_many_as_were_asked_for() {
    // The figures of the papers: 131,072 ([PDM]) over a plane's two, 1.5 million ([POM]) over 1,100 polygons.
    assert_eq!(2 * pieces(131_072, 2).pow(2), 131_072);
    assert_eq!(1100 * pieces(1_500_000, 1100).pow(2), 1_505_900);
    assert_eq!((pieces(2, 2), pieces(2, 1000)), (1, 1));
    let mesh = Shape::Torus.mesh([1.0, 1.0]);
    let (own, all) = (vertices(&mesh.vertices, &mesh.indices, 5), indices(mesh.triangle_count() as u32, 5));
    assert_eq!((own.len(), all.len()), (21 * mesh.triangle_count(), 3 * 25 * mesh.triangle_count()));
    assert!(all.iter().all(|&index| (index as usize) < own.len()));
    let (own, all) = bare_plane([1.0, 1.0], Addressing::Wrap, 256, &Placement::default());
    assert_eq!((own.len(), all.len()), (257 * 257, 3 * 131_072));
    // 56 bytes a vertex and 12 a triangle.
    assert_eq!(size_of_val(own.as_slice()) + size_of_val(all.as_slice()), 56 * 257 * 257 + 12 * 131_072);
}

fn place(vertex: &MicroVertex) -> [u32; 3] {
    vertex.position.map(|coordinate| (coordinate + 0.0).to_bits())
}

/// Every edge is walked once each way: pieces of neighbouring triangles share their vertices to the bit. The heights there are those
/// of their texture coordinates, and so are the same too, whole tiles apart.
#[test]
fn a_closed_mesh_stays_closed() {
    for shape in [Shape::Box, Shape::Cylinder, Shape::Sphere, Shape::Torus] {
        let mesh = shape.mesh([1.0, 1.0]);
        let own = vertices(&mesh.vertices, &mesh.indices, 3);
        let mut edges: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
        for corners in indices(mesh.triangle_count() as u32, 3).chunks_exact(3) {
            for i in 0..3 {
                let [from, to] = [i, (i + 1) % 3].map(|i| place(&own[corners[i] as usize]));
                *edges.entry([from, to]).or_default() += 1;
            }
        }
        for (&[from, to], &count) in &edges {
            assert_eq!((count, edges.get(&[to, from])), (1, Some(&1)), "{}: an edge is open or doubled", shape.name());
        }
    }
}

/// What every pixel shows.
fn numbers(scene: &Scene, heights: Vec<f32>, mesh: Option<Mesh>, size: [u32; 2]) -> Option<Vec<Channel>> {
    let gpu = gpu()?;
    let start = Start::new(scene, heights, mesh);
    let mut frame = Frame::new(gpu, &start, size, PICTURE_FORMAT).expect("the scene fits");
    let tick = Clock::new([None; 3]).advance(Pace::Fixed { dt_seconds: 1.0 / 60.0 });
    let (strokes, camera) = (Strokes::default(), Camera::at(&scene.camera, 0.0));
    let input = FrameInput { tick: &tick, strokes: &strokes, camera: &camera, display: Display::default() };
    let target = rilievo::modes::capture::Picture::new(gpu, size);
    let mut encoder = gpu.encoder("test");
    frame.record(gpu, &mut encoder, &input, Some(target.view())).expect("it is drawn");
    frame.finish(gpu, encoder);
    let pass = Channels::new(gpu, Choice::of(scene)).expect("the shader compiles");
    let numbers = read_channels(gpu, &frame, &pass, &input).expect("the device is there");
    assert_eq!(gpu.take_error(), None);
    Some(numbers)
}

fn scene(addressing: Addressing, triangles: u32, size: [u32; 2]) -> Scene {
    let mut scene = Scene::default();
    scene.field.size = size;
    scene.field.addressing = addressing;
    scene.trace.technique = Technique::Mesh;
    scene.trace.shadow = Shadow::None;
    scene.trace.mesh_triangles = triangles;
    scene
}

/// The picture's positions are those of the triangulated surface on the pixel's own ray, and every pixel of the plane shows it: also
/// where its ray leaves the plane before it meets the surface.
#[test]
fn pictures_show_the_surface_of_the_reference() {
    let image_size = [160, 120];
    for (addressing, eye) in
        ADDRESSINGS.into_iter().flat_map(|addressing| [[0.3, 1.1, 0.9], [-0.8, 0.35, 0.5]].map(|eye| (addressing, eye)))
    {
        let mut scene = scene(addressing, 2 * 48 * 48, [64, 64]);
        scene.camera.eye = eye;
        let field = Kind::Waves.field(scene.field.size, addressing);
        let Some(numbers) = numbers(&scene, field.heights.clone(), None, image_size) else { return };
        let camera = Camera::at(&scene.camera, 0.0);
        let target = Target {
            placement: Placement::default(),
            field_size: scene.field.size,
            plane_size_metres: scene.plane_size_metres(),
            depth_metres: scene.plane.depth_metres.into(),
        };
        let (mut shown, mut off) = (0, 0);
        for (index, channel) in numbers.iter().enumerate() {
            let pixel = [index % 160, index / 160].map(|at| at as f64 + 0.5);
            let Some(line) = ray_map::ray(&camera, image_size, &target, pixel) else { continue };
            if !(0..2).all(|axis| (-0.49..63.49).contains(&line.lattice[axis])) {
                continue;
            }
            shown += 1;
            let t = trace_mesh::meets(&field, 48, &line, 1.0).expect("a ray into the slab ends in it");
            let expected = line.lattice_at(t);
            let found = [0, 1].map(|axis| f64::from(channel.uv[axis]) * 64.0 - 0.5);
            let apart = (expected[0] - found[0]).hypot(expected[1] - found[1]);
            assert!(channel.steps >= 0.0, "{addressing:?}: the plane is missing at {pixel:?}");
            off += usize::from(apart > tolerances::MESH_PIXEL_CELLS);
        }
        println!("{addressing:?}, eye {eye:?}: {off} of {shown} pixels off");
        assert!(shown > 3000 && off as f64 <= tolerances::MESH_PIXEL_SHARE * f64::from(shown), "{off} of {shown} pixels");
    }
}

/// On a round mesh whose field is level the surface lies that much further in, on its facets.
#[test]
fn a_level_field_moves_a_mesh_inward() {
    let size = [32, 32];
    let scene = scene(Addressing::Wrap, 20_000, size);
    let field = HeightField::from_fn(size, Addressing::Wrap, |_, _| 0.25);
    let Some(numbers) = numbers(&scene, field.heights, Some(Shape::Sphere.mesh([1.0, 1.0])), [96, 72]) else { return };
    let seen: Vec<_> = numbers.iter().filter(|channel| channel.steps >= 0.0).collect();
    assert!(seen.len() > 300, "{} pixels", seen.len());
    // A sphere of 0.5 m, moved inward by three quarters of 0.1 m; its facets lie up to 1 − cos 5.6°·cos 5° of the radius within it.
    for channel in seen {
        let radius = glam::Vec3::from(channel.position).length();
        assert!((0.425 * 0.991..0.425 * 1.001).contains(&radius), "{radius} m");
        assert!(glam::Vec3::from(channel.normal).dot(glam::Vec3::from(channel.position)) > 0.99 * radius);
        assert_eq!(channel.height, 0.25);
    }
}

/// Over the borders of an open mesh stand walls down to the floor, which face outward.
#[test]
fn an_open_mesh_has_walls() {
    assert!(
        borders(&Shape::Torus.mesh([1.0, 1.0]).vertices, &Shape::Torus.mesh([1.0, 1.0]).indices)
            .iter()
            .flatten()
            .all(|edge| !edge)
    );
    let plane = Shape::Plane.mesh([1.0, 1.0]);
    assert_eq!(borders(&plane.vertices, &plane.indices).into_iter().flatten().filter(|&edge| edge).count(), 4);

    let size = [32, 32];
    let mut scene = scene(Addressing::Clamp, 2_000, size);
    scene.camera.eye = [0.0, 0.05, 2.0];
    scene.camera.target = [0.0, -0.05, 0.0];
    let heights = HeightField::from_fn(size, Addressing::Clamp, |_, _| 0.5).heights;
    let Some(numbers) = numbers(&scene, heights, Some(plane), [128, 96]) else { return };
    let walls: Vec<_> =
        numbers.iter().filter(|channel| channel.steps >= 0.0 && (channel.position[2] - 0.5).abs() < 1e-5).collect();
    // 1 m at 1.5 m, of 5 cm height: some 77 by 4 pixels.
    assert!((200..450).contains(&walls.len()), "{} pixels", walls.len());
    for channel in walls {
        let [x, y, _] = channel.position;
        assert!(x.abs() <= 0.5 + 1e-5 && (-0.1 - 1e-5..=-0.05 + 1e-5).contains(&y), "{x}, {y}");
        // Where it is cut deeper than rounding it is seen as the wall itself.
        if y < -0.051 {
            assert!(channel.normal[2] > 0.999, "{:?}", channel.normal);
        }
    }
}
