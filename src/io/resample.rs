//! Resampling of heights to another size.

use crate::scene::Addressing;

/// One output texel's share of the input: the first input texel, and a weight for each from there on. The weights sum to 1.
struct Taps {
    first: i64,
    weights: Vec<f64>,
}

/// Resamples rows of `size` texels to `to` with a tent filter, as wide as an output texel where that is the wider of the two: bilinear
/// interpolation when it enlarges, a weighted mean when it reduces. It neither overshoots nor rings, so a range stays a range.
///
/// Texels beyond the border are the border's, or the opposite side's where the field wraps: a tile stays a tile.
pub fn resample(heights: &[f32], size: [u32; 2], to: [u32; 2], addressing: Addressing) -> Vec<f32> {
    let [width, height] = size.map(|side| side as usize);
    let [to_width, to_height] = to.map(|side| side as usize);
    let columns = taps(size[0], to[0]);
    let rows = taps(size[1], to[1]);
    let address = |i: i64, side: usize| {
        let side = side as i64;
        let i = match addressing {
            Addressing::Wrap => i.rem_euclid(side),
            Addressing::Clamp => i.clamp(0, side - 1),
        };
        i as usize
    };

    // Rows first, into a buffer as high as the input; then columns.
    let mut narrow = Vec::with_capacity(to_width * height);
    for row in heights.chunks_exact(width) {
        narrow.extend(columns.iter().map(|taps| {
            let terms = taps.weights.iter().zip(taps.first..);
            terms.map(|(weight, i)| weight * f64::from(row[address(i, width)])).sum::<f64>()
        }));
    }
    let mut resampled = Vec::with_capacity(to_width * to_height);
    let mut sums = vec![0.0; to_width];
    for taps in &rows {
        sums.fill(0.0);
        for (weight, i) in taps.weights.iter().zip(taps.first..) {
            let start = address(i, height) * to_width;
            let row = &narrow[start..start + to_width];
            sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += weight * value);
        }
        #[expect(clippy::cast_possible_truncation, reason = "heights are f32")]
        // Weights that sum to 1 − 2⁻⁵³ must not turn a height of 1 into less, nor one of 0 into more: round, then clamp.
        resampled.extend(sums.iter().map(|&sum| (sum as f32).clamp(0.0, 1.0)));
    }
    resampled
}

/// The taps of every output texel along one axis.
fn taps(from: u32, to: u32) -> Vec<Taps> {
    let scale = f64::from(from) / f64::from(to);
    let radius = scale.max(1.0);
    (0..to)
        .map(|i| {
            // Texel centres lie at whole numbers plus a half.
            let centre = (f64::from(i) + 0.5) * scale - 0.5;
            #[expect(clippy::cast_possible_truncation, reason = "a texel's index, far below 2⁵³")]
            let [first, last] = [(centre - radius).floor() as i64, (centre + radius).ceil() as i64];
            let tent = |i: i64| (1.0 - (i as f64 - centre).abs() / radius).max(0.0);
            let weights: Vec<f64> = (first..=last).map(tent).collect();
            let sum: f64 = weights.iter().sum();
            Taps { first, weights: weights.into_iter().map(|weight| weight / sum).collect() }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOTH: [Addressing; 2] = [Addressing::Wrap, Addressing::Clamp];

    #[test]
    fn the_same_size_changes_nothing() {
        let heights: Vec<f32> = (0..35).map(|i| (i as f32 * 0.37).fract()).collect();
        for addressing in BOTH {
            assert_eq!(resample(&heights, [7, 5], [7, 5], addressing), heights);
        }
    }

    #[test]
    fn a_constant_stays_constant() {
        for addressing in BOTH {
            for to in [[1, 1], [3, 7], [16, 4], [1, 40], [100, 1]] {
                for height in [0.0, 0.1, 1.0] {
                    let resampled = resample(&[height; 35], [7, 5], to, addressing);
                    assert_eq!(resampled.len(), (to[0] * to[1]) as usize);
                    assert!(resampled.iter().all(|&h| (h - height).abs() <= f32::EPSILON), "{resampled:?}");
                }
            }
        }
    }

    #[test]
    fn a_ramp_stays_a_ramp() {
        // Away from the border a tent reproduces a line exactly, enlarging or reducing.
        let ramp: Vec<f32> = (0..64).map(|i| (i as f32 + 0.5) / 64.0).collect();
        for to in [16, 32, 128, 100] {
            let resampled = resample(&ramp, [64, 1], [to, 1], Addressing::Clamp);
            for (i, h) in resampled.iter().enumerate().skip(to as usize / 8).take(to as usize * 3 / 4) {
                let expected = (i as f32 + 0.5) / to as f32;
                assert!((h - expected).abs() < 2e-3 / to as f32 * 16.0, "{to} {i}: {h} for {expected}");
            }
        }
    }

    #[test]
    fn a_tile_stays_a_tile() {
        // Rotating a wrapping field by half its width and resampling commute.
        let heights: Vec<f32> = (0..16).map(|i| ((i * 7) % 16) as f32 / 16.0).collect();
        let rotated: Vec<f32> = (0..16).map(|i| heights[(i + 8) % 16]).collect();
        let once = resample(&heights, [16, 1], [8, 1], Addressing::Wrap);
        let other = resample(&rotated, [16, 1], [8, 1], Addressing::Wrap);
        for i in 0..8 {
            assert!((once[(i + 4) % 8] - other[i]).abs() < 1e-6);
        }
    }

    #[test]
    fn nothing_overshoots() {
        let step: Vec<f32> = (0..64).map(|i| if i < 32 { 0.25 } else { 0.75 }).collect();
        for to in [9, 63, 65, 500] {
            let resampled = resample(&step, [64, 1], [to, 1], Addressing::Clamp);
            assert!(resampled.iter().all(|h| (0.25..=0.75).contains(h)));
            assert!(resampled.is_sorted());
        }
    }
}
