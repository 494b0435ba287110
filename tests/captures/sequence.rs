//! Procedural scenes and series of images as a script sees them: functions of time alone, refused before anything is written.

use std::path::Path;

use rilievo::io::height_image::HeightImage;

use super::{capture, manifest, rilievo, write_heights};
use crate::support::gpu::gpu;

/// Three images of their own, and three pictures.
fn series(folder: &Path) {
    for number in 0..3_u32 {
        let heights = |x: u32, y: u32| f64::from((x + 2 * y + 5 * number) % 13) / 13.0;
        write_heights(&folder.join(format!("d_{number:03}.png")), [21, 13], heights);
        let colour = [[250, 20, 20], [20, 250, 20], [20, 20, 250]][number as usize];
        let picture = image::RgbImage::from_pixel(4, 4, image::Rgb(colour));
        picture.save(folder.join(format!("c_{number:03}.png"))).expect("it can be written");
    }
}

fn bytes(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn a_series_is_the_field_and_its_colours() {
    if gpu().is_none() {
        return;
    }
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let at = |name: &str| directory.path().join(name);
    series(directory.path());
    let (heights, colours) = (at("d_%03d.png"), at("c_*.png"));
    let arguments = [
        "--scene",
        "relief",
        "--size",
        "48x32",
        "--sequence",
        heights.to_str().expect("plain names"),
        "--sequence-colour",
        colours.to_str().expect("plain names"),
        "--sequence-rate",
        "60",
        "--export",
        "height-exr,sequence-exr",
    ];
    capture(&at("long"), &[&arguments[..], &["--frames", "5"]].concat());
    assert_eq!(manifest(&at("long"))["field_size"], serde_json::json!([21, 13]));
    for frame in 0..5_u32 {
        let read = |path: &Path| HeightImage::read(path, None).expect("it is an image");
        let shown = read(&at(&format!("long/field_{frame:05}.exr")));
        assert_eq!(shown, read(&at(&format!("d_{:03}.png", frame % 3))), "frame {frame}");
        assert_eq!(
            bytes(&at("long"), &format!("field_{frame:05}.exr")),
            bytes(&at("long"), &format!("field_{frame:05}_sequence.exr"))
        );
        // The picture in the middle has the colour of its image.
        let picture = image::open(at(&format!("long/frame_{frame:05}.png"))).expect("it is a picture").to_rgb8();
        let middle = picture.get_pixel(24, 16).0;
        let strongest = (0..3).max_by_key(|&channel| middle[channel]).expect("there are three");
        assert_eq!(strongest, frame as usize % 3, "frame {frame}: {middle:?}");
    }
    // The last two frames of the run, by themselves.
    capture(&at("late"), &[&arguments[..], &["--warmup", "3", "--frames", "2"]].concat());
    for (late, long) in [(0, 3), (1, 4)] {
        for ending in ["png", "exr"] {
            let stem = if ending == "png" { "frame" } else { "field" };
            let name = |number: u32| format!("{stem}_{number:05}.{ending}");
            assert_eq!(bytes(&at("late"), &name(late)), bytes(&at("long"), &name(long)), "{ending} {long}");
        }
    }
    // Another size is resampled, and keeps its aspect.
    capture(&at("small"), &[&arguments[..], &["--field", "7"]].concat());
    assert_eq!(manifest(&at("small"))["field_size"], serde_json::json!([7, 4]));
}

#[test]
fn what_cannot_be_played_leaves_nothing_behind() {
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    series(directory.path());
    let at = |name: &str| directory.path().join(name).to_str().expect("plain names").to_owned();
    let refused = |arguments: &[&str], part: &str| {
        let output = rilievo(&[&["capture", "--out", &at("out"), "--size", "16x16", "--scene", "relief"], arguments].concat());
        let sentence = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{sentence}");
        assert!(sentence.contains(part) && sentence.lines().count() == 1, "{arguments:?}: {sentence}");
        assert!(!Path::new(&at("out")).exists(), "{arguments:?}");
    };
    let pattern = at("d_%03d.png");
    refused(&["--sequence-rate", "3"], "this scene has none");
    refused(&["--sequence", &at("e_*.png")], "matches no file");
    refused(&["--sequence", directory.path().to_str().expect("plain names")], "more than one series");
    refused(&["--export", "wave-exr"], "--export wave-exr asks for what this scene does not have");
    if gpu().is_some() {
        // The third image is damaged between its ends: found before the first is shown.
        let path = directory.path().join("d_002.png");
        let mut bytes = std::fs::read(&path).expect("it is there");
        let data = bytes.windows(4).position(|name| name == b"IDAT").expect("every PNG has data");
        bytes[data + 7] ^= 0xff;
        std::fs::write(&path, bytes).expect("it can be written");
        refused(&["--sequence", &pattern, "--sequence-rate", "60", "--frames", "4"], "d_002.png");
    }
    std::fs::remove_file(directory.path().join("d_001.png")).expect("it is there");
    refused(&["--sequence", &pattern], "d_001.png is missing from a series of 0 to 2");
}

#[test]
fn a_procedural_frame_needs_no_other() {
    if gpu().is_none() {
        return;
    }
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    for scene in ["columns", "dunes"] {
        let at = |name: &str| directory.path().join(format!("{scene}-{name}"));
        let arguments = ["--scene", scene, "--size", "48x32", "--field", "64", "--export", "height-exr,noise-exr"];
        capture(&at("long"), &[&arguments[..], &["--frames", "8"]].concat());
        // One frame of that very time, and nothing before it but the start.
        capture(&at("alone"), &[&arguments[..], &["--dt", "0.11666666666666667", "--warmup", "1"]].concat());
        assert_eq!(bytes(&at("alone"), "field_00000.exr"), bytes(&at("long"), "field_00007.exr"), "{scene}");
        assert_eq!(bytes(&at("alone"), "frame_00000.png"), bytes(&at("long"), "frame_00007.png"), "{scene}");
        assert_ne!(bytes(&at("long"), "frame_00000.png"), bytes(&at("long"), "frame_00007.png"), "{scene} moves");
    }
}
