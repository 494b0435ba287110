//! The same command gives the same bytes; a warm-up is a part of one long run; a seed decides what is random.

use std::collections::BTreeMap;
use std::path::Path;

use super::capture;

/// Every file of a directory.
fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    std::fs::read_dir(directory)
        .expect("the capture made it")
        .map(|entry| {
            let path = entry.expect("its entries can be listed").path();
            let name = path.file_name().expect("an entry has a name").to_string_lossy().into_owned();
            (name, std::fs::read(&path).expect("it can be read"))
        })
        .collect()
}

const SMALL: &[&str] =
    &["--size", "96x64", "--field", "128", "--channels", "color,position,normal,uv,height,visibility,steps,lod"];

fn small<'a>(more: &[&'a str]) -> Vec<&'a str> {
    SMALL.iter().chain(more).copied().collect()
}

#[test]
fn the_same_command_twice_gives_the_same_bytes() {
    for scene in ["ripples", "bullet-wall", "relief"] {
        let directory = tempfile::tempdir().expect("there is a temporary directory");
        let (once, twice) = (directory.path().join("once"), directory.path().join("twice"));
        for out in [&once, &twice] {
            capture(out, &small(&["--scene", scene, "--frames", "4", "--warmup", "7"]));
        }
        let (once, twice) = (files(&once), files(&twice));
        assert_eq!(once.len(), 13, "{scene}: four pictures, four lists of channels, four fields and a manifest");
        assert!(once == twice, "{scene}: a file differs");
    }
}

#[test]
fn a_warm_up_is_the_beginning_of_one_long_run() {
    for scene in ["ripples", "bullet-wall"] {
        let directory = tempfile::tempdir().expect("there is a temporary directory");
        let (long, late) = (directory.path().join("long"), directory.path().join("late"));
        capture(&long, &small(&["--scene", scene, "--frames", "9", "--dt", "0.0213"]));
        capture(&late, &small(&["--scene", scene, "--frames", "3", "--warmup", "6", "--dt", "0.0213"]));
        let (long, late) = (files(&long), files(&late));
        for index in 0..3 {
            for kind in ["frame_0000{}.png", "frame_0000{}.exr", "field_0000{}.exr"] {
                let name = |index: usize| kind.replace("{}", &index.to_string());
                assert!(late[&name(index)] == long[&name(index + 6)], "{scene}: {} differs", name(index));
            }
        }
    }
}

#[test]
fn frame_0_is_the_untouched_start_and_eight_frames_change_it_visibly() {
    for scene in ["ripples", "bullet-wall", "depth-image", "cube", "planet"] {
        let directory = tempfile::tempdir().expect("there is a temporary directory");
        let out = directory.path();
        for seed in ["1", "2"] {
            capture(out, &["--scene", scene, "--size", "320x200", "--frames", "8", "--seed", seed, "--shadow", "none"]);
            let pixels =
                |index: usize| image::open(out.join(format!("frame_0000{index}.png"))).expect("it is a picture").to_rgb8();
            let (first, last) = (pixels(0), pixels(7));
            let changed = first.as_raw().iter().zip(last.as_raw()).filter(|(a, b)| a.abs_diff(**b) > 16).count();
            assert!(changed > 30, "{scene}, seed {seed}: {changed} values changed by more than 16");
        }
    }
}

#[test]
fn another_seed_gives_another_picture() {
    for scene in ["ripples", "bullet-wall"] {
        let directory = tempfile::tempdir().expect("there is a temporary directory");
        let picture = |seed: &str| {
            capture(directory.path(), &small(&["--scene", scene, "--warmup", "12", "--seed", seed]));
            std::fs::read(directory.path().join("frame_00000.png")).expect("it was written")
        };
        assert!(picture("1") != picture("2"), "{scene}");
    }
}
