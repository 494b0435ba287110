//! Soft shadows against their reference, and the properties that make them shadows.

use rilievo::gpu::Gpu;
use rilievo::reference::shadow_pom_soft::{Sampling, shadow};
use rilievo::reference::{Addressing, HeightField, Ray};
use rilievo::surface::{Shadow, View};

use crate::support::fields::{ADDRESSINGS, Kind, Random};
use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::tolerances;

/// Shadow rays from the surface toward lights of every elevation.
fn random_rays(seed: u64, count: usize, field: &HeightField) -> Vec<Ray> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| {
            let (lattice, travel) = rays::random_ray(&mut random, field.size);
            Ray::shadow(lattice, travel, field.bilinear(lattice.map(f64::from)) as f32)
        })
        .collect()
}

fn seen(gpu: &Gpu, field: &HeightField, sampling: Sampling, rays: &[Ray]) -> Vec<f64> {
    let view = View { shadow_samples: sampling.count as f32, shadow_strength: sampling.strength as f32, ..rays::view(field) };
    rays::shadow(gpu, Shadow::PomSoft, &rays::upload(gpu, field), &view, rays).into_iter().map(f64::from).collect()
}

const DEFAULT: Sampling = Sampling { count: 16, strength: 4.0 };

#[test]
fn every_visibility_is_the_references() {
    let Some(gpu) = gpu() else { return };
    for (kind, addressing) in
        [Kind::Elevation, Kind::Waves].into_iter().flat_map(|kind| ADDRESSINGS.map(|addressing| (kind, addressing)))
    {
        let field = kind.field([200, 150], addressing);
        for sampling in [Sampling { count: 1, strength: 1.0 }, DEFAULT, Sampling { count: 64, strength: 2.0 }] {
            let rays = random_rays(51, 10_000, &field);
            let off = rays
                .iter()
                .zip(seen(gpu, &field, sampling, &rays))
                .filter(|(ray, seen)| (seen - shadow(&field, ray, sampling)).abs() > tolerances::SOFT_VISIBILITY)
                .count();
            assert!(
                off as f64 <= tolerances::SOFT_OFF_SHARE * rays.len() as f64,
                "{off} off: {kind:?} {addressing:?} {sampling:?}"
            );
        }
    }
}

#[test]
fn a_flat_field_is_lit_at_any_height() {
    let Some(gpu) = gpu() else { return };
    for height in [0.0, 1e-30, 0.1, 0.3, 0.5, 0.7, 0.999_999_94, 1.0] {
        let field = HeightField::from_fn([37, 53], Addressing::Wrap, |_, _| height);
        let rays = random_rays(52, 2_000, &field);
        for count in [1, 7, 16, 200] {
            let seen = seen(gpu, &field, Sampling { count, strength: 100.0 }, &rays);
            assert!(seen.iter().all(|seen| *seen == 1.0), "{count} samples at {height}");
        }
    }
}

#[test]
fn a_higher_blocker_never_lets_more_light_through() {
    let Some(gpu) = gpu() else { return };
    let blocker = |top: f32| {
        HeightField::from_fn([64, 64], Addressing::Clamp, move |x, y| {
            let bump = (1.0 - ((x as f32 - 32.0).hypot(y as f32 - 32.0) / 9.0).powi(2)).max(0.0);
            0.2 + top * bump
        })
    };
    let mut random = Random::new(53);
    // Receivers on the floor around it, lights from every side and height.
    let rays: Vec<_> = (0..4_000)
        .map(|_| {
            let [x, y] = random.direction().map(|part| 32.0 + 14.0 * part);
            let length = random.logarithmic(5.0, 80.0);
            Ray::shadow([x, y], random.direction().map(|part| part * length), 0.2)
        })
        .collect();
    let mut before = vec![1.0; rays.len()];
    let mut darkest: f64 = 1.0;
    for step in 0..=20 {
        let seen = seen(gpu, &blocker(0.04 * step as f32), DEFAULT, &rays);
        for ((seen, before), ray) in seen.iter().zip(&before).zip(&rays) {
            assert!(*seen <= before + tolerances::SOFT_VISIBILITY, "{before} then {seen}: {ray:?}");
        }
        darkest = seen.iter().copied().fold(darkest, f64::min);
        before = seen;
    }
    assert_eq!(darkest, 0.0);
}

/// The stated count is 64: from there on more samples change what one sees by less than one can.
#[test]
fn more_than_64_samples_change_nothing() {
    for kind in [Kind::Elevation, Kind::Waves] {
        let field = kind.field([256, 256], Addressing::Wrap);
        let rays = random_rays(54, 10_000, &field);
        let by_count = |count| rays::each(rays.len(), |i| shadow(&field, &rays[i], Sampling { count, ..DEFAULT }));
        let truth = by_count(4096);
        let mean = |seen: &[f64]| seen.iter().sum::<f64>() / seen.len() as f64;
        for count in [8, 16, 32, 64, 128, 256] {
            let seen = by_count(count);
            let off = seen.iter().zip(&truth).map(|(seen, truth)| (seen - truth).abs()).sum::<f64>() / truth.len() as f64;
            println!("{kind:?}, {count} samples: {off:.5} off, mean {:.4} of {:.4}", mean(&seen), mean(&truth));
            if count >= 64 {
                assert!(off <= tolerances::SOFT_CONVERGED, "{off} with {count} samples");
            }
        }
    }
}

/// Across the penumbra of a wall, straight or askew, visibility falls from 1 to 0 and never rises: bands would.
#[test]
fn a_penumbra_has_no_bands() {
    for (skew, travel) in [(0.0, [60.0, 0.0]), (0.0, [120.0, 30.0]), (0.45, [120.0, 0.0]), (0.45, [96.0, 72.0])] {
        let wall = |x: u32, y: u32| if x as f32 + skew * y as f32 > 128.0 { 0.9 } else { 0.1 };
        let field = HeightField::from_fn([256, 16], Addressing::Clamp, wall);
        let at = |x: f32| shadow(&field, &Ray::shadow([x, 8.0], travel, 0.1), DEFAULT);
        let line: Vec<_> = (0..=2_300).map(|i| at(5.0 + 0.05 * i as f32)).collect();
        assert_eq!((line[0], line[line.len() - 1]), (1.0, 0.0));
        let changes = || line.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        println!("{travel:?}: steps of {:.4} at most, {:.3} in all", changes().fold(0.0, f64::max), changes().sum::<f64>());
        assert!(changes().fold(0.0, f64::max) <= tolerances::SOFT_STEP);
        assert!(changes().sum::<f64>() <= tolerances::SOFT_VARIATION);
    }
}
