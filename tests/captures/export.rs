//! What `--export` writes, read back: heights within half a sample or to the bit, normals within their quantisation.

use std::path::Path;

use rilievo::io::exr_file;
use rilievo::io::height_image::HeightImage;
use rilievo::reference::normals::normal;
use rilievo::reference::{Addressing, HeightField};

use super::{capture, manifest, write_heights};
use crate::support::gpu::gpu;

/// An odd field with slopes of every kind.
fn heights(x: u32, y: u32) -> f64 {
    let (x, y) = (f64::from(x), f64::from(y));
    0.5 + 0.3 * (0.31 * x).sin() * (0.17 * y).cos() + 0.15 * ((x * 7.0 + y * 3.0) % 11.0) / 11.0
}

fn samples(path: &Path) -> Vec<[u16; 3]> {
    let image = image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert!(matches!(image, image::DynamicImage::ImageRgb16(_)), "{}", path.display());
    image.to_rgb16().pixels().map(|pixel| pixel.0).collect()
}

#[test]
fn fields_and_normals_come_back() {
    if gpu().is_none() {
        return;
    }
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let (source, out) = (directory.path().join("source.png"), directory.path().join("out"));
    write_heights(&source, [37, 23], heights);
    let source = source.to_str().expect("plain names");
    let small = ["--scene", "relief", "--size", "16x16"];
    let list = "height-png,height-exr,normal-gl-png,normal-dx-png,relief-exr";
    capture(&out, &[&small[..], &["--height", source, "--export", list]].concat());
    let expected = [
        "frame_00000.png",
        "field_00000.png",
        "field_00000.exr",
        "field_00000_normal-gl.png",
        "field_00000_normal-dx.png",
        "field_00000_relief.exr",
    ];
    assert_eq!(manifest(&out)["frames"][0]["files"], serde_json::json!(expected));

    let read = |name: &str| HeightImage::read(&out.join(name), None).unwrap_or_else(|error| panic!("{name}: {error}"));
    let original = HeightImage::read(Path::new(source), None).expect("it was written just now");
    // The source has sixteen bits itself: nothing at all is lost.
    for name in ["field_00000.png", "field_00000.exr", "field_00000_relief.exr"] {
        assert_eq!(read(name), original, "{name}");
    }
    let again = directory.path().join("again");
    let exported = out.join("field_00000.exr");
    let exported = exported.to_str().expect("plain names");
    capture(&again, &[&small[..], &["--height", exported, "--export", "height-exr"]].concat());
    assert_eq!(std::fs::read(again.join("field_00000.exr")).expect("it is there"), std::fs::read(exported).expect("it is there"));

    let [gl, dx] = ["gl", "dx"].map(|convention| samples(&out.join(format!("field_00000_normal-{convention}.png"))));
    let field = HeightField::new([37, 23], Addressing::Clamp, original.heights);
    // The plane is a metre wide and 0.1 m deep, texels are square.
    let slope = [0.1 * 37.0; 2];
    let decoded = |sample: u16| f64::from(sample) / 65535.0 * 2.0 - 1.0;
    for (texel, (gl, dx)) in (0..).zip(gl.iter().zip(&dx)) {
        let [x, y, z] = normal(&field, texel % 37, texel / 37, slope);
        for (component, sample) in [(x, gl[0]), (-y, gl[1]), (z, gl[2]), (y, dx[1])] {
            // Half a step, and the depth's own rounding to f32.
            assert!((component - decoded(sample)).abs() <= 1.0 / 65535.0 + 1e-6, "texel {texel}: {component}, {sample}");
        }
        assert_eq!((gl[0], gl[2], u32::from(gl[1]) + u32::from(dx[1])), (dx[0], dx[2], 65535), "texel {texel}");
    }
}

#[test]
fn heights_between_samples_come_back_within_half_of_one() {
    if gpu().is_none() {
        return;
    }
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let arguments = ["--scene", "ripples", "--field", "65x33", "--size", "16x16", "--warmup", "20", "--frames", "2"];
    capture(directory.path(), &[&arguments[..], &["--export", "height-png,height-exr,wave-exr,relief-exr"]].concat());
    for frame in ["00000", "00001"] {
        let read = |name: String| HeightImage::read(&directory.path().join(&name), None).expect("it is an image");
        let (png, exr) = (read(format!("field_{frame}.png")), read(format!("field_{frame}.exr")));
        assert_eq!((png.size, exr.size), ([65, 33], [65, 33]));
        for (png, exr) in png.heights.iter().zip(&exr.heights) {
            assert!(f64::from((png - exr).abs()) <= 0.5 / 65535.0 + 6e-8, "{png} for {exr}");
        }
        let layer = |name: &str| {
            let path = directory.path().join(format!("field_{frame}_{name}.exr"));
            exr_file::read(&path).unwrap_or_else(|error| panic!("{name}: {error}")).1.remove("H").expect("its one channel")
        };
        // The field is the relief and the wave, where that is within range.
        let (relief, wave) = (layer("relief"), layer("wave"));
        assert!(wave.iter().any(|u| *u < 0.0) && wave.iter().any(|u| *u > 0.0));
        for ((relief, wave), height) in relief.iter().zip(&wave).zip(&exr.heights) {
            assert!((relief + 0.22 * wave - height).abs() < 1e-6);
        }
    }
}
