//! The command line as a script sees it: exit codes, one sentence on stderr, nothing on stdout, nothing left behind. The program runs
//! as a process.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};

use crate::captures::{capture, manifest, write_heights};
use crate::support::desktop::{signal, wait_for};

/// Runs the program in a directory.
fn rilievo(directory: &Path, arguments: &[&str]) -> Output {
    command(directory, arguments).output().expect("the program was built with the tests")
}

fn command(directory: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rilievo"));
    command.args(arguments).current_dir(directory).env_remove("RUST_LOG").env_remove("RUST_BACKTRACE");
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
    command
}

/// The sentence that a failed run says; nothing else may be said, and nothing left in the directory but what was there.
#[track_caller]
fn refused(output: &Output, code: i32) -> String {
    let (stdout, stderr) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{stderr}");
    assert_eq!(stdout, "");
    assert_eq!(stderr.lines().count(), 1, "one sentence: {stderr}");
    assert!(stderr.starts_with("error: ") && stderr.ends_with('\n') && !stderr.contains("panicked"), "{stderr}");
    stderr.into_owned()
}

fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).expect("the directory is there");
    let mut names: Vec<_> =
        entries.map(|entry| entry.expect("it can be listed").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn temporary() -> tempfile::TempDir {
    tempfile::tempdir().expect("there is a temporary directory")
}

/// Whether an adapter is there; without one these tests fail in CI, and elsewhere are skipped loudly.
fn has_adapter() -> bool {
    crate::support::gpu::gpu().is_some()
}

#[test]
fn arguments_alone_exit_with_2() {
    let directory = temporary();
    for (arguments, part) in [
        (&["--sceen", "relief"][..], "--scene"),
        (&["capture"], "--out"),
        (&["capture", "--out", "out", "--technique", "exat"], "did you mean `exact`, of normal"),
        (&["capture", "--out", "out", "--view", "stpes"], "did you mean `steps`"),
        (&["stress", "--split", "pom:soft"], "unknown shadow `soft`"),
        (&["capture", "--out", "out", "--shadow", "hrad"], "did you mean `hard`"),
        (&["capture", "--out", "out", "--size", "0x480"], "--size"),
        (&["capture", "--out", "out", "--frames", "0"], "--frames"),
        (&["capture", "--out", "out", "--dt", "-1"], "--dt"),
        (&["capture", "--out", "out", "--scene", "nowhere", "--field", "0"], "--field"),
        (&["capture", "--out", "out", "--text", ""], "--text"),
        (&["capture", "--out", "out", "--text", " \n "], "no letters"),
        (&["capture", "--out", "out", "--text", "a\tb"], "U+0009"),
        (&["capture", "--out", "out", "--text", "a", "--height", "b.png"], "exclude each other"),
        (&["capture", "--out", "out", "--text", "a", "--height-range", "0,2"], "exclude each other"),
        (&["capture", "--out", "out", "--font", "a.ttf", "--height", "b.png"], "exclude each other"),
        (&["stress", "--stamp-radius", "nan"], "--stamp-radius"),
        (&["live", "--fov", "180"], "--fov"),
        (&["compare", "--techniques", "pom,exat"], "did you mean `exact`"),
        (&["compare", "--sweep-samples", "4,0"], "--sweep-samples"),
        (&["compare", "--json", "t.json", "--check", "t.json"], "--check"),
    ] {
        let sentence = refused(&rilievo(directory.path(), arguments), 2);
        assert!(sentence.contains(part), "{arguments:?}: {sentence}");
    }
    assert_eq!(names(directory.path()), [""; 0]);
}

#[test]
fn help_version_and_scenes_go_to_stdout() {
    let directory = temporary();
    for (arguments, part) in [
        (&["--help"][..], "capture"),
        (&["capture", "--help"], "[default: 0]"),
        (&["--version"], env!("CARGO_PKG_VERSION")),
        (&["scenes"], "bullet-wall"),
    ] {
        let output = rilievo(directory.path(), arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert!(String::from_utf8_lossy(&output.stdout).contains(part), "{arguments:?}");
        assert!(output.stderr.is_empty(), "{arguments:?}");
    }
}

#[test]
fn unfit_content_exits_with_1_and_leaves_nothing() {
    let directory = temporary();
    let path = directory.path();
    fs::write(path.join("empty.png"), "").expect("the directory can be written");
    fs::write(path.join("text.png"), "no image\n").expect("the directory can be written");
    fs::write(path.join("broken.toml"), "version = 1\n[wave]\ncourrant = 0.5\n").expect("the directory can be written");
    fs::write(path.join("wild.toml"), "version = 1\n[wave]\ncourant = 0.9\n").expect("the directory can be written");
    fs::write(path.join("far.toml"), "version = 9\n").expect("the directory can be written");
    let before = names(path);
    for (arguments, part) in [
        (&["--scene", "riples"][..], "did you mean `ripples`, of ripples, bullet-wall, "),
        (&["--scene", "missing.toml"], "no such file"),
        (&["--scene", "./"], "directory"),
        (&["--scene", "broken.toml"], "broken.toml, line 3: unknown field `courrant`"),
        (&["--scene", "wild.toml"], "`wave.courant` is 0.9"),
        (&["--scene", "far.toml"], "version 9"),
        (&["--scene", "./text.png"], "line 1"),
        (&["--height", "missing.png"], "no such file"),
        (&["--height", "."], "directory"),
        (&["--height", "empty.png"], "empty"),
        (&["--height", "text.png"], "text, not a PNG"),
        (&["--height-range", "0,2"], "--height"),
        (&["--text", "a漢"], "has no glyph for `漢` (U+6F22)"),
        (&["--scene", "text", "--font", "missing.ttf"], "missing.ttf: there is no such file"),
        (&["--scene", "text", "--font", "text.png"], "text.png is not a TTF or OTF font"),
        (&["--scene", "text", "--font", "empty.png"], "empty"),
        (&["--font", "missing.ttf"], "--text"),
        (&["--albedo", "missing.png"], "missing.png: there is no such file"),
        (&["--albedo", "text.png"], "text, not a PNG"),
        (&["--albedo", "."], "directory"),
        // The scene is read before the image, and the image before anything of the adapter's.
        (&["--scene", "broken.toml", "--height", "missing.png"], "line 3"),
        (&["--height", "missing.png", "--adapter", "none of this name"], "missing.png"),
    ] {
        for mode in [&["capture", "--out", "out"][..], &["stress"], &["compare", "--out", "out"]] {
            let sentence = refused(&rilievo(path, &[mode, arguments].concat()), 1);
            assert!(sentence.contains(part), "{arguments:?}: {sentence}");
        }
    }
    assert_eq!(names(path), before);
}

#[test]
fn an_unfit_table_exits_with_1_before_anything_is_measured() {
    let directory = temporary();
    let path = directory.path();
    fs::write(path.join("text.json"), "no table\n").expect("the directory can be written");
    fs::write(path.join("cut.json"), "{\"version\": 1, \"rows\": [").expect("the directory can be written");
    fs::write(path.join("far.json"), "{\"version\": 9}").expect("the directory can be written");
    fs::write(path.join("bare.json"), "{\"version\": 1}").expect("the directory can be written");
    let before = names(path);
    for (file, part) in [
        ("missing.json", "no such file"),
        (".", "directory"),
        ("text.json", "is not JSON"),
        ("cut.json", "ends too early"),
        ("far.json", "is of version 9"),
        ("bare.json", "missing field"),
    ] {
        let sentence = refused(&rilievo(path, &["compare", "--out", "out", "--check", file]), 1);
        assert!(sentence.contains(part), "{file}: {sentence}");
    }
    assert_eq!(names(path), before);
}

#[test]
fn no_adapter_exits_with_3() {
    let directory = temporary();
    for mode in [&["adapters"][..], &["stress"], &["capture", "--out", "out"], &["compare", "--out", "out"]] {
        let sentence = refused(&rilievo(directory.path(), &[mode, &["--adapter", "none of this name"]].concat()), 3);
        assert!(sentence.contains("none of this name"), "{sentence}");
        // No driver at all: the loaders look where there is nothing.
        let mut nowhere = command(directory.path(), mode);
        for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES", "__EGL_VENDOR_LIBRARY_DIRS", "LIBGL_DRIVERS_PATH"] {
            nowhere.env(variable, "/nonexistent");
        }
        if cfg!(target_os = "linux") {
            let sentence = refused(&nowhere.env_remove("WGPU_BACKEND").output().expect("the program was built"), 3);
            assert!(sentence.contains("install"), "{sentence}");
        }
    }
    assert_eq!(names(directory.path()), [""; 0]);
}

#[test]
fn adapters_lists_what_there_is() {
    if has_adapter() {
        let directory = temporary();
        let output = rilievo(directory.path(), &["adapters"]);
        assert_eq!(output.status.code(), Some(0));
        assert!(output.stdout.starts_with(b"* "), "the first usable one is marked");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    }
}

#[test]
fn limits_are_told() {
    if has_adapter() {
        let directory = temporary();
        write_heights(&directory.path().join("h.png"), [2, 2], |_, _| 0.5);
        for arguments in
            [&["--size", "4000000000x2"][..], &["--field", "4000000000"], &["--height", "h.png", "--field", "4000000000x2"]]
        {
            for mode in [&["capture", "--out", "out"][..], &["stress"], &["compare", "--out", "out"]] {
                let sentence = refused(&rilievo(directory.path(), &[mode, arguments].concat()), 1);
                assert!(sentence.contains("4000000000") && sentence.contains("limit of"), "{sentence}");
            }
        }
        let sentence = refused(&rilievo(directory.path(), &["compare", "--out", "out", "--sweep-fields", "64,4000000000"]), 1);
        assert!(sentence.contains("4000000000") && sentence.contains("limit of"), "{sentence}");
        // Of several reliefs the one that is too large is named.
        let reliefs = "version = 1\n[[reliefs]]\n[[reliefs]]\n[reliefs.field]\nsize = [1000000, 8]\n";
        fs::write(directory.path().join("s.toml"), reliefs).expect("the directory can be written");
        let sentence = refused(&rilievo(directory.path(), &["capture", "--out", "out", "--scene", "s.toml"]), 1);
        assert!(sentence.contains("the field of `reliefs[1]` of 1000000×8") && sentence.contains("limit of"), "{sentence}");
        assert_eq!(names(directory.path()), ["h.png", "s.toml"]);
    }
}

#[test]
fn an_output_that_cannot_be_written_exits_with_1() {
    if has_adapter() {
        let directory = temporary();
        fs::write(directory.path().join("file"), "mine").expect("the directory can be written");
        for out in ["file", "file/below", "file/below/further"] {
            let sentence = refused(&rilievo(directory.path(), &["capture", "--size", "8x8", "--out", out]), 1);
            assert!(sentence.contains("file"), "{sentence}");
        }
        let sentence = refused(
            &rilievo(directory.path(), &["stress", "--size", "8x8", "--field", "16", "--frames", "1", "--json", "no/j"]),
            1,
        );
        assert!(sentence.contains("no/j"), "{sentence}");
        let compare = ["compare", "--size", "8x8", "--field", "16", "--frames", "1", "--out"];
        for (out, more, part) in [("file/below", &[][..], "file"), ("out", &["--csv", "no/c"], "no/c")] {
            let sentence = refused(&rilievo(directory.path(), &[&compare[..], &[out], more].concat()), 1);
            assert!(sentence.contains(part), "{sentence}");
        }
        assert_eq!(fs::read(directory.path().join("file")).expect("it is still there"), b"mine");
        assert_eq!(names(directory.path()), ["file"]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_fills_exits_with_1_and_leaves_nothing() {
    if !has_adapter() {
        return;
    }
    let directory = temporary();
    let disk = directory.path().join("disk");
    fs::create_dir(&disk).expect("the directory can be written");
    // 64 KiB: room for a few small pictures, not for all.
    let mounted = Command::new("mount").args(["-t", "tmpfs", "-o", "size=64k", "none"]).arg(&disk).output();
    if !mounted.is_ok_and(|output| output.status.success()) {
        eprintln!("SKIPPED, a disk that fills is not tested: only root may mount a small one");
        return;
    }
    fs::write(disk.join("mine.txt"), "mine").expect("there is room yet");
    let arguments =
        ["capture", "--size", "96x64", "--field", "64", "--frames", "50", "--channels", "position,height", "--out", "disk/out"];
    let output = rilievo(directory.path(), &arguments);
    let left = names(&disk);
    let unmounted = Command::new("umount").arg(&disk).status();
    assert!(unmounted.is_ok_and(|status| status.success()), "the small disk stays mounted at {}", disk.display());
    let sentence = refused(&output, 1);
    assert!(sentence.contains("the disk is full") && sentence.contains("disk/out/"), "{sentence}");
    assert_eq!(left, ["mine.txt"]);
}

#[test]
fn a_second_run_replaces_the_files_of_the_first_alone() {
    if has_adapter() {
        let directory = temporary();
        let out = directory.path().join("a/b");
        let small = ["--scene", "relief", "--size", "16x12", "--field", "16"];
        capture(&out, &[&small[..], &["--frames", "3", "--channels", "height"]].concat());
        fs::write(out.join("notes.txt"), "mine").expect("the directory can be written");
        let all = ["field_00000.exr", "field_00001.exr", "field_00002.exr", "frame_00000.exr", "frame_00000.png"];
        assert_eq!(names(&out)[..5], all);
        capture(&out, &small);
        assert_eq!(names(&out), ["frame_00000.png", "manifest.json", "notes.txt"]);
        assert_eq!(manifest(&out)["frames"][0]["files"], serde_json::json!(["frame_00000.png"]));
    }
}

#[test]
fn an_image_sets_the_size_of_the_field() {
    if has_adapter() {
        let directory = temporary();
        let image = directory.path().join("h.png");
        write_heights(&image, [30, 20], |x, _| f64::from(x) / 29.0);
        let out = directory.path().join("out");
        let image = image.to_str().expect("temporary directories have plain names");
        for (more, size, plane) in [
            (&[][..], [30, 20], [1.0, 20.0 / 30.0]),
            (&["--field", "16"], [16, 11], [1.0, 11.0 / 16.0]),
            (&["--field", "7x21"], [7, 21], [1.0, 3.0]),
        ] {
            capture(&out, &[&["--scene", "relief", "--size", "16x12", "--height", image][..], more].concat());
            let manifest = manifest(&out);
            assert_eq!(manifest["field_size"], serde_json::json!(size));
            for (written, expected) in manifest["plane_size"].as_array().expect("it is a pair").iter().zip(plane) {
                assert!((written.as_f64().expect("it is a number") - expected).abs() < 1e-6, "{manifest}");
            }
        }
    }
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_error() {
    use std::process::Stdio;
    let directory = temporary();
    for arguments in [["--help"], ["scenes"]] {
        let mut child = command(directory.path(), &arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program was built with the tests");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("it ends by itself");
        assert_eq!(output.status.code(), Some(0));
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_stdout_is_an_error() {
    let directory = temporary();
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
    let output = command(directory.path(), &["scenes"]).stdout(full).stderr(std::process::Stdio::piped()).output();
    let output = output.expect("the program was built with the tests");
    let sentence = refused(&output, 1);
    assert!(sentence.contains("stdout"), "{sentence}");
}

/// A run that would take hours, of which this file is there already.
#[cfg(unix)]
fn long_run(directory: &Path, arguments: &[&str], file: &str) -> Child {
    let arguments = [arguments, &["--size", "64x48", "--field", "64", "--frames", "1000000"]].concat();
    let child = command(directory, &arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts");
    wait_for(file, || directory.join(file).exists());
    child
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_only_what_is_whole() {
    if !has_adapter() {
        return;
    }
    for (arguments, first, name, code) in [
        (&["capture", "--scene", "ripples", "--out", "out", "--save-state", "state"][..], "out/frame_00002.png", "TERM", 143),
        (&["capture", "--scene", "ripples", "--out", "out"], "out/frame_00000.png", "HUP", 129),
        (
            &["compare", "--techniques", "steep", "--out", "out", "--csv", "t.csv", "--json", "t.json"],
            "out/row_00000.png",
            "INT",
            130,
        ),
    ] {
        let directory = temporary();
        let child = long_run(directory.path(), arguments, first);
        signal(&child, name);
        // As `timeout` does, which tells a program and then its group.
        signal(&child, name);
        let output = child.wait_with_output().expect("it ends");
        let sentence = refused(&output, code);
        assert!(sentence.contains("interrupted"), "{sentence}");
        assert_eq!(names(directory.path()), ["out"], "{arguments:?}");
        for file in names(&directory.path().join("out")) {
            assert!(file.ends_with(".png"), "{arguments:?}: {file}");
            image::open(directory.path().join("out").join(file)).expect("it is whole");
        }
    }
}

#[cfg(unix)]
#[test]
fn a_signal_that_is_ignored_stays_so() {
    if !has_adapter() {
        return;
    }
    let directory = temporary();
    let line = r#"trap "" INT HUP; exec "$0" capture --scene ripples --size 64x48 --field 64 --frames 60 --out out"#;
    let shell = Command::new("sh").args(["-c", line, env!("CARGO_BIN_EXE_rilievo")]).current_dir(directory.path()).spawn();
    let mut child = shell.expect("there is a shell");
    wait_for("the first frame", || directory.path().join("out/frame_00000.png").exists());
    signal(&child, "INT");
    signal(&child, "HUP");
    assert!(child.wait().expect("it ends").success());
    assert!(directory.path().join("out/manifest.json").exists());
}
