//! Facets: a box keeps the whole proof of the plane, and meshes show their relief where the polygons are.

use glam::{DVec2, DVec3};
use rilievo::camera::Camera;
use rilievo::mesh::Shape;
use rilievo::reference::Addressing;
use rilievo::reference::traversal::Line;
use rilievo::surface::facet::{charts, pick};

use crate::support::fields::Kind;
use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::seen::{scene_of, seen};
use crate::support::tolerances::{SHELL_OFF_SHARE, hit_height, lattice_bound};

const SIZE: [u32; 2] = [320, 200];

/// From the pixel's own ray, the chart that it meets first, and every cell on the way, in f64.
#[test]
fn on_a_box_exact_hits_where_brute_force_does() {
    let Some(gpu) = gpu() else { return };
    let (mut shown, mut off) = (0_usize, 0_usize);
    for (shape, addressing) in [(Shape::Box, Addressing::Wrap), (Shape::Plane, Addressing::Clamp)] {
        let mesh = shape.mesh([1.0, 1.0]);
        for (kind, eye) in [(Kind::Elevation, [0.9, 0.8, 1.1]), (Kind::Noise, [1.2, 0.1, 0.6]), (Kind::Steps, [-0.8, 0.9, 0.2])] {
            let field = kind.field([256, 256], addressing);
            let mut scene = scene_of(&field);
            scene.trace.displaced_depth = true;
            let depth = f64::from(scene.plane.depth_metres);
            let camera = Camera::look_at(eye.into(), DVec3::ZERO, 0.9, 0.01);
            let (channels, _) = seen(gpu, &scene, &field, Some(mesh.clone()), &camera, SIZE);
            let charts = charts(&mesh, 0..mesh.triangle_count() as u32);
            assert_eq!(charts.len(), if shape == Shape::Box { 6 } else { 1 });
            let judged = rays::each(channels.len(), |index| {
                let channel = &channels[index];
                if channel.steps < 0.0 {
                    return (0, 0, None);
                }
                let pixel = DVec2::new((index as u32 % SIZE[0]) as f64 + 0.5, (index as u32 / SIZE[0]) as f64 + 0.5);
                let (from, direction) = (camera.eye(), camera.direction(pixel, SIZE));
                // The chart whose face the ray enters, and the line over its field.
                let lines = charts.iter().filter_map(|chart| {
                    let place = &chart.placement;
                    let fall = -direction.dot(place.up);
                    let s = (from - place.origin).dot(place.up) / fall;
                    let meets = from + s * direction - place.origin;
                    let lattice = |at: DVec3| {
                        [place.u.dot(at) / chart.tile_metres[0], place.v.dot(at) / chart.tile_metres[1]]
                            .map(|uv| (uv + 0.5) * 256.0 - 0.5)
                    };
                    let start = lattice(meets);
                    let end = lattice(meets + direction * (depth / fall));
                    let inside = start.iter().all(|at| (-0.5 - 1e-3..=255.5 + 1e-3).contains(at));
                    let line = Line { lattice: start, travel: [end[0] - start[0], end[1] - start[1]], height: 1.0, rise: -1.0 };
                    (fall > 0.0 && s > 0.0 && inside).then_some((s, place, chart.tile_metres, line))
                });
                let position = DVec3::from(channel.position.map(f64::from));
                // At an edge the pixel may belong to either face.
                let mut why = None;
                for (_, place, tile, line) in lines {
                    let at = position - place.origin;
                    let here = [place.u.dot(at) / tile[0], place.v.dot(at) / tile[1]].map(|uv| (uv + 0.5) * 256.0 - 0.5);
                    let t = line.meets(&field, 0.0, 1.0).expect("a view ray always ends");
                    let there = line.lattice_at(t);
                    let cells = lattice_bound(rays::reach(&[line.lattice, line.lattice_at(1.0)]));
                    if rays::distance(here, there) <= cells {
                        return (1, 0, None);
                    }
                    let (lowest, slope) = line.closest(&field, 0.0, 1.0_f64.min(-place.up.dot(at) / depth));
                    let height = hit_height(cells, slope);
                    if -lowest <= height && ((1.0 + place.up.dot(at) / depth) - field.bilinear(here)).abs() <= height {
                        return (1, 1, None);
                    }
                    why = Some(format!("pixel {pixel}: {here:?}, not {there:?}; passes {:e} under", -lowest));
                }
                (1, 1, why)
            });
            for (is_shown, is_off, wrong) in judged {
                shown += is_shown;
                off += is_off;
                if let Some(wrong) = wrong {
                    panic!("{} of {kind:?}: {wrong}", shape.name());
                }
            }
        }
    }
    println!("{shown} pixels shown, {off} off by rounding at a tangent");
    assert!(shown > 50_000 && off as f64 <= SHELL_OFF_SHARE * shown as f64, "{off} of {shown}");
}

/// What is drawn flat ends at the polygon's silhouette: a sphere of ones is the sphere's polygons.
#[test]
fn a_mesh_of_ones_shows_its_polygons() {
    let Some(gpu) = gpu() else { return };
    let field = rilievo::reference::HeightField::from_fn([64, 64], Addressing::Wrap, |_, _| 1.0);
    let camera = Camera::look_at(DVec3::new(0.2, 0.5, 1.4), DVec3::ZERO, 0.9, 0.01);
    for shape in [Shape::Sphere, Shape::Cylinder, Shape::Torus] {
        let mesh = shape.mesh([1.0, 1.0]);
        let (channels, _) = seen(gpu, &scene_of(&field), &field, Some(mesh.clone()), &camera, SIZE);
        let shown: Vec<_> = channels.iter().enumerate().filter(|(_, channel)| channel.steps >= 0.0).collect();
        assert!(shown.len() > 4_000, "{}: {}", shape.name(), shown.len());
        let mut wrong = 0;
        for (index, channel) in shown.iter().step_by(17) {
            let pixel = DVec2::new((*index as u32 % SIZE[0]) as f64 + 0.5, (*index as u32 / SIZE[0]) as f64 + 0.5);
            let (from, direction) = (camera.eye(), camera.direction(pixel, SIZE));
            let nearest = mesh
                .triangles()
                .filter_map(|corners| {
                    let [a, b, c] = corners.map(|corner| corner.position.as_dvec3());
                    let weights = glam::DMat3::from_cols(b - a, c - a, -direction).inverse() * (from - a);
                    let inside = weights.x >= -1e-4 && weights.y >= -1e-4 && weights.x + weights.y <= 1.0 + 1e-4;
                    inside.then_some(weights.z)
                })
                .fold(f64::INFINITY, f64::min);
            let found = (DVec3::from(channel.position.map(f64::from)) - from).length();
            // Varyings are interpolated from corners that are snapped to a 256th of a pixel, some 10 µm here, at any slope.
            if (found - nearest).abs() >= 2e-3 && nearest.is_finite() {
                println!("{}, pixel {pixel}: {found}, not {nearest}; {channel:?}", shape.name());
                wrong += 1;
            }
        }
        assert_eq!(wrong, 0, "{}", shape.name());
    }
}

/// A pointer's ray meets the field where the picture shows it: on a box the same numbers as the channels.
#[test]
fn a_pointer_picks_what_its_pixel_shows() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Elevation.field([128, 128], Addressing::Wrap);
    let camera = Camera::look_at(DVec3::new(0.9, 0.8, 1.1), DVec3::ZERO, 0.9, 0.01);
    let mesh = Shape::Box.mesh([1.0, 1.0]);
    let mut scene = scene_of(&field);
    scene.trace.technique = rilievo::surface::Technique::Normal;
    let (channels, _) = seen(gpu, &scene, &field, Some(mesh.clone()), &camera, SIZE);
    let (mut picked, mut missed) = (0, 0);
    for (index, channel) in channels.iter().enumerate().step_by(29) {
        let pixel = DVec2::new((index as u32 % SIZE[0]) as f64 + 0.5, (index as u32 / SIZE[0]) as f64 + 0.5);
        let depth = f64::from(scene.plane.depth_metres);
        let ray = pick(&mesh.vertices, &mesh.indices, field.size, depth, camera.eye(), camera.direction(pixel, SIZE));
        match (ray, channel.steps >= 0.0) {
            (Some(ray), true) => {
                let uv = ray.lattice_at(0.0).map(|at| (at + 0.5) / 128.0);
                let apart = rays::distance(uv, channel.uv.map(f64::from));
                // At an edge between two faces either may be meant.
                if apart > 1e-5 {
                    missed += 1;
                }
                picked += 1;
            }
            (None, false) => {}
            _ => missed += 1,
        }
    }
    assert!(picked > 500 && missed <= picked / 200, "{missed} of {picked}");
}
