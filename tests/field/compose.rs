//! Composition against its reference, poison included.

use rilievo::field::compose::Compose;
use rilievo::field::{Field, Region};
use rilievo::gpu::{Gpu, Readback};
use rilievo::reference::Addressing;
use rilievo::reference::compose::compose;

use crate::support::fields::Random;
use crate::support::gpu::{gpu, read, run, wait_for};
use crate::support::tolerances;

const SIZES: [[u32; 2]; 6] = [[1, 1], [1, 40], [33, 1], [16, 16], [17, 31], [130, 67]];

/// What no height should be, and what looks like it but is one.
const POISON: [u32; 16] = [
    0x7fc0_0000, // NaN
    0xffc0_0000, // −NaN
    0x7f80_0001, // signalling NaN
    0x7f80_0000, // +Inf
    0xff80_0000, // −Inf
    0x0000_0001, // the smallest denormal
    0x8000_0001, // and its negative
    0x007f_ffff, // the largest denormal
    0x8000_0000, // −0
    0x3f80_0000, // 1
    0x3f80_0001, // just above
    0x3f7f_ffff, // just below
    0xbf80_0000, // −1
    0x7f7f_ffff, // the largest finite
    0xff7f_ffff, // and its negative
    0x0000_0000, // 0
];

fn poisoned(size: [u32; 2]) -> Vec<f32> {
    let mut random = Random::new(1);
    (0..size[0] * size[1])
        .map(|_| if random.below(3) == 0 { f32::from_bits(POISON[random.below(16) as usize]) } else { random.uniform(-0.3, 1.3) })
        .collect()
}

/// The height field that the kernel makes, and how many texels it clamped.
fn composed(gpu: &Gpu, size: [u32; 2], relief: &[f32], wave: &[f32], amplitude: f32) -> (Vec<f32>, u32) {
    let field = Field::new(gpu, size, Addressing::Wrap, amplitude != 0.0);
    field.relief.write(gpu, relief);
    if amplitude != 0.0 {
        field.wave[0].write(gpu, wave);
    }
    let kernel = Compose::new(gpu).expect("the shader compiles");
    let set = kernel.bind(gpu, &field);
    let counts = run(gpu, |recorder| {
        kernel.record(recorder, &set, &[Region::all(size)], amplitude, 0);
        Readback::record_buffer(gpu, recorder.encoder, &field.clipped, field.clipped.size())
    });
    counts.start();
    let heights = read(gpu, &field.height);
    let counts: Vec<u32> = bytemuck::pod_collect_to_vec(&wait_for(gpu, &counts));
    (heights, counts.iter().sum())
}

#[test]
fn poison_is_clamped_and_counted_as_the_reference_does() {
    let Some(gpu) = gpu() else { return };
    for size in SIZES {
        let relief = poisoned(size);
        let (heights, clipped) = composed(gpu, size, &relief, &[], 0.0);
        let (expected, expected_clipped) = compose(&relief, &[], 0.0);
        let bits = |heights: &[f32]| heights.iter().map(|height| height.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&heights), bits(&expected), "{size:?}");
        assert_eq!(clipped, expected_clipped, "{size:?}");
    }
}

#[test]
fn waves_are_added() {
    let Some(gpu) = gpu() else { return };
    for size in SIZES {
        let mut random = Random::new(2);
        let relief: Vec<_> = (0..size[0] * size[1]).map(|_| random.uniform(0.0, 1.0)).collect();
        let wave: Vec<_> = relief.iter().map(|_| random.uniform(-2.0, 2.0)).collect();
        let (heights, clipped) = composed(gpu, size, &relief, &wave, 0.2);
        let (expected, expected_clipped) = compose(&relief, &wave, 0.2);
        for (height, expected) in heights.iter().zip(&expected) {
            assert!(f64::from((height - expected).abs()) <= tolerances::COMPOSED_HEIGHT, "{height} for {expected}");
        }
        assert_eq!(clipped, expected_clipped, "{size:?}");
    }
}

#[test]
fn the_reference_obeys_the_range_rule() {
    let relief = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.0, 0.25, 1.5, -1e-30];
    let (heights, clipped) = compose(&relief, &[], 0.0);
    assert_eq!(heights, [0.0, 1.0, 0.0, 0.0, 0.25, 1.0, 0.0]);
    assert!(heights.iter().all(|height| height.is_sign_positive()));
    assert_eq!(clipped, 5);
}
