//! The statistics of fractal noise, and how it travels.

use rilievo::reference::Addressing;
use rilievo::scene::{Fold, FractalNoise, NoisePattern};

use super::noise::{evaluated, ground};
use crate::support::gpu::gpu;
use crate::support::tolerances::{NOISE_HEIGHT, NOISE_MEAN};

#[test]
fn folds_have_the_statistics_that_they_state() {
    let Some(gpu) = gpu() else { return };
    let field = ground([256, 256], Addressing::Wrap);
    for &fold in Fold::ALL {
        let fractal = FractalNoise { fold, feature_metres: 1.0 / 32.0, octaves: 4, contrast: 1.0, ..FractalNoise::default() };
        let heights = evaluated(gpu, &NoisePattern::Fractal(fractal), &field, 0.4);
        let mean = heights.iter().map(|h| f64::from(*h)).sum::<f64>() / heights.len() as f64;
        let deviation = (heights.iter().map(|h| (f64::from(*h) - mean).powi(2)).sum::<f64>() / heights.len() as f64).sqrt();
        println!("{fold:?}: mean {mean:.4}, deviation {deviation:.4}");
        // Without contrast nothing is cut off: the octaves' weights sum to 1.
        assert!(heights.iter().all(|h| (0.0..=1.0).contains(h)), "{fold:?}");
        assert!(deviation > 0.05, "{fold:?}: {deviation}");
        match fold {
            Fold::Plain => assert!((mean - 0.5).abs() < NOISE_MEAN, "{mean}"),
            // A folded octave's mean is that of |n|, some 0.2.
            Fold::Billow => assert!((0.1..0.3).contains(&mean), "{mean}"),
            Fold::Ridged => assert!((0.4..0.8).contains(&mean), "{mean}"),
        }
    }
}

#[test]
fn drift_moves_it_by_whole_texels_and_changes_nothing_else() {
    let Some(gpu) = gpu() else { return };
    let size = [96, 64];
    let field = ground(size, Addressing::Wrap);
    let speed = [0.5, -0.25].map(|texels: f64| (texels * field.texel_metres) as f32);
    let fractal = FractalNoise { evolution_per_second: 0.0, drift_metres_per_second: speed, ..FractalNoise::default() };
    let pattern = NoisePattern::Fractal(fractal);
    // 12 seconds: six texels along u, three back along v.
    let [before, after] = [0.0, 12.0].map(|time| evaluated(gpu, &pattern, &field, time));
    for y in 0..size[1] {
        for x in 0..size[0] {
            let from = (y + 3) % size[1] * size[0] + (x + size[0] - 6) % size[0];
            let off = (after[(y * size[0] + x) as usize] - before[from as usize]).abs();
            assert!(f64::from(off) <= 2.0 * NOISE_HEIGHT, "{x}, {y}: {off}");
        }
    }
}

#[test]
fn a_second_octave_is_as_much_finer_as_lacunarity_says() {
    // On a field that one cell fits, noise is 0 at the corner of the cell: of an octave three times as fine, at each third.
    let Some(gpu) = gpu() else { return };
    let field = ground([300, 300], Addressing::Wrap);
    let fractal = FractalNoise {
        feature_metres: 1.0,
        octaves: 2,
        lacunarity: 3.0,
        gain: 1.0,
        contrast: 1.0,
        evolution_per_second: 0.0,
        ..FractalNoise::default()
    };
    let both = evaluated(gpu, &NoisePattern::Fractal(fractal.clone()), &field, 0.0);
    let first = evaluated(gpu, &NoisePattern::Fractal(FractalNoise { octaves: 1, ..fractal }), &field, 0.0);
    for third in [[100, 100], [200, 100], [100, 200], [200, 200]] {
        // The four texels about a lattice point: their mean is the value there, up to the curvature of a cell of 100 texels.
        let mean = |heights: &[f32]| -> f32 {
            let texel = |dx: usize, dy: usize| heights[(third[1] - dy) * 300 + third[0] - dx] - 0.5;
            (texel(0, 0) + texel(1, 0) + texel(0, 1) + texel(1, 1)) / 4.0
        };
        assert!((2.0 * mean(&both) - mean(&first)).abs() < 1e-3, "{third:?}: {} and {}", mean(&both), mean(&first));
    }
}
