//! Colour images: every kind of PNG that is promised, exact to the byte; everything else refused in one sentence.

use std::fs;
use std::path::Path;

use png::{BitDepth, ColorType};
use proptest::prelude::{ProptestConfig, any, proptest};
use rilievo::io::colour_image;
use rilievo::surface::albedo_image::ColourImage;

fn read_bytes(bytes: &[u8]) -> Result<ColourImage, String> {
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let path = directory.path().join("image");
    fs::write(&path, bytes).expect("the directory can be written");
    colour_image::read(&path).map_err(|error| error.to_string())
}

fn png_bytes(size: [u32; 2], colour: ColorType, depth: BitDepth, palette: Option<&[u8]>, samples: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    if let Some(palette) = palette {
        encoder.set_palette(palette);
    }
    let mut writer = encoder.write_header().expect("the header is sound");
    writer.write_image_data(samples).expect("there are as many samples as the header says");
    writer.finish().expect("a vector can be written");
    bytes
}

#[test]
fn every_colour_type_is_read_as_it_stands() {
    let palette = [255, 0, 0, 0, 255, 0, 1, 2, 3];
    for (colour, depth, palette, samples, expected) in [
        (ColorType::Rgb, BitDepth::Eight, None, &[1, 2, 3, 4, 5, 6][..], [[1, 2, 3], [4, 5, 6]]),
        // Alpha is dropped: what is transparent has its colour too.
        (ColorType::Rgba, BitDepth::Eight, None, &[1, 2, 3, 0, 4, 5, 6, 128], [[1, 2, 3], [4, 5, 6]]),
        (ColorType::Grayscale, BitDepth::Eight, None, &[7, 200], [[7; 3], [200; 3]]),
        (ColorType::GrayscaleAlpha, BitDepth::Eight, None, &[7, 0, 200, 255], [[7; 3], [200; 3]]),
        (ColorType::Grayscale, BitDepth::One, None, &[0b0100_0000], [[0; 3], [255; 3]]),
        (ColorType::Rgb, BitDepth::Sixteen, None, &[1, 99, 2, 99, 3, 99, 4, 99, 5, 99, 6, 99], [[1, 2, 3], [4, 5, 6]]),
        (ColorType::Indexed, BitDepth::Eight, Some(&palette[..]), &[2, 1], [[1, 2, 3], [0, 255, 0]]),
    ] {
        let image = read_bytes(&png_bytes([2, 1], colour, depth, palette, samples)).expect("it is sound");
        assert_eq!(image.size, [2, 1]);
        let pixels: Vec<_> = image.rgba.chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        assert_eq!(pixels, expected, "{colour:?} {depth:?}");
    }
}

#[test]
fn rows_run_from_the_top_interlaced_or_not() {
    let interlaced = colour_image::read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/io/interlaced.png")));
    let image = interlaced.expect("it is sound");
    let expected = image::open(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/io/interlaced.png")).expect("it is sound").to_rgb8();
    assert_eq!(image.size, [expected.width(), expected.height()]);
    for (index, pixel) in expected.pixels().enumerate() {
        assert_eq!(image.rgba[4 * index..][..3], pixel.0, "pixel {index}");
    }
}

#[test]
fn what_is_no_picture_is_refused_in_one_sentence() {
    let sound =
        png_bytes([64, 64], ColorType::Rgb, BitDepth::Eight, None, &(0..12288).map(|i| (i * 7) as u8).collect::<Vec<_>>());
    let mut huge = sound.clone();
    huge[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
    for (bytes, part) in [
        (&b""[..], "is empty: it must be a PNG image"),
        (b"\x89PNG", "damaged PNG"),
        (b"\x89PNG\r\n\x1a\nnothing of the kind", "damaged PNG"),
        (b"\x76\x2f\x31\x01\x02\0\0\0", "OpenEXR image, and colours must be a PNG"),
        (b"\xff\xd8\xff\xe0JFIF", "a JPEG image, not a PNG"),
        (b"no picture", "text, not a PNG"),
        (&sound[..sound.len() / 2], "PNG"),
        (&huge, "PNG"),
    ] {
        let sentence = read_bytes(bytes).expect_err("it is unfit");
        assert!(sentence.contains(part) && !sentence.contains('\n'), "{sentence}");
    }
    for (path, part) in [(Path::new("nowhere.png"), "no such file"), (Path::new("/"), "directory")] {
        assert!(colour_image::read(path).expect_err("it is unfit").to_string().contains(part));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]
    #[test]
    fn damage_never_panics(place in 0usize..400, byte in any::<u8>(), length in 0usize..400) {
        let mut bytes = png_bytes([9, 5], ColorType::Rgba, BitDepth::Eight, None, &[77; 180]);
        let place = place % bytes.len();
        bytes[place] = byte;
        bytes.truncate(length.max(9));
        if let Err(sentence) = read_bytes(&bytes) {
            assert!(!sentence.contains('\n'), "{sentence}");
        }
    }
}
