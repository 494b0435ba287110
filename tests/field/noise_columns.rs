//! Columns reach the heights that they state, each in its own time.

use rilievo::reference::Addressing;
use rilievo::scene::{ColumnShape, Columns, NoisePattern};

use super::noise::{evaluated, ground};
use crate::support::fields::ADDRESSINGS;
use crate::support::gpu::gpu;
use crate::support::tolerances::NOISE_HEIGHT;

#[test]
fn they_rise_to_the_highest_and_sink_to_the_lowest_in_half_a_period() {
    let Some(gpu) = gpu() else { return };
    for &shape in ColumnShape::ALL {
        for addressing in ADDRESSINGS {
            let columns = Columns {
                shape,
                pitch_metres: 0.2,
                gap_metres: 0.02,
                edge_metres: 0.02,
                low: 0.3,
                high: 0.9,
                ground: 0.1,
                period_seconds: 3.0,
                waves: [0, 0],
                disorder: 0.0,
            };
            let pattern = NoisePattern::Columns(columns);
            let field = ground([200, 200], addressing);
            for (time, top) in [(0.0, 0.9), (1.5, 0.3), (3.0, 0.9), (0.75, 0.6), (3e6, 0.9)] {
                let heights = evaluated(gpu, &pattern, &field, time);
                let near = |height: f64| heights.iter().filter(|h| (f64::from(**h) - height).abs() <= NOISE_HEIGHT).count();
                // Tops are level, and so are gaps. Four fifths of a pitch is top at the most.
                assert!(near(top) > heights.len() / 3, "{shape:?} {addressing:?} {time}: {} at the top", near(top));
                assert!(near(0.1) > heights.len() / 40, "{shape:?} {addressing:?} {time}: {} in the gaps", near(0.1));
                let range = heights.iter().fold((1.0_f32, 0.0_f32), |(low, high), h| (low.min(*h), high.max(*h)));
                assert!(f64::from(range.0) >= 0.1 - NOISE_HEIGHT && f64::from(range.1) <= top + NOISE_HEIGHT, "{range:?}");
            }
        }
    }
}

#[test]
fn each_has_a_phase_of_its_own() {
    let Some(gpu) = gpu() else { return };
    let columns = Columns { shape: ColumnShape::Squares, pitch_metres: 0.1, waves: [0, 0], disorder: 1.0, ..Columns::default() };
    let field = ground([200, 200], Addressing::Wrap);
    let heights = evaluated(gpu, &NoisePattern::Columns(columns), &field, 1.0);
    // An axis stands in the middle of the field, and another every 20 texels.
    let tops: Vec<f32> = (0..100).map(|column| heights[(column / 10 * 20 * 200 + column % 10 * 20) as usize]).collect();
    let mean = tops.iter().sum::<f32>() / 100.0;
    assert!((mean - 0.625).abs() < 0.08, "{mean}");
    assert!(tops.iter().any(|top| *top < 0.3) && tops.iter().any(|top| *top > 0.95));
    let neighbours = tops.windows(2).filter(|pair| (pair[0] - pair[1]).abs() > 0.05).count();
    assert!(neighbours > 70, "{neighbours}");
}

#[test]
fn a_wave_runs_across_them() {
    let Some(gpu) = gpu() else { return };
    let columns = Columns {
        shape: ColumnShape::Squares,
        pitch_metres: 0.1,
        period_seconds: 4.0,
        waves: [1, 0],
        disorder: 0.0,
        ..Columns::default()
    };
    let field = ground([200, 200], Addressing::Wrap);
    let row = |time: f64| -> Vec<f32> {
        let heights = evaluated(gpu, &NoisePattern::Columns(columns.clone()), &field, time);
        (0..10).map(|column| heights[100 * 200 + column * 20]).collect()
    };
    // A tenth of a period later each is where its neighbour along u was.
    let (now, later) = (row(1.0), row(1.4));
    assert!((0..9).all(|i| f64::from((later[i] - now[i + 1]).abs()) <= NOISE_HEIGHT), "{now:?} {later:?}");
    assert!((now[0] - now[5]).abs() > 0.1 || (now[2] - now[7]).abs() > 0.1);
}
