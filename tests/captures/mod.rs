//! What `capture` writes, read back from its files as a script outside would: the binary runs as a process.

mod determinism;
mod export;
mod flight;
mod goldens;
mod positions;
mod resumed;
mod sequence;
mod techniques;
mod views;

use std::path::Path;
use std::process::{Command, Output};

use rilievo::io::exr_file::{self, Channels};

/// Runs the program on the software adapter that every machine can have, unless the environment asks for another.
pub fn rilievo(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rilievo")).args(arguments).output().expect("the program was built with the tests")
}

/// Captures into a directory, which must succeed.
pub fn capture(out: &Path, arguments: &[&str]) {
    let mut all = vec!["capture", "--out", out.to_str().expect("temporary directories have plain names")];
    all.extend(arguments);
    let output = rilievo(&all);
    assert!(output.status.success(), "{all:?}: {}", String::from_utf8_lossy(&output.stderr));
}

/// The channels of an EXR file of a capture.
pub fn channels(out: &Path, name: &str) -> ([u32; 2], Channels) {
    exr_file::read(&out.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The manifest of a capture.
pub fn manifest(out: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(out.join("manifest.json")).expect("a capture has a manifest");
    serde_json::from_str(&text).expect("it is JSON")
}

/// Writes a 16-bit PNG of these heights.
pub fn write_heights(path: &Path, [width, height]: [u32; 2], heights: impl Fn(u32, u32) -> f64) {
    let image = image::ImageBuffer::from_fn(width, height, |x, y| image::Luma([(heights(x, y) * 65535.0).round() as u16]));
    image.save(path).expect("the temporary directory can be written");
}
