//! The micropolygon mesh's walk against its reference, and the mesh's convergence to the exact surface.

use rilievo::reference::traversal::Line;
use rilievo::reference::{Ray, trace_mesh};
use rilievo::surface::probe::Hit;
use rilievo::surface::{Technique, View};

use crate::support::fields::{ADDRESSINGS, Kind, Random};
use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::tolerances;

fn random_rays(seed: u64, count: usize, size: [u32; 2]) -> Vec<Ray> {
    let mut random = Random::new(seed);
    let ray = |random: &mut Random| {
        let (lattice, travel) = rays::random_ray(random, size);
        Ray::view(lattice, travel)
    };
    (0..count).map(|_| ray(&mut random)).collect()
}

#[test]
fn rays_end_where_the_references_do() {
    let Some(gpu) = gpu() else { return };
    for (size, quads) in [([200, 150], 64), ([33, 70], 256), ([128, 128], 128), ([1, 61], 5)] {
        for (kind, addressing) in [Kind::Noise, Kind::Steps, Kind::Elevation, Kind::Waves]
            .into_iter()
            .flat_map(|kind| ADDRESSINGS.map(|addressing| (kind, addressing)))
        {
            let field = kind.field(size, addressing);
            let rays = random_rays(71, 4_000, size);
            let view = View { mesh_quads: quads, ..rays::view(&field) };
            let hits = rays::trace(gpu, Technique::Mesh, &rays::upload(gpu, &field), &view, &rays);
            let off = rays.iter().zip(&hits).filter(|(ray, hit)| {
                let t = trace_mesh::meets(&field, quads, &Line::from(*ray), 1.0).unwrap_or(1.0);
                assert_eq!(hit.status, Hit::HIT);
                let (found, expected) = (hit.lattice.map(f64::from), ray.lattice_at(t));
                let bound = tolerances::lattice_bound(rays::reach(&[ray.lattice_at(0.0), ray.lattice_at(1.0)]));
                rays::distance(found, expected) > bound && (f64::from(hit.t) - t).abs() > tolerances::MESH_PARAMETER
            });
            let share = off.count() as f64 / rays.len() as f64;
            assert!(share <= tolerances::MESH_OFF_SHARE, "{kind:?} {addressing:?} {size:?} {quads}: {share}");
        }
    }
}

/// At the vertices the triangulated surface is the surface, and with four times the triangles it is about four times as near on the
/// average where the field is smooth.
#[test]
fn more_triangles_come_nearer_to_the_surface() {
    for addressing in ADDRESSINGS {
        let field = Kind::Waves.field([128, 96], addressing);
        let mut random = Random::new(72);
        let places: Vec<_> = (0..20_000).map(|_| rays::random_position(&mut random, field.size).map(f64::from)).collect();
        let mut last = f64::INFINITY;
        for quads in [16, 32, 64, 128, 256, 512] {
            let apart = |place: &[f64; 2]| (trace_mesh::surface(&field, quads, *place) - field.bilinear(*place)).abs();
            let mean = places.iter().map(apart).sum::<f64>() / places.len() as f64;
            println!("{addressing:?}, {quads}² quads: {mean:.2e} heights off on the average");
            assert!(mean <= 0.5 * last, "{addressing:?}, {quads}² quads: {mean:e} after {last:e}");
            last = mean;
            for (i, j) in [(0, 0), (3, quads), (quads / 2, 5)] {
                let lattice =
                    [(i, 0), (j, 1)].map(|(place, axis)| f64::from(place) * f64::from(field.size[axis]) / f64::from(quads) - 0.5);
                assert!((trace_mesh::surface(&field, quads, lattice) - field.bilinear(lattice)).abs() < 1e-9);
            }
        }
    }
}
