//! The arguments that are read, and those that are refused.

use std::ffi::OsString;
use std::path::PathBuf;

use super::*;
use crate::io::scene_file::{CameraPlacement, FieldSize, SceneOverrides};
use crate::surface::{Shadow, Technique};

fn parse(line: &str) -> Result<Command, Refusal> {
    super::parse(std::iter::once("rilievo").chain(line.split_whitespace()))
}

fn capture(line: &str) -> CaptureOptions {
    match parse(&format!("capture --out DIR {line}")) {
        Ok(Command::Capture(options)) => options,
        other => panic!("{line}: {other:?}"),
    }
}

#[test]
fn clap_finds_no_fault_with_the_declaration() {
    <Arguments as clap::CommandFactory>::command().debug_assert();
}

#[test]
fn the_defaults_are_those_of_the_contract() {
    let options = capture("");
    assert_eq!((options.frames, options.dt, options.warmup), (1, 1.0 / 60.0, 0));
    assert_eq!(options.channels(), [Channel::Color]);
    assert_eq!(options.common.overrides(), SceneOverrides::default());
    let Ok(Command::Stress(options)) = parse("stress") else { panic!() };
    assert_eq!((options.frames, options.stamps, options.stamp_radius, options.json), (60, 0, 8.0, None));
    let Ok(Command::Live(options)) = parse("live") else { panic!() };
    assert_eq!((options.frames, options.out), (None, None));
}

#[test]
fn without_a_mode_it_is_live() {
    assert_eq!(parse(""), parse("live"));
    assert_eq!(parse("--scene relief --seed 3"), parse("live --scene relief --seed 3"));
    assert_eq!(parse("--frames 3 --out DIR"), parse("live --frames 3 --out DIR"));
}

#[test]
fn values_arrive() {
    let options = capture(
        "--scene a.toml --technique pom --shadow pom-soft --seed 18446744073709551615 --size 7x9 --field 31 --height h.png \
         --height-range -5,7.5 --depth 0.25 --camera -1,2,-3,0,-.5,1e-3 --fov 30 --light-angle 2.5 --adapter llvm --backend gl -v \
         --frames 5 --dt 0.5 --warmup 9 --channels lod,height,lod",
    );
    assert_eq!(options.common.scene, "a.toml");
    assert_eq!(options.common.image_size, [7, 9]);
    assert_eq!(options.common.machine.adapter.as_deref(), Some("llvm"));
    assert_eq!(options.common.machine.backend, Some(wgpu::Backends::GL));
    assert_eq!(
        options.common.overrides(),
        SceneOverrides {
            height: Some("h.png".into()),
            height_range: Some([-5.0, 7.5]),
            field: Some(FieldSize::Width(31)),
            depth_metres: Some(0.25),
            technique: Some(Technique::Pom),
            shadow: Some(Shadow::PomSoft),
            seed: Some(u64::MAX),
            camera: Some(CameraPlacement { eye: [-1.0, 2.0, -3.0], target: [0.0, -0.5, 1e-3] }),
            vertical_fov_degrees: Some(30.0),
            light_half_angle_degrees: Some(2.5),
        }
    );
    assert_eq!((options.frames, options.dt, options.warmup), (5, 0.5, 9));
    assert_eq!(options.channels(), [Channel::Color, Channel::Height, Channel::Lod]);
    assert_eq!(Command::Capture(options).verbosity(), Verbosity::Verbose);
    assert_eq!(capture("--field 31x7").common.overrides().field, Some(FieldSize::Exactly([31, 7])));
    assert_eq!(parse("live --camera=-1,2,3,0,0,0"), parse("live --camera -1,2,3,0,0,0"));
}

#[test]
fn help_tells_every_default() {
    for line in ["--help", "live --help", "capture --help", "stress --help", "adapters --help"] {
        let Err(Refusal::Told(help)) = parse(line) else { panic!("{line}") };
        // Each flag up to the next, whatever the lines are broken into. Help and version do nothing unless asked.
        let flags = help.split("\n  ").map(|part| part.split_whitespace().collect::<Vec<_>>().join(" "));
        let mut paragraphs: Vec<String> = Vec::new();
        for part in flags {
            if part.starts_with('-') || paragraphs.is_empty() {
                paragraphs.push(part)
            } else {
                *paragraphs.last_mut().unwrap() += &part
            }
        }
        let flags =
            paragraphs.iter().filter(|part| part.starts_with('-') && !part.contains("--help") && !part.contains("--version"));
        for flag in flags.filter(|flag| !(line.starts_with("capture") && flag.starts_with("--out"))) {
            assert!(flag.contains("[default:"), "{line}: {flag}");
        }
    }
    assert!(matches!(parse("--version"), Err(Refusal::Told(_))));
}

#[test]
fn nonsense_is_refused_in_one_sentence() {
    let lines = [
        ("--sceen x", "--scene"),
        ("fly", "known are live, capture, stress, adapters and scenes"),
        ("captur --out DIR", "capture"),
        ("capture", "--out"),
        ("capture --out", "--out"),
        ("capture --out=", "--out"),
        ("--size 8x8 capture --out DIR", "mode"),
        ("capture --out DIR extra", "extra"),
        ("capture --out a --out b", "twice"),
        ("live -v -q", "exclude"),
        ("live --frames 3", "--out"),
        ("live --out DIR", "--frames"),
        ("live --technique exat", "did you mean `exact`, of normal, pom and exact?"),
        ("live --technique", "--technique"),
        ("live --shadow soft", "none, steep, hard, pom-soft, cone and area"),
        ("live --backend vulcan", "did you mean `vulkan`"),
        ("live --adapter=", "--adapter"),
        ("capture --out DIR --channels color,hight", "did you mean `height`"),
        ("capture --out DIR --channels color,", "known are color"),
    ];
    let values = [
        ("seed", "-1 1.5 x 18446744073709551616"),
        ("size", "0x5 5x0 5 5x 5x5x5 -5x5 5.5x5 4294967296x1 axb"),
        ("field", "0 0x5 5x0 -5 5.5 5x x 4294967296"),
        ("height-range", "1,1 5,1 1 1,2,3 nan,1 0,inf a,b , -1e39,1e39"),
        ("depth", "0 -1 nan inf x 1e9"),
        ("camera", "1,2,3 1,2,3,1,2,3 nan,0,0,1,1,1 inf,0,0,1,1,1 1,2,3,4,5,6,7 a,b,c,d,e,f 1e12,0,0,0,0,0"),
        ("fov", "0 -45 180 nan inf x"),
        ("light-angle", "0 -1 16 nan inf x"),
        ("frames", "0 -1 1.5 x 4294967296"),
        ("dt", "0 -1 nan inf x 1e9"),
        ("warmup", "-1 1.5 x"),
    ];
    let values = values.into_iter().flat_map(|(flag, values)| {
        values.split(' ').map(move |value| (format!("capture --out DIR --{flag} {value}"), format!("--{flag}")))
    });
    let stress = [
        ("frames", "0"),
        ("stamps", "-1"),
        ("stamps", "4294967295"),
        ("stamp-radius", "0"),
        ("stamp-radius", "-3"),
        ("stamp-radius", "nan"),
    ];
    let stress = stress.map(|(flag, value)| (format!("stress --{flag} {value}"), format!("--{flag}")));
    for (line, part) in lines.map(|(line, part)| (line.to_owned(), part.to_owned())).into_iter().chain(values).chain(stress) {
        match parse(&line) {
            Err(Refusal::Refused(sentence)) => {
                assert!(sentence.contains(&part), "{line}: {sentence}");
                assert!(!sentence.contains('\n') && !sentence.contains("``"), "{line}: {sentence}");
            }
            other => panic!("{line}: {other:?}"),
        }
    }
}

#[test]
fn a_scene_is_content() {
    assert!(parse("live --scene nowhere").is_ok());
}

#[cfg(unix)]
#[test]
fn paths_need_not_be_text() {
    use std::os::unix::ffi::OsStringExt as _;
    let path = OsString::from_vec(vec![b'a', 0xff]);
    let arguments = [OsString::from("rilievo"), "capture".into(), "--out".into(), path.clone()];
    let Ok(Command::Capture(options)) = super::parse(arguments) else { panic!() };
    assert_eq!(options.out, PathBuf::from(path));
}
