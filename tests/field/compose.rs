//! Composition against its reference, poison included.

use rilievo::field::compose::{Compose, LAYERS_MAX};
use rilievo::field::source::Heights;
use rilievo::field::wave::WaveState;
use rilievo::field::{Field, Region};
use rilievo::gpu::{Gpu, Readback, Texture};
use rilievo::reference::Addressing;
use rilievo::reference::compose::{blend, clamped};
use rilievo::scene::{Layer, LayerBlend};

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

/// A layer of a stack, and its values.
type Values = (Layer, Vec<f32>);

/// The height field that the kernel makes, and how many texels it clamped.
fn composed(gpu: &Gpu, size: [u32; 2], relief: &[f32], layers: &[Values]) -> (Vec<f32>, u32) {
    let field = Field::new(gpu, size, Addressing::Wrap, false);
    field.relief.write(gpu, relief);
    let textures: Vec<Texture<WaveState>> = layers.iter().map(|_| Texture::new(gpu, size)).collect();
    textures.iter().zip(layers).for_each(|(texture, (_, values))| texture.write(gpu, values));
    // The second of two textures is the current one, and the first holds nothing.
    let still = Texture::<WaveState>::new(gpu, size);
    let heights: Vec<_> = textures.iter().map(|texture| Heights { views: [&still.view, &texture.view], current: 1 }).collect();
    let kernel = Compose::new(gpu, layers.len(), true).expect("the shader compiles");
    let set = kernel.bind(gpu, &field, &field.relief.view, &heights, &field.height.view);
    let currents: Vec<_> = layers.iter().map(|(layer, _)| (*layer, 1)).collect();
    let counts = run(gpu, |recorder| {
        kernel.record(recorder, &set, &[Region::all(size)], &currents);
        Readback::record_buffer(gpu, recorder.encoder, &field.clipped, field.clipped.size())
    });
    counts.start();
    let heights = read(gpu, &field.height);
    let counts: Vec<u32> = bytemuck::pod_collect_to_vec(&wait_for(gpu, &counts));
    (heights, counts.iter().sum())
}

/// What the reference makes of the same.
fn expected(relief: &[f32], layers: &[Values]) -> (Vec<f32>, u32) {
    clamped(relief.iter().enumerate().map(|(texel, &beneath)| {
        let values: Vec<_> = layers.iter().map(|(layer, values)| (*layer, values[texel])).collect();
        blend(beneath, &values)
    }))
}

#[test]
fn poison_is_clamped_and_counted_as_the_reference_does() {
    let Some(gpu) = gpu() else { return };
    for size in SIZES {
        let relief = poisoned(size);
        let (heights, clipped) = composed(gpu, size, &relief, &[]);
        let (expected, expected_clipped) = expected(&relief, &[]);
        let bits = |heights: &[f32]| heights.iter().map(|height| height.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&heights), bits(&expected), "{size:?}");
        assert_eq!(clipped, expected_clipped, "{size:?}");
    }
}

#[test]
fn layers_are_blended_from_the_ground_up() {
    let Some(gpu) = gpu() else { return };
    let mut random = Random::new(2);
    // Every blend alone, every pair in this order, and stacks as high as a segment may be.
    let blends = LayerBlend::ALL;
    let alone = blends.iter().map(|&blend| vec![blend]);
    let pairs = blends.iter().flat_map(|&low| blends.iter().map(move |&high| vec![low, high]));
    let high = (0..5).map(|turn| (0..LAYERS_MAX).map(|layer| blends[(turn + 2 * layer) % 5]).collect());
    for (index, stack) in alone.chain(pairs).chain(high).enumerate() {
        let size = SIZES[index % SIZES.len()];
        let texels = size[0] * size[1];
        let relief: Vec<_> = (0..texels).map(|_| random.uniform(0.0, 1.0)).collect();
        let layers: Vec<Values> = stack
            .iter()
            .map(|&blend| {
                let amplitude = random.uniform(0.2, 1.0);
                (Layer { blend, amplitude }, (0..texels).map(|_| random.uniform(-1.0, 2.0)).collect())
            })
            .collect();
        let (heights, clipped) = composed(gpu, size, &relief, &layers);
        let (expected, expected_clipped) = expected(&relief, &layers);
        for (height, expected) in heights.iter().zip(&expected) {
            let bound = tolerances::COMPOSED_HEIGHT * layers.len() as f64;
            assert!(f64::from((height - expected).abs()) <= bound, "{stack:?}: {height} for {expected}");
        }
        assert_eq!(clipped, expected_clipped, "{stack:?}");
    }
}

#[test]
fn below_the_top_nothing_is_clamped() {
    let Some(gpu) = gpu() else { return };
    let size = [33, 17];
    let field = Field::new(gpu, size, Addressing::Wrap, false);
    let relief: Vec<f32> = (0..size[0] * size[1]).map(|texel| texel as f32 - 100.0).collect();
    field.relief.write(gpu, &relief);
    let bed = Texture::<WaveState>::new(gpu, size);
    let kernel = Compose::new(gpu, 0, false).expect("the shader compiles");
    let set = kernel.bind(gpu, &field, &field.relief.view, &[], &bed.view);
    run(gpu, |recorder| kernel.record(recorder, &set, &[Region::all(size)], &[]));
    assert_eq!(read::<_, f32>(gpu, &bed), relief);
}

#[test]
fn the_reference_obeys_the_range_rule() {
    let relief = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.0, 0.25, 1.5, -1e-30];
    let (heights, clipped) = clamped(relief);
    assert_eq!(heights, [0.0, 1.0, 0.0, 0.0, 0.25, 1.0, 0.0]);
    assert!(heights.iter().all(|height| height.is_sign_positive()));
    assert_eq!(clipped, 5);
}
