//! Octaves of gradient noise, plain, billowing or ridged. Specification of `shaders/field/noise_fractal.wgsl`.

use super::noise::{Ground, cells_across, gradient_noise};
use crate::field::noise::hash;
use crate::scene::{Fold, FractalNoise};

/// The height at a place in metres.
pub fn height(fractal: &FractalNoise, ground: &Ground, time_seconds: f64, at: [f64; 2]) -> f64 {
    let (mut sum, mut weights, mut share) = (0.0, 0.0, 1.0);
    for octave in 0..fractal.octaves {
        let fineness = f64::from(fractal.lacunarity).powi(octave as i32);
        let weight = f64::from(fractal.gain).powi(octave as i32);
        let cells = cells_across(ground, f64::from(fractal.feature_metres) / fineness);
        let [x, y] = [0, 1].map(|axis| {
            (at[axis] - time_seconds * f64::from(fractal.drift_metres_per_second[axis])) * cells[axis] / ground.metres()[axis]
        });
        let z = time_seconds * f64::from(fractal.evolution_per_second) * fineness.powf(2.0 / 3.0);
        let period = ground.wraps().then(|| cells.map(|count| count as i64));
        let n = gradient_noise([x, y, z], period, hash(ground.salt.wrapping_add(octave)));
        weights += weight;
        sum += weight
            * match fractal.fold {
                Fold::Plain => n,
                Fold::Billow => n.abs(),
                Fold::Ridged => {
                    let signal = share * (1.0 - n.abs().min(1.0)).powi(2);
                    share = (2.0 * signal).clamp(0.0, 1.0);
                    signal
                }
            };
    }
    let sum = f64::from(fractal.contrast) * sum / weights;
    (if fractal.fold == Fold::Plain { 0.5 + 0.5 * sum } else { sum }).clamp(0.0, 1.0)
}
