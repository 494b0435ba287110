//! Gears turn by exactly the angle that their speed says, and mesh.

use std::f64::consts::TAU;

use rilievo::field::noise::Ground;
use rilievo::gpu::Gpu;
use rilievo::reference::noise_gears::{inside_outline, wheels};
use rilievo::reference::{Addressing, HeightField};
use rilievo::scene::{Gear, Gears, NoisePattern};

use super::noise::{evaluated, ground};
use crate::support::gpu::gpu;
use crate::support::tolerances::{GEAR_INTERFERENCE, GEAR_TURNS};

/// The angle of a wheel's teeth on the GPU, turns, up to whole teeth: the phase of their harmonic round the pitch circle.
fn turned(gpu: &Gpu, gears: &Gears, field: &Ground, time: f64, wheel: usize) -> f64 {
    let heights = evaluated(gpu, &NoisePattern::Gears(gears.clone()), field, time);
    let heights = HeightField::new(field.size, field.addressing, heights);
    let wheel = wheels(gears, field, 0.0)[wheel];
    let (mut sin, mut cos) = (0.0, 0.0);
    let samples = 7200;
    for i in 0..samples {
        let angle = TAU * f64::from(i) / f64::from(samples);
        let at = [wheel.centre[0] + wheel.pitch_radius * angle.cos(), wheel.centre[1] + wheel.pitch_radius * angle.sin()];
        let height = heights.bilinear(at.map(|metres| metres / field.texel_metres - 0.5));
        sin += height * (wheel.teeth * angle).sin();
        cos += height * (wheel.teeth * angle).cos();
    }
    sin.atan2(cos) / TAU / wheel.teeth
}

/// A difference of turns, up to whole teeth.
fn apart(a: f64, b: f64, teeth: f64) -> f64 {
    let teeth_apart = (a - b) * teeth;
    (teeth_apart - teeth_apart.round()).abs() / teeth
}

#[test]
fn a_wheel_turns_by_exactly_the_angle_of_its_speed() {
    let Some(gpu) = gpu() else { return };
    let field = ground([400, 400], Addressing::Clamp);
    let gears = Gears {
        centre: [0.5, 0.5],
        module_metres: 0.03,
        turns_per_second: 0.1,
        train: vec![Gear { teeth: 20, spokes: 5, toward_degrees: 0.0 }],
        ..Gears::default()
    };
    let start = turned(gpu, &gears, &field, 0.0, 0);
    for time in [0.013, 0.1, 1.0 / 3.0, 1.7, 1e6 + 0.013] {
        let turned = turned(gpu, &gears, &field, time, 0) - start;
        let off = apart(turned, f64::from(gears.turns_per_second) * time, 20.0);
        println!("{time} s: {off:.1e} turns off");
        assert!(off <= GEAR_TURNS, "{time} s: {turned} turns, {off} off");
    }
}

#[test]
fn a_driven_wheel_turns_back_by_the_ratio_of_the_teeth() {
    let Some(gpu) = gpu() else { return };
    let field = ground([400, 400], Addressing::Clamp);
    let gears = Gears { centre: [0.3, 0.4], module_metres: 0.02, turns_per_second: 0.25, ..Gears::default() };
    let start = turned(gpu, &gears, &field, 0.0, 1);
    for time in [0.02, 0.11, 3.3] {
        let turned = turned(gpu, &gears, &field, time, 1) - start;
        let off = apart(turned, -0.25 * time * 24.0 / 16.0, 16.0);
        println!("{time} s: {off:.1e} turns off");
        // The neighbour's teeth reach over the pitch circle, in one of sixteen places.
        assert!(off <= 20.0 * GEAR_TURNS, "{time} s: {turned} turns, {off} off");
    }
}

#[test]
fn teeth_stand_in_the_gaps_of_the_other_wheel() {
    let field = ground([100, 100], Addressing::Clamp);
    let gears = Gears::default();
    let module = f64::from(gears.module_metres);
    let mut closest = f64::MIN;
    for frame in 0..60 {
        let wheels = wheels(&gears, &field, f64::from(frame) * 0.01);
        let [one, other] = [wheels[0], wheels[1]];
        for step in 0..100_000 {
            // All about the place where the pitch circles touch.
            let [i, j] = [step % 400, step / 400].map(f64::from);
            let toward = [other.centre[0] - one.centre[0], other.centre[1] - one.centre[1]];
            let length = toward[0].hypot(toward[1]);
            let unit = toward.map(|side| side / length);
            let (along, across) = (one.pitch_radius + (j / 125.0 - 1.0) * 1.3 * module, (i / 200.0 - 1.0) * 4.0 * module);
            let from_one = [along * unit[0] - across * unit[1], along * unit[1] + across * unit[0]];
            let from_other = [0, 1].map(|axis| from_one[axis] - toward[axis]);
            closest = closest.max(inside_outline(&one, module, from_one).min(inside_outline(&other, module, from_other)));
        }
    }
    println!("teeth cut {:.3} modules into each other", closest / module);
    assert!(closest <= GEAR_INTERFERENCE * module, "{closest}");
    // Turned by half a tooth they would stand on each other.
    let mut jammed = wheels(&gears, &field, 0.0);
    jammed[1].angle += TAU / jammed[1].teeth / 2.0;
    let toward = 20_f64.to_radians();
    let contact = [0, 1].map(|axis| jammed[0].pitch_radius * [toward.cos(), toward.sin()][axis]);
    let seen = [0, 1].map(|axis| contact[axis] + jammed[0].centre[axis] - jammed[1].centre[axis]);
    assert!(inside_outline(&jammed[1], module, seen).min(inside_outline(&jammed[0], module, contact)) > -module);
}
