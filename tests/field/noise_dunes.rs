//! Dunes travel at the speed that they state, and their steep side is behind the crest.

use rilievo::reference::{Addressing, noise};
use rilievo::scene::{Dunes, NoisePattern};

use super::noise::{evaluated, ground};
use crate::support::gpu::gpu;
use crate::support::tolerances::NOISE_HEIGHT;

#[test]
fn they_travel_at_their_speed_and_keep_their_shape() {
    let Some(gpu) = gpu() else { return };
    let size = [160, 120];
    let field = ground(size, Addressing::Wrap);
    // Three texels along u and four along v, five together, in each second.
    let wind_degrees = 4_f64.atan2(3.0).to_degrees() as f32;
    let speed = (5.0 * field.texel_metres) as f32;
    let dunes = Dunes { wind_degrees, speed_metres_per_second: speed, ripple_height: 0.0, ..Dunes::default() };
    let pattern = NoisePattern::Dunes(dunes);
    for start in [0.0, 86_400.0] {
        let [before, after] = [start, start + 7.0].map(|time| evaluated(gpu, &pattern, &field, time));
        for y in 0..size[1] {
            for x in 0..size[0] {
                let from = (y + 2 * size[1] - 28) % size[1] * size[0] + (x + size[0] - 21) % size[0];
                let off = (after[(y * size[0] + x) as usize] - before[from as usize]).abs();
                assert!(f64::from(off) <= 2.0 * NOISE_HEIGHT, "{x}, {y}: {off}");
            }
        }
    }
}

#[test]
fn ripples_travel_at_theirs() {
    // On dunes that stand still, of one height, what changes is the ripples.
    let Some(gpu) = gpu() else { return };
    let size = [160, 40];
    let field = ground(size, Addressing::Wrap);
    let speed = (2.0 * field.texel_metres) as f32;
    let dunes = Dunes {
        speed_metres_per_second: 0.0,
        ripple_speed_metres_per_second: speed,
        meander: 0.0,
        variety: 0.0,
        ripple_height: 0.5,
        wavelength_metres: 1.0,
        crest: 0.95,
        ripple_metres: 0.1,
        ..Dunes::default()
    };
    let [before, after] = [0.0, 4.0].map(|time| evaluated(gpu, &NoisePattern::Dunes(dunes.clone()), &field, time));
    let bare = evaluated(gpu, &NoisePattern::Dunes(Dunes { ripple_height: 0.0, ..dunes.clone() }), &field, 0.0);
    // On the middle of the back, where they are fully grown.
    for x in 64..112 {
        for y in 0..size[1] {
            let ripple = |heights: &[f32], x: u32| heights[(y * size[0] + x) as usize] - 0.5 * bare[(y * size[0] + x) as usize];
            let off = (ripple(&after, x) - ripple(&before, x - 8)).abs();
            assert!(f64::from(off) <= 2.0 * NOISE_HEIGHT, "{x}, {y}: {off}");
        }
    }
}

#[test]
fn the_wind_drives_sand_up_the_gentle_side() {
    let field = ground([400, 1], Addressing::Wrap);
    let dunes = Dunes { wavelength_metres: 0.5, crest: 0.8, meander: 0.0, variety: 0.0, ripple_height: 0.0, ..Dunes::default() };
    let pattern = NoisePattern::Dunes(dunes);
    let row: Vec<f64> = (0..400).map(|x| noise::height(&pattern, &field, 0.0, x, 0)).collect();
    let rising = (0..400).filter(|&x| row[(x + 1) % 400] > row[x]).count();
    // The rounding of a crest begins where the sides differ by 0.12: a fiftieth of a wavelength before it, four texels, of each of two.
    assert!((312..=321).contains(&rising), "{rising} of 400 texels rise");
    let highest = row.iter().copied().fold(0.0, f64::max);
    assert!(highest > 0.95 && row.iter().copied().fold(1.0, f64::min) < 0.001, "{highest}");
}
