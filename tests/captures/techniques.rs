//! Techniques side by side: on flat fields they agree.

use rilievo::surface::Technique;

use super::{capture, channels, write_heights};
use crate::support::tolerances::FLAT_FIELD;

fn picture(out: &std::path::Path) -> Vec<u8> {
    image::open(out.join("frame_00000.png")).expect("it is a picture").to_rgb8().into_raw()
}

const VIEW: [&str; 8] =
    ["--size", "160x120", "--camera", "0.3,0.4,0.9,0,0,0", "--channels", "position,uv,steps", "--shadow", "hard"];

#[test]
fn a_field_of_ones_looks_the_same_with_every_technique() {
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let image = directory.path().join("ones.png");
    write_heights(&image, [37, 21], |_, _| 1.0);
    let pictures = Technique::ALL.iter().map(|technique| {
        let technique = technique.name();
        let out = directory.path().join(technique);
        let height = image.to_str().expect("a plain name");
        capture(&out, &[&VIEW[..], &["--scene", "relief", "--height", height, "--technique", technique]].concat());
        picture(&out)
    });
    let pictures: Vec<_> = pictures.collect();
    assert!(pictures[0].iter().any(|value| *value > 60), "the plane is in the picture");
    for (technique, picture) in Technique::ALL.iter().zip(&pictures) {
        assert!(*picture == pictures[0], "{technique:?}");
    }
}

#[test]
fn a_field_of_halves_is_where_geometry_says() {
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let image = directory.path().join("halves.png");
    let half = 32768.0 / 65535.0;
    write_heights(&image, [64, 64], |_, _| half);
    // Those that neither stop at a sample nor shorten the offset.
    for technique in ["parallax", "pom", "pyramid", "exact"] {
        let out = directory.path().join(technique);
        let height = image.to_str().expect("a plain name");
        capture(&out, &[&VIEW[..], &["--scene", "relief", "--height", height, "--technique", technique]].concat());
        let (_, position) = channels(&out, "frame_00000.exr");
        let depth = (half - 1.0) * 0.1;
        let mut shown = 0;
        for y in position["position.Y"].iter().filter(|y| y.is_finite()) {
            assert!((f64::from(*y) - depth).abs() <= FLAT_FIELD, "{technique}: {y} for {depth}");
            shown += 1;
        }
        assert!(shown > 1000);
    }
}
