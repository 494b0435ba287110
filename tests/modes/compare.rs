//! `compare` end to end: the program runs as a process, and its tables are read back as a script would.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::captures::rilievo;
use crate::support::gpu::gpu;
use crate::support::tolerances::{COMPARED_P99, TANGENT_SHARE};

/// Runs a comparison, which must succeed, and returns its table, and what it printed.
fn compare(directory: &Path, arguments: &[&str]) -> (Value, String) {
    let json = directory.join("t.json");
    let json_text = json.to_str().expect("temporary directories have plain names");
    let output = rilievo(&[&["compare", "--frames", "1", "--json", json_text], arguments].concat());
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    (read(&json), String::from_utf8_lossy(&output.stdout).into_owned())
}

fn read(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).expect("the table was written")).expect("it is JSON")
}

fn rows(table: &Value) -> &[Value] {
    table["rows"].as_array().expect("a table has rows")
}

fn number(row: &Value, pointer: &str) -> f64 {
    row.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer} of {row}"))
}

fn temporary() -> tempfile::TempDir {
    tempfile::tempdir().expect("there is a temporary directory")
}

const SMALL: [&str; 8] = ["--scene", "relief", "--field", "128", "--size", "160x100", "--shadow", "hard"];
const RMS: &str = "/position_error_texels/rms";

#[test]
fn exact_is_where_the_reference_is_and_approximations_are_not() {
    if gpu().is_none() {
        return;
    }
    let directory = temporary();
    // From above, and four degrees over the plane.
    let cameras = ["--view-from", "0,1,0.8,0,-0.04,0.02", "--view-from", "0.2,0.07,0.95,0,0,0"];
    let more = ["--techniques", "exact,normal,pom", "--truth", "reference"];
    let (table, _) = compare(directory.path(), &[&SMALL[..], &cameras, &more].concat());
    assert_eq!(rows(&table).len(), 6);
    for rows in rows(&table).chunks_exact(3) {
        let [exact, normal, pom] = rows else { unreachable!("chunks are exact") };
        let pixels = number(exact, "/pixels");
        assert!(pixels > 1000.0, "{exact}");
        // One pixel in so few is more than the share that may be tangent.
        assert!(number(exact, "/wrong_cell_share") <= TANGENT_SHARE.max(1.0 / pixels), "{exact}");
        assert!(number(exact, "/position_error_texels/p99") < COMPARED_P99, "{exact}");
        // The true picture is that of exact.
        assert_eq!((number(exact, "/flip"), &exact["psnr_db"], number(exact, "/visibility_rms")), (0.0, &Value::Null, 0.0));
        for worse in [normal, pom] {
            assert!(number(worse, RMS) > 10.0 * number(exact, RMS) && number(worse, "/flip") > 0.001, "{worse}");
            let texel = number(worse, "/position_error_metres/rms") / number(worse, RMS);
            assert!((texel * 128.0 - 1.0).abs() < 1e-6, "a plane of one metre has 128 texels a metre, not {texel}");
        }
        assert!(number(normal, RMS) > number(pom, RMS) && number(normal, "/wrong_cell_share") > 0.5);
    }
}

#[test]
fn the_reference_speaks_of_the_bare_plane_alone() {
    if gpu().is_none() {
        return;
    }
    for other in [&["--mesh", "box"][..], &["--mesh", "sphere"], &["--shell"], &["--mesh", "torus", "--shell"]] {
        let reference = ["compare", "--truth", "reference", "--techniques", "exact", "--frames", "1"];
        let output = rilievo(&[&reference[..], &SMALL, other].concat());
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(1) && told.contains("knows the bare plane alone"), "{other:?}: {told}");
    }
}

#[test]
fn more_samples_make_a_smaller_error_and_the_curve_shows_it() {
    if gpu().is_none() {
        return;
    }
    let directory = temporary();
    let out = directory.path().join("out");
    let more = ["--techniques", "pom,exact", "--sweep-samples", "64,4,16", "--out", out.to_str().expect("a plain name")];
    let (table, text) = compare(directory.path(), &[&SMALL[..], &more].concat());
    let counts: Vec<_> = rows(&table).iter().map(|row| row["samples"].as_u64()).collect();
    assert_eq!(counts, [Some(4), Some(16), Some(64), None]);
    let errors: Vec<_> = rows(&table).iter().map(|row| number(row, RMS)).collect();
    assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?}");
    let steps: Vec<_> = rows(&table)[..3].iter().map(|row| number(row, "/steps_per_pixel/max")).collect();
    assert!(steps.iter().zip([4.0, 16.0, 64.0]).all(|(steps, count)| *steps <= count + 2.0), "{steps:?}");
    assert!(text.contains("RMS") && text.contains("pom"), "{text}");

    assert_eq!(read(&out.join("table.json")), table, "both tables are of one run");
    let curve = image::open(out.join("curve_00000.png")).expect("there is a curve").to_rgb8();
    let saturated = |pixel: &[u8; 3]| pixel.iter().max().zip(pixel.iter().min()).is_some_and(|(most, least)| most - least > 60);
    let coloured = curve.pixels().filter(|pixel| saturated(&pixel.0)).count();
    assert!(coloured > 500, "lines are in colour: {coloured} pixels");
}

#[test]
fn pictures_are_written_and_those_of_an_earlier_run_removed() {
    if gpu().is_none() {
        return;
    }
    let directory = temporary();
    let out = directory.path().join("a/out");
    let names = || {
        let mut names: Vec<_> = fs::read_dir(&out)
            .expect("it was made")
            .map(|entry| entry.expect("it can be listed").file_name().into_string().expect("plain names"))
            .collect();
        names.sort();
        names
    };
    let arguments = |techniques: &'static str| {
        [&SMALL[..], &["--techniques", techniques, "--out", out.to_str().expect("a plain name")]].concat()
    };
    let (table, _) = compare(directory.path(), &arguments("normal,exact"));
    let of_row = |row: u32| [".png", "_error.png", "_flip.png"].map(|end| format!("row_{row:05}{end}"));
    let mut all: Vec<String> = [of_row(0), of_row(1)].concat();
    all.sort();
    all.extend(["table.csv", "table.json", "truth_00000.png"].map(str::to_owned));
    assert_eq!(names(), all);
    let files: Vec<_> = rows(&table)[0]["files"].as_array().expect("a list").iter().filter_map(Value::as_str).collect();
    assert_eq!(files, ["row_00000.png", "row_00000_error.png", "row_00000_flip.png", "truth_00000.png"]);
    let picture = |name: &str| image::open(out.join(name)).expect("it is a picture").to_rgb8();
    assert_eq!(picture("row_00001.png"), picture("truth_00000.png"), "exact is the truth");
    assert_ne!(picture("row_00000.png"), picture("truth_00000.png"));
    let light = |name: &str| picture(name).pixels().map(|pixel| u64::from(pixel.0[0])).sum::<u64>();
    assert!(light("row_00000_flip.png") > light("row_00001_flip.png"), "only normal differs");

    fs::write(out.join("notes.txt"), "mine").expect("the directory can be written");
    compare(directory.path(), &arguments("exact"));
    let mut one = of_row(0).to_vec();
    one.sort();
    one.splice(0..0, ["notes.txt".to_owned()]);
    one.extend(["table.csv", "table.json", "truth_00000.png"].map(str::to_owned));
    assert_eq!(names(), one);
}

#[test]
fn csv_and_json_say_the_same() {
    if gpu().is_none() {
        return;
    }
    let directory = temporary();
    let csv = directory.path().join("t.csv");
    let more = ["--techniques", "pom,exact", "--shadows", "none,hard", "--csv", csv.to_str().expect("a plain name")];
    let (table, _) = compare(directory.path(), &[&SMALL[..6], &more].concat());
    let csv = fs::read_to_string(csv).expect("it was written");
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().expect("names stand first");
    let lines: Vec<_> = lines.collect();
    assert_eq!((lines.len(), rows(&table).len()), (4, 4));
    for (line, row) in lines.iter().zip(rows(&table)) {
        let value = |name: &str| line[head.iter().position(|column| *column == name).unwrap_or_else(|| panic!("no {name}"))];
        for (name, pointer) in [
            ("position_rms_texels", RMS),
            ("position_p99_texels", "/position_error_texels/p99"),
            ("position_max_metres", "/position_error_metres/max"),
            ("wrong_cell_share", "/wrong_cell_share"),
            ("visibility_rms", "/visibility_rms"),
            ("flip", "/flip"),
            ("steps_mean", "/steps_per_pixel/mean"),
            ("steps_p99", "/steps_per_pixel/p99"),
            ("memory_bytes", "/memory_bytes"),
            ("surface_ms", "/surface_ms"),
        ] {
            // JSON's parser may miss the last bit.
            let (in_csv, in_json) = (value(name).parse::<f64>().expect(name), number(row, pointer));
            assert!((in_csv - in_json).abs() <= 1e-14 * in_json.abs(), "{name}: {in_csv} and {in_json}");
        }
        for name in ["technique", "shadow", "truth_shadow"] {
            assert_eq!(row[name], value(name));
        }
        assert_eq!(value("psnr_db") == "inf", row["psnr_db"].is_null());
    }
    // Among several shadows the truest is the truth.
    assert!(rows(&table).iter().all(|row| row["truth_shadow"] != "none"), "{table}");
    assert!(number(&rows(&table)[2], "/visibility_rms") > 0.01, "no shadow is not the true one: {table}");
}

#[test]
fn a_field_swept_keeps_its_content() {
    if gpu().is_none() {
        return;
    }
    let directory = temporary();
    let more = ["--techniques", "exact", "--sweep-fields", "128,64,256"];
    // A wall under fire, so that what stamps left is carried over too.
    let scene = ["--scene", "bullet-wall", "--field", "128x64", "--size", "160x100", "--shadow", "none", "--warmup", "20"];
    let (table, text) = compare(directory.path(), &[&scene[..], &more].concat());
    let sizes: Vec<_> = rows(&table).iter().map(|row| row["field_size"].clone()).collect();
    assert_eq!(sizes, [[64, 32], [128, 64], [256, 128]].map(|size| serde_json::json!(size)));
    assert_eq!(text.matches("field ").count(), 3, "{text}");
    let pixels: Vec<_> = rows(&table).iter().map(|row| number(row, "/pixels")).collect();
    assert!(pixels.iter().all(|count| *count == pixels[0]), "a plane of one size in a picture of one camera: {pixels:?}");
    let memory: Vec<_> = rows(&table).iter().map(|row| number(row, "/memory_bytes")).collect();
    assert!(memory.is_sorted_by(|a, b| a < b), "{memory:?}");
}

#[test]
fn a_table_holds_against_itself_and_not_against_a_better_one() {
    if gpu().is_none() {
        return;
    }
    let directory = temporary();
    let arguments = [&SMALL[..], &["--techniques", "pom,exact"]].concat();
    let (table, _) = compare(directory.path(), &arguments);
    let earlier = directory.path().join("earlier.json");
    let check = |table: &Value, arguments: &[&str]| {
        fs::write(&earlier, table.to_string()).expect("the directory can be written");
        let earlier = earlier.to_str().expect("a plain name");
        rilievo(&[&["compare", "--frames", "1", "--check", earlier], arguments].concat())
    };
    let output = check(&table, &arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));

    let mut better = table.clone();
    let rms = better.pointer_mut("/rows/0/position_error_texels/rms").expect("it has one");
    *rms = (0.9 * rms.as_f64().expect("a number")).into();
    let mut another = table.clone();
    another["scene"]["name"] = "ripples".into();
    let mut future = table.clone();
    future["version"] = 99.into();
    for (table, parts) in [
        (better, &["pom, shadow hard, field 128×128, camera 1", "RMS position error", "earlier.json"][..]),
        (another, &["of the scene ripples, and this is relief"]),
        (future, &["version 99"]),
    ] {
        let output = check(&table, &arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), output.stdout.len(), stderr.lines().count()), (Some(1), 0, 1), "{stderr}");
        assert!(parts.iter().all(|part| stderr.contains(part)), "{stderr}");
    }
    let output = check(&table, &[&SMALL[..], &["--techniques", "pom"]].concat());
    assert!(String::from_utf8_lossy(&output.stderr).contains("exact, shadow hard"), "a row is missing");
}
