//! Scales overlap, and lift in waves.

use rilievo::reference::Addressing;
use rilievo::scene::{NoisePattern, Scales};

use super::noise::{evaluated, ground};
use crate::support::gpu::gpu;
use crate::support::tolerances::NOISE_HEIGHT;

#[test]
fn they_cover_all_and_each_lies_over_the_next_row() {
    let Some(gpu) = gpu() else { return };
    let scales = Scales { pitch_metres: 0.2, edge_metres: 0.01, lift: 0.0, keel: 0.0, ..Scales::default() };
    let field = ground([200, 200], Addressing::Wrap);
    let heights = evaluated(gpu, &NoisePattern::Scales(scales), &field, 0.0);
    // No ground shows between them.
    assert!(heights.iter().all(|h| (0.05..=1.0).contains(h)), "{:?}", heights.iter().copied().reduce(f32::min));
    // Down the middle of a scale it rises, then falls off a whole step to the next row's scale, once every two rows of 20 texels.
    let column: Vec<f32> = (0..200).map(|y| heights[y * 200 + 100]).collect();
    let steps = (0..200).filter(|&y| column[y] - column[(y + 3) % 200] > 0.2).count();
    let rises = (0..200).filter(|&y| column[(y + 1) % 200] > column[y]).count();
    assert!((5..=30).contains(&steps) && rises > 150, "{steps} steps, {rises} rises");
}

#[test]
fn they_lose_as_much_height_as_lift_says_and_regain_it() {
    let Some(gpu) = gpu() else { return };
    let scales = Scales { lift: 0.4, waves: [0, 0], disorder: 0.0, period_seconds: 2.0, ..Scales::default() };
    let field = ground([128, 128], Addressing::Wrap);
    let [sunk, lifted, again] = [0.0, 1.0, 2.0].map(|time| evaluated(gpu, &NoisePattern::Scales(scales.clone()), &field, time));
    for ((sunk, lifted), again) in sunk.iter().zip(&lifted).zip(&again) {
        assert!(f64::from((sunk - 0.6 * lifted).abs()) <= NOISE_HEIGHT, "{sunk} for {lifted}");
        assert!(f64::from((sunk - again).abs()) <= NOISE_HEIGHT);
    }
}
