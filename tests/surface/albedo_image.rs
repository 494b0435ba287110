//! The colour image over a field: each place has the picture's own colour, whatever the sizes.

use std::path::Path;

use crate::captures::{capture, write_heights};
use crate::support::gpu::gpu;
use crate::support::tolerances::ALBEDO_IMAGE_LEVELS;

/// Eight pixels, no two alike.
const COLOURS: [[u8; 3]; 8] =
    [[160, 0, 0], [0, 160, 0], [0, 0, 160], [160, 160, 0], [0, 160, 160], [160, 0, 160], [160, 160, 160], [20, 20, 20]];

fn write_colours(path: &Path) {
    let picture = image::RgbImage::from_fn(4, 2, |x, y| image::Rgb(COLOURS[(4 * y + x) as usize]));
    picture.save(path).expect("the temporary directory can be written");
}

/// The picture of a flat field seen from straight above, in which the plane fills the width.
fn seen(out: &Path, albedo: &Path, heights: &Path) -> image::RgbImage {
    let path = |path: &Path| path.to_str().expect("temporary directories have plain names").to_owned();
    let (albedo, heights) = (path(albedo), path(heights));
    // At half a metre above a plane 1 m wide, half of the picture's width is as wide as the eye is high.
    let view = [
        "--size",
        "96x48",
        "--camera",
        "0,0.5,0,0,0,0",
        "--fov",
        "53.13010235415598",
        "--technique",
        "normal",
        "--shadow",
        "none",
    ];
    capture(out, &[&["--scene", "relief", "--height", &heights, "--albedo", &albedo], &view[..]].concat());
    image::open(out.join("frame_00000.png")).expect("it is a picture").to_rgb8()
}

#[test]
fn every_place_has_its_own_colour() {
    if gpu().is_none() {
        return;
    }
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let path = |name: &str| directory.path().join(name);
    write_colours(&path("colours.png"));
    let mut first: Option<Vec<[u8; 3]>> = None;
    for size in [[4, 2], [64, 32], [101, 50]] {
        write_heights(&path("flat.png"), size, |_, _| 1.0);
        let picture = seen(&path("out"), &path("colours.png"), &path("flat.png"));
        // At the centres of the picture's own pixels no filter mixes in a neighbour.
        let colours: Vec<[u8; 3]> = (0..8).map(|i| picture.get_pixel(24 * (i % 4) + 12, 24 * (i / 4) + 12).0).collect();
        for (seen, colour) in colours.iter().zip(COLOURS) {
            for (a, b) in [(0, 1), (1, 2), (0, 2)] {
                // The light is warm and the sky cool: levels that are alike stay near one another, others stay in order.
                let order = colour[a].cmp(&colour[b]);
                let apart = seen[a].abs_diff(seen[b]) > 30;
                assert_eq!(apart, order.is_ne(), "{size:?}: {seen:?} for {colour:?}");
                assert!(!apart || seen[a].cmp(&seen[b]) == order, "{size:?}: {seen:?} for {colour:?}");
            }
        }
        assert!(colours[6][0] > colours[7][0] + 30, "{colours:?}");
        // The field's size has no part in it.
        let first = first.get_or_insert(colours.clone());
        for (a, b) in first.iter().flatten().zip(colours.iter().flatten()) {
            assert!(a.abs_diff(*b) <= ALBEDO_IMAGE_LEVELS, "{size:?}: {colours:?} for {first:?}");
        }
    }
}
