//! The pyramid against its reference, bit for bit, and its bounds against the surface.

use rilievo::field::pyramid::Pyramid;
use rilievo::field::{Field, Region};
use rilievo::gpu::texture::mip_level_count;
use rilievo::gpu::{Gpu, Readback};
use rilievo::reference::pyramid::{Level, pyramid};
use rilievo::reference::{Addressing, HeightField};

use crate::support::fields::{ADDRESSINGS, Kind, Random};
use crate::support::gpu::{gpu, run, wait_for};

/// Every level of the pyramids of these fields, all in one submission: what costs is waiting.
fn built(gpu: &Gpu, kernel: &Pyramid, fields: &[HeightField]) -> Vec<Vec<Level>> {
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
            readbacks.push(record_levels(gpu, recorder.encoder, textures));
        }
        readbacks
    });
    textures.iter().zip(readbacks).map(|(textures, readbacks)| levels(gpu, textures.size, &readbacks)).collect()
}

fn record_levels(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, field: &Field) -> Vec<Readback> {
    let levels = mip_level_count(field.size);
    (0..levels).map(|level| Readback::record_texture(gpu, encoder, &field.pyramid.texture, level)).collect()
}

fn levels(gpu: &Gpu, size: [u32; 2], readbacks: &[Readback]) -> Vec<Level> {
    readbacks.iter().for_each(Readback::start);
    let level = |(level, readback): (u32, _)| Level {
        size: size.map(|size| (size >> level).max(1)),
        bounds: bytemuck::pod_collect_to_vec(&wait_for(gpu, readback)),
    };
    (0..).zip(readbacks).map(level).collect()
}

fn noise(size: [u32; 2], addressing: Addressing) -> HeightField {
    Kind::Noise.field(size, addressing)
}

/// Compares many sizes, a batch at a time.
fn compare(gpu: &Gpu, sizes: impl Iterator<Item = [u32; 2]>) {
    let kernel = Pyramid::new(gpu).expect("the shader compiles");
    let fields: Vec<_> = sizes.flat_map(|size| ADDRESSINGS.map(|addressing| noise(size, addressing))).collect();
    for batch in fields.chunks(256) {
        for (field, actual) in batch.iter().zip(built(gpu, &kernel, batch)) {
            let expected = pyramid(field);
            assert_eq!(actual.len(), expected.len(), "{:?}", field.size);
            for (level, (actual, expected)) in actual.iter().zip(&expected).enumerate() {
                assert_eq!(actual.size, expected.size, "level {level} of {:?} {:?}", field.size, field.addressing);
                assert!(actual.bounds == expected.bounds, "level {level} of {:?} {:?}", field.size, field.addressing);
            }
        }
    }
}

#[test]
fn rows_and_columns_up_to_4096_equal_the_reference() {
    let Some(gpu) = gpu() else { return };
    compare(gpu, (1..=4096).flat_map(|n| [[1, n], [n, 1]]));
}

#[test]
fn rectangles_up_to_130_equal_the_reference() {
    let Some(gpu) = gpu() else { return };
    compare(gpu, (1..=130).flat_map(|x| (1..=130).map(move |y| [x, y])));
}

#[test]
fn large_fields_equal_the_reference() {
    let Some(gpu) = gpu() else { return };
    for size in [[255, 257], [344, 403], [1000, 1000], [1024, 1024], [2048, 2048], [4096, 4096]] {
        compare(gpu, [size].into_iter());
    }
}

#[test]
fn a_dirty_update_equals_a_full_rebuild() {
    let Some(gpu) = gpu() else { return };
    let kernel = Pyramid::new(gpu).expect("the shader compiles");
    let mut random = Random::new(3);
    for size in [[1, 1], [1, 77], [64, 64], [255, 257], [344, 403]] {
        for addressing in ADDRESSINGS {
            let mut field = noise(size, addressing);
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
                let readbacks = run(gpu, |recorder| {
                    kernel.record(recorder, &set, &cells);
                    record_levels(gpu, recorder.encoder, &textures)
                });
                assert!(levels(gpu, size, &readbacks) == pyramid(&field), "{size:?} {addressing:?} {origin:?} {extent:?}");
            }
        }
    }
}

#[test]
fn every_node_bounds_the_surface_below_it_and_no_higher() {
    for addressing in ADDRESSINGS {
        let field = noise([13, 10], addressing);
        for (k, level) in pyramid(&field).iter().enumerate() {
            for node in 0..level.size[0] * level.size[1] {
                let [i, j] = [node % level.size[0], node / level.size[0]];
                // The cells of the node: the last one reaches to the field's end.
                let span = |node: u32, nodes: u32, size: u32| node << k..if node + 1 == nodes { size } else { (node + 1) << k };
                let highest = span(j, level.size[1], 10)
                    .flat_map(|y| span(i, level.size[0], 13).map(move |x| [x, y]))
                    .flat_map(|[x, y]| field.corners(x.into(), y.into()))
                    .fold(0.0, f64::max);
                assert_eq!(f64::from(level.bounds[node as usize]), highest, "level {k}, node {i}, {j}");
            }
        }
    }
}
