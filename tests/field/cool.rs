//! Glow that cools: the clock of heat, the pass that forgets it, and what is seen of it, against e^(−t/τ).

use rilievo::field::Field;
use rilievo::field::cool::{Cool, EVERY_MOMENTS, every_seconds};
use rilievo::field::groundwork::Groundwork;
use rilievo::field::material::{GLOWING_MOMENTS, MOMENTS, MOMENTS_PER_FALL, Marks, moment};
use rilievo::field::stamp::{Profile, Stamp};
use rilievo::gpu::{Binding, BindingLayout, Kernel, Readback};
use rilievo::reference;
use rilievo::scene::{Addressing, Explosions, Scene};
use rilievo::stroke::Strokes;

use crate::support::gpu::{gpu, own_gpu, read, run, wait_for};
use crate::support::tolerances::GLOW;

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

/// What a pixel sees of every heat, at some moments.
const GLOWS: &str = "
@group(1) @binding(0) var<storage, read> moments: array<f32>;
@group(1) @binding(1) var<storage, read_write> glows: array<f32>;

@compute @workgroup_size(64)
fn glows_of_heats(@builtin(global_invocation_id) id: vec3u) {
    glows[id.y * 1024u + id.x] = material_glow(id.x, moments[id.y]);
}
";

#[test]
fn what_is_seen_of_a_heat_equals_the_reference() {
    let Some(mut gpu) = own_gpu() else { return };
    gpu.shaders.replace("test/glows", GLOWS.to_owned());
    let gpu = &gpu;
    // The clock's start, its end, and between moments: a heat that rounding puts into the future glows as one of now.
    let moments = [0.0_f32, 0.4, 333.6, 800.5, 1022.0, 1022.9];
    let layout = BindingLayout::new(gpu, "glows", wgpu::ShaderStages::COMPUTE, &[Binding::Read, Binding::ReadWrite]);
    let constants = [
        ("MATERIAL_MOMENTS", f64::from(MOMENTS)),
        ("MATERIAL_MOMENTS_PER_FALL", MOMENTS_PER_FALL),
        ("MATERIAL_GLOWING_MOMENTS", GLOWING_MOMENTS),
    ];
    let parts = ["common/material", "test/glows"];
    let kernel = Kernel::new(gpu, "glows", &parts, "glows_of_heats", &constants, &[None, Some(&layout)]).expect("it compiles");
    let buffer = |values: usize| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("glows"),
            size: 4 * values as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        })
    };
    let (given, found) = (buffer(moments.len()), buffer(1024 * moments.len()));
    gpu.queue.write_buffer(&given, 0, bytemuck::cast_slice(&moments));
    let group = layout.bind(gpu, &[given.as_entire_binding(), found.as_entire_binding()]);
    let readback = run(gpu, |recorder| {
        recorder.compute("glows", |pass| {
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(1, &group, &[]);
            pass.dispatch_workgroups(1024 / 64, moments.len() as u32, 1);
        });
        Readback::record_buffer(gpu, recorder.encoder, &found, found.size())
    });
    readback.start();
    let glows: Vec<f32> = bytemuck::pod_collect_to_vec(&wait_for(gpu, &readback));
    for (row, &moment) in glows.chunks_exact(1024).zip(&moments) {
        for (heat, &glow) in (0..).zip(row) {
            let expected = reference::cool::glow(heat, f64::from(moment));
            assert!((f64::from(glow) - expected).abs() <= GLOW, "heat {heat} at {moment}: {glow} for {expected}");
        }
        assert!(row.iter().any(|&glow| glow > 0.9), "all is cold at {moment}");
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
