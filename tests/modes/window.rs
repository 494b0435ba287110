//! The program in a real window, run as a process under Xvfb with a window manager: winit allows one event loop a process.

use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

use image::RgbImage;
use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};

use crate::support::desktop::{Desktop, wait_for};

/// Small enough that a software adapter shows many frames a second.
const SMALL: [&str; 4] = ["--size", "700x400", "--field", "128"];

/// It ended of its own will, and without a word of complaint.
fn assert_ended_well(output: &Output) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{}: {said}", output.status);
    assert!(!said.contains("panicked") && !said.contains("ERROR"), "{said}");
    assert!(output.stdout.is_empty(), "nothing belongs on stdout");
}

/// How many different colours are in a part of a picture.
fn colours(picture: &RgbImage, columns: std::ops::Range<u32>) -> usize {
    let pixels = picture.enumerate_pixels().filter(|(x, ..)| columns.contains(x)).map(|(.., pixel)| pixel.0);
    pixels.collect::<std::collections::HashSet<_>>().len()
}

/// How many pixels of a part differ visibly, above the line where messages come and go.
fn differing(a: &RgbImage, b: &RgbImage, columns: std::ops::Range<u32>) -> usize {
    assert_eq!(a.dimensions(), b.dimensions());
    let messages = a.height() - 60;
    let part = a.enumerate_pixels().filter(|(x, y, _)| columns.contains(x) && *y < messages);
    let pairs = part.map(|(x, y, pixel)| (pixel, b.get_pixel(x, y)));
    pairs.filter(|(a, b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 8)).count()
}

fn read_picture(directory: &Path) -> RgbImage {
    image::open(directory.join("frame_00000.png")).expect("the frame was written").into_rgb8()
}

fn capture(scene: &str, arguments: &[&str], out: &Path) {
    let output = Command::new(env!("CARGO_BIN_EXE_rilievo"))
        .args(["capture", "--scene", scene])
        .args(arguments)
        .arg("--out")
        .arg(out)
        .output()
        .expect("the program starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn opens_draws_and_closes_cleanly() {
    let Some(desktop) = Desktop::start() else { return };
    let directory = tempfile::tempdir().expect("a temporary folder");
    let program = desktop.open(directory.path(), "relief", &SMALL);
    let picture = program.picture_that("the surface beside the panel", |picture| colours(picture, 340..700) > 500);
    assert_eq!(picture.dimensions(), (700, 400));
    assert!(colours(&picture, 0..320) > 50, "the panel is there");
    program.close();
    assert_ended_well(&program.end());
}

#[test]
fn a_script_writes_what_capture_would() {
    let Some(desktop) = Desktop::start() else { return };
    let directory = tempfile::tempdir().expect("a temporary folder");
    let (live, captured) = (directory.path().join("live"), directory.path().join("captured"));
    let small = ["--size", "160x120", "--field", "64"];
    let mut arguments = small.to_vec();
    let out = live.to_string_lossy().into_owned();
    arguments.extend(["--frames", "40", "--out", &out]);
    assert_ended_well(&desktop.open(directory.path(), "ripples", &arguments).end());
    capture("ripples", &[&small[..], &["--warmup", "39"]].concat(), &captured);
    for file in ["frame_00000.png", "manifest.json"] {
        let read = |folder: &Path| std::fs::read(folder.join(file)).expect("it was written");
        assert!(read(&live) == read(&captured), "{file} differs");
    }
}

#[test]
fn a_click_upon_the_surface_changes_the_field_there() {
    let Some(desktop) = Desktop::start() else { return };
    let directory = tempfile::tempdir().expect("a temporary folder");
    let (live, still) = (directory.path().join("live"), directory.path().join("still"));
    let out = live.to_string_lossy().into_owned();
    // Frames enough for the click to fall among them on a fast machine, too.
    let program =
        desktop.open(directory.path(), "relief", &["--size", "320x240", "--field", "128", "--frames", "400", "--out", &out]);
    program.hand("mousemove --window WINDOW 200 150 click 1");
    assert_ended_well(&program.end());
    capture("relief", &["--size", "320x240", "--field", "128"], &still);
    let (live, still) = (read_picture(&live), read_picture(&still));
    let changed: Vec<[u32; 2]> =
        still.enumerate_pixels().filter(|(x, y, pixel)| live.get_pixel(*x, *y) != *pixel).map(|(x, y, _)| [x, y]).collect();
    // A crater of a few per cent of the plane's width, its scorch and the shadows of its rim, around the pointer.
    assert!(changed.len() > 50, "{} pixels changed", changed.len());
    let near = changed.iter().filter(|[x, y]| x.abs_diff(200) < 40 && y.abs_diff(150) < 40).count();
    assert!(near * 10 >= changed.len() * 9, "{near} of {} changed pixels are near the click", changed.len());
    assert!(changed.contains(&[200, 150]), "the surface under the pointer itself changed");
}

#[test]
fn a_drop_upon_the_water_makes_waves_even_while_it_rains() {
    let Some(desktop) = Desktop::start() else { return };
    let directory = tempfile::tempdir().expect("a temporary folder");
    let (live, rain) = (directory.path().join("live"), directory.path().join("rain"));
    let out = live.to_string_lossy().into_owned();
    let small = ["--size", "240x180", "--field", "64"];
    let program = desktop.open(directory.path(), "ripples", &[&small[..], &["--frames", "600", "--out", &out]].concat());
    // Held down to the end: drops fall until the last frame.
    program.hand("mousemove --window WINDOW 120 100 mousedown 1");
    assert_ended_well(&program.end());
    capture("ripples", &[&small[..], &["--warmup", "599"]].concat(), &rain);
    // Without the hand the two would agree to the byte.
    let (live, rain) = (read_picture(&live), read_picture(&rain));
    let changed = live.pixels().zip(rain.pixels()).filter(|(a, b)| a != b).count();
    assert!(changed > 1000, "{changed} pixels changed");
}

#[test]
fn a_recorded_session_is_replayed_to_the_byte() {
    let Some(desktop) = Desktop::start() else { return };
    let directory = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| directory.path().join(name);
    let small = ["--size", "240x180", "--field", "64"];
    for scene in ["ripples", "bullet-wall"] {
        let recorded = ["--frames", "300", "--out", "live", "--record", "journal", "--save-state", "state"];
        let program = desktop.open(directory.path(), scene, &[&small[..], &recorded[..]].concat());
        // Strokes, a parameter that changes, a new seed, which begins anew, another camera, and more strokes.
        program.hand("mousemove --window WINDOW 120 100 mousedown 1 sleep 0.2 mouseup 1 key t key R");
        program.hand("mousemove --window WINDOW 90 90 mousedown 3 mousemove --window WINDOW 110 95 mouseup 3");
        program.hand("mousemove --window WINDOW 130 110 mousedown 1 mousemove --window WINDOW 150 120");
        assert_ended_well(&program.end());
        let replay = |mode: &[&str]| {
            let output = Command::new(env!("CARGO_BIN_EXE_rilievo"))
                .current_dir(directory.path())
                .args(mode)
                .args(["--replay", "journal", "--size", "240x180"])
                .output()
                .expect("the program starts");
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        };
        replay(&["capture", "--warmup", "299", "--out", "captured", "--save-state", "replayed"]);
        let read = |file: &str| std::fs::read(at(file)).expect("it was written");
        assert!(read("live/frame_00000.png") == read("captured/frame_00000.png"), "{scene}: the picture differs");
        // The scene in the states differs in nothing, nor do the textures; the clocks ran at another pace.
        let states = ["state", "replayed"].map(|file| rilievo::io::state_file::read(&at(file)).expect("it is whole"));
        assert!(states[0].blobs == states[1].blobs, "{scene}: the field differs");
        assert_eq!(states[0].scene, states[1].scene, "{scene}");
        assert!(
            std::fs::read_to_string(at("journal")).expect("it is text").contains("\"strokes\""),
            "{scene}: the hand did nothing"
        );
        // It may be looked at otherwise, and measured.
        replay(&["stress", "--frames", "20", "--technique", "normal", "--shadow", "none"]);
    }
}

#[test]
fn survives_twenty_random_resizes_and_a_minimise() {
    let Some(desktop) = Desktop::start() else { return };
    let directory = tempfile::tempdir().expect("a temporary folder");
    let mut program = desktop.open(directory.path(), "ripples", &SMALL);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
    for _ in 0..20 {
        let (width, height) = (random.random_range(40..900), random.random_range(40..700));
        program.hand(&format!("windowsize WINDOW {width} {height}"));
        std::thread::sleep(Duration::from_millis(random.random_range(0..150)));
        assert!(program.runs());
    }
    program.hand("windowminimize WINDOW");
    std::thread::sleep(Duration::from_secs(1));
    assert!(program.runs());
    program.hand("windowmap WINDOW windowactivate WINDOW");
    program.hand("windowsize WINDOW 600 420");
    program.picture_that("the surface, in the last size", |picture| {
        picture.dimensions() == (600, 420) && colours(picture, 340..600) > 500
    });
    program.close();
    assert_ended_well(&program.end());
}

#[test]
fn memory_does_not_grow_over_two_thousand_frames() {
    let Some(desktop) = Desktop::start() else { return };
    let directory = tempfile::tempdir().expect("a temporary folder");
    for scene in ["bullet-wall", "relief"] {
        let small = ["--size", "64x48", "--field", "32", "--frames", "2200", "--out", "out"];
        let mut program = desktop.open(directory.path(), scene, &small);
        // Caches fill in the first frames; after that nothing may be kept.
        std::thread::sleep(Duration::from_secs(1));
        let (first, mut most) = (program.resident_kibibytes(), None);
        while program.runs() {
            most = most.max(program.resident_kibibytes());
            std::thread::sleep(Duration::from_millis(50));
        }
        let (first, most) = first.zip(most).expect("2,200 frames take more than a second");
        // A kibibyte a frame would be 2 MiB; what a driver keeps in reserve comes in larger pieces.
        assert!(most < first + 16 * 1024, "{scene}: grew from {first} to {most} KiB");
        assert_ended_well(&program.end());
    }
}

#[test]
fn keys_and_mouse_do_what_the_panel_says() {
    let Some(desktop) = Desktop::start() else { return };
    let directory = tempfile::tempdir().expect("a temporary folder");
    let program = desktop.open(directory.path(), "relief", &SMALL);
    let first = program.picture_that("the surface beside the panel", |picture| colours(picture, 340..700) > 500);

    // A drag that starts upon the panel's heading moves nothing, wherever it goes.
    program.hand("mousemove --window WINDOW 100 14 mousedown 3 mousemove --window WINDOW 500 200 mouseup 3");
    program.hand("key H key H sleep 0.5");
    let after = program.picture();
    assert!(differing(&first, &after, 340..680) < 200, "the camera moved with a drag of the panel's");

    // The same button upon the surface turns the camera.
    program.hand("mousemove --window WINDOW 500 200 mousedown 3 mousemove --window WINDOW 560 230 mouseup 3");
    program.picture_that("another view", |picture| differing(&after, picture, 340..680) > 5000);
    // C brings it back.
    program.hand("key c");
    program.picture_that("the first view", |picture| differing(&after, picture, 340..680) < 200);

    // Without the panel the surface is in the middle.
    program.hand("key Tab");
    let bare = program.picture_that("no panel", |picture| differing(&after, picture, 0..320) > 5000);
    program.hand("key Tab");
    program.picture_that("the panel again", |picture| differing(&bare, picture, 0..320) > 5000);

    program.hand("key t");
    wait_for("another technique", || program.title().contains("Normal mapping"));
    program.hand("key p");
    let file = directory.path().join("rilievo-relief-001.png");
    wait_for("a picture", || image::open(&file).is_ok_and(|picture| picture.width() == 700));
    program.hand("key 2");
    wait_for("another scene", || program.title().starts_with("bullet-wall"));

    // Esc closes no window.
    program.hand("key F1 key Escape key Escape sleep 0.5");
    program.close();
    assert_ended_well(&program.end());
}

#[test]
fn a_window_that_is_destroyed_ends_the_program_without_a_panic() {
    let Some(desktop) = Desktop::start() else { return };
    let directory = tempfile::tempdir().expect("a temporary folder");
    let program = desktop.open(directory.path(), "ripples", &SMALL);
    program.hand("windowclose WINDOW");
    assert_ended_well(&program.end());
}

#[test]
fn an_interrupted_session_keeps_its_journal_and_its_state() {
    let Some(desktop) = Desktop::start() else { return };
    for (name, code) in [("INT", 130), ("TERM", 143)] {
        let directory = tempfile::tempdir().expect("a temporary folder");
        let small = [&SMALL[..], &["--record", "journal", "--save-state", "state"]].concat();
        let program = desktop.open(directory.path(), "ripples", &small);
        program.hand("mousemove --window WINDOW 520 250 click 1 sleep 0.5");
        program.signal(name);
        let output = program.end();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{said}");
        assert!(said.starts_with("error: interrupted") && said.lines().count() == 1, "{said}");
        let mut names: Vec<_> =
            std::fs::read_dir(&directory).expect("it is there").map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["journal", "state"]);
        let journal = rilievo::io::journal::read(&directory.path().join("journal")).expect("it is whole");
        assert!(journal.entries.len() > 1);
        rilievo::io::state_file::read(&directory.path().join("state")).expect("it is whole");
    }
}

#[test]
fn closing_a_script_early_writes_nothing_and_says_so() {
    let Some(desktop) = Desktop::start() else { return };
    let directory = tempfile::tempdir().expect("a temporary folder");
    let out = directory.path().join("out");
    let program = desktop.open(directory.path(), "ripples", &["--size", "320x240", "--frames", "100000", "--out", "out"]);
    program.close();
    let output = program.end();
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("nothing was written"));
    assert!(!out.exists());
}

#[test]
fn without_a_display_one_sentence_says_what_to_do() {
    let output = Command::new(env!("CARGO_BIN_EXE_rilievo"))
        .args(["live", "--scene", "relief"])
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("capture") && said.lines().count() == 1, "{said}");
    assert!(output.stdout.is_empty());
}
