//! The steep march toward the light against its reference, and the properties that make it a shadow.

use rilievo::gpu::Gpu;
use rilievo::reference::shadow_steep::shadow;
use rilievo::reference::{Addressing, HeightField, Ray, shadow_hard};
use rilievo::surface::{Shadow, View};

use crate::support::fields::{Kind, Random};
use crate::support::gpu::gpu;
use crate::support::lights::growing_hills;
use crate::support::rays;
use crate::support::tolerances;

fn random_rays(seed: u64, count: usize, field: &HeightField) -> Vec<Ray> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| {
            let (lattice, travel) = rays::random_ray(&mut random, field.size);
            Ray::shadow(lattice, travel, field.bilinear(lattice.map(f64::from)) as f32)
        })
        .collect()
}

fn seen(gpu: &Gpu, field: &HeightField, layers: u32, rays: &[Ray]) -> Vec<f64> {
    let view = View { shadow_samples: layers as f32, ..rays::view(field) };
    rays::shadow(gpu, Shadow::Steep, &rays::upload(gpu, field), &view, rays).into_iter().map(f64::from).collect()
}

#[test]
fn every_visibility_is_the_references() {
    let Some(gpu) = gpu() else { return };
    for kind in [Kind::Elevation, Kind::Waves, Kind::Steps] {
        let field = kind.field([200, 150], Addressing::Wrap);
        for layers in [1, 7, 16, 128] {
            let rays = random_rays(71, 10_000, &field);
            let seen = seen(gpu, &field, layers, &rays);
            let off = rays.iter().zip(&seen).filter(|(ray, seen)| **seen != shadow(&field, ray, f64::from(layers))).count();
            assert!(off as f64 <= tolerances::STEEP_OFF_SHARE * rays.len() as f64, "{off} off: {kind:?}, {layers} layers");
        }
    }
}

#[test]
fn a_flat_field_is_lit_at_any_height() {
    let Some(gpu) = gpu() else { return };
    for height in [0.0, 1e-30, 0.1, 0.3, 0.5, 0.7, 0.999_999_94, 1.0] {
        let field = HeightField::from_fn([37, 53], Addressing::Wrap, |_, _| height);
        let rays = random_rays(72, 2_000, &field);
        for layers in [1, 16, 200] {
            assert!(seen(gpu, &field, layers, &rays).iter().all(|seen| *seen == 1.0), "{layers} layers at {height}");
        }
    }
}

#[test]
fn a_higher_blocker_never_lets_more_light_through() {
    let Some(gpu) = gpu() else { return };
    let (hills, rays) = growing_hills();
    let mut before = vec![1.0; rays.len()];
    for field in &hills {
        let seen = seen(gpu, field, 64, &rays);
        assert!(seen.iter().zip(&before).all(|(seen, before)| seen <= before));
        before = seen;
    }
    assert!(before.contains(&0.0) && before.contains(&1.0));
}

/// It marches toward the light, not away from it as the poster prints it: with enough layers it is the hard shadow.
#[test]
fn many_layers_are_the_hard_shadow() {
    let field = Kind::Waves.field([200, 150], Addressing::Wrap);
    let rays = random_rays(73, 4_000, &field);
    let off = rays.iter().filter(|ray| shadow(&field, ray, 4096.0) != shadow_hard::shadow(&field, ray)).count();
    println!("{off} of {} differ", rays.len());
    assert!(off as f64 <= tolerances::STEEP_HARD_SHARE * rays.len() as f64, "{off} differ");
}
