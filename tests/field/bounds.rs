//! The bounds against their reference, bit for bit, and their ranges against the surface.

use rilievo::field::bounds::{BoundsPass, HIGH_STEPS, LOW_STEPS, level_count, level_origin, level_size};
use rilievo::field::{Field, Region};
use rilievo::gpu::{Gpu, Readback};
use rilievo::reference::HeightField;
use rilievo::reference::bounds::{Level, bounds};

use crate::support::fields::{ADDRESSINGS, Kind, Random};
use crate::support::gpu::{gpu, run, wait_for};
use crate::support::tolerances;

/// Every level, taken out of the texture that holds them all.
fn levels(gpu: &Gpu, field: &Field, readback: &Readback) -> Vec<Level> {
    readback.start();
    let texels: Vec<f32> = bytemuck::pod_collect_to_vec(&wait_for(gpu, readback));
    let width = field.bounds.size()[0];
    (1..=level_count(field.size))
        .map(|level| {
            let (size, origin) = (level_size(field.size, level), level_origin(field.size, level));
            let nodes = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [origin[0] + x, origin[1] + y]));
            let packed = nodes.map(|[x, y]| texels[(y * width + x) as usize] as u32);
            Level { size, steps: packed.map(|packed| [packed % (LOW_STEPS + 1), packed / (LOW_STEPS + 1)]).collect() }
        })
        .collect()
}

/// The levels of these fields, all in one submission: what costs is waiting.
fn built(gpu: &Gpu, kernel: &BoundsPass, fields: &[HeightField]) -> Vec<Vec<Level>> {
    let textures: Vec<_> = fields
        .iter()
        .map(|field| {
            let textures = Field::new(gpu, field.size, field.addressing, false);
            textures.height.write(gpu, &field.heights);
            textures
        })
        .collect();
    let sets: Vec<_> = textures.iter().map(|textures| kernel.bind(gpu, textures)).collect();
    let readbacks = run(gpu, |recorder| {
        let mut readbacks = Vec::new();
        for (textures, set) in textures.iter().zip(&sets) {
            kernel.record(recorder, set, &[Region::all(textures.size)]);
            readbacks.push(Readback::record_texture(gpu, recorder.encoder, &textures.bounds.texture, 0));
        }
        readbacks
    });
    textures.iter().zip(readbacks).map(|(textures, readback)| levels(gpu, textures, &readback)).collect()
}

fn compare(gpu: &Gpu, sizes: impl Iterator<Item = [u32; 2]>) {
    let kernel = BoundsPass::new(gpu).expect("the shader compiles");
    let fields: Vec<_> = sizes.flat_map(|size| ADDRESSINGS.map(|addressing| Kind::Noise.field(size, addressing))).collect();
    for batch in fields.chunks(256) {
        for (field, actual) in batch.iter().zip(built(gpu, &kernel, batch)) {
            for (level, (actual, expected)) in (1..).zip(actual.iter().zip(&bounds(field))) {
                assert!(actual == expected, "level {level} of {:?} {:?}", field.size, field.addressing);
            }
        }
    }
}

#[test]
fn rows_and_columns_equal_the_reference() {
    let Some(gpu) = gpu() else { return };
    compare(gpu, (1..=300).chain([511, 512, 513, 1000, 4095, 4096]).flat_map(|n| [[1, n], [n, 1]]));
}

#[test]
fn rectangles_up_to_40_equal_the_reference() {
    let Some(gpu) = gpu() else { return };
    compare(gpu, (1..=40).flat_map(|x| (1..=40).map(move |y| [x, y])));
}

#[test]
fn large_fields_equal_the_reference() {
    let Some(gpu) = gpu() else { return };
    for size in [[255, 257], [344, 403], [1000, 640], [1024, 1024], [2048, 2048]] {
        compare(gpu, [size].into_iter());
    }
}

#[test]
fn a_dirty_update_equals_a_full_rebuild() {
    let Some(gpu) = gpu() else { return };
    let kernel = BoundsPass::new(gpu).expect("the shader compiles");
    let mut random = Random::new(3);
    for size in [[1, 1], [1, 77], [64, 64], [255, 257], [344, 403]] {
        for addressing in ADDRESSINGS {
            let mut field = Kind::Noise.field(size, addressing);
            let textures = Field::new(gpu, size, addressing, false);
            textures.height.write(gpu, &field.heights);
            let set = kernel.bind(gpu, &textures);
            run(gpu, |recorder| kernel.record(recorder, &set, &[Region::all(size)]));
            for _ in 0..6 {
                // A rectangle changes, and with it the cells that have a corner there: one more at the low side.
                let extent = size.map(|size| 1 + random.below(size.min(40)));
                let origin = [0, 1].map(|axis| random.below(size[axis] - extent[axis] + 1));
                for y in origin[1]..origin[1] + extent[1] {
                    for x in origin[0]..origin[0] + extent[0] {
                        field.heights[(y * size[0] + x) as usize] = random.uniform(0.0, 1.0);
                    }
                }
                textures.height.write(gpu, &field.heights);
                let cells = Region { origin, extent }.grown(1, 0, size, addressing);
                let readback = run(gpu, |recorder| {
                    kernel.record(recorder, &set, &cells);
                    Readback::record_texture(gpu, recorder.encoder, &textures.bounds.texture, 0)
                });
                assert!(levels(gpu, &textures, &readback) == bounds(&field), "{size:?} {addressing:?} {origin:?} {extent:?}");
            }
        }
    }
}

/// What the traversal makes of a node, by the arithmetic of `shaders/common/range.wgsl`, holds all of the surface beneath, and no more
/// than a step beside it.
#[test]
fn every_range_holds_the_surface_below_it_and_little_more() {
    let mut random = Random::new(4);
    for (kind, addressing) in Kind::ALL.into_iter().flat_map(|kind| ADDRESSINGS.map(|addressing| (kind, addressing))) {
        let mut field = kind.field([61, 43], addressing);
        for height in [0.0, f32::from_bits(1), 0.5, 1.0 - f32::EPSILON / 2.0, 1.0] {
            let texel = random.below(61 * 43) as usize;
            field.heights[texel] = height;
        }
        for (k, level) in (1..).zip(bounds(&field)) {
            let mut truth = vec![[f64::MAX, f64::MIN]; level.steps.len()];
            for [x, y] in (0..43).flat_map(|y| (0..61).map(move |x| [x, y])) {
                let node = &mut truth[((y >> k) * level.size[0] + (x >> k)) as usize];
                for z in field.corners(x.into(), y.into()) {
                    *node = [node[0].min(z), node[1].max(z)];
                }
            }
            for (steps, [low, high]) in level.steps.iter().zip(truth) {
                let ends =
                    [steps[0] as f32 * (1.0 / LOW_STEPS as f32), steps[1] as f32 * (1.0 / HIGH_STEPS as f32)].map(f64::from);
                assert!(high <= ends[1] + tolerances::BOUND_SLACK, "{kind:?}, level {k}: {high} over {}", ends[1]);
                assert!(low >= ends[0] - tolerances::BOUND_SLACK, "{kind:?}, level {k}: {low} under {}", ends[0]);
                assert!(ends[1] - high < 1.001 / f64::from(HIGH_STEPS) && low - ends[0] < 1.001 / f64::from(LOW_STEPS));
            }
        }
    }
}
