//! Runs that go on from a saved state, or as a journal says: what they must match to the byte, and what they must refuse.

use std::path::Path;

use rilievo::camera::Camera;
use rilievo::clock::{Clock, Pace};
use rilievo::io::journal;
use rilievo::io::scene_file::{self, SceneOverrides};

use super::{capture, rilievo};

const SMALL: &[&str] = &["--size", "96x64", "--field", "64", "--channels", "color,position,normal,height,steps"];

/// Scenes in which something moves by a state of its own.
const LIVING: [&str; 6] = ["ripples", "bullet-wall", "explosions", "snow", "dam-break", "gas-planet"];

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    SMALL.iter().chain(more).copied().collect()
}

fn path_in(directory: &tempfile::TempDir, name: &str) -> String {
    directory.path().join(name).to_str().expect("temporary directories have plain names").to_owned()
}

fn assert_same_frames(a: (&Path, u32), b: (&Path, u32), count: u32, what: &str) {
    for frame in 0..count {
        for [prefix, ending] in [["frame", "png"], ["frame", "exr"], ["field", "exr"]] {
            let read = |(folder, first): (&Path, u32)| {
                let name = format!("{prefix}_{:05}.{ending}", first + frame);
                std::fs::read(folder.join(&name)).unwrap_or_else(|error| panic!("{name}: {error}"))
            };
            assert!(read(a) == read(b), "{what}: {prefix}.{ending} of frame {frame} differs");
        }
    }
}

/// A run that must fail with exit code 1, and in one sentence that says this. It leaves nothing.
fn refused(arguments: &[&str], says: &str) {
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let out = path_in(&directory, "out");
    let mut all = vec!["capture", "--out", &out];
    all.extend(arguments);
    let output = rilievo(&all);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains(says) && said.trim_end().lines().count() == 1, "{said}");
    assert!(!Path::new(&out).exists(), "{said}");
}

#[test]
fn a_resumed_run_goes_on_to_the_byte() {
    for scene in LIVING {
        let directory = tempfile::tempdir().expect("there is a temporary directory");
        let [whole, first, second] = ["whole", "first", "second"].map(|name| directory.path().join(name));
        let [state, later] = ["state", "later"].map(|name| path_in(&directory, name));
        let dt = ["--scene", scene, "--dt", "0.0213"];
        capture(&whole, &with(&[&dt[..], &["--frames", "11"]].concat()));
        capture(&first, &with(&[&dt[..], &["--frames", "1", "--warmup", "4", "--save-state", &state]].concat()));
        capture(&second, &with(&[&dt[..], &["--frames", "3", "--load-state", &state, "--save-state", &later]].concat()));
        assert_same_frames((&second, 0), (&whole, 5), 3, scene);
        // And once more, from where that one ended.
        capture(&second, &with(&[&dt[..], &["--frames", "2", "--warmup", "1", "--load-state", &later]].concat()));
        assert_same_frames((&second, 0), (&whole, 9), 2, scene);
    }
}

#[test]
fn a_state_of_another_run_is_refused() {
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let state = path_in(&directory, "state");
    let out = directory.path().join("out");
    capture(&out, &with(&["--scene", "ripples", "--save-state", &state]));
    let load = |more: &[&'static str], says: &str| {
        let all: Vec<&str> = [&["--load-state", state.as_str()][..], more].concat();
        refused(&all, says);
    };
    load(&["--scene", "ripples", "--field", "32"], "holds a field of 64×64");
    load(&["--scene", "ripples", "--field", "64", "--seed", "9"], "is of seed");
    load(&["--scene", "bullet-wall", "--field", "64", "--seed", "1"], "is of the scene ripples");
    load(&["--scene", "ripples", "--field", "64", "--depth", "0.3"], "`plane` is another");
    // To follow advice about its seed and size would not help.
    load(&["--scene", "bullet-wall", "--field", "32"], "is of the scene ripples");
    let ripples = std::fs::read_to_string("scenes/ripples.toml").expect("it is in the repository");
    let other = path_in(&directory, "other.toml");
    std::fs::write(&other, ripples.replace("\"clamp\"", "\"wrap\"")).expect("it can be written");
    let other: &'static str = other.leak();
    load(&["--scene", other, "--field", "64"], "`field.addressing` is another");
    // What is looked at otherwise is the same field.
    capture(&out, &["--scene", "ripples", "--field", "64", "--load-state", &state, "--technique", "pom", "--shadow", "none"]);

    let whole = std::fs::read(&state).expect("it was written");
    std::fs::write(&state, &whole[..whole.len() - 100]).expect("it can be written");
    load(&["--scene", "ripples", "--field", "64"], "is truncated or damaged");
    std::fs::write(&state, b"something else").expect("it can be written");
    load(&["--scene", "ripples", "--field", "64"], "is no state of a field");
    refused(&["--load-state", "/no/such/file"], "cannot read the state /no/such/file");
}

/// A journal of so many frames of a scene, as a window would record it that nobody touches.
fn record(path: &str, scene: &str, frames: u32) {
    let loaded = scene_file::load(scene, &SceneOverrides::default(), [32, 24]).expect("it is a scene");
    let (start, _) = rilievo::modes::start(&loaded).expect("its images are whole");
    let mut writer = journal::Writer::create(Path::new(path), &loaded.scene, start.sums()).expect("it can be written");
    let mut clock = Clock::new(Default::default());
    for _ in 0..frames {
        let tick = clock.advance(Pace::Fixed { dt_seconds: 1.0 / 60.0 });
        let camera = Camera::at(&loaded.scene.camera, tick.time_seconds);
        writer.add(&tick, &[], false, &loaded.scene, &camera).expect("it can be written");
    }
    writer.finish().expect("it can be written");
}

#[test]
fn a_state_and_a_journal_know_when_an_image_changed() {
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let [height, imprint, state, tape] = ["height.png", "imprint.png", "state", "tape"].map(|name| path_in(&directory, name));
    let [out, replayed] = ["out", "replayed"].map(|name| directory.path().join(name));
    let draw = |path: &str, at: u32| {
        let picture = image::GrayImage::from_fn(24, 16, |x, y| image::Luma([if (x, y) == (at, at) { 200 } else { 90 }]));
        picture.save(path).expect("it can be written");
    };
    let scene = path_in(&directory, "scene.toml");
    let text = format!("version = 1\n[base]\nkind = \"image\"\npath = {height:?}\n[[imprints]]\nimage = {imprint:?}\n");
    std::fs::write(&scene, text).expect("it can be written");
    let run = ["--scene", scene.as_str(), "--size", "32x24"];
    draw(&height, 3);
    draw(&imprint, 4);
    capture(&out, &[&run[..], &["--frames", "2", "--save-state", &state]].concat());
    record(&tape, &scene, 2);
    let resumed = [&run[..], &["--load-state", &state]].concat();
    let replay = ["--replay", tape.as_str(), "--size", "32x24", "--frames", "2"];
    // The journal's frames are the scene's own, to the byte.
    capture(&replayed, &replay);
    for frame in ["frame_00000.png", "frame_00001.png"] {
        let [own, again] = [&out, &replayed].map(|folder| std::fs::read(folder.join(frame)).expect("it was captured"));
        assert!(own == again, "{frame}");
    }
    for run in [&resumed[..], &replay] {
        capture(&out, run);
        draw(&height, 4);
        refused(run, "started from other heights than this run: put the image or the font back");
        draw(&height, 3);
        draw(&imprint, 5);
        refused(run, "had other images to imprint than this run: put those back");
        draw(&imprint, 4);
        capture(&out, run);
    }
}

#[test]
fn a_state_that_cannot_be_written_is_refused_before_anything_is_made() {
    refused(&["--scene", "relief", "--size", "32x32", "--field", "32", "--save-state", "/no/such/folder/state"], "cannot write");
}

#[test]
fn a_journal_that_is_not_whole_is_refused() {
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let journal = path_in(&directory, "journal");
    refused(&["--replay", "/no/such/file"], "cannot read the journal /no/such/file");
    for (content, says) in [
        (&b"\xff\xfe\x00"[..], "is no journal"),
        (b"", "is no journal"),
        (b"{}\n", "is no journal"),
        (b"{\"rilievo_journal\":99}\n", "is of version 99"),
        (b"{\"rilievo_journal\":2}\n{\"frames\":0}\n", "cannot be understood, line 1"),
    ] {
        std::fs::write(&journal, content).expect("it can be written");
        refused(&["--replay", &journal], says);
    }
}

#[test]
fn what_a_journal_says_no_flag_may_contradict() {
    let series = [
        ["--sequence", "depths"],
        ["--sequence-colour", "colours"],
        ["--sequence-rate", "5"],
        ["--sequence-playback", "loop"],
        ["--sequence-interpolate", "on"],
    ];
    let field = [["--scene", "relief"], ["--seed", "3"], ["--field", "64"], ["--depth", "0.2"], ["--load-state", "state"]];
    for flag in field.into_iter().chain(series).chain([["--dt", "0.1"]]) {
        let output = rilievo(&[&["capture", "--out", "out", "--replay", "journal"][..], &flag[..]].concat());
        assert_eq!(output.status.code(), Some(2), "{flag:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
}
