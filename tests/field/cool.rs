//! Glow that cools: the clock of heat, the pass that forgets it, and what is seen of it, against e^(−t/τ).

use rilievo::field::Field;
use rilievo::field::cool::{Cool, EVERY_MOMENTS, every_seconds};
use rilievo::field::groundwork::Groundwork;
use rilievo::field::material::{GLOWING_MOMENTS, MOMENTS_PER_FALL, Marks, moment};
use rilievo::field::stamp::{Profile, Stamp};
use rilievo::reference;
use rilievo::scene::{Addressing, Explosions, Scene};
use rilievo::stroke::Strokes;

use crate::support::gpu::{gpu, read, run};

#[test]
fn the_pass_equals_the_reference() {
    let Some(gpu) = gpu() else { return };
    let cool = Cool::new(gpu).expect("the shader compiles");
    // Every heat there is, beside other marks.
    let size = [41, 25];
    let bits: Vec<u32> =
        (0..size[0] * size[1]).map(|index| (index.min(1023) << 22) | ((index * 2_654_435) & 0x3f_ffff)).collect();
    for seconds in [0.0, 3.21, 777.7] {
        let field = Field::new(gpu, size, Addressing::Clamp, false);
        let mut set = cool.bind(gpu, &field);
        field.material.write(gpu, &bits);
        cool.upload(gpu, &mut set, &[seconds], 0.7);
        run(gpu, |recorder| cool.record(recorder, &set, 0));
        let left: Vec<u32> = read(gpu, &field.material);
        let now = f64::from(moment(seconds, 0.7));
        for (before, after) in bits.iter().zip(&left) {
            let expected = reference::cool::cool(Marks::from_bits(*before), now);
            assert_eq!(Marks::from_bits(*after), expected, "at {seconds} s");
        }
    }
}

#[test]
fn a_glow_falls_by_e_in_its_time_whatever_the_frames_are() {
    let Some(gpu) = gpu() else { return };
    let cooling_seconds = 0.5;
    let settings = Explosions { per_second: 0.0, cooling_seconds: cooling_seconds as f32, ..Explosions::default() };
    let mut scene = Scene { explosions: Some(settings), ..Scene::default() };
    scene.field.size = [64, 32];
    let hot = Stamp {
        at_seconds: 0.9,
        centre: [20.0, 15.0],
        radius: 12.0,
        profile: Profile::Bump,
        height: 0.0,
        heat: 0.8,
        ..Stamp::default()
    };
    // Long enough for the clock to start over many times.
    let last = 40.0;
    for frames in [37_u32, 400, 4001] {
        let field = Field::new(gpu, scene.field.size, Addressing::Clamp, false);
        let mut groundwork = Groundwork::new(gpu, &field, &scene, &[]).expect("its shaders compile");
        let time = |frame: u32| last * f64::from(frame) / f64::from(frames);
        let mut seen = 0;
        for frame in 0..frames {
            let tick =
                rilievo::clock::Tick { previous_seconds: time(frame), time_seconds: time(frame + 1), ..Default::default() };
            let pressed = tick.previous_seconds < 0.9 && 0.9 <= tick.time_seconds;
            let strokes = Strokes { presses: if pressed { vec![hot] } else { Vec::new() }, ..Strokes::default() };
            run(gpu, |recorder| groundwork.record(recorder, &field, &tick, &strokes)).expect("it fits");
            // Not every frame is looked at.
            if frame % (1 + frames / 200) != 0 {
                continue;
            }
            let material: Vec<u32> = read(gpu, &field.material);
            let glow = reference::cool::glow(
                Marks::from_bits(material[15 * 64 + 20]).heat,
                f64::from(moment(tick.time_seconds, cooling_seconds)),
            );
            let since = tick.time_seconds - 0.9;
            let expected = if since < 0.0 { 0.0 } else { 0.8 * (-since / cooling_seconds).exp() };
            // A moment is a 32nd of the time: the glow is at most that much too old. What is below e⁻⁹ is none.
            let allowed = expected * (1.0 - (-1.01 / MOMENTS_PER_FALL).exp()) + (-GLOWING_MOMENTS / MOMENTS_PER_FALL).exp();
            assert!(glow <= expected + 1e-6 && expected - glow <= allowed, "{since} s: {glow} for {expected}");
            seen += usize::from(glow > 0.1);
            let elsewhere = Marks::from_bits(material[5 * 64 + 60]).heat;
            assert_eq!(elsewhere, 0);
        }
        assert!(seen > 1 || frames < 100, "{seen} frames of {frames} saw it");
        let left: Vec<u32> = read(gpu, &field.material);
        assert!(left.iter().all(|bits| Marks::from_bits(*bits).heat == 0), "it was forgotten");
    }
    assert_eq!(every_seconds(cooling_seconds), cooling_seconds * EVERY_MOMENTS / MOMENTS_PER_FALL);
}
