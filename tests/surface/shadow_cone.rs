//! Cone shadows against their reference, against the area light that they stand for, and against hard ones.

use rilievo::reference::shadow_cone::shadow_above;
use rilievo::reference::{Addressing, HeightField};
use rilievo::surface::Shadow;

use crate::support::fields::{ADDRESSINGS, Kind};
use crate::support::gpu::gpu;
use crate::support::lights::{self, Light, Scenery};
use crate::support::rays;
use crate::support::tolerances;

/// By how much the shader lifts its rays off the surface: `TRAVERSAL_LIFT`.
const LIFT: f64 = 9.6e-7;

/// Held to the reference that lifts its rays as the shader does: that lift is all that takes more than a few receivers away from the
/// reference on the surface, whose share is printed.
#[test]
fn every_visibility_is_the_references() {
    let Some(gpu) = gpu() else { return };
    let mut worst = 0.0_f64;
    for (kind, addressing) in Kind::ALL.into_iter().flat_map(|kind| ADDRESSINGS.map(|addressing| (kind, addressing))) {
        let field = kind.field([200, 150], addressing);
        for light in
            [(40.0, 215.0, 3.0), (40.0, 46.0, 1.0), (15.0, 100.0, 5.0), (6.0, 10.0, 5.0), (60.0, 180.0, 4.0), (88.0, 300.0, 3.0)]
                .map(|(elevation, azimuth, half_angle)| Light { elevation, azimuth, half_angle })
        {
            let list = light.receivers(&field, 2_000);
            let seen = lights::seen(gpu, Shadow::Cone, &field, light.radius(), 1, &list);
            let above = |lift| rays::each(list.len(), |i| shadow_above(&field, &list[i], &light.disc(&list[i]), lift));
            let off_share = |truth: &[f64]| {
                let off = seen.iter().zip(truth).filter(|(seen, truth)| (*seen - *truth).abs() > tolerances::CONE_VISIBILITY);
                off.count() as f64 / list.len() as f64
            };
            let (truth, on_surface) = (above(LIFT), above(0.0));
            let share = off_share(&truth);
            println!(
                "{kind:?} {addressing:?} {light:?}: {share:.4} off, rms {:.5}; from the surface itself {:.4} off",
                lights::rms(&seen, &truth),
                off_share(&on_surface)
            );
            worst = worst.max(share);
        }
    }
    assert!(worst <= tolerances::CONE_OFF_SHARE, "{worst}");
}

#[test]
fn a_flat_field_is_lit_at_any_height() {
    let Some(gpu) = gpu() else { return };
    for height in [0.0, 1e-30, 0.1, 0.5, 0.999_999_94, 1.0] {
        let field = HeightField::from_fn([37, 53], Addressing::Wrap, |_, _| height);
        for (elevation, half_angle) in [(40.0, 3.0), (5.01, 5.0), (90.0, 15.0), (30.0, 0.01)] {
            let light = Light { elevation, azimuth: 33.0, half_angle };
            let rays = light.receivers(&field, 500);
            let seen = lights::seen(gpu, Shadow::Cone, &field, light.radius(), 1, &rays);
            assert!(seen.iter().all(|seen| *seen == 1.0), "at {height}: {light:?}");
        }
    }
}

#[test]
fn a_higher_blocker_never_lets_more_light_through() {
    let Some(gpu) = gpu() else { return };
    let (hills, rays) = lights::growing_hills();
    let mut before = vec![1.0; rays.len()];
    for field in &hills {
        let seen = lights::seen(gpu, Shadow::Cone, field, 0.06, 1, &rays);
        for ((seen, before), ray) in seen.iter().zip(&before).zip(&rays) {
            assert!(*seen <= before + tolerances::CONE_ROUNDING, "{before} then {seen}: {ray:?}");
        }
        before = seen;
    }
    assert!(before.contains(&0.0) && before.contains(&1.0));
}

#[test]
fn the_penumbra_of_a_step_is_the_discs_ramp() {
    let Some(gpu) = gpu() else { return };
    for light in
        [(35.0, 1.0), (35.0, 5.0), (60.0, 3.0)].map(|(elevation, half_angle)| Light { elevation, azimuth: 0.0, half_angle })
    {
        let (field, rays, ramp) = lights::behind_a_step(light);
        let seen = lights::seen(gpu, Shadow::Cone, &field, light.radius(), 1, &rays);
        let worst = seen.iter().zip(&ramp).map(|(seen, ramp)| (seen - ramp).abs()).fold(0.0, f64::max);
        let within = ramp.iter().filter(|ramp| **ramp > 0.0 && **ramp < 1.0).count();
        println!("{light:?}: {worst:.4} off at most, {within} in the penumbra");
        assert!(within > 50 && worst <= tolerances::CONE_RAMP, "{worst}, {within} in the penumbra");
    }
}

/// The project's bar: near the truth where the disc sees whole edges, nowhere worse than a hard shadow.
#[test]
fn it_is_near_the_truth_and_nearer_than_a_hard_shadow() {
    let Some(gpu) = gpu() else { return };
    println!("rms of visibility against 256 points of the disc: cone (hard)");
    for scenery in Scenery::ALL {
        let field = scenery.field();
        let mut line = format!("{scenery:?}");
        for half_angle in [1.0, 2.0, 3.0, 4.0, 5.0] {
            let (mut cone, mut hard) = (0.0_f64, 0.0_f64);
            for (elevation, azimuth) in [(40.0, 215.0), (25.0, 190.0), (55.0, 300.0)] {
                let light = Light { elevation, azimuth, half_angle };
                let rays = light.receivers(&field, 1_500);
                let by = |shadow| lights::seen(gpu, shadow, &field, light.radius(), 256, &rays);
                let truth = by(Shadow::Area);
                // The worst of the lights, not their mean.
                cone = cone.max(lights::rms(&by(Shadow::Cone), &truth));
                hard = hard.max(lights::rms(&by(Shadow::Hard), &truth));
            }
            line += &format!("  {half_angle}° {cone:.4} ({hard:.3})");
            assert!(cone <= hard, "{scenery:?} at {half_angle}°: {cone}, hard {hard}");
            assert!(!scenery.is_plain() || cone <= tolerances::CONE_RMS, "{scenery:?} at {half_angle}°: {cone}");
        }
        println!("{line}");
    }
}

/// A light of a milliradian is a point but for its penumbra's own width.
#[test]
fn a_small_light_casts_hard_shadows() {
    let Some(gpu) = gpu() else { return };
    for scenery in Scenery::ALL {
        let field = scenery.field();
        for (elevation, azimuth) in [(40.0, 215.0), (25.0, 190.0), (55.0, 300.0)] {
            let light = Light { elevation, azimuth, half_angle: 1e-3_f32.to_degrees() };
            let rays = light.receivers(&field, 20_000);
            let by = |shadow| lights::seen(gpu, shadow, &field, light.radius(), 1, &rays);
            let (cone, hard) = (by(Shadow::Cone), by(Shadow::Hard));
            let equal = cone.iter().zip(&hard).filter(|(cone, hard)| cone.round() == **hard).count() as f64 / rays.len() as f64;
            let within =
                cone.iter().zip(&hard).filter(|(cone, hard)| (*cone - *hard).abs() > 0.01).count() as f64 / rays.len() as f64;
            println!("{scenery:?} {light:?}: {equal:.5} equal, {within:.5} in the penumbra");
            assert!(equal >= tolerances::CONE_POINT_SHARE, "{scenery:?} {light:?}: {equal}");
        }
    }
}
