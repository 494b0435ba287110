//! The area light's shadow against its reference, and the properties that make it the truth.

use rilievo::reference::shadow_area::shadow;
use rilievo::reference::{Addressing, HeightField};
use rilievo::surface::Shadow;

use crate::support::fields::ADDRESSINGS;
use crate::support::fields::Kind;
use crate::support::gpu::gpu;
use crate::support::lights::{self, Light, Scenery};
use crate::support::rays;
use crate::support::tolerances;

#[test]
fn every_visibility_is_the_references() {
    let Some(gpu) = gpu() else { return };
    for (kind, addressing) in Kind::ALL.into_iter().flat_map(|kind| ADDRESSINGS.map(|addressing| (kind, addressing))) {
        let field = kind.field([100, 75], addressing);
        // High, low, so low that the disc dips under the horizon, and round the zenith.
        for light in [(40.0, 215.0, 3.0), (15.0, 100.0, 5.0), (4.0, 10.0, 6.0), (89.0, 300.0, 4.0)]
            .map(|(elevation, azimuth, half_angle)| Light { elevation, azimuth, half_angle })
        {
            let points = 32;
            let list = light.receivers(&field, 500);
            let seen = lights::seen(gpu, Shadow::Area, &field, light.radius(), points, &list);
            let truth = rays::each(list.len(), |i| shadow(&field, &list[i], &light.disc(&list[i]), points));
            let off = seen.iter().zip(&truth).filter(|(seen, truth)| seen != truth).count();
            let mean = lights::rms(&seen, &truth);
            println!("{kind:?} {addressing:?} {light:?}: {off} off, rms {mean:.5}");
            assert!(mean <= tolerances::AREA_RMS, "{mean}: {kind:?} {addressing:?} {light:?}");
        }
    }
}

#[test]
fn a_flat_field_is_lit_at_any_height() {
    let Some(gpu) = gpu() else { return };
    for height in [0.0, 1e-30, 0.1, 0.5, 0.999_999_94, 1.0] {
        let field = HeightField::from_fn([37, 53], Addressing::Wrap, |_, _| height);
        // Down to where the disc touches the horizon.
        for (elevation, half_angle) in [(40.0, 3.0), (5.01, 5.0), (90.0, 15.0)] {
            let light = Light { elevation, azimuth: 33.0, half_angle };
            let rays = light.receivers(&field, 500);
            let seen = lights::seen(gpu, Shadow::Area, &field, light.radius(), 61, &rays);
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
        let seen = lights::seen(gpu, Shadow::Area, field, 0.06, 48, &rays);
        assert!(seen.iter().zip(&before).all(|(seen, before)| seen <= before));
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
        let seen = lights::seen(gpu, Shadow::Area, &field, light.radius(), 512, &rays);
        let worst = seen.iter().zip(&ramp).map(|(seen, ramp)| (seen - ramp).abs()).fold(0.0, f64::max);
        let within = ramp.iter().filter(|ramp| **ramp > 0.0 && **ramp < 1.0).count();
        println!("{light:?}: {worst:.4} off at most, {within} in the penumbra");
        assert!(within > 50 && worst <= tolerances::AREA_RAMP, "{worst}, {within} in the penumbra");
    }
}

/// The stated count is 256: from there on more points change what one sees by less than one can.
#[test]
fn more_than_256_points_change_nothing() {
    for scenery in [Scenery::Hills, Scenery::Boxes, Scenery::Posts] {
        let field = scenery.field();
        let light = Light { elevation: 40.0, azimuth: 215.0, half_angle: 3.0 };
        let rays = light.receivers(&field, 400);
        let by_count = |points| rays::each(rays.len(), |i| shadow(&field, &rays[i], &light.disc(&rays[i]), points));
        let truth = by_count(4096);
        for points in [16, 64, 256, 512] {
            let seen = by_count(points);
            let off = seen.iter().zip(&truth).map(|(seen, truth)| (seen - truth).abs()).sum::<f64>() / truth.len() as f64;
            println!("{scenery:?}, {points} points: {off:.5} off");
            if points >= 256 {
                assert!(off <= tolerances::AREA_CONVERGED, "{scenery:?}: {off} with {points} points");
            }
        }
    }
}
