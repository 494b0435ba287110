//! Pyramidal displacement mapping against its reference, and how near its two leaves come to the exact surface.

use rilievo::reference::traversal::Line;
use rilievo::reference::{Addressing, HeightField, Ray, trace_pyramid};
use rilievo::scene::PyramidLeaf;
use rilievo::surface::probe::Hit;
use rilievo::surface::{Technique, View};

use crate::support::fields::{ADDRESSINGS, Kind, Random};
use crate::support::gpu::gpu;
use crate::support::rays::{self, Adversary};
use crate::support::techniques::{compare, gpu_that_loads, hold, mean_error, truth, view_rays};
use crate::support::tolerances;

#[test]
fn rays_end_where_the_reference_does() {
    hold(Technique::Pyramid, |view| view.pyramid_leaf = PyramidLeaf::Nearest as u32);
    hold(Technique::Pyramid, |view| view.pyramid_leaf = PyramidLeaf::Refined as u32);
}

/// The traversal itself, where node ids go wrong if they can: odd sizes, borders, corners, hundreds of wraps.
#[test]
fn adversarial_rays_meet_the_same_column_as_without_a_pyramid() {
    let Some(gpu) = gpu_that_loads() else { return };
    let mut total = crate::support::techniques::Tally::default();
    for (size, addressing) in [[1, 1], [1, 61], [64, 1], [255, 257]].into_iter().flat_map(|size| ADDRESSINGS.map(|a| (size, a))) {
        let field = Kind::Noise.field(size, addressing);
        let view = View { pyramid_leaf: PyramidLeaf::Nearest as u32, ..rays::view(&field) };
        let mut random = Random::new(51);
        for adversary in Adversary::ALL.into_iter().filter(|adversary| *adversary != Adversary::Long) {
            let rays: Vec<_> = (0..500)
                .map(|_| {
                    let (lattice, travel) = adversary.ray(&mut random, size);
                    Ray::view(lattice, travel)
                })
                .collect();
            let tally = compare(gpu, Technique::Pyramid, &field, &view, &rays);
            for wrong in tally.wrong.iter().take(2) {
                eprintln!("{adversary:?}, {size:?} {addressing:?}: {wrong}");
            }
            total.add(tally);
        }
    }
    println!("of {} rays {} at a sample's border, {} tangent", total.rays, total.at_border, total.tangent);
    assert_eq!(total.wrong.len(), 0);
}

#[test]
fn a_column_has_a_flat_top_and_steep_sides() {
    let field = HeightField::from_fn([8, 8], Addressing::Clamp, |x, _| if x == 4 { 0.5 } else { 0.0 });
    // Through the top: at half the height.
    let top = trace_pyramid::trace_nearest(&field, &Ray::view([4.4, 3.0], [-0.6, 0.0]));
    assert_eq!(top.height, 0.5);
    // Into the side: at its border, 3.5.
    let side = trace_pyramid::trace_nearest(&field, &Ray::view([0.0, 3.0], [4.5, 0.0]));
    assert!((side.lattice[0] - 3.5).abs() < 1e-6 && side.height < 0.5, "{side:?}");
}

/// [PDM] fig. 14: blocks at the top, smooth below, and neither exact.
#[test]
fn refinement_comes_nearer_to_the_surface_than_columns() {
    let Some(gpu) = gpu() else { return };
    for (kind, bars) in [(Kind::Waves, tolerances::PYRAMID_WAVES), (Kind::Elevation, tolerances::PYRAMID_ELEVATION)] {
        let field = kind.field([256, 256], Addressing::Wrap);
        let rays = view_rays(52, 20_000, field.size);
        let truth: Vec<_> = rays.iter().map(|ray| truth(&field, ray)).collect();
        let error = |leaf: PyramidLeaf| {
            let view = View { pyramid_leaf: leaf as u32, ..rays::view(&field) };
            mean_error(gpu, Technique::Pyramid, &field, &view, &rays, &truth)
        };
        let (nearest, refined) = (error(PyramidLeaf::Nearest), error(PyramidLeaf::Refined));
        println!("{kind:?}: {nearest:.4} cells off with columns, {refined:.4} refined");
        assert!(nearest <= bars[0] && refined <= bars[1], "{kind:?}: {nearest}, {refined}");
    }
}

/// Between columns the surface is missed, as [PDM] §3.3 allows: a leaf that did not would be another technique.
#[test]
fn a_ridge_between_columns_is_stepped_over() {
    // A diagonal ridge: the ray across it passes between two high texels, at half their height, over low columns alone.
    let field = HeightField::from_fn([32, 32], Addressing::Clamp, |x, y| if x + y == 31 { 1.0 } else { 0.0 });
    let ray = Ray { height: 0.45, rise: -0.01, t_end: 1.0, ends: Hit::MISS, ..Ray::view([14.95, 15.05], [1.0, 1.0]) };
    let line = Line::from(&ray);
    assert!(line.meets(&field, 0.0, 1.0).is_some());
    let Some(gpu) = gpu_that_loads() else { return };
    let hits = rays::trace(gpu, Technique::Pyramid, &rays::upload(gpu, &field), &rays::view(&field), &[ray]);
    assert_eq!(hits[0].status, trace_pyramid::trace_refined(&field, &ray).status);
}
