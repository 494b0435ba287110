//! Stamps: the shader against its reference, and both against what blends and volumes must be.

use std::time::Instant;

use rilievo::camera::Camera;
use rilievo::clock::Tick;
use rilievo::field::bins::BinError;
use rilievo::field::material::Marks;
use rilievo::field::stamp::{Blend, CRATER_RIM, ImageForm, Profile, Stamp, StampExtra, StampImage, StampSet, Stamps};
use rilievo::field::wave::Waves;
use rilievo::field::{Dirty, Field};
use rilievo::frame::{Frame, FrameInput, Start};
use rilievo::gpu::{Gpu, List, Recorder};
use rilievo::modes::capture::{PICTURE_FORMAT, Picture};
use rilievo::reference::stamp::{self, Layers, from_segment};
use rilievo::scene::{self, Addressing, Boundary, Scene};
use rilievo::stroke::{Random, Stream, Strokes, stress_discs};
use rilievo::surface::Shows;

use crate::support::gpu::{gpu, own_gpu, read, run};
use crate::support::tolerances::*;

/// A wall on the GPU.
struct Wall {
    gpu: &'static Gpu,
    stamps: Stamps,
    field: Field,
    set: StampSet,
}

impl Wall {
    fn new(size: [u32; 2], addressing: Addressing, height: f32) -> Option<Self> {
        let gpu = gpu()?;
        let stamps = Stamps::new(gpu).expect("the shader compiles");
        let field = Field::new(gpu, size, addressing, false);
        let set = stamps.bind(gpu, &field, &images());
        let wall = Self { gpu, stamps, field, set };
        wall.clear(height);
        Some(wall)
    }

    /// One height everywhere, and clean.
    fn clear(&self, height: f32) {
        let count = self.field.size[0] as usize * self.field.size[1] as usize;
        self.field.relief.write(self.gpu, &vec![height; count]);
        self.field.material.write(self.gpu, &vec![0_u32; count]);
    }

    fn press(&mut self, stamps: &[Stamp]) -> Dirty {
        run(self.gpu, |recorder| self.stamps.record(recorder, &mut self.set, stamps)).expect("the stamps fit every buffer")
    }

    fn relief(&self) -> Vec<f32> {
        read(self.gpu, &self.field.relief)
    }

    fn material(&self) -> Vec<Marks> {
        read::<_, u32>(self.gpu, &self.field.material).into_iter().map(Marks::from_bits).collect()
    }
}

/// Stamps of all kinds, of a radius up to `largest`, all over the field and over its border.
fn any_stamps(seed: u64, count: u64, size: [u32; 2], largest: f64) -> Vec<Stamp> {
    (0..count)
        .map(|number| {
            let mut random = Random::new(seed, Stream::Hand, number);
            let mut pick = |from: usize| (random.unit() * from as f64) as usize;
            let (profile, blend) = (Profile::ALL[pick(5)], Blend::ALL[pick(4)]);
            Stamp {
                at_seconds: random.between(3.0, 4.0),
                centre: [0, 1].map(|axis| random.between(-4.0, f64::from(size[axis]) + 4.0) as f32),
                radius: random.between(0.6, largest) as f32,
                height: random.between(-0.2, 0.2) as f32,
                level: random.between(0.3, 0.9) as f32,
                profile,
                blend,
                alpha: random.unit() as f32,
                irregularity: if random.unit() < 0.5 { 0.0 } else { random.unit() as f32 },
                phase: random.between(0.0, 7.0) as f32,
                soot: random.unit() as f32,
                bare: random.unit() as f32,
                gloss: random.unit() as f32,
                heat: random.unit() as f32,
                ..Stamp::default()
            }
        })
        .collect()
}

/// The same, swept, some of them joined to a segment before, some with a tread, and some of them images instead.
fn any_forms(seed: u64, count: u64, size: [u32; 2], largest: f64) -> Vec<Stamp> {
    let forms = |(number, stamp): (usize, Stamp)| {
        let mut random = Random::new(seed + 77, Stream::Hand, number as u64);
        let mut any = |low: f64, high: f64| random.between(low, high) as f32;
        if number % 4 == 0 {
            let half_extent = [any(1.0, 0.7 * largest), any(1.0, 0.7 * largest)];
            let image = ImageForm { number: (number / 4 % 2) as u32, half_extent, turn: any(0.0, 7.0) };
            return Stamp { radius: half_extent[0].hypot(half_extent[1]), image: Some(image), ..stamp };
        }
        let span = [any(-25.0, 25.0), if number % 4 == 1 { 0.0 } else { any(-25.0, 25.0) }];
        let joins = if number % 3 == 0 { [any(-25.0, 25.0), any(-25.0, 25.0)] } else { [0.0; 2] };
        let tread = if number % 2 == 0 { any(0.0, 1.0) } else { 0.0 };
        Stamp { span, joins, tread, lug_texels: any(2.0, 9.0), along: any(0.0, 99.0), ..stamp }
    };
    any_stamps(seed, count, size, largest).into_iter().enumerate().map(forms).collect()
}

/// A slope from corner to corner, and noise.
fn images() -> Vec<StampImage> {
    let slope = (0..35).map(|index| (index % 7) as f32 / 12.0 + (index / 7) as f32 / 8.0).collect();
    let noise = (0..64).map(|number| Random::new(1, Stream::Hand, number).unit() as f32).collect();
    vec![StampImage { size: [7, 5], values: slope }, StampImage { size: [8, 8], values: noise }]
}

/// What the reference makes of them.
fn layers(size: [u32; 2], wrap: bool, height: f64) -> Layers {
    Layers { images: images(), ..Layers::flat(size.map(|size| size as usize), wrap, height) }
}

/// Largest difference of relief and of material, away from texels where f32 cannot tell on which side of a hard edge they lie.
fn compare(wall: &Wall, expected: &Layers, stamps: &[Stamp]) -> (f64, f64) {
    let unsure = |index: usize| stamps.iter().any(|stamp| on_edge(stamp, index, expected.size));
    let relief = wall.relief();
    let material = wall.material();
    let (mut worst, mut apart) = ((0.0_f64, 0.0_f64), 0);
    for index in (0..relief.len()).filter(|index| !unsure(*index)) {
        worst.0 = worst.0.max((f64::from(relief[index]) - expected.relief[index]).abs());
        let levels = differences(material[index], expected.material[index]);
        worst.1 = worst.1.max(levels.into_iter().fold(0.0, f64::max));
        apart += usize::from(levels != [0.0; 4]);
    }
    // A level is decided otherwise where rounding meets a half, which is rare.
    // Where much of a stamp has one value a half flips all of it, and after a segment that covers nearly all, what is left to cover is
    // a quotient of small numbers.
    let rare = stamps.len() * relief.len() / 50;
    assert!(apart <= 2 + rare, "{apart} texels of {} differ by a level", relief.len());
    worst
}

/// Levels by which soot, bareness and gloss differ, and moments by which heat does.
fn differences(a: Marks, b: Marks) -> [f64; 4] {
    let turn = f64::from(rilievo::field::material::MOMENTS);
    let moments = (f64::from(a.heat) - f64::from(b.heat)).abs();
    let heat = if (a.heat == 0) == (b.heat == 0) { moments.min(turn - moments) } else { turn };
    let apart = |a: u8, b: u8| f64::from(a.abs_diff(b));
    [apart(a.soot, b.soot), apart(a.bare, b.bare), apart(a.gloss, b.gloss), heat]
}

/// Whether a texel, in some image of the field, lies within rounding of the edge of a stamp, where a disc, or any min, max or
/// replace, jumps.
fn on_edge(stamp: &Stamp, index: usize, size: [usize; 2]) -> bool {
    let radius = f64::from(stamp.radius);
    let length = f64::from(stamp.span[0].hypot(stamp.span[1]));
    let reach = ((radius + length) / size[0].min(size[1]) as f64).ceil() as i64 + 1;
    (-reach..=reach).any(|image_y| {
        (-reach..=reach).any(|image_x| {
            let x = (index % size[0]) as f64 + (image_x * size[0] as i64) as f64 - f64::from(stamp.centre[0]);
            let y = (index / size[0]) as f64 + (image_y * size[1] as i64) as f64 - f64::from(stamp.centre[1]);
            if let Some(form) = stamp.image {
                let (sin, cos) = f64::from(form.turn).sin_cos();
                let along = [x * cos + y * sin, y * cos - x * sin];
                let border = |axis: usize| (along[axis].abs() - f64::from(form.half_extent[axis])).abs() < 1e-5 * (1.0 + radius);
                return border(0) || border(1);
            }
            let (away, _) = from_segment([x, y], stamp.span);
            // Irregular discs, and what they lay bare, end within it.
            let rho = stamp::stretched(stamp, away);
            (away[0].hypot(away[1]) - radius).abs() < 2e-6 * (1.0 + radius) || (rho - 1.0).abs() < 1e-5
        })
    })
}

#[test]
fn every_profile_and_blend_equals_the_reference() {
    for (addressing, wrap) in [(Addressing::Wrap, true), (Addressing::Clamp, false)] {
        let size = [45, 38];
        let Some(mut wall) = Wall::new(size, addressing, 0.75) else { return };
        for profile in Profile::ALL {
            for blend in Blend::ALL {
                for stamp in any_stamps(1, 6, size, 20.0).into_iter().chain(any_forms(2, 8, size, 12.0)) {
                    let stamp = Stamp { profile, blend, ..stamp };
                    wall.clear(0.75);
                    let mut expected = layers(size, wrap, 0.75);
                    wall.press(&[stamp]);
                    expected.press(&stamp);
                    let (relief, material) = compare(&wall, &expected, &[stamp]);
                    assert!(relief <= STAMP_HEIGHT, "{stamp:?}: relief differs by {relief:.2e}");
                    assert!(material <= STAMP_MATERIAL, "{stamp:?}: material differs by {material:.2e}");
                }
            }
        }
    }
}

#[test]
fn many_stamps_on_top_of_one_another_equal_the_reference_in_their_order() {
    for (addressing, wrap) in [(Addressing::Wrap, true), (Addressing::Clamp, false)] {
        for size in [[61, 47], [64, 64], [1, 40], [40, 1], [1, 1], [5, 3]] {
            let stamps = any_stamps(u64::from(size[0]), 60, size, 12.0);
            let Some(mut wall) = Wall::new(size, addressing, 0.5) else { return };
            let mut expected = layers(size, wrap, 0.5);
            wall.press(&stamps);
            stamps.iter().for_each(|stamp| expected.press(stamp));
            let (relief, material) = compare(&wall, &expected, &stamps);
            // On a tiny wrapping field one stamp falls upon a texel many times.
            let largest = expected.relief.iter().fold(1.0_f64, |largest, height| largest.max(height.abs()));
            let falls = 60.0 * if wrap { (24.0 / f64::from(size[0].min(size[1])) + 1.0).powi(2) } else { 1.0 };
            assert!(
                relief <= STAMP_HEIGHT_EACH * falls * largest,
                "{size:?}, wrap {wrap}: {relief:.2e}, {falls} falls, {largest}"
            );
            assert!(material <= STAMP_MATERIAL, "{size:?}, wrap {wrap}: material differs by {material:.2e}");
        }
    }
}

#[test]
fn the_order_of_replacing_matters_and_is_that_of_submission() {
    let disc = |level| Stamp {
        centre: [20.0, 20.0],
        level,
        height: 0.0,
        blend: Blend::Replace,
        profile: Profile::Disc,
        ..Stamp::default()
    };
    for order in [[0.2, 0.6], [0.6, 0.2]] {
        let Some(mut wall) = Wall::new([40, 40], Addressing::Clamp, 1.0) else { return };
        wall.press(&order.map(disc));
        assert_eq!(wall.relief()[20 * 40 + 20], order[1]);
    }
}

#[test]
fn min_and_max_are_the_same_in_every_order_to_the_bit() {
    for blend in [Blend::Min, Blend::Max] {
        let size = [70, 50];
        let stamps = any_stamps(9, 200, size, 15.0).into_iter().chain(any_forms(8, 100, size, 12.0));
        let mut stamps: Vec<_> = stamps.map(|stamp| Stamp { blend, ..stamp }).collect();
        let pressed = |stamps: &[Stamp]| {
            let mut wall = Wall::new(size, Addressing::Wrap, 0.6)?;
            wall.press(stamps);
            Some(wall.relief().into_iter().map(f32::to_bits).collect::<Vec<_>>())
        };
        let Some(expected) = pressed(&stamps) else { return };
        stamps.reverse();
        assert!(pressed(&stamps).as_ref() == Some(&expected), "{blend:?} reversed");
        // A riffle: the second half between the first.
        let (first, second) = stamps.split_at(150);
        let riffled: Vec<_> = first.iter().zip(second).flat_map(|(a, b)| [*b, *a]).collect();
        assert!(pressed(&riffled).as_ref() == Some(&expected), "{blend:?} riffled");
    }
}

#[test]
fn the_volume_of_smooth_profiles_is_the_analytic_one() {
    for profile in [Profile::Bump, Profile::Crater, Profile::Cone, Profile::Rut] {
        let size = [256, 256];
        let stamps: Vec<_> = any_stamps(4, 40, size, 30.0)
            .into_iter()
            .map(|stamp| Stamp {
                radius: stamp.radius.max(12.0),
                height: stamp.height.abs() + 0.05,
                profile,
                blend: Blend::Add,
                irregularity: 0.0,
                ..stamp
            })
            .collect();
        let Some(mut wall) = Wall::new(size, Addressing::Wrap, 0.0) else { return };
        wall.press(&stamps);
        let volume: f64 = wall.relief().into_iter().map(f64::from).sum();
        let expected: f64 =
            stamps.iter().map(|stamp| f64::from(stamp.height) * f64::from(stamp.radius).powi(2) * profile.volume()).sum();
        let error = (volume / expected - 1.0).abs();
        println!("{profile:?}: volume {volume:.3}, relative error {error:.1e}");
        assert!(error <= STAMP_VOLUME, "{profile:?}: {volume} of {expected}");
    }
}

/// Volume of a profile swept along a texel's length: the integral of its cross-section, by Simpson's rule.
fn cross_section(profile: Profile) -> f64 {
    let steps = 20_000;
    let weight = |step: u32| if step == 0 || step == steps { 1.0 } else { f64::from(2 + 2 * (step % 2)) };
    let sum: f64 = (0..=steps).map(|step| weight(step) * stamp::profile(profile, f64::from(step) / f64::from(steps))).sum();
    2.0 * sum / (3.0 * f64::from(steps))
}

#[test]
fn the_volume_of_a_capsule_is_that_of_its_body_and_its_two_ends() {
    assert!((cross_section(Profile::Bump) - 16.0 / 15.0).abs() < 1e-9, "{}", cross_section(Profile::Bump));
    for profile in [Profile::Bump, Profile::Crater, Profile::Cone, Profile::Rut] {
        let size = [256, 256];
        for stamp in any_stamps(6, 12, size, 20.0) {
            let Some(mut wall) = Wall::new(size, Addressing::Wrap, 0.0) else { return };
            let span = [90.0 * stamp.phase.cos(), 90.0 * stamp.phase.sin()];
            let capsule = Stamp {
                span,
                radius: stamp.radius.max(12.0),
                height: 0.2,
                profile,
                blend: Blend::Add,
                irregularity: 0.0,
                ..stamp
            };
            wall.press(&[capsule]);
            let volume: f64 = wall.relief().into_iter().map(f64::from).sum();
            let radius = f64::from(capsule.radius);
            let expected = 0.2_f32 as f64 * (profile.volume() * radius * radius + cross_section(profile) * radius * 90.0);
            let error = (volume / expected - 1.0).abs();
            assert!(error <= STAMP_VOLUME, "{profile:?}: {volume} of {expected}, {error:.1e}");
        }
    }
}

#[test]
fn a_chain_of_segments_presses_what_one_sweep_would() {
    let size = [160, 120];
    for (profile, pieces) in [(Profile::Bump, 3), (Profile::Rut, 25), (Profile::Crater, 15)] {
        let whole = Stamp {
            centre: [20.3, 30.7],
            span: [110.0, 55.0],
            radius: 9.0,
            height: -0.2,
            profile,
            // Soot falls most round a crater's rim, and no later piece takes it away again.
            soot: if profile == Profile::Crater { 0.0 } else { 0.7 },
            gloss: 0.6,
            bare: 0.5,
            ..Stamp::default()
        };
        let step = whole.span.map(|along| along / pieces as f32);
        let chain: Vec<_> = (0..pieces)
            .map(|piece| Stamp {
                centre: [0, 1].map(|axis| whole.centre[axis] + piece as f32 * step[axis]),
                span: step,
                joins: if piece == 0 { [0.0; 2] } else { step.map(|along| -along) },
                ..whole
            })
            .collect();
        let (Some(mut one), Some(mut many)) = (Wall::new(size, Addressing::Wrap, 0.5), Wall::new(size, Addressing::Wrap, 0.5))
        else {
            return;
        };
        one.press(&[whole]);
        many.press(&chain);
        let relief = one.relief().into_iter().zip(many.relief()).map(|(a, b)| f64::from((a - b).abs())).fold(0.0, f64::max);
        assert!(relief <= f64::from(pieces) * STAMP_CHAIN_EACH, "{profile:?} in {pieces}: {relief:.1e}");
        // Each piece rounds to whole levels.
        let material =
            one.material().into_iter().zip(many.material()).map(|(a, b)| differences(a, b).into_iter().fold(0.0, f64::max));
        let worst = material.fold(0.0, f64::max);
        assert!(worst <= 3.0, "{profile:?} in {pieces}: {worst} levels");
    }
}

#[test]
fn a_swept_stamp_wraps_at_every_border_and_a_clamped_one_ends_there() {
    for (centre, span) in [([5.0, 60.0], [-20.0, 0.0]), ([5.0, 3.0], [-20.0, -30.0]), ([75.0, 55.0], [30.0, 40.0])] {
        for (addressing, wrap) in [(Addressing::Wrap, true), (Addressing::Clamp, false)] {
            let stamp = Stamp { centre, span, radius: 4.0, height: -0.3, tread: 0.5, lug_texels: 5.0, ..Stamp::default() };
            let Some(mut wall) = Wall::new([80, 64], addressing, 1.0) else { return };
            wall.press(&[stamp]);
            let mut expected = layers([80, 64], wrap, 1.0);
            expected.press(&stamp);
            let (relief, _) = compare(&wall, &expected, &[stamp]);
            assert!(relief <= STAMP_HEIGHT, "{addressing:?} {centre:?}: {relief:.1e}");
        }
    }
}

#[test]
fn an_image_is_pressed_as_it_is_turned_and_stretched() {
    // Upright and a texel a texel it is the image itself, mirrored by half a turn.
    let image = &images()[0];
    for (turn, mirrored) in [(0.0, false), (std::f32::consts::PI, true)] {
        let Some(mut wall) = Wall::new([20, 20], Addressing::Clamp, 0.0) else { return };
        let form = ImageForm { number: 0, half_extent: [3.5, 2.5], turn };
        wall.press(&[Stamp { height: 1.0, ..Stamp::of_image(form, [10.0, 10.0]) }]);
        let relief = wall.relief();
        for y in 0..5 {
            for x in 0..7 {
                let index = if mirrored { (4 - y) * 7 + 6 - x } else { y * 7 + x };
                let (actual, expected) = (relief[(y + 8) * 20 + x + 7], image.values[index]);
                assert!((actual - expected).abs() < 1e-5, "{x}, {y}: {actual} for {expected}");
            }
        }
    }
}

#[test]
fn a_stamp_over_the_corner_of_a_wrapping_field_lands_on_all_four_corners() {
    let corners = [0, 31, 31 * 32, 31 * 32 + 31];
    let stamp = Stamp { centre: [-0.5, 31.5], radius: 4.0, profile: Profile::Bump, height: -0.3, ..Stamp::default() };
    let Some(mut wall) = Wall::new([32, 32], Addressing::Wrap, 1.0) else { return };
    let dirty = wall.press(&[stamp]);
    let relief = wall.relief();
    // The centre lies half a texel from each of them: the same to the bit.
    assert!(corners.iter().all(|corner| relief[*corner] == relief[0] && relief[0] < 0.75), "{:?}", corners.map(|c| relief[c]));
    let held = dirty.regions([32, 32]);
    assert_eq!(held.len(), 4, "{held:?}");
    let Some(mut wall) = Wall::new([32, 32], Addressing::Clamp, 1.0) else { return };
    wall.press(&[stamp]);
    let relief = wall.relief();
    assert!(relief[corners[2]] < 0.75 && [0, 1, 3].iter().all(|corner| relief[corners[*corner]] == 1.0));
}

#[test]
fn a_stamp_larger_than_a_wrapping_field_falls_upon_it_as_often_as_it_covers_it() {
    let stamp = Stamp { centre: [3.0, 2.0], radius: 40.0, height: 0.001, profile: Profile::Disc, ..Stamp::default() };
    let Some(mut wall) = Wall::new([7, 5], Addressing::Wrap, 0.0) else { return };
    wall.press(&[stamp]);
    let mut expected = Layers::flat([7, 5], true, 0.0);
    expected.press(&stamp);
    let (relief, _) = compare(&wall, &expected, &[stamp]);
    assert!(expected.relief.iter().all(|height| *height > 0.13), "some 143 images");
    assert!(relief <= 143.0 * STAMP_HEIGHT_EACH * 0.15, "{relief:.2e}");
}

#[test]
fn nothing_changes_outside_what_is_said_to_be_dirty_nor_beyond_a_radius() {
    for addressing in [Addressing::Wrap, Addressing::Clamp] {
        let size = [120, 90];
        let Some(mut wall) = Wall::new(size, addressing, 0.5) else { return };
        for seed in 0..20 {
            let before = (wall.relief(), wall.material());
            let stamps = any_stamps(seed, 1 + seed % 6, size, 9.0);
            let dirty = wall.press(&stamps).regions(size);
            let after = (wall.relief(), wall.material());
            for index in 0..before.0.len() {
                let texel = [index as u32 % size[0], index as u32 / size[0]];
                let held = dirty.iter().any(|region| {
                    (0..2).all(|axis| (region.origin[axis]..region.origin[axis] + region.extent[axis]).contains(&texel[axis]))
                });
                assert!(
                    held || (before.0[index] == after.0[index] && before.1[index] == after.1[index]),
                    "{texel:?} of {dirty:?}"
                );
            }
        }
    }
}

#[test]
fn frames_of_stamps_equal_one_frame_of_them_all() {
    let size = [60, 60];
    let stamps: Vec<_> = any_stamps(2, 90, size, 10.0).into_iter().chain(any_forms(3, 30, size, 10.0)).collect();
    let (Some(mut one), Some(mut many)) = (Wall::new(size, Addressing::Wrap, 0.5), Wall::new(size, Addressing::Wrap, 0.5)) else {
        return;
    };
    one.press(&stamps);
    stamps.chunks(7).for_each(|chunk| {
        many.press(chunk);
    });
    assert_eq!(one.relief(), many.relief());
    assert_eq!(one.material(), many.material());
}

#[test]
fn stamps_that_are_no_numbers_or_off_the_field_change_nothing() {
    let at = |centre, radius| Stamp { centre, radius, soot: 1.0, ..Stamp::default() };
    let (nan, infinity) = (f32::NAN, f32::INFINITY);
    let stamps = [
        at([nan, 4.0], 3.0),
        at([4.0, infinity], 3.0),
        at([4.0, 4.0], nan),
        at([4.0, 4.0], infinity),
        at([4.0, 4.0], 0.0),
        at([4.0, 4.0], -3.0),
        at([1e30, 4.0], 3.0),
    ];
    for addressing in [Addressing::Wrap, Addressing::Clamp] {
        let Some(mut wall) = Wall::new([16, 16], addressing, 0.5) else { return };
        assert_eq!(wall.press(&stamps), Dirty::Nothing);
        assert!(wall.relief().iter().all(|height| *height == 0.5));
    }
    let Some(mut wall) = Wall::new([16, 16], Addressing::Clamp, 0.5) else { return };
    assert_eq!(wall.press(&[at([-3.0, 4.0], 2.9), at([40.0, 4.0], 8.0)]), Dirty::Nothing);
    assert_eq!(wall.press(&[]), Dirty::Nothing);
}

#[test]
fn ten_thousand_fit_and_what_does_not_fit_says_so() {
    let size = [1024, 1024];
    let Some(mut wall) = Wall::new(size, Addressing::Wrap, 0.5) else { return };
    let discs: Vec<_> = stress_discs(0, 0, 10_000, 8.0, size).collect();
    assert_eq!(wall.press(&discs), Dirty::All);
    let lifted: Vec<_> = stress_discs(0, 1, 10_000, 8.0, size).collect();
    wall.press(&lifted);
    let uneven = wall.relief().into_iter().map(|height| (height - 0.5).abs()).fold(0.0, f32::max);
    assert!(uneven < 1e-5, "what was pressed is lifted again: {uneven}");

    let huge = vec![Stamp { radius: 1e6, ..Stamp::default() }; 3];
    let before = wall.relief();
    let error =
        run(wall.gpu, |recorder| wall.stamps.record(recorder, &mut wall.set, &huge)).expect_err("no buffer is that large");
    assert!(matches!(error, BinError::TooMany { discs: 3, .. }));
    assert!(error.to_string().ends_with("press fewer or smaller ones"), "{error}");
    // What leaves soot takes more room than its place in a tile's list.
    let count = List::<StampExtra>::limit(wall.gpu) as usize + 1;
    let sooty = Stamp { centre: [512.0, 512.0], radius: 0.1, soot: 1.0, ..Stamp::default() };
    let error =
        run(wall.gpu, |recorder| wall.stamps.record(recorder, &mut wall.set, &vec![sooty; count])).expect_err("nor so long");
    assert!(matches!(error, BinError::TooManyDiscs { discs, .. } if discs == count), "{error}");
    assert!(error.to_string().contains("fall in one frame"), "{error}");
    assert_eq!(before, wall.relief());
}

#[test]
fn four_thousand_stamps_cost_at_most_two_wave_steps() {
    let Some(gpu) = own_gpu() else { return };
    let gpu = &gpu;
    let size = [1024, 1024];
    let (stamps, waves) = (Stamps::new(gpu).expect("the shader compiles"), Waves::new(gpu).expect("the shader compiles"));
    let field = Field::new(gpu, size, Addressing::Wrap, false);
    let wave = scene::Wave { boundary: Boundary::Periodic, ..scene::Wave::default() };
    let (mut wall, mut pool) = (stamps.bind(gpu, &field, &[]), waves.bind(gpu, size, &wave, [1.0, 1.0]));
    let seconds = |record: &mut dyn FnMut(&mut Recorder<'_>)| {
        let start = Instant::now();
        run(gpu, record);
        start.elapsed().as_secs_f64()
    };
    // Each alone from its recording to its end, which is what every adapter can tell; in turn, so that both see the same machine.
    let mut in_steps = |stamps_of: &dyn Fn(u64) -> Vec<Stamp>| {
        let mut ratios: Vec<_> = (0..15)
            .map(|frame| {
                let pressed = stamps_of(frame);
                let steps = seconds(&mut |recorder| assert_eq!(waves.record(recorder, &mut pool, 2, &[]), Ok(true)));
                2.0 * seconds(&mut |recorder| assert_eq!(stamps.record(recorder, &mut wall, &pressed), Ok(Dirty::All))) / steps
            })
            .collect();
        ratios.sort_by(f64::total_cmp);
        ratios[7]
    };
    let discs = |frame| stress_discs(0, frame, 4096, 8.0, size).collect::<Vec<_>>();
    let craters = |frame| {
        let crater = |disc| Stamp { profile: Profile::Crater, irregularity: 0.5, soot: 0.5, bare: 1.0, ..disc };
        stress_discs(0, frame, 4096, 8.0, size).map(crater).collect::<Vec<_>>()
    };
    // What a stamp can do at most; its margin is too small to be held to it on a busy machine.
    println!("4,096 irregular craters with soot, radius 8 at 1024²: {:.2} wave steps", in_steps(&craters));
    // The other tests run beside this one and disturb it; one quiet spell is enough.
    let steps = (0..5).map(|_| in_steps(&discs)).find(|steps| *steps <= STAMP_BUDGET_STEPS);
    println!("4,096 discs: {steps:.2?} wave steps");
    assert!(steps.is_some(), "4,096 discs cost more than {STAMP_BUDGET_STEPS} wave steps, five times over");
}

#[test]
fn a_crater_blackens_its_surroundings_and_bares_its_inside() {
    let Some(mut wall) = Wall::new([64, 64], Addressing::Clamp, 1.0) else { return };
    let crater = Stamp { centre: [32.0, 32.0], radius: 24.0, profile: Profile::Crater, soot: 0.9, bare: 1.0, ..Stamp::default() };
    wall.press(&[crater]);
    let material = wall.material();
    let at = |away: f64| material[32 * 64 + 32 + (away * 24.0) as usize];
    assert_eq!(at(0.0).bare, 255);
    assert_eq!(at(CRATER_RIM + 0.1).bare, 0);
    assert!(at(CRATER_RIM + 0.1).soot > 50, "soot beyond the rim: {:?}", at(CRATER_RIM + 0.1));
}

#[test]
fn ten_thousand_small_stamps_cost_what_they_touch_and_not_the_field() {
    let Some(gpu) = gpu() else { return };
    let camera = Camera::at(&scene::Camera::default(), 0.0);
    let bytes = |side: u32, count: u32, radius: f32| {
        let field = scene::FieldSettings { size: [side; 2], addressing: Addressing::Wrap };
        let wall = Scene { field, ..Scene::default() };
        let heights = vec![0.5; (side * side) as usize];
        let mut frame = Frame::new(gpu, &Start::new(&wall, heights, None), [8, 8], PICTURE_FORMAT).expect("its shaders compile");
        let picture = Picture::new(gpu, [8, 8]);
        let mut moved = [0; 2];
        for (number, moved) in (0..).zip(&mut moved) {
            let tick = Tick::default();
            let presses = if number == 0 { Vec::new() } else { stress_discs(0, number, count, radius, [side; 2]).collect() };
            let strokes = Strokes { presses, ..Strokes::default() };
            let input = FrameInput { tick: &tick, strokes: &strokes, camera: &camera, display: Shows::Picture.into() };
            let mut encoder = gpu.encoder("test");
            frame.record(gpu, &mut encoder, &input, Some(picture.view())).expect("they fit");
            frame.finish(gpu, encoder);
            *moved = frame.field_traffic_bytes();
        }
        // Against a frame in which all of it changed.
        (moved[1], moved[1] as f64 / moved[0] as f64)
    };
    for radius in [1.0, 2.0, 4.0, 8.0, 16.0] {
        let (moved, share) = bytes(2048, 10_000, radius);
        println!("10,000 stamps of radius {radius} at 2048²: {:.1} MB, {share:.2} of a whole frame's", moved as f64 / 1e6);
    }
    // The same stamps on a field of four times the texels.
    let [small, large] = [1024, 2048].map(|side| bytes(side, 1000, 2.0));
    println!("1,000 of radius 2: {:.2} MB at 1024², {:.2} MB at 2048²", small.0 as f64 / 1e6, large.0 as f64 / 1e6);
    assert!(large.0 as f64 <= STAMP_COST_GROWTH * small.0 as f64 && large.1 < 0.15, "{small:?}, {large:?}");
}

#[test]
fn the_lists_of_stamps_are_memory_too() {
    let Some(gpu) = gpu() else { return };
    let wall = Scene { field: scene::FieldSettings { size: [64; 2], addressing: Addressing::Wrap }, ..Scene::default() };
    let camera = Camera::at(&scene::Camera::default(), 0.0);
    let bytes = |count: u32| {
        let start = Start::new(&wall, vec![0.5; 64 * 64], None);
        let mut frame = Frame::new(gpu, &start, [8, 8], PICTURE_FORMAT).expect("its shaders compile");
        let picture = Picture::new(gpu, [8, 8]);
        let strokes = Strokes { presses: stress_discs(0, 0, count, 0.1, [64; 2]).collect(), ..Strokes::default() };
        let tick = Tick::default();
        let input = FrameInput { tick: &tick, strokes: &strokes, camera: &camera, display: Shows::Picture.into() };
        let mut encoder = gpu.encoder("test");
        frame.record(gpu, &mut encoder, &input, Some(picture.view())).expect("they fit");
        frame.finish(gpu, encoder);
        frame.memory_bytes()
    };
    // Discs of less than a texel, one entry each at most: records of 20 bytes for all of them, and a power of two for those that meet
    // a texel, of whose entries each takes 16 bytes.
    let grown = bytes(4096) - bytes(0);
    assert!(grown >= 4096 * 20 - 64 * 20, "{grown} bytes for 4,096 stamps");
    // What is not used has room for a few: all lists of a small field together are small.
    let textures = (29.5 * 64.0 * 64.0) as u64;
    assert!((textures + 10_000..textures + 100_000).contains(&bytes(0)), "{}", bytes(0));
}
