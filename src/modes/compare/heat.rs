//! Numbers as colours: black, violet, orange, pale yellow, ever brighter, as the views of the program have them.

use super::metrics::Deviation;

/// Nothing is shown here, in truth neither.
const NOTHING: [u8; 4] = [46, 50, 56, 255];
/// The surface is shown here or in truth, but not in both.
const ONLY_ONE: [u8; 4] = [0, 170, 255, 255];

/// The colour of a number between 0 and 1, RGBA in sRGB.
fn heat(value: f64) -> [u8; 4] {
    let x = value.clamp(0.0, 1.0);
    let step = |low: f64, high: f64| {
        let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let blue = 0.45 * step(0.0, 0.28) * (1.0 - step(0.34, 0.66)) + 0.62 * step(0.72, 1.0);
    let [r, g, b] = [step(0.05, 0.62), 0.9 * step(0.38, 1.0), blue].map(encoded);
    [r, g, b, 255]
}

/// Light in sRGB (IEC 61966-2-1).
fn encoded(linear: f64) -> u8 {
    let value = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (value * 255.0).round() as u8
}

/// A picture of position errors, the brightest where they are `brightest_metres`. Grey shows nothing; blue only here or in truth.
pub fn of_deviations(deviations: &[Deviation], brightest_metres: f64) -> Vec<u8> {
    let colour = |deviation: &Deviation| match deviation {
        Deviation::Nothing => NOTHING,
        Deviation::Metres(metres) => heat(metres / brightest_metres),
        Deviation::OnlyOne => ONLY_ONE,
    };
    deviations.iter().flat_map(colour).collect()
}

/// A picture of numbers from 0 to 1.
pub fn of_shares(shares: &[f32]) -> Vec<u8> {
    shares.iter().flat_map(|share| heat(f64::from(*share))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_is_brighter() {
        let luminance = |value: f64| {
            let [r, g, b, _] = heat(value).map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        assert_eq!(heat(0.0), [0, 0, 0, 255]);
        let ramp: Vec<f64> = (0..=20).map(|i| luminance(f64::from(i) / 20.0)).collect();
        assert!(ramp.is_sorted_by(|a, b| a < b), "{ramp:?}");
        assert_eq!((heat(-1.0), heat(7.0)), (heat(0.0), heat(1.0)));
    }

    #[test]
    fn the_gain_decides_what_is_brightest() {
        let picture = of_deviations(&[Deviation::Metres(0.5), Deviation::Nothing, Deviation::OnlyOne], 0.5);
        assert_eq!(picture, [heat(1.0), NOTHING, ONLY_ONE].concat());
    }
}
