//! Fields as images for other programs: heights as 16-bit grey, normals as 16-bit RGB in either convention.

use std::path::Path;

use super::atomic::{self, WriteError};

/// Which way green points in a normal map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NormalMap {
    /// Up the image, as OpenGL has it.
    OpenGl,
    /// Down the image, as DirectX has it.
    DirectX,
}

/// The sample of a height from 0 to 1: the nearest of 65,536, halves upward. What reads it gets the height within half a sample back.
pub fn sample(height: f32) -> u16 {
    (f64::from(height.clamp(0.0, 1.0)) * 65535.0).round() as u16
}

/// The samples of a unit normal in field space (u right, v down, out): a component c, −1 to 1, is the nearest sample to
/// (c + 1)/2·65,535, halves upward. The two conventions differ in green alone, and there one is 65,535 less the other.
pub fn normal_samples(normal: [f64; 3], convention: NormalMap) -> [u16; 3] {
    let [red, down, blue] = normal.map(|component| ((component.clamp(-1.0, 1.0) + 1.0) * 0.5 * 65535.0).round() as u16);
    let green = match convention {
        NormalMap::DirectX => down,
        NormalMap::OpenGl => 65535 - down,
    };
    [red, green, blue]
}

/// Writes heights as 16-bit grey.
///
/// # Errors
///
/// The file cannot be written.
pub fn write_heights(path: &Path, size: [u32; 2], heights: &[f32]) -> Result<(), WriteError> {
    write(path, size, png::ColorType::Grayscale, heights.iter().map(|height| sample(*height)))
}

/// Writes unit normals in field space as 16-bit RGB.
///
/// # Errors
///
/// The file cannot be written.
pub fn write_normals(path: &Path, size: [u32; 2], normals: &[[f64; 3]], convention: NormalMap) -> Result<(), WriteError> {
    write(path, size, png::ColorType::Rgb, normals.iter().flat_map(|normal| normal_samples(*normal, convention)))
}

fn write(path: &Path, size: [u32; 2], colour: png::ColorType, samples: impl Iterator<Item = u16>) -> Result<(), WriteError> {
    // A PNG's samples have their high byte first.
    let bytes: Vec<u8> = samples.flat_map(u16::to_be_bytes).collect();
    atomic::write(path, |file| {
        let mut encoder = png::Encoder::new(file, size[0], size[1]);
        encoder.set_color(colour);
        encoder.set_depth(png::BitDepth::Sixteen);
        encoder.set_compression(png::Compression::Fast);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&bytes)?;
        writer.finish()?;
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::super::height_image::HeightImage;
    use super::*;

    #[test]
    fn a_height_comes_back_within_half_a_sample() {
        let heights: Vec<f32> = (0..=1000).map(|i| (i as f32 / 1000.0).powi(2)).chain([1e-7, 0.999_999_9]).collect();
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.png");
        write_heights(&path, [heights.len() as u32, 1], &heights).unwrap();
        let back = HeightImage::read(&path, None).unwrap();
        assert_eq!(back.size, [heights.len() as u32, 1]);
        for (height, back) in heights.iter().zip(&back.heights) {
            // And f32's rounding of what comes back.
            assert!(f64::from((height - back).abs()) <= 0.5 / 65535.0 + 6e-8, "{height} became {back}");
        }
        assert_eq!([0.0, 1.0, 0.5, -3.0, 7.0].map(sample), [0, 65535, 32768, 0, 65535]);
    }

    #[test]
    fn conventions_differ_in_the_sign_of_green_alone() {
        for (x, y) in [(0.0, 0.0), (0.3, -0.2), (-0.9, 0.4), (0.001, 0.002)] {
            let z = f64::sqrt(1.0 - x * x - y * y);
            let [gl, dx] = [NormalMap::OpenGl, NormalMap::DirectX].map(|convention| normal_samples([x, y, z], convention));
            assert_eq!((gl[0], gl[2]), (dx[0], dx[2]));
            assert_eq!(u32::from(gl[1]) + u32::from(dx[1]), 65535);
            let decoded = |sample: u16| f64::from(sample) / 65535.0 * 2.0 - 1.0;
            for (component, sample) in [(x, gl[0]), (-y, gl[1]), (y, dx[1]), (z, gl[2])] {
                assert!((component - decoded(sample)).abs() <= 1.0 / 65535.0 + 1e-12, "{component}: {sample}");
            }
        }
        // A slope that rises toward v faces up the image.
        assert!(normal_samples([0.0, -0.6, 0.8], NormalMap::OpenGl)[1] > 32768);
    }
}
