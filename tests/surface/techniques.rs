//! What all techniques, or all that search, have in common.

use rilievo::reference::{Addressing, HeightField, Ray};
use rilievo::surface::probe::Hit;
use rilievo::surface::{Technique, View};

use crate::support::fields::{ADDRESSINGS, Kind};
use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::techniques::{flat, mean_error, pieces, truth, view_rays};
use crate::support::tolerances;

#[test]
fn the_reference_surface_is_hit_at_once_to_the_bit_by_every_technique() {
    let Some(gpu) = gpu() else { return };
    for addressing in ADDRESSINGS {
        let field = HeightField::from_fn([33, 70], addressing, |_, _| 1.0);
        let rays = view_rays(43, 5_000, field.size);
        for technique in Technique::ALL {
            let hits = rays::trace(gpu, *technique, &rays::upload(gpu, &field), &rays::view(&field), &rays);
            for (ray, hit) in rays.iter().zip(hits) {
                assert_eq!((hit.lattice, hit.t, hit.height, hit.status), (ray.lattice, 0.0, 1.0, Hit::HIT), "{technique:?}");
            }
        }
    }
}

/// How far beyond a flat surface each technique may stop, as a share of the way to the floor. Those that interpolate, and those
/// that ask once, are right on a flat surface; the others stop at a sample.
fn beyond(technique: Technique, view: &View) -> Option<f32> {
    match technique {
        Technique::Normal | Technique::ParallaxLimited => None,
        Technique::Steep => Some(1.0 / view.steep_layers),
        Technique::Relief => Some(0.5_f32.powi(view.relief_binary_steps as i32) / view.relief_linear_steps),
        Technique::PomLinear => Some(1.0 / view.pom_samples_min),
        Technique::Parallax | Technique::Pom | Technique::Pyramid | Technique::Mesh | Technique::Exact => Some(0.0),
    }
}

#[test]
fn a_flat_field_is_hit_where_it_is() {
    let Some(gpu) = gpu() else { return };
    for height in [0.0, 0.37, 0.5, 0.99] {
        let field = flat(height);
        let view = rays::view(&field);
        let rays = view_rays(44, 2_000, field.size);
        for &technique in Technique::ALL {
            let Some(beyond) = beyond(technique, &view) else { continue };
            for (ray, hit) in rays.iter().zip(rays::trace(gpu, technique, &rays::upload(gpu, &field), &view, &rays)) {
                let bound = tolerances::lattice_bound(rays::reach(&[ray.lattice_at(0.0), ray.lattice_at(1.0)]));
                let length = rays::distance(ray.lattice_at(0.0), ray.lattice_at(1.0));
                let apart = (f64::from(hit.t) - f64::from(1.0 - height)) * length;
                assert!(
                    (-bound..=f64::from(beyond) * length + bound).contains(&apart),
                    "{technique:?}: {apart} cells beyond {height}: {ray:?}"
                );
            }
        }
    }
}

/// Printed by sample count; each doubling must be no worse than 1.05 times the error before it.
#[test]
fn more_samples_come_nearer_to_the_surface() {
    let Some(gpu) = gpu() else { return };
    for technique in [Technique::Steep, Technique::Relief, Technique::PomLinear, Technique::Pom] {
        for kind in [Kind::Elevation, Kind::Waves, Kind::Steps, Kind::Noise] {
            let field = kind.field([256, 256], Addressing::Wrap);
            let rays = view_rays(45, 10_000, field.size);
            let truth: Vec<_> = rays.iter().map(|ray| truth(&field, ray)).collect();
            let mut before = f64::INFINITY;
            for doubling in 2..=12 {
                let count = 2_u32.pow(doubling) as f32;
                let view = View {
                    steep_layers: count,
                    relief_linear_steps: count,
                    pom_samples_min: count,
                    pom_samples_max: count,
                    ..rays::view(&field)
                };
                let mean = mean_error(gpu, technique, &field, &view, &rays, &truth);
                println!("{technique:?}, {kind:?}, {count} samples: {mean:.5} cells off");
                assert!(mean <= 1.05 * before, "{technique:?}, {kind:?}: {mean} after {before}");
                before = mean;
            }
        }
    }
}

/// A piece of a shell over everything is left without a hit; one that begins under everything is hit where it begins.
#[test]
fn pieces_above_the_surface_are_missed_and_below_it_hit_at_once() {
    let Some(gpu) = gpu() else { return };
    let list = pieces(53, 2_000, [64, 64]);
    for &technique in Technique::ALL.iter().filter(|technique| **technique != Technique::Normal) {
        let (below, above) = (flat(0.0), flat(1.0));
        let high: Vec<_> = list.iter().map(|ray| Ray { height: 0.5 * ray.height + 0.5, rise: 0.4 * ray.rise, ..*ray }).collect();
        for (ray, hit) in high.iter().zip(rays::trace(gpu, technique, &rays::upload(gpu, &below), &rays::view(&below), &high)) {
            assert_eq!((hit.status, hit.t), (Hit::MISS, ray.t_end), "{technique:?}: {ray:?}");
        }
        for (ray, hit) in list.iter().zip(rays::trace(gpu, technique, &rays::upload(gpu, &above), &rays::view(&above), &list)) {
            assert_eq!((hit.status, hit.t), (Hit::HIT, 0.0), "{technique:?}: {ray:?}");
        }
    }
}
