//! The shell against brute force over its tetrahedra, pixel by pixel through the passes that draw it.

use glam::{DVec2, DVec3};
use rilievo::camera::Camera;
use rilievo::frame::{Frame, Start};
use rilievo::mesh::{Mesh, Shape};
use rilievo::modes::capture::PICTURE_FORMAT;
use rilievo::reference::shell::{self, Tetrahedron};
use rilievo::reference::{Addressing, HeightField};
use rilievo::scene::{self, MeshMaterial, Scene};
use rilievo::surface::shell::{Core, core, inward, triangles};

use crate::support::fields::Kind;
use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::seen::{scene_of, seen};
use crate::support::tolerances::{SHELL_OFF_SHARE, hit_height, lattice_bound};

const SIZE: [u32; 2] = [200, 150];

struct Eye {
    camera: Camera,
}

impl Eye {
    fn ray(&self, pixel: DVec2) -> (DVec3, DVec3) {
        (self.camera.eye(), self.camera.direction(pixel, SIZE))
    }
}

/// Pixels that show something, and those of them that are off by more than rounding.
#[derive(Default)]
struct Tally {
    shown: usize,
    off: usize,
    wrong: Vec<String>,
}

fn compare(name: &str, mesh: &Mesh, field: &HeightField, eye: &Eye) -> Tally {
    let Some(gpu) = gpu() else { return Tally::default() };
    let mut scene = scene_of(field);
    scene.trace.shell = true;
    let depth = scene.plane.depth_metres;
    let (channels, _) = seen(gpu, &scene, field, Some(mesh.clone()), &eye.camera, SIZE);
    let all = shell::tetrahedra(&mesh.vertices, &mesh.indices, field.size, depth);
    let [metres_u, metres_v] = mesh.metres_per_tile();
    let cell_metres = f64::from(metres_u / field.size[0] as f32).min(f64::from(metres_v / field.size[1] as f32));
    let judged = rays::each(channels.len(), |index| {
        let pixel = DVec2::new((index as u32 % SIZE[0]) as f64 + 0.5, (index as u32 / SIZE[0]) as f64 + 0.5);
        let (from, direction) = eye.ray(pixel);
        let truth = shell::first_hit(field, &all, from, direction);
        let channel = &channels[index];
        let position = DVec3::from(channel.position.map(f64::from));
        // Coordinates are counted in cells from the eye: that is how far f32 has to reach.
        let cells = lattice_bound((position - from).length() / cell_metres);
        match (truth, channel.steps >= 0.0) {
            (None, false) => (0, 0, None),
            (Some((_, s)), true) if (from + s * direction).distance(position) <= cells * cell_metres => (1, 0, None),
            (truth, shows) => {
                let why = judge(field, &all, eye, pixel, truth, shows.then_some(position), cells);
                let what = format!("{name}, pixel {pixel}: {truth:?}, shown {shows} at {position}");
                (usize::from(shows), 1, why.map(|why| format!("{what}: {why}")))
            }
        }
    });
    let mut tally = Tally::default();
    for (shown, off, wrong) in judged {
        tally.shown += shown;
        tally.off += off;
        tally.wrong.extend(wrong);
    }
    println!("{name}: {} pixels shown, {} off, {} of them not by rounding", tally.shown, tally.off, tally.wrong.len());
    tally
}

/// Why a pixel that disagrees with the reference is wrong; none where rounding decides it.
fn judge(
    field: &HeightField,
    all: &[Tetrahedron],
    eye: &Eye,
    pixel: DVec2,
    truth: Option<(usize, f64)>,
    shown: Option<DVec3>,
    cells: f64,
) -> Option<String> {
    // A silhouette: rasterisers know corners to a 256th of a pixel, and beyond that a neighbouring ray sees otherwise.
    let here = truth.map_or(f64::INFINITY, |(_, s)| s);
    let offsets = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0]];
    let (from, direction) = eye.ray(pixel);
    let found = shown.map_or(f64::INFINITY, |position| (position - from).dot(direction));
    let near = |s: f64| (s - found).abs() <= 1e-3 * found.min(1e3) || s == found;
    if offsets.iter().any(|offset| {
        let (from, direction) = eye.ray(pixel + DVec2::from(*offset) / 128.0);
        near(shell::first_hit(field, all, from, direction).map_or(f64::INFINITY, |(_, s)| s))
    }) {
        return None;
    }
    // Wherever it is, it has to be on the surface, and must not have dived under it before.
    let limit = |lattice: [f64; 2]| hit_height(cells, rays::steepness_around(field, lattice, cells));
    let last = found.min(1e3);
    for tetrahedron in all {
        let Some([enter, leave]) = tetrahedron.way(from, direction) else { continue };
        let leave = leave.min(last);
        if enter >= leave {
            continue;
        }
        let line = tetrahedron.line(from, direction, [enter, leave]);
        let (lowest, slope) = line.closest(field, 0.0, 1.0);
        if -lowest > hit_height(cells, slope) {
            return Some(format!("dives {:e} under the surface before {found}, the truth is {here}", -lowest));
        }
        if let Some(position) = shown
            && (enter..=leave + 1e-9).contains(&found)
        {
            let at = tetrahedron.field_of(position);
            let gap = at.z - field.bilinear([at.x, at.y]);
            if gap > limit([at.x, at.y]) {
                return Some(format!("floats {gap:e} above the surface"));
            }
        }
    }
    None
}

fn look(eye: [f64; 3], target: [f64; 3]) -> Eye {
    Eye { camera: Camera::look_at(eye.into(), target.into(), 0.8, 0.01) }
}

/// Every shape, two fields, from afar and from near the silhouette.
#[test]
fn a_shell_is_hit_where_brute_force_over_its_tetrahedra_hits_it() {
    if gpu().is_none() {
        return;
    }
    let (mut shown, mut off, mut wrong) = (0, 0, Vec::new());
    for shape in Shape::ALL {
        let mesh = shape.mesh([1.0, 1.0]);
        for kind in [Kind::Elevation, Kind::Steps] {
            let addressing = if shape == Shape::Plane { Addressing::Clamp } else { Addressing::Wrap };
            let field = kind.field([128, 128], addressing);
            for eye in [look([0.9, 0.8, 1.1], [0.0; 3]), look([0.75, 0.12, 0.35], [0.0, -0.05, 0.0])] {
                let tally = compare(&format!("{} of {kind:?}", shape.name()), &mesh, &field, &eye);
                shown += tally.shown;
                off += tally.off;
                wrong.extend(tally.wrong);
            }
        }
    }
    for why in wrong.iter().take(5) {
        eprintln!("{why}");
    }
    println!("{shown} pixels shown, {off} off by more than rounding, {} wrong", wrong.len());
    assert!(shown > 50_000);
    assert_eq!(wrong.len(), 0);
    assert!((off as f64) <= SHELL_OFF_SHARE * shown as f64, "{off} of {shown}");
}

/// A material with a depth of its own, here the scene's, leaves a mesh without a core: nothing else may change. From near the limb,
/// and through long lenses from where an f32 no longer tells the squares of distances apart.
#[test]
fn what_is_behind_the_core_of_a_shell_was_not_to_be_seen() {
    let Some(gpu) = gpu() else { return };
    let mesh = Shape::Sphere.mesh([1.0, 1.0]);
    let field = Kind::Steps.field([128, 128], Addressing::Wrap);
    let mut scene = scene_of(&field);
    scene.trace.shell = true;
    let mut whole = scene.clone();
    let material = MeshMaterial { depth_metres: Some(scene.plane.depth_metres), ..MeshMaterial::default() };
    whole.mesh = Some(scene::Mesh { materials: vec![material], ..scene::Mesh::default() });
    assert!(core(&mesh.vertices, &mesh.indices, scene.plane.depth_metres).radius > 0.0);
    let far = |metres: f64| {
        let eye = metres * DVec3::new(0.4, 0.3, 0.866);
        Eye { camera: Camera::look_at(eye, DVec3::ZERO, 1.1 / metres, 0.01) }
    };
    for eye in [look([0.75, 0.12, 0.35], [0.0, -0.05, 0.0]), far(2.0), far(300.0), far(1200.0)] {
        let of = |scene: &Scene| seen(gpu, scene, &field, Some(mesh.clone()), &eye.camera, SIZE).0;
        let (with, without) = (of(&scene), of(&whole));
        let shown = with.iter().filter(|channel| channel.steps >= 0.0).count();
        let differing = with.iter().zip(&without).filter(|(with, without)| with != without).count();
        assert!(shown > 8_000 && differing == 0, "{} from {}: {differing} differ", shown, eye.camera.eye());
    }
}

/// How far the tetrahedra are from the smooth shell that they stand for: the chord's sagitta, printed by shape and number of
/// triangles, and falling with its square.
#[test]
fn the_deviation_from_the_smooth_shell_falls_with_the_square_of_the_triangles_edge() {
    let radius = 0.5;
    let depth = 0.1;
    for (name, is_sphere) in [("sphere", true), ("cylinder", false)] {
        let mut before: Option<f64> = None;
        for segments in [16_u32, 32, 64] {
            let mesh = if is_sphere {
                rilievo::mesh::shapes::sphere(radius, [segments, segments / 2], [1.0, 1.0])
            } else {
                rilievo::mesh::shapes::cylinder(radius, 1.0, [segments, 4], [1.0, 1.0])
            };
            let round: Vec<u32> = mesh
                .indices
                .chunks_exact(3)
                .filter(|corners| is_sphere || corners.iter().all(|&i| mesh.vertices[i as usize].normal.y.abs() < 0.5))
                .flatten()
                .copied()
                .collect();
            let mut largest = 0.0_f64;
            for tetrahedron in shell::tetrahedra(&mesh.vertices, &round, [64, 64], depth) {
                for i in 0..=4 {
                    for j in 0..=4 - i {
                        for k in 0..=4 - i - j {
                            let weights = [i, j, k, 4 - i - j - k].map(|n| f64::from(n) / 4.0);
                            let mix = |values: &[DVec3; 4]| (0..4).map(|n| weights[n] * values[n]).sum::<DVec3>();
                            let (world, height) = (mix(&tetrahedron.corners), mix(&tetrahedron.field).z);
                            let axis = if is_sphere { world } else { DVec3::new(world.x, 0.0, world.z) };
                            let smooth = f64::from(radius) - (1.0 - height) * f64::from(depth);
                            largest = largest.max((axis.length() - smooth).abs());
                        }
                    }
                }
            }
            println!("{name} of radius {radius} m, {segments} segments: at most {:.4} mm from the smooth shell", largest * 1e3);
            if let Some(before) = before {
                assert!((0.2..0.35).contains(&(largest / before)), "{name}: {largest} after {before}");
            }
            before = Some(largest);
        }
    }
}

#[test]
fn the_shell_of_a_closed_shape_has_no_border_and_no_gap() {
    for shape in Shape::ALL {
        let mesh = shape.mesh([1.0, 1.0]);
        let borders: u32 = triangles(&mesh.vertices, &mesh.indices).iter().map(|triangle| triangle.borders.count_ones()).sum();
        assert_eq!(borders, if shape == Shape::Plane { 4 } else { 0 }, "{}", shape.name());
        // One place has one way inward, a depth from every face that meets there.
        let ways = inward(&mesh.vertices);
        for (vertex, way) in mesh.vertices.iter().zip(&ways) {
            let same = mesh.vertices.iter().zip(&ways).filter(|(other, _)| other.position == vertex.position);
            assert!(same.clone().all(|(_, other)| other == way), "{}", shape.name());
            assert!(same.clone().all(|(other, _)| (other.normal.dot(*way) + 1.0).abs() < 0.02), "{}: {way}", shape.name());
        }
    }
}

/// The ball that hides what is behind it: in every closed shape but the torus, whose middle is outside.
#[test]
fn the_core_of_a_shell_lies_deeper_than_its_floor_and_only_closed_shapes_have_one() {
    let depth = 0.1;
    for shape in Shape::ALL {
        let mesh = shape.mesh([1.0, 1.0]);
        let Core { centre, radius } = core(&mesh.vertices, &mesh.indices, depth);
        assert_eq!(radius > 0.0, !matches!(shape, Shape::Plane | Shape::Torus), "{}: {radius}", shape.name());
        let ways = inward(&mesh.vertices);
        let floor = |index: u32| {
            let way = ways[index as usize];
            (mesh.vertices[index as usize].position + depth * way).as_dvec3() - centre.as_dvec3()
        };
        let (mut nearest, steps) = (f64::INFINITY, 8);
        for face in mesh.indices.chunks_exact(3) {
            let [a, b, c] = [floor(face[0]), floor(face[1]), floor(face[2])];
            for i in 0..=steps {
                for j in 0..=steps - i {
                    let [u, v] = [i, j].map(|n| f64::from(n) / f64::from(steps));
                    nearest = nearest.min((a + u * (b - a) + v * (c - a)).length());
                }
            }
        }
        assert!(f64::from(radius) < nearest, "{}: {radius}, and the floor is at {nearest}", shape.name());
        // The floor of a ball or a cube is hardly farther.
        let touches = if radius > 0.0 { 0.97 * nearest } else { 0.0 };
        assert!(f64::from(radius) >= touches, "{}: {radius} of {nearest}", shape.name());
        // Deeper than its middle it would be inside out.
        assert_eq!(core(&mesh.vertices, &mesh.indices, 0.9).radius, 0.0, "{}", shape.name());
    }
}

#[test]
fn a_mesh_of_too_many_triangles_is_refused_as_a_shell_and_drawn_flat() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Constant.field([16, 16], Addressing::Wrap);
    let mesh = rilievo::mesh::shapes::sphere(0.5, [400, 200], [1.0, 1.0]);
    assert!(mesh.triangle_count() > rilievo::surface::shell::TRIANGLES_MAX);
    let mut scene = scene_of(&field);
    let (channels, _) = seen(gpu, &scene, &field, Some(mesh.clone()), &look([0.0, 0.0, 1.5], [0.0; 3]).camera, [32, 24]);
    assert!(channels.iter().any(|channel| channel.steps >= 0.0));
    scene.trace.shell = true;
    let start = Start::new(&scene, field.heights.clone(), Some(mesh));
    let error = Frame::new(gpu, &start, [32, 24], PICTURE_FORMAT).err().expect("it is too large").to_string();
    assert!(error.contains("100000") && error.contains("without --shell"), "{error}");
}
