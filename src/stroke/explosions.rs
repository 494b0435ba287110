//! Explosions: a crater that grows, what it throws out, and where that lands.
//!
//! All of it is a function of the seed, the charge's number and the time: a crater grows in [`STEPS`] stamps at times of their own, each
//! a fraction of its depth and wider than the one before; clods fly as Newton has it and land where and when that says.

use std::f64::consts::TAU;

use super::{Lattice, Random, Stream, due, numbers_between};
use crate::field::stamp::{Blend, CRATER_RIM, Profile, Stamp};
use crate::scene::Explosions;

/// Stamps in which a crater grows.
pub const STEPS: u32 = 16;

/// Acceleration of gravity, m/s².
const GRAVITY: f64 = 9.81;

/// The elevations at which clods leave, as tangents: 35° to 72°.
const TANGENTS: [f64; 2] = [0.70, 3.08];

/// The stamps of charges after one time and until another, both seconds: charge k goes off at (k + ¼)/rate.
pub fn between<'a>(
    explosions: &'a Explosions,
    seed: u64,
    lattice: &'a Lattice,
    after_seconds: f64,
    until_seconds: f64,
) -> impl Iterator<Item = Stamp> + 'a {
    let rate = f64::from(explosions.per_second);
    // Those that may still press something.
    let earliest = (after_seconds - longest_seconds(explosions)).max(-1.0);
    numbers_between(rate, 0.25, earliest, until_seconds)
        .flat_map(move |number| {
            let mut random = Random::new(seed, Stream::Explosions, number);
            // Not too near a border, so that the whole of it is seen.
            let uv = [random.between(0.08, 0.92), random.between(0.08, 0.92)];
            explosion(explosions, lattice, uv, (number as f64 + 0.25) / rate, &mut random)
        })
        .filter(move |stamp| !due(stamp.at_seconds, after_seconds) && due(stamp.at_seconds, until_seconds))
}

/// From a charge to the last stamp of any, seconds.
fn longest_seconds(explosions: &Explosions) -> f64 {
    let range = f64::from(explosions.reach) * f64::from(explosions.radius_metres[1]);
    f64::from(explosions.growth_seconds).max(flight_seconds(range, TANGENTS[1])) + 0.01
}

/// How long a clod flies that lands so far away and left at this elevation: from r = v² sin 2θ / g and t = 2 v sin θ / g.
fn flight_seconds(range_metres: f64, tangent: f64) -> f64 {
    (2.0 * range_metres * tangent / GRAVITY).sqrt()
}

/// What one charge at a point of the plane presses, each stamp at its own time.
pub fn explosion(explosions: &Explosions, lattice: &Lattice, uv: [f64; 2], at_seconds: f64, random: &mut Random) -> Vec<Stamp> {
    let [smallest, largest] = explosions.radius_metres.map(f64::from);
    let rim_metres = smallest + (largest - smallest) * random.unit();
    let depth_metres = f64::from(explosions.depth_metres) * rim_metres / largest;
    let growth_seconds = f64::from(explosions.growth_seconds);
    let centre = lattice.at(uv);
    let radius = lattice.texels(rim_metres / CRATER_RIM);
    let whole = Stamp {
        at_seconds,
        centre,
        radius,
        height: lattice.heights(depth_metres),
        profile: Profile::Crater,
        blend: Blend::Add,
        irregularity: random.between(0.3, 0.6) as f32,
        phase: random.between(0.0, TAU) as f32,
        ..Stamp::default()
    };
    let mut stamps = Vec::with_capacity((STEPS + explosions.ejecta) as usize);
    for step in 1..=STEPS {
        let share = f64::from(step) / f64::from(STEPS);
        // As a blast: fast at first, at rest in the end.
        let grown = 1.0 - (1.0 - share).powi(3);
        let last = step == STEPS;
        stamps.push(Stamp {
            at_seconds: at_seconds + growth_seconds * share,
            radius: whole.radius * (0.3 + 0.7 * grown) as f32,
            height: whole.height / STEPS as f32,
            // Soot is laid as it comes to rest; what is bared glows while it grows.
            soot: if last { explosions.scorch } else { 0.0 },
            bare: if last { 1.0 } else { 0.25 },
            heat: explosions.heat,
            ..whole
        });
    }
    for _ in 0..explosions.ejecta {
        stamps.push(clod(explosions, lattice, (rim_metres, depth_metres), &whole, random));
    }
    stamps
}

/// One clod, where and when it lands.
fn clod(
    explosions: &Explosions,
    lattice: &Lattice,
    (rim_metres, depth_metres): (f64, f64),
    crater: &Stamp,
    random: &mut Random,
) -> Stamp {
    // Most land near: the range is a power of a uniform number.
    let nearest = 1.1;
    let rims = nearest + (f64::from(explosions.reach) - nearest).max(0.0) * random.unit().powf(1.7);
    let range_metres = rims * rim_metres;
    let flight = flight_seconds(range_metres, random.between(TANGENTS[0], TANGENTS[1]));
    let angle = random.between(0.0, TAU);
    let away = lattice.texels(range_metres);
    let size = rim_metres * random.between(0.05, 0.20) / rims.sqrt();
    let hot = random.unit() < 0.3;
    Stamp {
        at_seconds: crater.at_seconds + flight,
        centre: [crater.centre[0] + away * angle.cos() as f32, crater.centre[1] + away * angle.sin() as f32],
        radius: lattice.texels(size).max(1.0),
        height: lattice.heights(random.between(0.05, 0.16) * depth_metres / rims.sqrt()),
        profile: Profile::Bump,
        irregularity: random.between(0.2, 0.8) as f32,
        phase: random.between(0.0, TAU) as f32,
        soot: 0.3 * explosions.scorch,
        bare: 0.9,
        heat: if hot { 0.8 * explosions.heat } else { 0.0 },
        ..Stamp::default()
    }
}

#[cfg(test)]
mod tests {
    use super::super::presses_between;
    use super::*;
    use crate::scene::Scene;

    fn scene() -> Scene {
        Scene { explosions: Some(Explosions { per_second: 3.0, ..Explosions::default() }), ..Scene::default() }
    }

    #[test]
    fn what_is_pressed_does_not_depend_on_how_frames_cut_time() {
        let scene = scene();
        let lattice = Lattice::of_scene(&scene);
        let cut = |frames: u32| -> Vec<Stamp> {
            let time = |frame: u32| 4.0 * f64::from(frame) / f64::from(frames);
            (0..frames).flat_map(|frame| presses_between(&scene, 5, &lattice, time(frame), time(frame + 1))).collect()
        };
        let whole = cut(1);
        assert!(whole.len() > 600, "{}", whole.len());
        for frames in [7, 96, 240] {
            assert_eq!(cut(frames), whole, "in {frames} frames");
        }
        assert!(whole.windows(2).all(|pair| pair[0].at_seconds <= pair[1].at_seconds));
    }

    #[test]
    fn a_crater_is_as_deep_in_the_end_as_it_was_meant_to_be_and_grows() {
        let scene = scene();
        let lattice = Lattice::of_scene(&scene);
        let settings = scene.explosions.as_ref().expect("it has some");
        let stamps = explosion(settings, &lattice, [0.5, 0.5], 1.0, &mut Random::new(1, Stream::Explosions, 0));
        let grown: Vec<_> = stamps.iter().filter(|stamp| stamp.profile == Profile::Crater).collect();
        assert_eq!(grown.len(), STEPS as usize);
        assert!(grown.windows(2).all(|pair| pair[0].radius < pair[1].radius && pair[0].at_seconds < pair[1].at_seconds));
        assert!((grown[15].at_seconds - 1.0 - f64::from(settings.growth_seconds)).abs() < 1e-9);
        // A crater's radius says how deep one of this size is.
        let rim_metres = f64::from(grown[15].radius) * CRATER_RIM * lattice.texel_metres;
        let depth: f64 = grown.iter().map(|stamp| f64::from(stamp.height)).sum::<f64>() * lattice.depth_metres;
        let expected = f64::from(settings.depth_metres) * rim_metres / f64::from(settings.radius_metres[1]);
        assert!((depth / expected - 1.0).abs() < 1e-5, "{depth} for {expected}");
    }

    #[test]
    fn clods_land_where_and_when_a_throw_says() {
        let scene = scene();
        let lattice = Lattice::of_scene(&scene);
        let settings = scene.explosions.as_ref().expect("it has some");
        for number in 0..20 {
            let stamps = explosion(settings, &lattice, [0.5, 0.5], 2.0, &mut Random::new(3, Stream::Explosions, number));
            let rim = f64::from(stamps[15].radius) * CRATER_RIM;
            for clod in &stamps[STEPS as usize..] {
                let away = [0, 1].map(|axis| f64::from(clod.centre[axis] - stamps[0].centre[axis]));
                let range = away[0].hypot(away[1]);
                assert!(range > 1.05 * rim && range < f64::from(settings.reach) * rim * 1.001, "{range} of {rim}");
                // t² g / 2r is the tangent of the elevation.
                let tangent = GRAVITY * (clod.at_seconds - 2.0).powi(2) / (2.0 * range * lattice.texel_metres);
                assert!(tangent > 0.999 * TANGENTS[0] && tangent < 1.001 * TANGENTS[1], "{tangent}");
                assert!(clod.at_seconds - 2.0 <= longest_seconds(settings));
            }
        }
    }
}
