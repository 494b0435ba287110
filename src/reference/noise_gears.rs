//! Wheels with teeth that mesh. Specification of `shaders/field/noise_gears.wgsl`.

use std::f64::consts::{FRAC_PI_4, TAU};

use super::noise::{Ground, edge_metres, smooth};
use crate::scene::Gears;

/// A wheel of a train at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// Its centre, metres.
    pub centre: [f64; 2],
    /// The angle that it has turned by, from u toward v, radians.
    pub angle: f64,
    /// Radius of its pitch circle, metres.
    pub pitch_radius: f64,
    /// How many teeth it has. One of them points where it has turned to.
    pub teeth: f64,
    /// How many spokes.
    pub spokes: f64,
}

/// The wheels of a train.
pub fn wheels(gears: &Gears, ground: &Ground, time_seconds: f64) -> Vec<Wheel> {
    let metres = ground.metres();
    let mut wheels: Vec<Wheel> = Vec::new();
    for gear in &gears.train {
        let teeth = f64::from(gear.teeth);
        let pitch_radius = 0.5 * f64::from(gears.module_metres) * teeth;
        let (centre, angle) = match wheels.last() {
            None => {
                let centre = [0, 1].map(|axis| f64::from(gears.centre[axis]) * metres[axis]);
                (centre, TAU * f64::from(gears.turns_per_second) * time_seconds)
            }
            Some(driver) => {
                // Pitch circles touch. Where a tooth of the driver points to this wheel, a gap of this wheel points back.
                let toward = f64::from(gear.toward_degrees).to_radians();
                let apart = driver.pitch_radius + pitch_radius;
                let centre = [driver.centre[0] + apart * toward.cos(), driver.centre[1] + apart * toward.sin()];
                let past_tooth = (toward - driver.angle) * driver.teeth;
                let half_tooth = TAU / 2.0;
                (centre, toward + TAU / 2.0 - (half_tooth - past_tooth) / teeth)
            }
        };
        wheels.push(Wheel { centre, angle, pitch_radius, teeth, spokes: f64::from(gear.spokes) });
    }
    wheels
}

/// How far inside a wheel's outline, without its spokes, a place is, metres; negative outside. `module`: metres of pitch diameter a
/// tooth.
pub fn inside_outline(wheel: &Wheel, module: f64, offset: [f64; 2]) -> f64 {
    let distance = offset[0].hypot(offset[1]);
    let arc = arc(wheel.teeth, wheel.angle, offset) * distance;
    // Teeth narrow by tan 20° on each side; a fortieth of the module on both sides is play.
    let half_width = FRAC_PI_4 * module - 0.0125 * module - (distance - wheel.pitch_radius) * 20_f64.to_radians().tan();
    let flank = (half_width - arc) * 20_f64.to_radians().cos();
    let root = wheel.pitch_radius - 1.25 * module - distance;
    root.max(flank.min(wheel.pitch_radius + module - distance))
}

/// The angle to the nearest of so many evenly spaced directions, the first at `angle`.
fn arc(count: f64, angle: f64, offset: [f64; 2]) -> f64 {
    let turns = (offset[1].atan2(offset[0]) - angle) / TAU * count;
    (turns - turns.round()).abs() / count * TAU
}

/// The height at a place in metres: that of the highest wheel.
pub fn height(gears: &Gears, ground: &Ground, time_seconds: f64, at: [f64; 2]) -> f64 {
    let module = f64::from(gears.module_metres);
    let edge = edge_metres(ground, gears.edge_metres);
    let mut highest = 0.0_f64;
    for wheel in wheels(gears, ground, time_seconds) {
        let offset = [0, 1].map(|axis| {
            let apart = at[axis] - wheel.centre[axis];
            if ground.wraps() { apart - (apart / ground.metres()[axis]).round() * ground.metres()[axis] } else { apart }
        });
        let distance = offset[0].hypot(offset[1]);
        let hub = 0.28 * wheel.pitch_radius;
        let rim = wheel.pitch_radius - 2.75 * module;
        let between = (distance - hub).min(rim - distance);
        let from_spoke = arc(wheel.spokes, wheel.angle, offset) * distance;
        let spoke = 0.07 * wheel.pitch_radius + 0.25 * module - from_spoke;
        let bore = distance - 0.12 * wheel.pitch_radius;
        let inside = inside_outline(&wheel, module, offset).min(spoke.max(-between)).min(bore);
        let sunk = 1.0 - 0.3 * smooth(between / (2.0 * edge));
        highest = highest.max(f64::from(gears.top) * sunk * smooth(inside / edge));
    }
    highest
}
