//! Files: images of heights and colours, fonts, meshes and scenes in; pictures, channels and the manifest out; journals and states
//! both ways.

pub mod atomic;
pub mod colour_image;
pub mod exr_file;
pub mod field_image;
pub mod font;
pub mod height_image;
pub mod image_sequence;
pub mod imprint_image;
pub mod journal;
pub mod manifest;
pub mod mesh_file;
pub mod output_dir;
pub mod png_file;
mod resample;
pub mod scene_file;
pub mod shader_folder;
pub mod state_file;
pub mod sums;

use std::io::Write as _;

/// Prints to stdout. A reader that went away early (`| head`) is no error: it has what it wanted.
///
/// # Errors
///
/// Stdout cannot be written for another reason, a full disk for one.
pub fn print(text: &str) -> std::io::Result<()> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(std::io::Error::new(error.kind(), format!("cannot write to stdout: {error}"))),
        Ok(()) => Ok(()),
    }
}
