//! Height images: every kind that is promised, exact to the bit; everything else refused in one sentence, whatever its bytes.

use std::fs;
use std::path::Path;

use exr::prelude::*;
use proptest::prelude::{ProptestConfig, any, proptest};
use rilievo::io::height_image::HeightImage;
use rilievo::scene::Addressing;

fn temporary() -> tempfile::TempDir {
    tempfile::tempdir().expect("there is a temporary directory")
}

/// Reads an image of these bytes.
fn read_bytes(bytes: &[u8], range: Option<[f32; 2]>) -> std::result::Result<HeightImage, String> {
    let directory = temporary();
    let path = directory.path().join("image");
    fs::write(&path, bytes).expect("the directory can be written");
    HeightImage::read(&path, range).map_err(|error| error.to_string())
}

#[track_caller]
fn refusal(bytes: &[u8], part: &str) {
    let sentence = read_bytes(bytes, None).expect_err("it is unfit");
    assert!(sentence.contains(part) && !sentence.contains('\n'), "{sentence}");
}

/// The bytes of a PNG of these samples, packed as the format has them.
fn png_bytes(size: [u32; 2], colour: png::ColorType, depth: png::BitDepth, palette: Option<&[u8]>, samples: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    if let Some(palette) = palette {
        encoder.set_palette(palette);
        encoder.set_trns(vec![0; palette.len() / 3]);
    }
    let mut writer = encoder.write_header().expect("the header is sound");
    writer.write_image_data(samples).expect("there are as many samples as the header says");
    writer.finish().expect("a vector can be written");
    bytes
}

fn grey8(size: [u32; 2], samples: &[u8]) -> Vec<u8> {
    png_bytes(size, png::ColorType::Grayscale, png::BitDepth::Eight, None, samples)
}

/// The bytes of an EXR of these channels.
fn exr_bytes(size: [usize; 2], encoding: Encoding, channels: &[(&str, FlatSamples)]) -> Vec<u8> {
    let channels = channels.iter().map(|(name, samples)| AnyChannel::new(*name, samples.clone())).collect();
    let layer = Layer::new((size[0], size[1]), LayerAttributes::default(), encoding, AnyChannels::sort(channels));
    let mut bytes = std::io::Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).expect("a vector can be written");
    bytes.into_inner()
}

fn exr_of(name: &str, size: [usize; 2], values: &[f32]) -> Vec<u8> {
    exr_bytes(size, Encoding::FAST_LOSSLESS, &[(name, FlatSamples::F32(values.to_vec()))])
}

#[test]
fn every_depth_of_grey_is_its_samples_over_the_largest() {
    use png::BitDepth::{Eight, Four, One, Sixteen, Two};
    // Rows are padded to whole bytes.
    for (depth, samples, largest, expected) in [
        (One, &[0b1010_0000, 0b0100_0000][..], 1.0, [1.0, 0.0, 1.0, 0.0, 1.0, 0.0]),
        (Two, &[0b0001_1000, 0b1100_0100], 3.0, [0.0, 1.0, 2.0, 3.0, 0.0, 1.0]),
        (Four, &[0x0f, 0x70, 0x8a, 0x10], 15.0, [0.0, 15.0, 7.0, 8.0, 10.0, 1.0]),
        (Eight, &[0, 255, 127, 128, 1, 254], 255.0, [0.0, 255.0, 127.0, 128.0, 1.0, 254.0]),
        (
            Sixteen,
            &[0, 0, 255, 255, 0x7f, 0xff, 0x80, 0, 0, 1, 0x12, 0x34],
            65535.0,
            [0.0, 65535.0, 32767.0, 32768.0, 1.0, 4660.0],
        ),
    ] {
        let image = read_bytes(&png_bytes([3, 2], png::ColorType::Grayscale, depth, None, samples), None).expect("it is sound");
        assert_eq!(image.size, [3, 2]);
        assert_eq!(image.heights, expected.map(|sample: f64| (sample / largest) as f32), "{depth:?}");
    }
}

#[test]
fn colours_give_their_luminance_and_alpha_does_not_count() {
    let bt709 = |r: f64, g: f64, b: f64| (0.2126 * r + 0.7152 * g + 0.0722 * b) as f32;
    let rgb = [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 77, 77, 77, 0, 0, 0];
    let expected = [bt709(1.0, 0.0, 0.0), bt709(0.0, 1.0, 0.0), bt709(0.0, 0.0, 1.0), 1.0, (77.0 / 255.0) as f32, 0.0];
    let bytes = png_bytes([3, 2], png::ColorType::Rgb, png::BitDepth::Eight, None, &rgb);
    assert_eq!(read_bytes(&bytes, None).expect("it is sound").heights, expected);

    let rgba: Vec<u8> = rgb.chunks(3).zip([0, 1, 2, 3, 128, 255]).flat_map(|(rgb, a)| [rgb[0], rgb[1], rgb[2], a]).collect();
    let bytes = png_bytes([3, 2], png::ColorType::Rgba, png::BitDepth::Eight, None, &rgba);
    assert_eq!(read_bytes(&bytes, None).expect("it is sound").heights, expected);

    let wide: Vec<u8> = rgba.iter().flat_map(|&sample| [sample, sample]).collect();
    let bytes = png_bytes([3, 2], png::ColorType::Rgba, png::BitDepth::Sixteen, None, &wide);
    assert_eq!(read_bytes(&bytes, None).expect("it is sound").heights, expected);

    let bytes = png_bytes([3, 1], png::ColorType::GrayscaleAlpha, png::BitDepth::Eight, None, &[0, 9, 51, 0, 255, 0]);
    assert_eq!(read_bytes(&bytes, None).expect("it is sound").heights, [0.0, 0.2, 1.0]);

    // A palette whose every entry is transparent, four bits an index.
    let bytes = png_bytes([3, 2], png::ColorType::Indexed, png::BitDepth::Four, Some(&rgb), &[0x01, 0x20, 0x34, 0x50]);
    assert_eq!(read_bytes(&bytes, None).expect("it is sound").heights, expected);
}

#[test]
fn interlaced_rows_find_their_place() {
    // Made by an encoder that interlaces: 11x9, 16 bits of grey, sample = 600 · (column + 11 · row).
    let bytes = include_bytes!("interlaced.png");
    let image = read_bytes(bytes, None).expect("it is sound");
    assert_eq!(image.size, [11, 9]);
    let expected: Vec<f32> = (0..99).map(|i| (f64::from(600 * i) / 65535.0) as f32).collect();
    assert_eq!(image.heights, expected);
    for length in 0..bytes.len() {
        assert!(read_bytes(&bytes[..length], None).is_err(), "{length} of {} bytes", bytes.len());
    }
}

#[test]
fn every_kind_of_exr_gives_its_values() {
    let values: Vec<f32> = (0..70 * 50).map(|i| (i % 97) as f32 / 128.0).collect();
    let halves: Vec<f16> = values.iter().copied().map(f16::from_f32).collect();
    let bits: Vec<u32> = (0..70 * 50).map(|i| i % 2).collect();
    let compressions = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
    ];
    for compression in compressions {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(32, 16))] {
            for line_order in [LineOrder::Increasing, LineOrder::Decreasing] {
                let encoding = Encoding { compression, blocks, line_order };
                let what = format!("{encoding:?}");
                let read = |samples| read_bytes(&exr_bytes([70, 50], encoding, &[("H", samples)]), None).expect(&what);
                // Multiples of 1/128 below 1 are exact as halves, and in the 24 bits that PXR24 keeps of a float.
                assert_eq!(read(FlatSamples::F32(values.clone())).heights, values, "{what}");
                assert_eq!(read(FlatSamples::F16(halves.clone())).heights, values, "{what}");
                let ones: Vec<f32> = bits.iter().map(|&bit| bit as f32).collect();
                assert_eq!(read(FlatSamples::U32(bits.clone())).heights, ones, "{what}");
            }
        }
    }
}

#[test]
fn the_channel_is_h_then_y_then_r_then_the_only_one() {
    let constant = |value: f32| FlatSamples::F32(vec![value; 6]);
    for (channels, expected) in [
        (&[("A", 0.1), ("H", 0.2), ("R", 0.3), ("Y", 0.4)][..], Some(0.2)),
        (&[("A", 0.1), ("R", 0.3), ("Y", 0.4)], Some(0.4)),
        (&[("B", 0.1), ("G", 0.2), ("R", 0.3)], Some(0.3)),
        (&[("height.H", 0.7)], Some(0.7)),
        (&[("A", 0.1), ("Z", 0.2)], None),
    ] {
        let channels: Vec<_> = channels.iter().map(|&(name, value)| (name, constant(value))).collect();
        let result = read_bytes(&exr_bytes([3, 2], Encoding::UNCOMPRESSED, &channels), None);
        match expected {
            Some(height) => assert_eq!(result.expect("it is sound").heights, [height; 6]),
            None => assert!(result.expect_err("it is unfit").contains("channels A, Z: rename")),
        }
    }
}

#[test]
fn what_a_capture_writes_can_be_loaded() {
    let directory = temporary();
    let path = directory.path().join("field.exr");
    let heights: Vec<f32> = (0..35).map(|i| i as f32 / 34.0).collect();
    rilievo::io::exr_file::write(&path, [7, 5], [("H".to_owned(), heights.clone())].into()).expect("it can be written");
    assert_eq!(HeightImage::read(&path, None).expect("it is sound"), HeightImage { size: [7, 5], heights });
}

#[test]
fn poison_is_refused_where_it_stands() {
    for (poison, name) in [(f32::NAN, "NaN"), (f32::INFINITY, "infinite"), (f32::NEG_INFINITY, "infinite")] {
        let mut values = [0.5; 12];
        values[7] = poison;
        values[11] = poison;
        let bytes = exr_of("H", [4, 3], &values);
        for range in [None, Some([0.0, 10.0])] {
            let sentence = read_bytes(&bytes, range).expect_err("it is unfit");
            assert!(sentence.contains(name) && sentence.contains("column 3, row 1"), "{sentence}");
        }
    }
    // Denormals and negative zero are heights like any other.
    assert!(read_bytes(&exr_of("H", [2, 1], &[1e-42, -0.0]), None).is_ok());
}

#[test]
fn values_outside_need_a_range_and_the_error_says_which() {
    let values = [-12.5, 0.0, 100.25, 88.0];
    let bytes = exr_of("H", [2, 2], &values);
    let sentence = read_bytes(&bytes, None).expect_err("it is unfit");
    assert!(sentence.contains("map them with --height-range -12.5,100.25"), "{sentence}");
    let image = read_bytes(&bytes, Some([-12.5, 100.25])).expect("it is mapped");
    assert_eq!((image.heights[0], image.heights[2]), (0.0, 1.0));
    assert!((image.heights[3] - (100.5 / 112.75) as f32).abs() < 1e-7);
    let sentence = read_bytes(&bytes, Some([0.0, 100.0])).expect_err("the range is too narrow");
    assert!(sentence.contains("--height-range -12.5,100.25"), "{sentence}");
    assert!(read_bytes(&exr_of("H", [1, 1], &[1.000_000_1]), None).is_err());
    // A range applies to a PNG as well.
    let image = read_bytes(&grey8([2, 1], &[51, 102]), Some([0.2, 0.4])).expect("it is mapped");
    assert!((image.heights[0]).abs() < 1e-6 && (image.heights[1] - 1.0).abs() < 1e-6, "{image:?}");
}

#[test]
fn other_things_are_named() {
    refusal(b"", "is empty");
    refusal(b"\x89PN", "truncated or damaged PNG");
    refusal(b"\xff\xd8\xff\xe0 and so on", "a JPEG image, not a PNG or an OpenEXR image: convert it");
    refusal(b"GIF89a", "a GIF image");
    refusal(b"hello, world\n", "text");
    refusal(b"P5 2 2 255\n....", "a Netpbm image");
    refusal(&[0; 64], "something else");
    refusal(b"\x76\x2f\x31\x01", "truncated or damaged OpenEXR");
    let directory = temporary();
    let error = HeightImage::read(directory.path(), None).expect_err("it is a directory").to_string();
    assert!(error.contains("it is a directory"), "{error}");
    let error = HeightImage::read(&directory.path().join("nowhere.png"), None).expect_err("it is missing").to_string();
    assert!(error.contains("nowhere.png: there is no such file"), "{error}");
    if cfg!(unix) {
        let error = HeightImage::read(Path::new("/dev/null"), None).expect_err("it is a device").to_string();
        assert!(error.contains("not a regular file"), "{error}");
    }
}

/// CRC-32 as PNG has it.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 })
    })
}

#[test]
fn an_absurd_size_is_refused_before_it_is_allocated() {
    let mut bytes = grey8([2, 2], &[0; 4]);
    for (width, height) in [(u32::MAX >> 1, u32::MAX >> 1), (1 << 20, 1 << 20), (1 << 15, 1 << 14), (0, 2), (2, 0)] {
        bytes[16..20].copy_from_slice(&width.to_be_bytes());
        bytes[20..24].copy_from_slice(&height.to_be_bytes());
        let sum = crc(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&sum.to_be_bytes());
        refusal(&bytes, if width == 0 || height == 0 { "damaged" } else { "more than the 268435456 that can be read" });
    }
    // The largest size that is read at all, promised by a file that holds four texels: it grows by rows, and ends at once.
    bytes[16..20].copy_from_slice(&(1_u32 << 14).to_be_bytes());
    bytes[20..24].copy_from_slice(&(1_u32 << 14).to_be_bytes());
    let sum = crc(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&sum.to_be_bytes());
    refusal(&bytes, "truncated or damaged PNG");

    let bytes = exr_of("H", [2, 2], &[0.5; 4]);
    // The data window, as its attribute stands in the header: name, type, length 16, then the lowest and highest column and row.
    let name = b"dataWindow\0box2i\0\x10\0\0\0";
    let at = bytes.windows(name.len()).position(|window| window == name).expect("every EXR has a data window") + name.len();
    for (width, height) in [(i32::MAX, i32::MAX), (1 << 20, 1 << 20), (1 << 28, 2)] {
        let mut bytes = bytes.clone();
        bytes[at..at + 16].copy_from_slice(bytemuck::cast_slice(&[0, 0, width - 1, height - 1]));
        let sentence = read_bytes(&bytes, None).expect_err("it is absurd");
        assert!(sentence.contains("more than the 268435456") || sentence.contains("damaged"), "{sentence}");
    }
}

/// Small images of several kinds, to be maimed.
fn victims() -> Vec<Vec<u8>> {
    let ramp: Vec<u8> = (0..96).map(|i| i * 2).collect();
    let values: Vec<f32> = (0..96).map(|i| i as f32 / 95.0).collect();
    let exr = |compression, blocks| {
        let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
        exr_bytes([12, 8], encoding, &[("H", FlatSamples::F32(values.clone())), ("R", FlatSamples::F32(values.clone()))])
    };
    vec![
        grey8([12, 8], &ramp),
        png_bytes([6, 8], png::ColorType::Grayscale, png::BitDepth::Sixteen, None, &ramp),
        png_bytes([4, 8], png::ColorType::Rgb, png::BitDepth::Eight, None, &ramp),
        png_bytes([12, 8], png::ColorType::Indexed, png::BitDepth::Eight, Some(&[7; 3 * 256]), &ramp),
        include_bytes!("interlaced.png").to_vec(),
        exr(Compression::Uncompressed, Blocks::ScanLines),
        exr(Compression::RLE, Blocks::ScanLines),
        exr(Compression::ZIP16, Blocks::Tiles(Vec2(5, 3))),
        exr(Compression::PIZ, Blocks::ScanLines),
        exr(Compression::PXR24, Blocks::Tiles(Vec2(64, 64))),
    ]
}

#[test]
fn no_part_of_an_image_is_an_image() {
    for (i, bytes) in victims().into_iter().enumerate() {
        assert!(read_bytes(&bytes, None).is_ok(), "victim {i}");
        for length in 0..bytes.len() {
            let sentence = read_bytes(&bytes[..length], None).err();
            let sentence = sentence.unwrap_or_else(|| panic!("victim {i}: {length} of {} bytes are read", bytes.len()));
            assert!(!sentence.contains('\n'), "{sentence}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever happens to the bytes: heights in [0, 1], or one sentence. Never a panic, never gigabytes.
    #[test]
    fn damage_is_survived(
        victim in 0..10_usize,
        places in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 1..6),
        cut in proptest::option::of(any::<proptest::sample::Index>()),
    ) {
        let mut bytes = victims().swap_remove(victim);
        for (place, value) in places {
            let at = place.index(bytes.len());
            bytes[at] = value;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        // Checksums would hide the decoder behind them: make them right again where the chunks can still be found.
        if victim < 5 {
            mend_checksums(&mut bytes);
        }
        match read_bytes(&bytes, None) {
            Ok(image) => {
                assert_eq!(image.heights.len(), image.size[0] as usize * image.size[1] as usize);
                assert!(image.heights.iter().all(|height| (0.0..=1.0).contains(height)));
            }
            Err(sentence) => assert!(!sentence.contains('\n'), "{sentence}"),
        }
    }
}

/// Makes the checksum of every chunk of a PNG right.
fn mend_checksums(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = bytes.get(at..at + 4).map(|four| u32::from_be_bytes([four[0], four[1], four[2], four[3]]) as usize) {
        let Some(end) = at.checked_add(8 + length).filter(|end| end + 4 <= bytes.len()) else { return };
        let sum = crc(&bytes[at + 4..end]);
        bytes[end..end + 4].copy_from_slice(&sum.to_be_bytes());
        at = end + 4;
    }
}

#[test]
fn resampling_keeps_heights_heights() {
    let image = read_bytes(&grey8([4, 4], &[255; 16]), None).expect("it is sound");
    for size in [[1, 1], [3, 9], [64, 2]] {
        let resampled = image.resampled(size, Addressing::Wrap);
        assert_eq!(resampled.size, size);
        assert!(resampled.heights.iter().all(|&height| height == 1.0));
    }
}
