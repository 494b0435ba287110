//! The colour image over a field, with its mips. Shader: `shaders/surface/albedo_image.wgsl`.
//!
//! It has a size of its own and lies over the field's whole tile, wrapped or clamped as the field is. It stands outside of the field's
//! contract table: its bytes are the image's, not the field's.

use std::sync::OnceLock;

use wgpu::{TextureFormat, TextureUsages};

use crate::gpu::{Contract, Gpu, Role, Texture};

/// The colours of [`crate::surface::Albedo::Image`].
#[derive(Clone, Copy, Debug)]
pub enum AlbedoMap {}

impl Role for AlbedoMap {
    const CONTRACT: Contract = Contract {
        name: "albedo map",
        format: TextureFormat::Rgba8UnormSrgb,
        mips: true,
        share: 1.0,
        content: "albedo, sRGB; alpha unused",
        writer: "upload",
        readers: "surface",
        usage: TextureUsages::TEXTURE_BINDING.union(TextureUsages::COPY_DST),
    };
}

/// An image in sRGB.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourImage {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Four bytes a pixel, rows from the top; the fourth is unused.
    pub rgba: Vec<u8>,
}

impl ColourImage {
    /// One white pixel: what a field without an image is bound to.
    pub fn white() -> Self {
        Self { size: [1, 1], rgba: vec![255; 4] }
    }

    /// The next mip level, of floor size: means over areas, in linear light.
    pub fn halved(&self) -> Self {
        let to = self.size.map(|side| (side / 2).max(1));
        let [columns, rows] = [0, 1].map(|axis| shares(self.size[axis], to[axis]));
        let width = self.size[0] as usize;
        let mut rgba = Vec::with_capacity(to[0] as usize * to[1] as usize * 4);
        for (first_row, row_weights) in &rows {
            for (first_column, column_weights) in &columns {
                let mut sums = [0.0_f32; 3];
                for (y, row_weight) in (*first_row..).zip(row_weights) {
                    for (x, column_weight) in (*first_column..).zip(column_weights) {
                        let pixel = &self.rgba[(y * width + x) * 4..][..3];
                        let weight = row_weight * column_weight;
                        for (sum, byte) in sums.iter_mut().zip(pixel) {
                            *sum += weight * tables().linear[usize::from(*byte)];
                        }
                    }
                }
                rgba.extend(sums.map(encode));
                rgba.push(255);
            }
        }
        Self { size: to, rgba }
    }
}

/// For each of `to` texels along an axis the first of `from` that it covers, and the share of itself that each covers from there on.
fn shares(from: u32, to: u32) -> Vec<(usize, Vec<f32>)> {
    let scale = f64::from(from) / f64::from(to);
    (0..to)
        .map(|i| {
            let (low, high) = (f64::from(i) * scale, (f64::from(i) + 1.0) * scale);
            let texels = low.floor() as u32..(high - 1e-6).ceil() as u32;
            let weight = |texel: u32| (high.min(f64::from(texel) + 1.0) - low.max(f64::from(texel))) / scale;
            (texels.start as usize, texels.map(|texel| weight(texel) as f32).collect())
        })
        .collect()
}

/// sRGB in both directions: the decoder's 256 values, and the encoder's over a lattice so fine that a step of it is a fifth of a level
/// where the curve is steepest.
struct Tables {
    linear: [f32; 256],
    encoded: Vec<u8>,
}

const LATTICE: usize = 1 << 14;

fn tables() -> &'static Tables {
    static TABLES: OnceLock<Tables> = OnceLock::new();
    TABLES.get_or_init(|| {
        let decode = |byte: usize| {
            let x = byte as f64 / 255.0;
            (if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }) as f32
        };
        let encode = |step: usize| {
            let x = step as f64 / LATTICE as f64;
            let y = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
            (255.0 * y).round() as u8
        };
        Tables { linear: std::array::from_fn(decode), encoded: (0..=LATTICE).map(encode).collect() }
    })
}

/// The nearest byte of a linear value from 0 to 1.
pub(crate) fn encode(linear: f32) -> u8 {
    tables().encoded[(linear.clamp(0.0, 1.0) * LATTICE as f32).round() as usize]
}

/// Uploads an image with all its mips.
pub fn upload(gpu: &Gpu, image: &ColourImage) -> Texture<AlbedoMap> {
    let texture = Texture::new(gpu, image.size);
    overwrite(gpu, &texture, image);
    texture
}

/// Writes an image of the same size with all its mips over another.
pub fn overwrite(gpu: &Gpu, texture: &Texture<AlbedoMap>, image: &ColourImage) {
    let mut level = image.clone();
    for index in 0..texture.texture.mip_level_count() {
        if index > 0 {
            level = level.halved();
        }
        texture.write_level(gpu, index, &level.rgba);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_decoding_and_encoding() {
        for byte in 0..=255 {
            assert_eq!(encode(tables().linear[usize::from(byte)]), byte);
        }
    }

    #[test]
    fn a_mip_is_a_mean_of_light() {
        // Black and white in equal parts are half the light, which sRGB calls 188, not 128.
        let checker = ColourImage { size: [2, 2], rgba: [[0; 4], [255; 4], [255; 4], [0; 4]].concat() };
        assert_eq!(checker.halved(), ColourImage { size: [1, 1], rgba: vec![188, 188, 188, 255] });
        // Odd sizes: every texel has its share. A third of white in 3×1 is a third of the light.
        for white in 0..3 {
            let rgba = (0..3).flat_map(|x| if x == white { [255; 4] } else { [0, 0, 0, 255] }).collect();
            assert_eq!(ColourImage { size: [3, 1], rgba }.halved().rgba, [156, 156, 156, 255]);
        }
        let constant = ColourImage { size: [13, 7], rgba: [10, 100, 200, 255].repeat(91) };
        let mut level = constant;
        for size in [[6, 3], [3, 1], [1, 1]] {
            level = level.halved();
            assert_eq!((level.size, &level.rgba), (size, &[10, 100, 200, 255].repeat(size[0] as usize * size[1] as usize)));
        }
    }
}
