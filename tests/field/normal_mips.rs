//! Means of normals and heights against their reference, at every kind of size, and after partial updates.

use rilievo::field::normal_mips::NormalMips;
use rilievo::field::normals::Normals;
use rilievo::field::{Field, Region};
use rilievo::gpu::texture::mip_level_count;
use rilievo::gpu::{Gpu, Readback};
use rilievo::reference::HeightField;
use rilievo::reference::normal_mips::{Level, normal_mips};

use super::normals::from_half;
use crate::support::fields::{ADDRESSINGS, Kind, Random};
use crate::support::gpu::{gpu, run, wait_for};
use crate::support::tolerances;

/// Depth over texel size of the tests: not the same on both axes, so that swapped ones are seen.
const SLOPE: [f32; 2] = [1.5, 0.8];

/// Both passes and a field.
struct Passes<'a> {
    gpu: &'a Gpu,
    normals: Normals,
    mips: NormalMips,
}

impl<'a> Passes<'a> {
    fn new(gpu: &'a Gpu) -> Self {
        Self {
            gpu,
            normals: Normals::new(gpu).expect("the shader compiles"),
            mips: NormalMips::new(gpu).expect("the shader compiles"),
        }
    }

    /// Derives these texels, and returns every level's bits.
    fn derive(&self, textures: &Field, texels: &[Region]) -> Vec<Vec<[u16; 4]>> {
        let (normals, mips) = (self.normals.bind(self.gpu, textures), self.mips.bind(self.gpu, textures));
        let readbacks = run(self.gpu, |recorder| {
            self.normals.record(recorder, &normals, texels, SLOPE);
            self.mips.record(recorder, &mips, texels);
            let level = |level| Readback::record_texture(self.gpu, recorder.encoder, &textures.normal.texture, level);
            (0..mip_level_count(textures.size)).map(level).collect::<Vec<_>>()
        });
        readbacks.iter().for_each(Readback::start);
        readbacks.iter().map(|readback| bytemuck::pod_collect_to_vec(&wait_for(self.gpu, readback))).collect()
    }
}

fn upload(gpu: &Gpu, field: &HeightField) -> Field {
    let textures = Field::new(gpu, field.size, field.addressing, false);
    textures.height.write(gpu, &field.heights);
    textures
}

fn assert_levels(actual: &[Vec<[u16; 4]>], expected: &[Level], what: &str) {
    assert_eq!(actual.len(), expected.len(), "{what}");
    for (level, (actual, expected)) in actual.iter().zip(expected).enumerate() {
        assert_eq!(actual.len(), expected.means.len(), "{what}, level {level}");
        for (texel, (actual, expected)) in actual.iter().zip(&expected.means).enumerate() {
            let actual = actual.map(from_half);
            let off = (0..4).map(|channel| (actual[channel] - expected[channel]).abs()).fold(0.0, f64::max);
            let bound = tolerances::normal_mip(level);
            assert!(off <= bound, "{what}, level {level}, texel {texel}: {actual:?} for {expected:?}");
        }
    }
}

#[test]
fn every_level_is_the_mean_of_what_is_beneath_it() {
    let Some(gpu) = gpu() else { return };
    let passes = Passes::new(gpu);
    for size in [[1, 1], [1, 2], [1, 33], [40, 1], [2, 3], [3, 3], [7, 5], [31, 64], [67, 131], [255, 257]] {
        for addressing in ADDRESSINGS {
            for kind in [Kind::Noise, Kind::Steps, Kind::Waves] {
                let field = kind.field(size, addressing);
                let actual = passes.derive(&upload(gpu, &field), &[Region::all(size)]);
                let expected = normal_mips(&field, SLOPE.map(f64::from));
                assert_levels(&actual, &expected, &format!("{kind:?} {size:?} {addressing:?}"));
            }
        }
    }
}

#[test]
fn a_dirty_update_equals_a_full_rebuild() {
    let Some(gpu) = gpu() else { return };
    let passes = Passes::new(gpu);
    let mut random = Random::new(5);
    for size in [[1, 77], [64, 64], [255, 257]] {
        for addressing in ADDRESSINGS {
            let mut field = Kind::Noise.field(size, addressing);
            let textures = upload(gpu, &field);
            passes.derive(&textures, &[Region::all(size)]);
            for _ in 0..4 {
                let extent = size.map(|size| 1 + random.below(size.min(40)));
                let origin = [0, 1].map(|axis| random.below(size[axis] - extent[axis] + 1));
                for y in origin[1]..origin[1] + extent[1] {
                    for x in origin[0]..origin[0] + extent[0] {
                        field.heights[(y * size[0] + x) as usize] = random.uniform(0.0, 1.0);
                    }
                }
                textures.height.write(gpu, &field.heights);
                // A rectangle changes, and with it the normals of its neighbours.
                let updated = passes.derive(&textures, &Region { origin, extent }.grown(1, 1, size, addressing));
                let rebuilt = passes.derive(&upload(gpu, &field), &[Region::all(size)]);
                assert!(updated == rebuilt, "{size:?} {addressing:?} {origin:?} {extent:?}");
            }
        }
    }
}

/// A mean is shorter than 1 by the variance that it averages away: of slopes ±a by 1 − cos(atan a).
#[test]
fn a_mean_is_as_short_as_its_normals_differ() {
    let Some(gpu) = gpu() else { return };
    // Sobel's gradient over a zigzag of period 4 is ±1 step a texel on every second texel and 0 between: so of period 4 over
    // x, averaged over 4 texels, two normals lean by the step's slope and two stand upright.
    let zigzag = [0.5, 0.6, 0.5, 0.4];
    let field = HeightField::from_fn([64, 64], rilievo::reference::Addressing::Wrap, |x, _| zigzag[(x % 4) as usize]);
    let levels = Passes::new(gpu).derive(&upload(gpu, &field), &[Region::all(field.size)]);
    let slope = 0.1 * f64::from(SLOPE[0]);
    let expected = 0.5 + 0.5 / slope.hypot(1.0);
    for texel in &levels[2] {
        let [u, v, out, height] = texel.map(from_half);
        let bound = tolerances::normal_mip(2);
        assert!(u.abs() <= bound && v.abs() <= bound && (out - expected).abs() <= bound, "{u} {v} {out} for {expected}");
        assert!((height - 0.5).abs() <= bound, "{height}");
    }
}
