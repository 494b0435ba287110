//! Pictures as 8-bit RGB PNG.

use std::path::Path;

use super::atomic::{self, WriteError};

/// Writes sRGB-encoded pixels, `width · height · 4` bytes RGBA in rows from the top, as an RGB PNG; alpha is dropped.
///
/// # Errors
///
/// The file cannot be written.
///
/// # Panics
///
/// The number of bytes is not that of the size.
pub fn write(path: &Path, size: [u32; 2], rgba: &[u8]) -> Result<(), WriteError> {
    assert_eq!(rgba.len(), size[0] as usize * size[1] as usize * 4, "a picture of {size:?}");
    atomic::write(path, |file| {
        let mut encoder = png::Encoder::new(file, size[0], size[1]);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::Fast);
        let mut writer = encoder.write_header()?;
        let rgb: Vec<u8> = rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        writer.write_image_data(&rgb)?;
        writer.finish()?;
        Ok(())
    })
}
