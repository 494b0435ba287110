//! Parallax occlusion mapping against its reference, and its convergence to the exact trace.

use rilievo::gpu::{Gpu, Preference};
use rilievo::reference::traversal::Line;
use rilievo::reference::{Addressing, HeightField, Ray, trace_pom};
use rilievo::surface::probe::Hit;
use rilievo::surface::{Technique, View};

use crate::support::fields::{ADDRESSINGS, Kind, Random};
use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::tolerances;

fn random_rays(seed: u64, count: usize, size: [u32; 2]) -> Vec<Ray> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| {
            let (lattice, travel) = rays::random_ray(&mut random, size);
            Ray::view(lattice, travel)
        })
        .collect()
}

fn traced(gpu: &Gpu, technique: Technique, field: &HeightField, view: &View, rays: &[Ray]) -> Vec<Hit> {
    rays::trace(gpu, technique, &rays::upload(gpu, field), view, rays)
}

/// A view with so many samples whatever the angle.
fn sampled(field: &HeightField, samples: f32) -> View {
    View { pom_samples_min: samples, pom_samples_max: samples, ..rays::view(field) }
}

/// How many samples the reference says that a ray takes, by the view.
fn samples(view: &View, ray: &Ray) -> f64 {
    let travel_metres = [0, 1]
        .map(|axis| f64::from(ray.travel[axis]) * f64::from(view.plane_size_metres[axis]) / f64::from(view.field_size[axis]));
    let range = [f64::from(view.pom_samples_min), f64::from(view.pom_samples_max)];
    trace_pom::samples(travel_metres, f64::from(view.depth_metres), range)
}

/// The share of rays that do not end where the reference has them.
fn off(gpu: &Gpu, field: &HeightField, rays: &[Ray]) -> f64 {
    let view = rays::view(field);
    let hits = traced(gpu, Technique::Pom, field, &view, rays);
    let off = rays.iter().zip(&hits).filter(|(ray, hit)| {
        let expected = trace_pom::trace(field, ray, samples(&view, ray));
        (f64::from(hit.t) - expected.t).abs() > tolerances::POM_PARAMETER
    });
    off.count() as f64 / rays.len() as f64
}

#[test]
fn rays_end_where_the_references_do() {
    let Some(gpu) = gpu() else { return };
    for (kind, addressing) in [Kind::Elevation, Kind::Waves, Kind::Constant]
        .into_iter()
        .flat_map(|kind| ADDRESSINGS.map(|addressing| (kind, addressing)))
    {
        let field = kind.field([200, 150], addressing);
        let off = off(gpu, &field, &random_rays(41, 20_000, field.size));
        assert!(off <= tolerances::POM_OFF_SHARE, "{kind:?} {addressing:?}: {off}");
    }
}

#[test]
fn an_adapter_that_filters_no_floats_sees_the_same() {
    if gpu().is_none() {
        return;
    }
    let preference =
        Preference { software_first: true, masked_features: wgpu::Features::FLOAT32_FILTERABLE, ..Preference::default() };
    let gpu = pollster::block_on(Gpu::new(&preference.with_environment())).expect("there is an adapter, as gpu() found");
    assert!(!gpu.filters_r32float());
    let field = Kind::Elevation.field([200, 150], Addressing::Wrap);
    let off = off(&gpu, &field, &random_rays(42, 20_000, field.size));
    assert!(off <= tolerances::POM_OFF_SHARE, "{off}");
}

#[test]
fn the_reference_surface_is_hit_at_once_to_the_bit_by_every_technique() {
    let Some(gpu) = gpu() else { return };
    for addressing in ADDRESSINGS {
        let field = HeightField::from_fn([33, 70], addressing, |_, _| 1.0);
        let rays = random_rays(43, 5_000, field.size);
        for technique in Technique::ALL {
            for (ray, hit) in rays.iter().zip(traced(gpu, *technique, &field, &rays::view(&field), &rays)) {
                assert_eq!((hit.lattice, hit.t, hit.height, hit.steps), (ray.lattice, 0.0, 1.0, hit.steps), "{technique:?}");
            }
        }
    }
}

#[test]
fn a_flat_field_is_hit_where_the_exact_trace_hits_it() {
    let Some(gpu) = gpu() else { return };
    let field = HeightField::from_fn([64, 64], Addressing::Wrap, |_, _| 0.5);
    let rays = random_rays(44, 5_000, field.size);
    let pom = traced(gpu, Technique::Pom, &field, &rays::view(&field), &rays);
    let exact = traced(gpu, Technique::Exact, &field, &rays::view(&field), &rays);
    for ((pom, exact), ray) in pom.iter().zip(&exact).zip(&rays) {
        let apart = rays::distance(pom.lattice.map(f64::from), exact.lattice.map(f64::from));
        let ends = [ray.lattice.map(f64::from), exact.lattice.map(f64::from)];
        assert!(apart <= tolerances::lattice_bound(rays::reach(&ends)), "{apart} cells apart: {ray:?}");
    }
}

/// Printed by sample count; each doubling must be no worse than 1.05 times the error before it.
#[test]
fn more_samples_come_nearer_to_the_exact_trace() {
    let Some(gpu) = gpu() else { return };
    for kind in [Kind::Elevation, Kind::Waves, Kind::Steps, Kind::Noise] {
        let field = kind.field([256, 256], Addressing::Wrap);
        let rays = random_rays(45, 20_000, field.size);
        let truth: Vec<_> = rays
            .iter()
            .map(|ray| {
                let line = Line::from(ray);
                line.lattice_at(line.meets(&field, 0.0, 1.0).expect("a view ray always ends"))
            })
            .collect();
        let mut before = f64::INFINITY;
        for doubling in 2..=12 {
            let count = 2_u32.pow(doubling);
            let hits = traced(gpu, Technique::Pom, &field, &sampled(&field, count as f32), &rays);
            let errors = hits.iter().zip(&truth).map(|(hit, truth)| rays::distance(hit.lattice.map(f64::from), *truth));
            let mean = errors.sum::<f64>() / rays.len() as f64;
            println!("{kind:?}, {count} samples: {mean:.5} cells off");
            assert!(mean <= 1.05 * before, "{mean} after {before}");
            before = mean;
        }
    }
}

#[test]
fn samples_grow_from_head_on_to_edge_on_and_need_not_be_whole() {
    let range = [8.0, 50.0];
    assert_eq!(trace_pom::samples([0.0, 0.0], 0.1, range), 8.0);
    assert!((trace_pom::samples([1e6, 0.0], 0.1, range) - 50.0).abs() < 1e-4);
    let counts: Vec<_> = (0..100).map(|i| trace_pom::samples([0.0, 0.01 * f64::from(i)], 0.1, range)).collect();
    assert!(counts.windows(2).all(|pair| pair[0] < pair[1]));
}

/// Rounded counts show as bands: the hit on a smooth field has to move smoothly with the count, through whole numbers too.
#[test]
fn a_fraction_of_a_sample_moves_the_hit_by_little() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Waves.field([1024, 1024], Addressing::Wrap);
    // Steep enough that no ray grazes.
    let rays: Vec<_> = random_rays(46, 500, field.size)
        .into_iter()
        .map(|ray| {
            let length = rays::distance(ray.travel.map(f64::from), [0.0, 0.0]) as f32;
            Ray { travel: ray.travel.map(|travel| travel / length * 60.0), ..ray }
        })
        .collect();
    let mut before: Option<Vec<Hit>> = None;
    for hundredth in 780..=1_220 {
        let hits = traced(gpu, Technique::Pom, &field, &sampled(&field, hundredth as f32 * 0.01), &rays);
        if let Some(before) = before {
            let jumps = hits.iter().zip(&before).map(|(a, b)| (a.t - b.t).abs());
            let largest = jumps.fold(0.0, f32::max);
            assert!(f64::from(largest) <= tolerances::POM_JUMP, "{largest} at {}", hundredth as f32 * 0.01);
        }
        before = Some(hits);
    }
}
