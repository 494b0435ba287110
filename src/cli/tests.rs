//! The arguments that are read, and those that are refused.

use std::ffi::OsString;
use std::path::PathBuf;

use super::*;
use crate::io::scene_file::{CameraPlacement, FieldSize, SceneOverrides};
use crate::mesh::{MeshSource, Shape};
use crate::scene::{Playback, PomCounts, PyramidLeaf};
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
         --height-range -5,7.5 --albedo c.png --samples 4,20 --pom-counts texels --relief-bias on --pyramid-leaf nearest \
         --depth 0.25 --camera -1,2,-3,0,-.5,1e-3 --fov 30 --lod 2.5 --lod-exact off --light-angle 2.5 --adapter llvm --backend gl -v \
         --mesh torus --mesh-triangles 5000 --shell --displaced-depth \
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
            sequence: None,
            sequence_colours: None,
            images_per_second: None,
            playback: None,
            interpolate: None,
            text: None,
            font: None,
            albedo: Some("c.png".into()),
            field: Some(FieldSize::Width(31)),
            depth_metres: Some(0.25),
            technique: Some(Technique::Pom),
            shadow: Some(Shadow::PomSoft),
            lod: Some(Some(2.5)),
            lod_keep_exact: Some(false),
            shading: None,
            samples: Some([4, 20]),
            pom_counts: Some(PomCounts::Texels),
            relief_depth_bias: Some(true),
            pyramid_leaf: Some(PyramidLeaf::Nearest),
            seed: Some(u64::MAX),
            camera: Some(CameraPlacement { eye: [-1.0, 2.0, -3.0], target: [0.0, -0.5, 1e-3] }),
            vertical_fov_degrees: Some(30.0),
            mesh: Some(MeshSource::Shape(Shape::Torus)),
            mesh_triangles: Some(5000),
            shell: true,
            displaced_depth: true,
            light_half_angle_degrees: Some(2.5),
        }
    );
    let overrides = capture("--text Two\\nlines --font f.ttf").common.overrides();
    assert_eq!((overrides.text.as_deref(), overrides.font), (Some("Two\nlines"), Some("f.ttf".into())));
    let overrides = capture(
        "--sequence d_%05d.png --sequence-colour c --sequence-rate 12.5 --sequence-playback ping-pong --sequence-interpolate on \
         --height-range 0,3",
    )
    .common
    .overrides();
    assert_eq!((overrides.sequence, overrides.sequence_colours), (Some("d_%05d.png".into()), Some("c".into())));
    assert_eq!(
        (overrides.images_per_second, overrides.playback, overrides.interpolate),
        (Some(12.5), Some(Playback::PingPong), Some(true))
    );
    let exports = capture("--export wave-exr,height-png,height-png").exports();
    assert_eq!(exports, [Export::HeightPng, Export::SourceExr("wave")]);
    assert_eq!(capture("--text -a").common.overrides().text.as_deref(), Some("-a"));
    assert_eq!((options.frames, options.dt, options.warmup), (5, 0.5, 9));
    assert_eq!(options.channels(), [Channel::Color, Channel::Height, Channel::Lod]);
    assert_eq!(Command::Capture(options).verbosity(), Verbosity::Verbose);
    assert_eq!(capture("--field 31x7").common.overrides().field, Some(FieldSize::Exactly([31, 7])));
    assert_eq!(parse("live --camera=-1,2,3,0,0,0"), parse("live --camera -1,2,3,0,0,0"));
}

#[test]
fn help_tells_every_default() {
    for line in ["--help", "live --help", "capture --help", "stress --help", "compare --help", "adapters --help"] {
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
        ("fly", "known are live, capture, stress, compare, adapters and scenes"),
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
        (
            "live --technique exat",
            "did you mean `exact`, of normal, parallax, parallax-limited, steep, relief, pom-linear, pom, pyramid, mesh and exact?",
        ),
        ("live --pom-counts texel", "did you mean `texels`, of angle and texels?"),
        ("live --relief-bias yes", "on and off"),
        ("live --pyramid-leaf blurred", "nearest and refined"),
        ("live --technique", "--technique"),
        ("live --shading gxx", "did you mean `ggx`, of phong and ggx?"),
        ("live --view nomrals", "did you mean `normals`"),
        ("capture --out DIR --view", "--view"),
        ("live --split pmo", "did you mean `pom`"),
        ("live --split pom:hrad", "did you mean `hard`"),
        ("live --split pom@2", "--split"),
        ("live --shadow soft", "none, steep, hard, pom-soft, cone and area"),
        ("live --lod-exact yes", "known are on and off"),
        ("live --backend vulcan", "did you mean `vulkan`"),
        ("live --adapter=", "--adapter"),
        ("capture --out DIR --channels color,hight", "did you mean `height`"),
        ("capture --out DIR --channels color,", "known are color"),
        ("capture --out DIR --export height-pgn", "did you mean `height-png`"),
        ("live --sequence-playback once", "loop, ping-pong and hold"),
        ("live --sequence a --height b", "exclude each other"),
        ("live --height a --height-range -3e38,3e38", "too far apart"),
        ("capture --out DIR --replay a --dt 0.1", "exclude each other"),
        ("stress --replay a --sequence-rate 5", "exclude each other"),
    ];
    let values = [
        ("seed", "-1 1.5 x 18446744073709551616"),
        ("size", "0x5 5x0 5 5x 5x5x5 -5x5 5.5x5 4294967296x1 axb"),
        ("field", "0 0x5 5x0 -5 5.5 5x x 4294967296"),
        ("samples", "8 0,5 5,4 -1,5 1.5,5 1,65537 1,2,3 a,b ,"),
        ("height-range", "1,1 5,1 1 1,2,3 nan,1 0,inf a,b , -1e39,1e39"),
        ("depth", "0 -1 nan inf x 1e9"),
        ("camera", "1,2,3 1,2,3,1,2,3 nan,0,0,1,1,1 inf,0,0,1,1,1 1,2,3,4,5,6,7 a,b,c,d,e,f 1e12,0,0,0,0,0"),
        ("gain", "0 -1 nan inf x 1e9"),
        ("level-cap", "-1 1.5 32 x"),
        ("fov", "0 -45 180 nan inf x"),
        ("lod", "-1 17 nan on x"),
        ("light-angle", "0 -1 16 nan inf x"),
        ("frames", "0 -1 1.5 x 4294967296"),
        ("dt", "0 -1 nan inf x 1e9"),
        ("warmup", "-1 1.5 x"),
        ("sequence-rate", "0 -1 nan inf x 1001"),
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

fn compare(line: &str) -> CompareOptions {
    match parse(&format!("compare {line}")) {
        Ok(Command::Compare(options)) => options,
        other => panic!("{line}: {other:?}"),
    }
}

#[test]
fn a_comparison_compares_everything_unless_told() {
    let options = compare("");
    assert_eq!((options.frames, options.warmup, options.common.display.gain(), options.truth), (15, 0, 1.0, Truth::Exact));
    assert_eq!(options.techniques(), Technique::ALL);
    assert_eq!(options.shadows(Shadow::PomSoft), [Shadow::PomSoft]);
    assert_eq!(
        (options.truth_shadow, &options.out, &options.csv, &options.json, &options.check),
        (None, &None, &None, &None, &None)
    );
    assert!(options.view_from.is_empty() && options.sweep_samples().is_empty() && options.sweep_fields().is_empty());
    assert_eq!(compare("--technique pom").techniques(), [Technique::Pom]);
}

#[test]
fn a_comparison_takes_lists() {
    let options = compare(
        "--techniques pom,exact,pom --shadows hard,none --view-from 0,1,1,0,0,0 --view-from -1,.5,0,0,0,0 --truth reference \
         --truth-shadow none --sweep-samples 16,4,16 --gain 2.5 --out D --csv a --json b --check c --frames 3 --warmup 9",
    );
    assert_eq!(options.techniques(), [Technique::Pom, Technique::Exact]);
    assert_eq!(options.shadows(Shadow::PomSoft), [Shadow::Hard, Shadow::None]);
    assert_eq!(options.view_from[1], CameraPlacement { eye: [-1.0, 0.5, 0.0], target: [0.0; 3] });
    assert_eq!((options.truth, options.truth_shadow), (Truth::Reference, Some(Shadow::None)));
    assert_eq!(options.sweep_samples(), [4, 16]);
    assert_eq!((options.common.display.gain(), options.frames, options.warmup), (2.5, 3, 9));
    assert_eq!(compare("--sweep-fields 512,64").sweep_fields(), [64, 512]);
}

#[test]
fn a_comparison_that_makes_no_sense_is_refused_in_one_sentence() {
    for (line, part) in [
        ("--techniques pom,exat", "did you mean `exact`"),
        ("--techniques pom,", "known are normal"),
        ("--techniques pom --technique exact", "exclude each other"),
        ("--shadows soft", "known are none"),
        ("--shadows none --shadow hard", "exclude each other"),
        ("--view-from 1,2,3", "six numbers"),
        ("--view-from 0,1,1,0,0,0 --camera 0,1,1,0,0,0", "exclude each other"),
        ("--truth exat", "did you mean `exact`"),
        ("--truth-shadow soft", "known are none"),
        ("--frames 0", "--frames"),
        ("--warmup -1", "--warmup"),
        ("--sweep-samples 4,0", "--sweep-samples"),
        ("--sweep-samples 4,-8", "--sweep-samples"),
        ("--sweep-samples 65537", "from 1 to 65536"),
        ("--sweep-fields 0", "--sweep-fields"),
        ("--sweep-fields 8x8", "--sweep-fields"),
        ("--sweep-fields 64 --sweep-samples 4", "exclude each other"),
        ("--gain 0", "--gain"),
        ("--gain nan", "--gain"),
        ("--json a --check a", "give `--check` another file"),
        ("--csv a --json a", "give them two"),
        ("--check=", "--check"),
    ] {
        match parse(&format!("compare {line}")) {
            Err(Refusal::Refused(sentence)) => {
                assert!(sentence.contains(part) && !sentence.contains('\n') && !sentence.contains("``"), "{line}: {sentence}");
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
