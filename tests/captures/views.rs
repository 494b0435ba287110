//! Views, splits and lights, as the files show them.

use std::path::Path;

use image::RgbImage;

use super::{capture, channels};
use crate::support::gpu::gpu;

const SMALL: [&str; 6] = ["--scene", "relief", "--size", "160x120", "--field", "128"];

fn picture(out: &Path, arguments: &[&str]) -> RgbImage {
    capture(out, &[&SMALL[..], arguments].concat());
    image::open(out.join("frame_00000.png")).expect("a capture has a picture").into_rgb8()
}

/// Positions of the pixels that show the surface.
fn positions(out: &Path, technique: &str) -> Vec<Option<[f32; 3]>> {
    capture(out, &[&SMALL[..], &["--technique", technique, "--channels", "position"]].concat());
    let (_, channels) = channels(out, "frame_00000.exr");
    let [x, y, z] = ["position.X", "position.Y", "position.Z"].map(|name| &channels[name]);
    (0..x.len()).map(|i| x[i].is_finite().then_some([x[i], y[i], z[i]])).collect()
}

#[test]
fn the_view_of_errors_is_the_distance_from_the_exact_surface() {
    if gpu().is_none() {
        return;
    }
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let out = directory.path();
    let [found, positions_of_exact] = ["normal", "exact"].map(|technique| positions(out, technique));
    // The plane is 1 m wide: a texel is 1/128 of it. The brightest is an error of two texels.
    let view = picture(out, &["--technique", "normal", "--view", "error", "--gain", "0.5"]);
    let none = picture(out, &["--technique", "exact", "--view", "error", "--gain", "1000"]);
    let (mut bright, mut dark) = (0, 0);
    for (i, (found, exact)) in found.iter().zip(&positions_of_exact).enumerate() {
        let (Some(found), Some(exact)) = (found, exact) else { continue };
        let (x, y) = (i as u32 % 160, i as u32 / 160);
        // The legend's corner, and pixels that the plane's border crosses.
        let inside = [i - 1, i + 1, i - 160, i + 160].iter().all(|&near| positions_of_exact[near].is_some());
        if x > 80 && y < 100 || !inside {
            continue;
        }
        let squared: f32 = found.iter().zip(exact).map(|(a, b)| (a - b) * (a - b)).sum();
        let error = squared.sqrt() * 128.0;
        let pixel = view.get_pixel(x, y).0;
        if error > 2.05 {
            assert_eq!(pixel, [255, 243, 206], "{x}, {y}: {error} texels");
            bright += 1;
        } else if error < 0.02 {
            assert!(pixel.iter().all(|&value| value < 40), "{x}, {y}: {error} texels, {pixel:?}");
            dark += 1;
        }
        assert_eq!(none.get_pixel(x, y).0, [0; 3], "{x}, {y}: exact is the truth");
    }
    assert!(bright > 500, "{bright} bright and {dark} dark pixels");
}

#[test]
fn each_side_of_a_split_is_what_it_would_be_alone() {
    if gpu().is_none() {
        return;
    }
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let out = directory.path();
    let left = picture(out, &["--technique", "exact", "--shadow", "hard"]);
    let right = picture(out, &["--technique", "pom", "--shadow", "pom-soft"]);
    let split = picture(out, &["--technique", "exact", "--shadow", "hard", "--split", "pom:pom-soft@0.4"]);
    let mut differing = 0;
    for (x, y, pixel) in split.enumerate_pixels() {
        // The divider at column 64, and its handle.
        if x.abs_diff(64) > 8 {
            let (own, other) = if x < 64 { (&left, &right) } else { (&right, &left) };
            assert_eq!(pixel, own.get_pixel(x, y), "{x}, {y}");
            differing += u32::from(pixel != other.get_pixel(x, y));
        }
    }
    assert!(differing > 400, "the sides could hardly be told apart: {differing}");
    assert!(split.get_pixel(64, 20).0.iter().all(|&value| value > 150), "the divider is drawn");
}

/// Light adds up: what is first in the list is no matter, and one without strength is as none.
#[test]
fn lights_add_up() {
    if gpu().is_none() {
        return;
    }
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let scene = |first: &str, others: &str| {
        let text = format!("version = 1\n[base]\nkind = \"terrain\"\n[field]\nsize = [128, 128]\n[light]\n{first}\n{others}");
        let file = directory.path().join("lights.toml");
        std::fs::write(&file, text).expect("the temporary directory can be written");
        let out = directory.path().join("out");
        let file = file.to_str().expect("temporary directories have plain names");
        capture(&out, &["--scene", file, "--size", "160x120"]);
        image::open(out.join("frame_00000.png")).expect("a capture has a picture").into_rgb8()
    };
    let warm = "azimuth_degrees = 215.0\nelevation_degrees = 40.0\ncolour = [1.0, 0.6, 0.3]\nintensity = 0.7";
    let cold = "azimuth_degrees = 20.0\nelevation_degrees = 30.0\ncolour = [0.3, 0.6, 1.0]\nintensity = 0.5";
    let dark = cold.replace("intensity = 0.5", "intensity = 0.0");
    let alone = scene(warm, "");
    assert_eq!(alone, scene(warm, &format!("[[lights]]\n{dark}")), "a light without strength is as none");
    let both = scene(warm, &format!("[[lights]]\n{cold}"));
    let swapped = scene(cold, &format!("[[lights]]\n{warm}"));
    let most = both.as_raw().iter().zip(swapped.as_raw()).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    assert!(most <= 1, "the order of lights changes {most} levels");
    let brighter = both.as_raw().iter().zip(alone.as_raw()).filter(|(both, alone)| both > alone).count();
    assert!(brighter > 5000, "{brighter} values are brighter with a second light");
    // Its shadows are its own.
    let free = scene(warm, &format!("[[lights]]\n{cold}\ncasts_shadow = false"));
    let brighter = free.as_raw().iter().zip(both.as_raw()).filter(|(free, both)| free > both).count();
    let darker = free.as_raw().iter().zip(both.as_raw()).filter(|(free, both)| free < both).count();
    assert!(brighter > 500 && darker == 0, "without the second shadow {brighter} are brighter, {darker} darker");
}

/// At a level beyond the pyramid's top there is one box, whose upper side is the highest texel: a plane. At any level the boxes hold
/// the surface.
#[test]
fn a_capped_traversal_shows_boxes() {
    if gpu().is_none() {
        return;
    }
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let out = directory.path();
    let view = |level: &str| picture(out, &["--shadow", "none", "--view", "level-cap", "--level-cap", level]);
    let (finest, boxes, plane) = (view("0"), view("4"), view("31"));
    let differing = |a: &RgbImage, b: &RgbImage| a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count();
    assert!(differing(&finest, &boxes) > 3000 && differing(&boxes, &plane) > 1000);
    // Magenta is a ray that gave up.
    for picture in [&finest, &boxes, &plane] {
        assert!(picture.pixels().all(|pixel| pixel.0 != [255, 0, 255]));
    }
}
