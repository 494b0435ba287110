//! Healing: the shader against its reference, and both against the time that it is given.

use rilievo::camera::Camera;
use rilievo::clock::{Clock, Pace, Tick};
use rilievo::field::groundwork::Groundwork;
use rilievo::field::heal::Heal;
use rilievo::field::material::Marks;
use rilievo::field::stamp::{Blend, Profile, Stamp, Stamps};
use rilievo::field::{Dirty, Field, Region};
use rilievo::frame::{Frame, FrameInput, Start};
use rilievo::gpu::Gpu;
use rilievo::reference;
use rilievo::scene::{Addressing, Base, Explosions, Healing, Scene, Shots};
use rilievo::stroke::{Random, Stream, Strokes};
use rilievo::surface::{Shows, Technique};

use crate::support::gpu::{gpu, read, run};
use crate::support::tolerances::HEAL_STEP;

#[test]
fn one_step_equals_the_reference() {
    let Some(gpu) = gpu() else { return };
    let heal = Heal::new(gpu).expect("the shader compiles");
    for size in [[61, 47], [1, 1], [1, 40], [40, 1], [255, 257]] {
        let count = (size[0] * size[1]) as usize;
        let field = Field::new(gpu, size, Addressing::Clamp, false);
        let number = |salt: u64| move |index: usize| Random::new(salt, Stream::Hand, index as u64).between(-0.4, 1.4) as f32;
        let base: Vec<_> = (0..count).map(number(1)).map(|height| height.clamp(0.0, 1.0)).collect();
        let mut relief: Vec<_> = (0..count).map(number(2)).collect();
        let poison = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38, -3e38, 1e-40, base[0]];
        relief.iter_mut().step_by(13).zip(poison.iter().cycle()).for_each(|(height, poison)| *height = *poison);
        let bits: Vec<u32> = (0..count as u32).map(|index| index.wrapping_mul(2_654_435_761)).collect();
        let mut set = heal.bind(gpu, &field, 4.0);
        set.reset(gpu, &base);
        field.relief.write(gpu, &relief);
        field.material.write(gpu, &bits);
        set.open_regions(&[Region::all(size)], 100);
        assert_eq!(set.plan(101), Dirty::All);
        heal.upload(gpu, &mut set);
        run(gpu, |recorder| heal.record(recorder, &set, 0));
        let (healed, wiped): (Vec<f32>, Vec<u32>) = (read(gpu, &field.relief), read(gpu, &field.material));
        for index in 0..count {
            let expected = reference::heal::heal(relief[index], base[index]);
            let error = (f64::from(healed[index]) - expected).abs();
            assert!(error <= HEAL_STEP * 2.0, "{size:?}: {} toward {}: {error:.1e}", relief[index], base[index]);
            let expected = reference::heal::wipe(Marks::from_bits(bits[index]), 101);
            assert_eq!(Marks::from_bits(wiped[index]), expected, "{size:?}, texel {index}");
        }
    }
}

/// A wall that heals, without a picture.
struct Wall {
    gpu: &'static Gpu,
    field: Field,
    groundwork: Groundwork,
    base: Vec<f32>,
    clock: Clock,
    scene: Scene,
}

impl Wall {
    fn new(scene: &Scene) -> Option<Self> {
        let gpu = gpu()?;
        let size = scene.field.size;
        let field = Field::new(gpu, size, scene.field.addressing, false);
        let base = rilievo::field::base::heights(scene).expect("it is procedural");
        let mut groundwork = Groundwork::new(gpu, &field, scene, &[]).expect("its shaders compile");
        field.relief.write(gpu, &base);
        groundwork.reset(gpu, &base);
        Some(Self { gpu, field, groundwork, base, clock: Clock::new([None; 3]), scene: scene.clone() })
    }

    fn frame(&mut self, dt_seconds: f64, hand: &[Stamp]) -> Dirty {
        let tick = self.clock.advance(Pace::Fixed { dt_seconds });
        let mut strokes = Strokes::of_scene(&self.scene, self.scene.seed, &tick);
        strokes.hand.extend_from_slice(hand);
        self.record(&tick, &strokes)
    }

    fn record(&mut self, tick: &Tick, strokes: &Strokes) -> Dirty {
        run(self.gpu, |recorder| self.groundwork.record(recorder, &self.field, tick, strokes)).expect("they fit")
    }

    fn relief(&self) -> Vec<f32> {
        read(self.gpu, &self.field.relief)
    }

    fn material(&self) -> Vec<u32> {
        read(self.gpu, &self.field.material)
    }
}

fn healing(seconds: f32) -> Scene {
    let mut scene = Scene { base: Base::Terrain {}, healing: Some(Healing { seconds }), ..Scene::default() };
    scene.field.size = [97, 75];
    scene
}

fn deep(at_seconds: f64) -> Vec<Stamp> {
    let stamp = |x: f32, height| Stamp {
        at_seconds,
        centre: [x, 30.0],
        radius: 15.0,
        height,
        profile: Profile::Disc,
        blend: Blend::Add,
        soot: 1.0,
        bare: 1.0,
        gloss: 1.0,
        ..Stamp::default()
    };
    vec![stamp(10.0, -0.3), stamp(40.0, 0.01), stamp(90.0, -7.0)]
}

#[test]
fn after_its_time_a_surface_is_its_base_to_the_bit_and_clean() {
    // Frames of several lengths, some shorter than a step, some of many.
    for dt_seconds in [1.0 / 240.0, 1.0 / 60.0, 0.11] {
        let Some(mut wall) = Wall::new(&healing(2.0)) else { return };
        wall.frame(dt_seconds, &[]);
        while wall.clock.time_seconds() < 0.3 {
            wall.frame(dt_seconds, &[]);
        }
        wall.frame(dt_seconds, &deep(wall.clock.time_seconds()));
        let pressed = wall.clock.time_seconds();
        assert!(wall.relief() != wall.base && wall.groundwork.heals());
        while wall.clock.time_seconds() + dt_seconds < pressed + 1.9 {
            wall.frame(dt_seconds, &[]);
        }
        assert!(wall.relief() != wall.base, "it takes its time");
        while wall.clock.time_seconds() < pressed + 2.0 {
            wall.frame(dt_seconds, &[]);
        }
        assert_eq!(wall.relief(), wall.base, "frames of {dt_seconds} s");
        assert!(wall.material().iter().all(|bits| *bits == 0));
        // And then it costs nothing.
        wall.frame(dt_seconds, &[]);
        assert_eq!(wall.frame(0.05, &[]), Dirty::Nothing);
        assert!(!wall.groundwork.heals() && wall.groundwork.traffic_bytes() == 0);
    }
}

#[test]
fn what_a_time_shows_does_not_depend_on_how_frames_cut_it() {
    let mut scene = healing(3.0);
    scene.shots = Some(Shots { per_second: 7.0, ..Shots::default() });
    scene.explosions = Some(Explosions { per_second: 1.5, cooling_seconds: 0.2, ..Explosions::default() });
    let shown = |frames: u32| {
        let mut wall = Wall::new(&scene)?;
        (0..=frames).for_each(|_| drop(wall.frame(4.0 / f64::from(frames), &[])));
        Some((wall.relief(), wall.material()))
    };
    let Some(expected) = shown(240) else { return };
    let changed = expected.1.iter().filter(|bits| **bits != 0).count();
    assert!(changed > 1000, "{changed}");
    for frames in [1, 9, 60, 700] {
        let actual = shown(frames).expect("there was an adapter");
        assert!(actual.0 == expected.0, "relief of {frames} frames");
        assert!(actual.1 == expected.1, "material of {frames} frames");
    }
}

#[test]
fn only_what_is_open_is_healed() {
    let mut scene = healing(4.0);
    scene.field.size = [512, 512];
    let Some(mut wall) = Wall::new(&scene) else { return };
    wall.frame(1.0 / 60.0, &[]);
    let stamp = Stamp { centre: [100.0, 100.0], radius: 4.0, height: -0.1, ..Stamp::default() };
    wall.frame(1.0 / 60.0, &[stamp]);
    let dirty = wall.frame(1.0 / 60.0, &[]);
    let texels: u64 = dirty.regions([512, 512]).iter().map(Region::area).sum();
    let tile = Stamps::TILE.map(u64::from).iter().product::<u64>();
    assert!((tile..=4 * tile).contains(&texels), "{texels}");
    assert!(wall.groundwork.traffic_bytes() <= 4 * tile * 20);
}

#[test]
fn undo_over_a_still_surface_restores_it_to_the_bit() {
    let mut scene = Scene { base: Base::Terrain {}, ..Scene::default() };
    scene.field.size = [120, 90];
    for addressing in [Addressing::Wrap, Addressing::Clamp] {
        scene.field.addressing = addressing;
        let Some(mut wall) = Wall::new(&scene) else { return };
        let still = Tick::default();
        let mut states = vec![(wall.relief(), wall.material())];
        for stroke_number in 1..=40_u64 {
            // Strokes of several frames, over borders and over one another.
            for piece in 0..3 {
                let mut random = Random::new(stroke_number, Stream::Hand, piece);
                let hand = (0..4)
                    .map(|_| Stamp {
                        centre: [random.between(-5.0, 125.0) as f32, random.between(-5.0, 95.0) as f32],
                        span: [random.between(-20.0, 20.0) as f32, 0.0],
                        radius: random.between(1.0, 14.0) as f32,
                        height: 0.1,
                        profile: Profile::Crater,
                        irregularity: 0.5,
                        soot: 0.8,
                        bare: 1.0,
                        heat: 0.5,
                        ..Stamp::default()
                    })
                    .collect();
                wall.record(&still, &Strokes { hand, stroke_number, ..Strokes::default() });
            }
            states.push((wall.relief(), wall.material()));
        }
        // Older strokes than the last 32 are forgotten.
        assert_eq!(wall.groundwork.undoable(), 32);
        for expected in states.iter().rev().skip(1).take(32) {
            let dirty = wall.record(&still, &Strokes { undo: 1, ..Strokes::default() });
            assert!(dirty != Dirty::Nothing);
            assert!((wall.relief(), wall.material()) == *expected, "{addressing:?}, {} left", wall.groundwork.undoable());
        }
        assert_eq!(wall.groundwork.undoable(), 0);
        assert_eq!(wall.record(&still, &Strokes { undo: 1, ..Strokes::default() }), Dirty::Nothing);
    }
}

#[test]
fn what_undo_keeps_has_a_bound() {
    let mut scene = Scene::default();
    scene.field.size = [2048, 2048];
    let Some(mut wall) = Wall::new(&scene) else { return };
    let stroke = |stroke_number, radius| Strokes {
        hand: vec![Stamp { centre: [1000.0, 1000.0], radius, height: 0.01, ..Stamp::default() }],
        stroke_number,
        ..Strokes::default()
    };
    // Each takes a little less than 8 MiB of 64.
    (1..=12).for_each(|number| drop(wall.record(&Tick::default(), &stroke(number, 511.0))));
    assert_eq!(wall.groundwork.undoable(), 8);
    assert!(wall.groundwork.memory_bytes() <= 65 << 20);
    // One of two frames that is larger than all: then nothing can be taken back, until there is another.
    for _ in 0..3 {
        wall.record(&Tick::default(), &stroke(13, 4000.0));
    }
    assert_eq!(wall.groundwork.undoable(), 0);
    wall.record(&Tick::default(), &stroke(14, 5.0));
    assert_eq!(wall.groundwork.undoable(), 1);
}

#[test]
fn a_derived_field_after_undo_equals_one_that_was_never_pressed() {
    let Some(gpu) = gpu() else { return };
    let mut scene = Scene { base: Base::Terrain {}, ..Scene::default() };
    scene.field.size = [100, 70];
    scene.trace.technique = Technique::Pyramid;
    let heights = rilievo::field::base::heights(&scene).expect("it is procedural");
    let mut frame = Frame::new(gpu, &Start::new(&scene, heights, None), [16, 16], wgpu::TextureFormat::Rgba8Unorm)
        .expect("its shaders compile");
    let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: 16, height: 16, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let camera = Camera::at(&scene.camera, 0.0);
    let mut show = |strokes: &Strokes| {
        let tick = Tick::default();
        let input = FrameInput { tick: &tick, strokes, camera: &camera, display: Shows::Picture.into() };
        let mut encoder = gpu.encoder("test");
        frame.record(gpu, &mut encoder, &input, Some(&view)).expect("it fits");
        frame.finish(gpu, encoder);
        (
            read::<_, f32>(gpu, &frame.field.height),
            read::<_, u32>(gpu, &frame.field.normal),
            read::<_, f32>(gpu, &frame.field.pyramid),
        )
    };
    let before = show(&Strokes::default());
    let hand = vec![Stamp { centre: [50.0, 35.0], radius: 20.0, height: -0.3, ..Stamp::default() }];
    let pressed = show(&Strokes { hand, stroke_number: 1, ..Strokes::default() });
    assert!(pressed.0 != before.0);
    assert!(show(&Strokes { undo: 1, ..Strokes::default() }) == before);
}
