//! A few small pictures, to notice what no number watches: light, colours, layout.

use std::path::{Path, PathBuf};

use super::capture;
use crate::support::gpu::gpu;
use crate::support::tolerances::{GOLDEN_LEVELS, GOLDEN_OUTLIERS};

/// Name of the golden, and what captures it.
const GOLDENS: [(&str, &[&str]); 24] = [
    ("ripples", &["--scene", "ripples", "--warmup", "60"]),
    ("bullet-wall", &["--scene", "bullet-wall", "--warmup", "60"]),
    ("explosions", &["--scene", "explosions", "--warmup", "60"]),
    ("snow", &["--scene", "snow", "--warmup", "90"]),
    ("relief", &["--scene", "relief"]),
    ("sidewalk", &["--scene", "sidewalk"]),
    ("fur", &["--scene", "fur"]),
    ("grass", &["--scene", "grass", "--technique", "steep"]),
    ("text", &["--scene", "text", "--field", "320x200"]),
    ("text-relief", &["--scene", "relief", "--text", "cut\\nin"]),
    ("terrain", &["--scene", "terrain"]),
    ("depth-image", &["--scene", "depth-image", "--warmup", "40", "--field", "320x256"]),
    ("cube", &["--scene", "cube"]),
    ("gas-planet", &["--scene", "gas-planet", "--field", "256x128", "--warmup", "12"]),
    ("planet", &["--scene", "planet", "--field", "256x128"]),
    ("columns", &["--scene", "columns", "--warmup", "60"]),
    ("dunes", &["--scene", "dunes", "--warmup", "60", "--field", "384x384"]),
    ("dam-break", &["--scene", "dam-break", "--warmup", "50", "--field", "160x120"]),
    ("harbour", &["--scene", "harbour", "--warmup", "150", "--field", "192"]),
    ("rain-on-cobbles", &["--scene", "rain-on-cobbles", "--warmup", "60", "--field", "192"]),
    ("clockwork", &["--scene", "clockwork", "--warmup", "60"]),
    ("relief-pom", &["--scene", "relief", "--technique", "pom", "--shadow", "pom-soft"]),
    ("relief-ggx", &["--scene", "relief", "--shading", "ggx"]),
    ("glass", &["--scene", "tests/goldens/glass.toml"]),
];

fn golden(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/goldens/{name}.png"))
}

/// `ACCEPT_GOLDENS=1 scripts/test goldens` replaces them, for someone to look at before they are committed.
#[test]
fn pictures_look_as_they_were_accepted() {
    if gpu().is_none() {
        return;
    }
    let mut complaints = Vec::new();
    for (name, arguments) in GOLDENS {
        let directory = tempfile::tempdir().expect("there is a temporary directory");
        // A small field, unless the golden asks for one of its own aspect.
        let field: &[&str] = if arguments.contains(&"--field") { &[] } else { &["--field", "256"] };
        capture(directory.path(), &[&["--size", "192x128"], field, arguments].concat());
        let actual = directory.path().join("frame_00000.png");
        if std::env::var_os("ACCEPT_GOLDENS").is_some() {
            std::fs::copy(&actual, golden(name)).expect("the repository can be written");
            continue;
        }
        let open = |path: &Path| image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display())).to_rgb8();
        let (actual, expected) = (open(&actual), open(&golden(name)));
        assert_eq!(actual.dimensions(), expected.dimensions(), "{name}");
        let differences: Vec<_> = actual.as_raw().iter().zip(expected.as_raw()).map(|(a, b)| a.abs_diff(*b)).collect();
        let outliers = differences.iter().filter(|difference| **difference > GOLDEN_LEVELS).count();
        let share = outliers as f64 / differences.len() as f64;
        let mean = differences.iter().map(|difference| f64::from(*difference)).sum::<f64>() / differences.len() as f64;
        println!("{name}: {share:.5} of the values differ by more than {GOLDEN_LEVELS}, mean {mean:.4}");
        if share > GOLDEN_OUTLIERS {
            let kept = std::env::temp_dir().join(format!("rilievo-{name}.png"));
            std::fs::copy(directory.path().join("frame_00000.png"), &kept).expect("the temporary directory can be written");
            complaints.push(format!("{name}: {share:.5} of the values differ (mean {mean:.4}); see {}", kept.display()));
        }
    }
    assert!(complaints.is_empty(), "{}\nIf this is meant: ACCEPT_GOLDENS=1 scripts/test goldens", complaints.join("\n"));
}
