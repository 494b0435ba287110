//! The light's disc: its points, its directions, and the rays that these are.

use rilievo::reference::light_disc::{point, ramp};
use rilievo::reference::{Addressing, HeightField};

use crate::support::lights::{Light, SCALE};
use crate::support::tolerances;

/// Cut by any straight line, the points on either side are as many as the area says.
#[test]
fn the_points_cover_the_disc_evenly() {
    for count in [64, 256, 1024] {
        let mut worst = 0.0_f64;
        for (turn, cut) in (0..40).flat_map(|turn| (-9..=9).map(move |cut| (f64::from(turn) * 0.157, f64::from(cut) / 10.0))) {
            let (sine, cosine) = turn.sin_cos();
            let above = (0..count).map(|index| point(index, count)).filter(|[a, b]| a * cosine + b * sine > cut).count();
            worst = worst.max((above as f64 / f64::from(count) - ramp(-cut)).abs());
        }
        println!("{count} points: {worst:.4} off at most");
        assert!(worst <= tolerances::DISC_POINTS / f64::from(count).powf(0.75), "{count} points: {worst}");
    }
}

/// Directions are where elevation, azimuth and half angle say, and the ray of each goes along it.
#[test]
fn a_ray_goes_along_its_direction() {
    let field = HeightField::from_fn([4, 4], Addressing::Wrap, |_, _| 0.5);
    for (elevation, azimuth, half_angle) in [(40.0, 215.0, 3.0), (10.0, 90.0, 5.0), (80.0, 0.0, 12.0)] {
        let light = Light { elevation, azimuth, half_angle };
        let ray = light.ray(&field, [1.0, 2.0]);
        let disc = light.disc(&ray);
        let degrees = |direction: [f64; 3]| {
            let line = disc.line([1.0, 2.0], 0.5, direction);
            let metres = [line.travel[0] * SCALE.cell_metres[0], line.travel[1] * SCALE.cell_metres[1]];
            let elevation = SCALE.depth_metres.atan2(metres[0].hypot(metres[1]));
            (elevation.to_degrees(), metres[1].atan2(metres[0]).to_degrees().rem_euclid(360.0))
        };
        let near = |a: (f64, f64), b: (f64, f64)| {
            assert!((a.0 - b.0).abs() < 1e-4 && (a.1 - b.1).abs() < 1e-4, "{a:?} for {b:?}");
        };
        let [elevation, azimuth, half_angle] = [elevation, azimuth, half_angle].map(f64::from);
        near(degrees(disc.direction([0.0, 0.0])), (elevation, azimuth));
        near(degrees(disc.direction([-1.0, 0.0])), (elevation - half_angle, azimuth));
        // Beside the centre a great circle turns the azimuth by more than the angle, and dips a little.
        let beside = half_angle.to_radians().tan();
        let turned = beside.atan2(elevation.to_radians().cos()).to_degrees();
        let dipped = (elevation.to_radians().sin() / beside.hypot(1.0)).asin().to_degrees();
        near(degrees(disc.direction([0.0, 1.0])), (dipped, azimuth + turned));
    }
}
