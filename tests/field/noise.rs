//! Procedural heights against their reference, and what all patterns have in common.

use rilievo::field::noise::{Ground, Instant, Patterns, salt};
use rilievo::gpu::Gpu;
use rilievo::reference::{Addressing, noise};
use rilievo::scene::{ColumnShape, Columns, Dunes, Fold, FractalNoise, Gears, NoisePattern, Scales};

use crate::support::fields::ADDRESSINGS;
use crate::support::gpu::{gpu, read, run};
use crate::support::tolerances::NOISE_HEIGHT;

/// A field a metre wide.
pub fn ground(size: [u32; 2], addressing: Addressing) -> Ground {
    Ground { size, texel_metres: 1.0 / f64::from(size[0].max(size[1])), addressing, salt: salt(7) }
}

/// The heights of a pattern on the GPU.
pub fn evaluated(gpu: &Gpu, pattern: &NoisePattern, ground: &Ground, time_seconds: f64) -> Vec<f32> {
    let patterns = Patterns::new(gpu).expect("the shaders compile");
    let mut set = patterns.bind(gpu, ground.size);
    // What was there before is of no account.
    set.heights.write(gpu, &vec![f32::NAN; (ground.size[0] * ground.size[1]) as usize]);
    assert!(run(gpu, |recorder| patterns.record(recorder, &mut set, Instant::new(pattern, ground, time_seconds))));
    read(gpu, &set.heights)
}

/// One pattern of each kind and choice.
fn patterns() -> Vec<NoisePattern> {
    let fractal = FractalNoise { drift_metres_per_second: [0.03, -0.02], ..FractalNoise::default() };
    let mut all: Vec<_> = Fold::ALL.iter().map(|&fold| NoisePattern::Fractal(FractalNoise { fold, ..fractal.clone() })).collect();
    all.extend(ColumnShape::ALL.iter().map(|&shape| NoisePattern::Columns(Columns { shape, ..Columns::default() })));
    all.push(NoisePattern::Scales(Scales::default()));
    all.push(NoisePattern::Gears(Gears::default()));
    all.push(NoisePattern::Dunes(Dunes { wind_degrees: 25.0, ..Dunes::default() }));
    all
}

/// The start, a moment, and the same after 11 days.
const TIMES: [f64; 3] = [0.0, 0.37, 1e6 + 0.37];

#[test]
fn every_height_is_the_references_at_any_time() {
    let Some(gpu) = gpu() else { return };
    for pattern in patterns() {
        let mut worst = 0.0_f64;
        for size in [[1, 1], [1, 33], [40, 1], [67, 131], [255, 257]] {
            for addressing in ADDRESSINGS {
                let ground = ground(size, addressing);
                for time in TIMES {
                    for (texel, actual) in (0..).zip(evaluated(gpu, &pattern, &ground, time)) {
                        let [x, y] = [texel % size[0], texel / size[0]];
                        let expected = noise::height(&pattern, &ground, time, x, y);
                        let off = (f64::from(actual) - expected).abs();
                        worst = worst.max(off);
                        assert!(
                            off <= NOISE_HEIGHT && (0.0..=1.0).contains(&actual),
                            "{pattern:?} {size:?} {addressing:?} at {x}, {y}, {time} s: {actual} for {expected}"
                        );
                    }
                }
            }
        }
        println!("{}: {worst:.2e}", pattern.name());
    }
}

#[test]
fn a_frame_alone_is_that_of_a_long_run_to_the_bit() {
    let Some(gpu) = gpu() else { return };
    let passes = Patterns::new(gpu).expect("the shaders compile");
    for pattern in patterns() {
        let ground = ground([67, 45], Addressing::Wrap);
        let mut set = passes.bind(gpu, ground.size);
        for frame in 0..=90 {
            let instant = Instant::new(&pattern, &ground, f64::from(frame) / 60.0);
            run(gpu, |recorder| passes.record(recorder, &mut set, instant));
        }
        let long: Vec<u32> = read(gpu, &set.heights);
        let alone: Vec<u32> = evaluated(gpu, &pattern, &ground, 1.5).into_iter().map(f32::to_bits).collect();
        assert!(long == alone, "{pattern:?}");
    }
}

#[test]
fn time_moves_every_pattern_smoothly_after_eleven_days_too() {
    for pattern in patterns() {
        let ground = ground([48, 48], Addressing::Wrap);
        let [soon, late] = [0.0, 1e6].map(|start| {
            let frame = |number: u32| -> Vec<f64> {
                let time = start + f64::from(number) / 60.0;
                (0..48 * 48).map(|texel| noise::height(&pattern, &ground, time, texel % 48, texel / 48)).collect()
            };
            let frames: Vec<_> = (0..20).map(frame).collect();
            frames
                .windows(2)
                .map(|pair| pair[0].iter().zip(&pair[1]).map(|(a, b)| (a - b).abs()).sum::<f64>() / (48.0 * 48.0))
                .collect::<Vec<_>>()
        });
        // It moves in every frame, never by a multiple of what it did at the start.
        let most = soon.iter().copied().fold(0.0, f64::max);
        assert!(
            soon.iter().chain(&late).all(|&moved| moved > 0.02 * most && moved < 3.0 * most),
            "{pattern:?}: {soon:?} {late:?}"
        );
    }
}

#[test]
fn a_wrapping_field_has_no_seam() {
    let Some(gpu) = gpu() else { return };
    for pattern in patterns() {
        let size = [120, 90];
        let heights = evaluated(gpu, &pattern, &ground(size, Addressing::Wrap), 0.8);
        let at = |x: u32, y: u32| heights[(y % size[1] * size[0] + x % size[0]) as usize];
        let largest = |texels: &mut dyn Iterator<Item = (u32, u32)>, dx: u32, dy: u32| {
            texels.map(|(x, y)| (at(x + dx, y + dy) - at(x, y)).abs()).fold(0.0, f32::max)
        };
        let inside = |dx, dy| largest(&mut (0..89).flat_map(|y| (0..119).map(move |x| (x, y))), dx, dy);
        let seams = [largest(&mut (0..90).map(|y| (119, y)), 1, 0), largest(&mut (0..120).map(|x| (x, 89)), 0, 1)];
        assert!(seams[0] <= inside(1, 0) && seams[1] <= inside(0, 1), "{pattern:?}: {seams:?}");
        // And it is the same pattern beyond the border, which a seam that only looks smooth would not be.
        let ground = ground(size, Addressing::Wrap);
        for (x, y) in [(3, 4), (119, 89), (60, 0)] {
            let here = noise::height(&pattern, &ground, 0.8, x, y);
            let there = noise::height(&pattern, &ground, 0.8, x + size[0], y + 2 * size[1]);
            assert!((here - there).abs() < 1e-9, "{pattern:?} at {x}, {y}: {here} and {there}");
        }
    }
}

#[test]
fn an_instant_that_is_shown_already_is_not_evaluated_again() {
    let Some(gpu) = gpu() else { return };
    let passes = Patterns::new(gpu).expect("the shaders compile");
    let ground = ground([9, 5], Addressing::Clamp);
    let mut set = passes.bind(gpu, ground.size);
    let still = FractalNoise { evolution_per_second: 0.0, ..FractalNoise::default() };
    let mut shows = |fractal: &FractalNoise, time: f64| {
        let instant = Instant::new(&NoisePattern::Fractal(fractal.clone()), &ground, time);
        run(gpu, |recorder| passes.record(recorder, &mut set, instant))
    };
    assert!(shows(&still, 0.0));
    assert!(!shows(&still, 5.0));
    assert!(shows(&FractalNoise { contrast: 2.0, ..still.clone() }, 5.0));
    set.forget();
    let instant = Instant::new(&NoisePattern::Fractal(still), &ground, 5.0);
    assert!(run(gpu, |recorder| passes.record(recorder, &mut set, instant)));
}

#[test]
fn seeds_differ() {
    for pattern in patterns().into_iter().filter(|pattern| !matches!(pattern, NoisePattern::Gears(_))) {
        let one = ground([32, 32], Addressing::Clamp);
        let other = Ground { salt: salt(8), ..one };
        let differ =
            (0..32).any(|x| (noise::height(&pattern, &one, 0.0, x, 9) - noise::height(&pattern, &other, 0.0, x, 9)).abs() > 0.01);
        assert!(differ, "{pattern:?}");
    }
    assert_ne!(salt(1 << 40), salt(0));
}

#[test]
fn the_extremes_of_every_setting_stay_within_range() {
    let Some(gpu) = gpu() else { return };
    let (least, most) = (1e-30, 1e6);
    let fractal = FractalNoise { octaves: 12, lacunarity: 4.0, gain: 1.0, contrast: 100.0, ..FractalNoise::default() };
    let columns = Columns { waves: [256, -256], disorder: 1.0, ..Columns::default() };
    let dunes = Dunes { meander: 4.0, ripple_height: 1.0, speed_metres_per_second: 1e4, ..Dunes::default() };
    let patterns = [least, most].into_iter().flat_map(|size| {
        let other = if size == least { most } else { least };
        [
            NoisePattern::Fractal(FractalNoise {
                feature_metres: size,
                evolution_per_second: -100.0,
                drift_metres_per_second: [1e4, -1e4],
                ..fractal.clone()
            }),
            NoisePattern::Fractal(FractalNoise { feature_metres: size, gain: 0.0, fold: Fold::Ridged, ..fractal.clone() }),
            NoisePattern::Columns(Columns {
                pitch_metres: size,
                edge_metres: 0.0,
                gap_metres: other,
                period_seconds: size,
                ..columns.clone()
            }),
            NoisePattern::Scales(Scales { pitch_metres: size, edge_metres: 0.0, period_seconds: other, ..Scales::default() }),
            NoisePattern::Gears(Gears { module_metres: size, edge_metres: 0.0, turns_per_second: 100.0, ..Gears::default() }),
            NoisePattern::Dunes(Dunes { wavelength_metres: size, ripple_metres: other, crest: 0.05, ..dunes.clone() }),
        ]
    });
    for pattern in patterns {
        for size in [[1, 1], [1, 64], [37, 23]] {
            for addressing in ADDRESSINGS {
                let heights = evaluated(gpu, &pattern, &ground(size, addressing), 1e6);
                // A NaN lies in no range.
                let stray = heights.iter().find(|height| !(0.0..=1.0).contains(*height));
                assert_eq!(stray, None, "{pattern:?} {size:?} {addressing:?}");
            }
        }
    }
}
