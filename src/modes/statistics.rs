//! What many measurements come to.

use serde::{Deserialize, Serialize};

use crate::surface::channels::Channel;

/// Median, 95th percentile and minimum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// The middle value.
    pub median: f64,
    /// Exceeded by one value in twenty.
    pub p95: f64,
    /// The smallest.
    pub min: f64,
}

impl Spread {
    /// Of these values; none of nothing.
    pub fn of(values: &[f64]) -> Option<Self> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let min = *sorted.first()?;
        Some(Self { median: quantile(&sorted, 0.5), p95: quantile(&sorted, 0.95), min })
    }
}

/// The value below which so large a share of the sorted values lies (nearest rank).
///
/// # Panics
///
/// There are no values.
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted[rank.clamp(1, sorted.len()) - 1]
}

/// Samples or nodes of the view rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Steps {
    /// Mean over the pixels that show the surface.
    pub mean: f64,
    /// 99th percentile.
    pub p99: f64,
    /// The most.
    pub max: f64,
    /// Pixels whose ray visited as many nodes as it may, and gave up: in tables only.
    #[serde(skip)]
    pub capped: usize,
}

impl Steps {
    /// Of the pixels of a picture.
    pub fn of(pixels: &[Channel]) -> Self {
        // A ray that gave up is −1 less the steps that it took.
        let taken = |pixel: &Channel| if pixel.steps < -1.0 { -1.0 - pixel.steps } else { pixel.steps };
        let mut steps: Vec<f64> = pixels.iter().map(|pixel| f64::from(taken(pixel))).filter(|steps| *steps >= 0.0).collect();
        steps.sort_by(f64::total_cmp);
        let Some(&max) = steps.last() else { return Self::default() };
        let capped = pixels.iter().filter(|pixel| pixel.steps < -1.0).count();
        Self { mean: steps.iter().sum::<f64>() / steps.len() as f64, p99: quantile(&steps, 0.99), max, capped }
    }
}

/// So many of what has this name, in words.
pub fn counted(count: u64, name: &str) -> String {
    if count == 1 { format!("1 {name}") } else { format!("{count} {name}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_values_that_occur() {
        let sorted: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!([0.0, 0.5, 0.95, 0.99, 1.0].map(|share| quantile(&sorted, share)), [1.0, 50.0, 95.0, 99.0, 100.0]);
        assert_eq!(Spread::of(&[3.0, 1.0, 2.0]), Some(Spread { median: 2.0, p95: 3.0, min: 1.0 }));
        assert_eq!(Spread::of(&[]), None);
    }

    #[test]
    fn rays_that_gave_up_count_with_the_steps_they_took() {
        let pixels = [4.0, -1.0, 8.0, -13.0].map(|steps| Channel { steps, ..Channel::default() });
        assert_eq!(Steps::of(&pixels), Steps { mean: 8.0, p99: 12.0, max: 12.0, capped: 1 });
        assert_eq!(Steps::of(&pixels[1..2]), Steps::default());
    }
}
