//! Normals against their reference and against slopes that are known in closed form.

use std::f64::consts::TAU;

use rilievo::field::normals::Normals;
use rilievo::field::{Field, Region};
use rilievo::gpu::Gpu;
use rilievo::reference::normals::{gradient, normal};
use rilievo::reference::{Addressing, HeightField};

use crate::support::fields::{ADDRESSINGS, Kind};
use crate::support::gpu::{gpu, read, run};
use crate::support::tolerances;

/// Depth over texel size of the tests: not the same on both axes, so that swapped ones are seen.
const SLOPE: [f32; 2] = [40.0, 25.0];

fn derived(gpu: &Gpu, field: &HeightField) -> Vec<[f64; 3]> {
    let textures = Field::new(gpu, field.size, field.addressing, false);
    textures.height.write(gpu, &field.heights);
    let kernel = Normals::new(gpu).expect("the shader compiles");
    let set = kernel.bind(gpu, &textures);
    run(gpu, |recorder| kernel.record(recorder, &set, &[Region::all(field.size)], SLOPE));
    let halves: Vec<[u16; 4]> = read(gpu, &textures.normal);
    halves.into_iter().map(|[x, y, z, _]| [x, y, z].map(from_half)).collect()
}

/// The value of an IEEE 754 half.
pub fn from_half(bits: u16) -> f64 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let exponent = i32::from(bits >> 10 & 31);
    let fraction = f64::from(bits & 1023) / 1024.0;
    sign * if exponent == 0 { fraction * 2.0_f64.powi(-14) } else { (1.0 + fraction) * 2.0_f64.powi(exponent - 15) }
}

fn assert_near(actual: [f64; 3], expected: [f64; 3], what: &str) {
    let off = (0..3).map(|axis| (actual[axis] - expected[axis]).abs()).fold(0.0, f64::max);
    assert!(off <= tolerances::NORMAL_COMPONENT, "{what}: {actual:?} for {expected:?}");
}

#[test]
fn every_normal_is_the_references() {
    let Some(gpu) = gpu() else { return };
    for size in [[1, 1], [1, 33], [40, 1], [2, 3], [67, 131]] {
        for addressing in ADDRESSINGS {
            for kind in Kind::ALL {
                let field = kind.field(size, addressing);
                for (texel, actual) in (0..).zip(derived(gpu, &field)) {
                    let [x, y] = [texel % size[0], texel / size[0]];
                    let expected = normal(&field, x, y, SLOPE.map(f64::from));
                    assert_near(actual, expected, &format!("{kind:?} {size:?} {addressing:?} at {x}, {y}"));
                }
            }
        }
    }
}

#[test]
fn a_plane_has_one_normal_and_half_the_slope_at_a_clamped_border() {
    let plane = |x: u32, y: u32| 0.2 + x as f32 / 128.0 + y as f32 / 256.0;
    let field = HeightField::from_fn([32, 32], Addressing::Clamp, plane);
    for (x, y) in [(1, 1), (15, 20), (30, 30)] {
        let [dx, dy] = gradient(&field, x, y);
        assert!((dx - 1.0 / 128.0).abs() < tolerances::ULP && (dy - 1.0 / 256.0).abs() < tolerances::ULP, "{dx} {dy}");
    }
    let [dx, dy] = gradient(&field, 0, 15);
    assert!((dx - 0.5 / 128.0).abs() < tolerances::ULP && (dy - 1.0 / 256.0).abs() < tolerances::ULP, "{dx} {dy}");
}

#[test]
fn a_sine_gives_sobels_own_response_and_no_seam() {
    let (size, amplitude, periods) = (64, 0.4, 5.0);
    let k = TAU * periods / f64::from(size);
    let field = HeightField::from_fn([size, size], Addressing::Wrap, |x, _| (0.5 + amplitude * (k * f64::from(x)).sin()) as f32);
    for x in 0..size {
        let [dx, dy] = gradient(&field, i64::from(x), 0);
        let expected = amplitude * k.sin() * (k * f64::from(x)).cos();
        // The heights are rounded to f32.
        assert!((dx - expected).abs() < tolerances::ULP, "{dx} for {expected} at {x}");
        assert_eq!(dy, 0.0);
    }
}
