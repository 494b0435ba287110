//! Series of images: found whole or refused in one sentence with the file's name, and played as a function of time alone.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use rilievo::io::exr_file;
use rilievo::io::image_sequence::{Player, SequenceFiles, files};
use rilievo::scene::{FieldSettings, Playback, Scene, Sequence};

use crate::captures::write_heights as write_png;

fn temporary() -> tempfile::TempDir {
    tempfile::tempdir().expect("there is a temporary directory")
}

/// A series of flat images, the i-th as high as a tenth of i.
fn series(folder: &Path, numbers: impl Iterator<Item = u32>, name: impl Fn(u32) -> String) {
    for number in numbers {
        write_png(&folder.join(name(number)), [4, 3], |_, _| f64::from(number) / 10.0);
    }
}

fn names(paths: &[PathBuf]) -> Vec<String> {
    paths.iter().map(|path| path.file_name().expect("a file").to_string_lossy().into_owned()).collect()
}

#[track_caller]
fn refused(place: &Path, part: &str) {
    let sequence = Sequence { heights: place.to_owned(), ..Sequence::default() };
    let sentence = SequenceFiles::find(&sequence).expect_err("it is no series").to_string();
    assert!(sentence.contains(part) && !sentence.contains('\n'), "{sentence}");
}

#[test]
fn a_series_is_found_by_folder_pattern_and_star_in_the_order_of_its_numbers() {
    let folder = temporary();
    // Nine to eleven: the order of numbers is not that of names.
    series(folder.path(), 9..12, |number| format!("depth_{number}.png"));
    fs::write(folder.path().join("notes 2.txt"), "not an image").expect("it can be written");
    fs::write(folder.path().join("._depth_9.png"), "hidden by another system").expect("it can be written");
    let expected = ["depth_9.png", "depth_10.png", "depth_11.png"];
    for place in ["", "depth_%d.png", "depth_*.png", "depth_%01d.png"] {
        let found = files(&folder.path().join(place)).unwrap_or_else(|error| panic!("{place}: {error}"));
        assert_eq!(names(&found), expected, "{place}");
    }
    let padded = temporary();
    series(padded.path(), 0..3, |number| format!("a1_{number:05}.png"));
    series(padded.path(), 7..9, |number| format!("b1_{number:03}.png"));
    assert_eq!(names(&files(&padded.path().join("a1_%05d.png")).expect("a series")).len(), 3);
    assert_eq!(names(&files(&padded.path().join("b1_*.png")).expect("a series")), ["b1_007.png", "b1_008.png"]);
    refused(padded.path(), "holds more than one series");
    refused(&padded.path().join("a1_%04d.png"), "matches no file");
}

#[test]
fn a_series_that_is_none_is_refused_with_the_files_name() {
    let folder = temporary();
    let at = |name: &str| folder.path().join(name);
    series(folder.path(), (0..10).filter(|number| *number != 3), |number| format!("d_{number:05}.png"));
    refused(&at("d_%05d.png"), "d_00003.png is missing from a series of 0 to 9");
    write_png(&at("d_00003.png"), [4, 4], |_, _| 0.0);
    refused(&at("d_*.png"), "d_00003.png is 4x4 pixels, and the first of its series, d_00000.png, is 4x3");
    fs::write(at("d_00003.png"), "x").expect("it can be written");
    refused(folder.path(), "d_00003.png is text, not a PNG");
    fs::write(at("d_00003.png"), "").expect("it can be written");
    refused(folder.path(), "d_00003.png is empty");
    let whole = fs::read(at("d_00002.png")).expect("it is there");
    fs::write(at("d_00003.png"), &whole[..whole.len() - 9]).expect("it can be written");
    refused(folder.path(), "d_00003.png is a truncated or damaged PNG");
    fs::write(at("d_00003.png"), &whole).expect("it can be written");
    fs::write(at("d_3.png"), &whole).expect("it can be written");
    refused(&at("d_*.png"), "both number 3");
    fs::remove_file(at("d_3.png")).expect("it is there");
    assert!(files(folder.path()).is_ok());

    refused(&at("d_00003.png"), "is one image");
    refused(&at("nowhere"), "neither a folder nor a pattern");
    refused(&at("d_%s.png"), "is no pattern");
    refused(&at("d_%05d_%05d.png"), "is no pattern");
    refused(&at("nowhere/d_%d.png"), "cannot list");
    refused(&at("e_%d.png"), "matches no file");
    let empty = temporary();
    refused(empty.path(), "holds no numbered PNG or EXR images");
}

#[test]
fn as_many_colours_as_heights_or_none() {
    let folder = temporary();
    series(folder.path(), 0..4, |number| format!("d_{number}.png"));
    let colours = |count: u8| {
        for number in 0..count {
            let image = image::RgbImage::from_pixel(2, 2, image::Rgb([10 * number, 0, 255]));
            image.save(folder.path().join(format!("c_{number}.png"))).expect("it can be written");
        }
    };
    colours(3);
    let sequence = Sequence {
        heights: folder.path().join("d_*.png"),
        colours: Some(folder.path().join("c_*.png")),
        interpolate: true,
        images_per_second: 1.0,
        ..Sequence::default()
    };
    let sentence = SequenceFiles::find(&sequence).expect_err("one is missing").to_string();
    assert!(sentence.contains("has 3 images for 4 of heights"), "{sentence}");
    colours(4);
    let mut player = player(&sequence, [4, 3]);
    let images = player.at(2.5).expect("it plays");
    let colours = images.colours.as_ref().expect("it has colours");
    assert_eq!((colours.size, &colours.rgba[..4]), ([2, 2], &[25, 0, 255, 255][..]));
}

fn player(sequence: &Sequence, size: [u32; 2]) -> Player {
    let files = SequenceFiles::find(sequence).expect("it is a series");
    let scene = Scene { field: FieldSettings { size, ..FieldSettings::default() }, ..Scene::default() };
    Player::new(files, &scene, sequence)
}

#[test]
fn a_moment_is_a_function_of_time_alone() {
    let folder = temporary();
    series(folder.path(), 0..5, |number| format!("d_{number}.png"));
    let sequence =
        Sequence { heights: folder.path().to_owned(), images_per_second: 10.0, interpolate: true, ..Sequence::default() };
    let height = |player: &mut Player, time: f64| {
        let images = player.at(time).expect("it plays");
        assert_eq!(images.heights.len(), 12);
        assert!(images.heights.iter().all(|height| *height == images.heights[0]));
        f64::from(images.heights[0])
    };
    let times = [0.0, 0.05, 0.1, 0.37, 0.45, 0.5, 12.25, 1e6];
    let expected = [0.0, 0.05, 0.1, 0.37, 0.2, 0.0, 0.25, 0.0];
    let mut forward = player(&sequence, [4, 3]);
    for (time, expected) in times.into_iter().zip(expected) {
        let seen = height(&mut forward, time);
        assert!((seen - expected).abs() < 2e-5, "{time}: {seen} for {expected}");
        let mut alone = player(&sequence, [4, 3]);
        assert_eq!(height(&mut alone, time), seen, "{time}");
    }
    assert!(times.iter().rev().all(|time| height(&mut forward, *time) == height(&mut player(&sequence, [4, 3]), *time)));
    let stepped = Sequence { interpolate: false, playback: Playback::Hold, ..sequence.clone() };
    let mut stepped = player(&stepped, [4, 3]);
    assert!((height(&mut stepped, 0.19) - 0.1).abs() < 1e-5 && (height(&mut stepped, 99.0) - 0.4).abs() < 1e-5);
    // The same moment is the same images, which need no second upload.
    assert!(std::sync::Arc::ptr_eq(&stepped.at(99.0).expect("it plays"), &stepped.at(100.0).expect("it plays")));
    // Another size is resampled.
    assert_eq!(player(&sequence, [7, 9]).at(0.0).expect("it plays").heights.len(), 63);
}

#[test]
fn values_follow_the_rule_of_a_single_image() {
    let folder = temporary();
    for (number, level) in [(0, -5.0), (1, 10.0)] {
        let path = folder.path().join(format!("d_{number}.exr"));
        exr_file::write(&path, [2, 1], BTreeMap::from([("H".to_owned(), vec![level; 2])])).expect("it can be written");
    }
    let sequence = Sequence { heights: folder.path().to_owned(), images_per_second: 1.0, ..Sequence::default() };
    let sentence = player(&sequence, [2, 1]).check([0.0, 1.0].into_iter()).expect_err("−5 is no height").to_string();
    assert!(sentence.contains("d_0.exr") && sentence.contains("--height-range"), "{sentence}");
    let mapped = Sequence { range: Some([-10.0, 10.0]), ..sequence };
    let mut player = player(&mapped, [2, 1]);
    assert!(player.check([0.0, 1.0].into_iter()).is_ok());
    assert_eq!(player.at(0.0).expect("it plays").heights[..], [0.25, 0.25]);
    assert_eq!(player.at(1.0).expect("it plays").heights[..], [1.0, 1.0]);
}

#[test]
fn a_damaged_image_is_found_before_its_time_comes() {
    let folder = temporary();
    series(folder.path(), 0..3, |number| format!("d_{number}.png"));
    // Sound at both ends, and nonsense between them.
    let path = folder.path().join("d_2.png");
    let mut bytes = fs::read(&path).expect("it is there");
    let data = bytes.windows(4).position(|name| name == b"IDAT").expect("every PNG has data");
    bytes[data + 7] ^= 0xff;
    fs::write(&path, bytes).expect("it can be written");
    let sequence = Sequence { heights: folder.path().to_owned(), images_per_second: 1.0, ..Sequence::default() };
    let mut player = player(&sequence, [4, 3]);
    assert!(player.check([0.0, 1.0].into_iter()).is_ok());
    let sentence = player.check([0.0, 1.0, 2.0].into_iter()).expect_err("it is damaged").to_string();
    assert!(sentence.contains("d_2.png"), "{sentence}");
}
