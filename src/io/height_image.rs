//! Heights from an image file: PNG of 8 or 16 bits in any colour type, or OpenEXR.
//!
//! Values are heights as they stand: a PNG's are its samples over their largest, without any colour management; an EXR's are those of
//! channel `H`, else `Y`, `R`, or the only one. A file is known by its content, not by its name. Sizes are checked before anything of
//! that size is allocated, so that no header can make the program run out of memory.

use std::fs::File;
use std::io::{BufReader, ErrorKind, Read as _, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};

use exr::prelude::{ReadChannels as _, ReadLayers as _, ReadSpecificChannel as _};

use super::resample::resample;
use crate::scene::Addressing;

/// The most texels that are read: 16,384², the largest texture that common adapters hold.
pub const TEXELS_MAX: u64 = 1 << 28;

/// Heights in [0, 1], rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightImage {
    /// Width and height, texels.
    pub size: [u32; 2],
    /// The heights, `width · height` of them.
    pub heights: Vec<f32>,
}

/// Why an image gives no heights.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// It cannot be opened or read.
    #[error("cannot read the image {}: {}", path.display(), explain(cause))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// It is no such image.
    #[error("{} {problem}", path.display())]
    Unfit {
        /// The file.
        path: PathBuf,
        /// What is the matter, and what to do about it.
        problem: String,
    },
}

/// The cause in words, and what to do about it.
pub(crate) fn explain(error: &std::io::Error) -> String {
    let advice = match error.kind() {
        ErrorKind::NotFound => "there is no such file, check the path",
        ErrorKind::PermissionDenied => "permission denied, make it readable",
        ErrorKind::IsADirectory => "it is a directory, name a file in it",
        ErrorKind::NotADirectory => "a part of the path is a file, not a directory; check the path",
        _ => return error.to_string(),
    };
    advice.to_owned()
}

impl HeightImage {
    /// Reads an image, mapping `range`, if there is one, to [0, 1].
    ///
    /// # Errors
    ///
    /// The file is missing, unreadable, of another kind, damaged or too large; a value is NaN, infinite, or outside of [0, 1] once
    /// it is mapped.
    pub fn read(path: &Path, range: Option<[f32; 2]>) -> Result<Self, ImageError> {
        let unfit = |problem: String| ImageError::Unfit { path: path.to_owned(), problem };
        let (file, signature) = open(path, "a PNG or an OpenEXR image")?;
        let raw = match signature.as_slice() {
            b"\x89PNG\r\n\x1a\n" => read_png(file),
            [0x76, 0x2f, 0x31, 0x01, ..] => read_exr(file),
            start => Err(foreign(start)),
        };
        let mut image = raw.map_err(unfit)?;
        image.normalise(range).map_err(unfit)?;
        Ok(image)
    }

    /// These heights at another size; see `resample`. The same size gives the same heights.
    pub fn resampled(&self, to: [u32; 2], addressing: Addressing) -> Self {
        let heights = if to == self.size { self.heights.clone() } else { resample(&self.heights, self.size, to, addressing) };
        Self { size: to, heights }
    }

    /// Maps the range to [0, 1] and refuses what is then outside, or no number.
    fn normalise(&mut self, range: Option<[f32; 2]>) -> Result<(), String> {
        if let Some(i) = self.heights.iter().position(|height| !height.is_finite()) {
            let (value, [column, row]) = (self.heights[i], self.position(i));
            let name = if value.is_nan() { "NaN" } else { "infinite" };
            return Err(format!(
                "has a value that is {name}, the first in column {column}, row {row} (from 0, at the upper left): repair the image"
            ));
        }
        // In f64, so that exactly LO and HI become exactly 0 and 1.
        let [low, high] = range.unwrap_or([0.0, 1.0]).map(f64::from);
        if range.is_some() {
            for height in &mut self.heights {
                #[expect(clippy::cast_possible_truncation, reason = "heights are f32")]
                let mapped = ((f64::from(*height) - low) / (high - low)) as f32;
                *height = mapped;
            }
        }
        let Some(i) = self.heights.iter().position(|height| !(0.0..=1.0).contains(height)) else {
            return Ok(());
        };
        let unmapped = |height: f32| f64::from(height) * (high - low) + low;
        let least = unmapped(self.heights.iter().copied().fold(f32::INFINITY, f32::min));
        let largest = unmapped(self.heights.iter().copied().fold(f32::NEG_INFINITY, f32::max));
        let [column, row] = self.position(i);
        #[expect(clippy::cast_possible_truncation, reason = "to print them as short as f32 can be")]
        // One value alone spans no range: say one that does.
        let [least, largest] =
            if least < largest { [least as f32, largest as f32] } else { [least.min(0.0) as f32, largest.max(1.0) as f32] };
        Err(format!(
            "has values from {least} to {largest}, outside of {low} to {high} first in column {column}, row {row}: map them with --height-range {least},{largest}"
        ))
    }

    /// Column and row of the i-th value.
    fn position(&self, i: usize) -> [usize; 2] {
        let width = self.size[0] as usize;
        [i % width, i / width]
    }
}

/// The size that an image states, if its header and its end are sound: nothing is decoded.
///
/// # Errors
///
/// The file is missing, unreadable, of another kind, too large, cut off, or has no channel of heights.
pub fn size(path: &Path) -> Result<[u32; 2], ImageError> {
    let (mut file, signature) = open(path, "a PNG or an OpenEXR image")?;
    let size = match signature.as_slice() {
        b"\x89PNG\r\n\x1a\n" => png_size(file),
        [0x76, 0x2f, 0x31, 0x01, ..] => read_exr_header(&mut file).map(|(_, size)| size),
        start => Err(foreign(start)),
    };
    size.map_err(|problem| ImageError::Unfit { path: path.to_owned(), problem })
}

/// What a file that is no such image is called.
fn foreign(start: &[u8]) -> String {
    match start {
        start if b"\x89PNG\r\n\x1a\n".starts_with(start) => damaged("PNG", "it ends within the signature"),
        start => format!("is {}, not a PNG or an OpenEXR image: convert it to one of these", kind_of(start)),
    }
}

/// The size of a PNG that has a sound header and an end.
pub(super) fn png_size(mut file: BufReader<File>) -> Result<[u32; 2], String> {
    let too_early = |_| damaged("PNG", "it ends too early");
    let mut end = [0; 12];
    file.seek(SeekFrom::End(-12)).and_then(|_| file.read_exact(&mut end)).map_err(too_early)?;
    if end[4..8] != *b"IEND" {
        return Err(damaged("PNG", "it has no end"));
    }
    file.rewind().map_err(too_early)?;
    let mut decoder = png::Decoder::new(file);
    let info = decoder.read_header_info().map_err(|error| damaged("PNG", &error.to_string()))?;
    check_size(info.width.into(), info.height.into())
}

/// Opens an image and reads its first eight bytes, or as many as it has. `kinds` says in words what it must be.
pub(super) fn open(path: &Path, kinds: &str) -> Result<(BufReader<File>, Vec<u8>), ImageError> {
    let unfit = |problem: String| ImageError::Unfit { path: path.to_owned(), problem };
    let unreadable = |cause| ImageError::Unreadable { path: path.to_owned(), cause };
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(unreadable(ErrorKind::IsADirectory.into()));
    }
    if !metadata.is_file() {
        return Err(unfit("is not a regular file: save the image to one first".to_owned()));
    }
    let mut file = BufReader::new(File::open(path).map_err(unreadable)?);
    let mut signature = Vec::new();
    file.by_ref().take(8).read_to_end(&mut signature).map_err(unreadable)?;
    file.rewind().map_err(unreadable)?;
    if signature.is_empty() {
        return Err(unfit(format!("is empty: it must be {kinds}")));
    }
    Ok((file, signature))
}

/// Refuses a size of nothing, and one that could not be held.
pub(super) fn check_size(width: u64, height: u64) -> Result<[u32; 2], String> {
    if width == 0 || height == 0 {
        return Err(format!("says that it is {width}x{height} pixels: it is damaged, save it anew"));
    }
    match (u32::try_from(width), u32::try_from(height)) {
        (Ok(w), Ok(h)) if width.saturating_mul(height) <= TEXELS_MAX => Ok([w, h]),
        _ => Err(format!("says that it is {width}x{height} pixels, more than the {TEXELS_MAX} that can be read: scale it down")),
    }
}

pub(super) fn damaged(kind: &str, detail: &str) -> String {
    // A decoder's words may span lines; a sentence does not.
    let detail = detail.split_whitespace().collect::<Vec<_>>().join(" ");
    format!("is a truncated or damaged {kind} image ({detail}): save it anew")
}

/// What a file seems to be, by its first bytes.
pub(super) fn kind_of(start: &[u8]) -> &'static str {
    match start {
        [0xff, 0xd8, 0xff, ..] => "a JPEG image",
        [b'G', b'I', b'F', b'8', ..] => "a GIF image",
        [b'I', b'I', 42, 0, ..] | [b'M', b'M', 0, 42, ..] => "a TIFF image",
        [b'R', b'I', b'F', b'F', ..] => "a WebP or other RIFF file",
        [b'B', b'M', ..] => "a BMP image",
        [b'#', b'?', ..] => "a Radiance HDR image",
        [b'P', b'1'..=b'7' | b'f' | b'F', ..] => "a Netpbm image",
        _ if start.iter().all(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace()) => "text",
        _ => "something else",
    }
}

fn read_png(file: BufReader<File>) -> Result<HeightImage, String> {
    let damaged = |error: png::DecodingError| match error {
        png::DecodingError::LimitsExceeded => "is a PNG image with absurdly large parts: save it anew".to_owned(),
        png::DecodingError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => damaged("PNG", "it ends too early"),
        other => damaged("PNG", &other.to_string()),
    };
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let info = decoder.read_header_info().map_err(damaged)?;
    let size = check_size(info.width.into(), info.height.into())?;
    let interlaced = info.interlaced;
    let mut reader = decoder.read_info().map_err(damaged)?;
    let (colour, depth) = reader.output_color_type();
    let two_bytes = depth == png::BitDepth::Sixteen;
    let samples = colour.samples();

    // Grows with what the file really holds, not with what its header promises. Interlaced rows come in no such order.
    let texels = size[0] as usize * size[1] as usize;
    let mut heights = if interlaced { vec![0.0_f32; texels] } else { Vec::new() };
    let mut row_heights: Vec<f32> = Vec::new();
    while let Some(row) = reader.next_interlaced_row().map_err(damaged)? {
        row_heights.clear();
        if two_bytes {
            let sample = |bytes: &[u8]| f64::from(u16::from_be_bytes([bytes[0], bytes[1]])) / 65535.0;
            row_heights.extend(row.data().chunks_exact(2 * samples).map(|pixel| luminance(pixel, 2, samples, sample)));
        } else {
            let sample = |bytes: &[u8]| f64::from(bytes[0]) / 255.0;
            row_heights.extend(row.data().chunks_exact(samples).map(|pixel| luminance(pixel, 1, samples, sample)));
        }
        match row.interlace() {
            png::InterlaceInfo::Null(_) => heights.extend_from_slice(&row_heights),
            png::InterlaceInfo::Adam7(adam7) => {
                let stride = size[0] as usize * size_of::<f32>();
                png::expand_interlaced_row(
                    bytemuck::cast_slice_mut(&mut heights),
                    stride,
                    bytemuck::cast_slice(&row_heights),
                    adam7,
                    32,
                );
            }
        }
    }
    // What follows the last row is read too: a file without its end is not whole.
    reader.finish().map_err(damaged)?;
    if heights.len() == texels { Ok(HeightImage { size, heights }) } else { Err(self::damaged("PNG", "rows are missing")) }
}

/// Height of one pixel: the grey value, or the luminance of the stored values with the weights of BT.709. Alpha does not count.
fn luminance(pixel: &[u8], bytes: usize, samples: usize, sample: impl Fn(&[u8]) -> f64) -> f32 {
    let value = |i: usize| sample(&pixel[i * bytes..]);
    let height = if samples < 3 { value(0) } else { 0.2126 * value(0) + 0.7152 * value(1) + 0.0722 * value(2) };
    #[expect(clippy::cast_possible_truncation, reason = "heights are f32")]
    let height = height as f32;
    height
}

/// A decoder's complaint, as one of ours.
fn damaged_exr(error: exr::error::Error) -> String {
    match error {
        exr::error::Error::NotSupported(what) => format!("is an OpenEXR image of an unsupported kind ({what}): save it plainly"),
        other => damaged("OpenEXR", &other.to_string()),
    }
}

/// The channel of an EXR that holds heights, and its size.
fn read_exr_header(file: &mut BufReader<File>) -> Result<(String, [u32; 2]), String> {
    let meta = exr::meta::MetaData::read_from_buffered(file, false).map_err(damaged_exr)?;
    let flat: Vec<_> = meta.headers.iter().filter(|header| !header.deep).collect();
    if flat.is_empty() {
        return Err("is an OpenEXR image of deep data only: save it flat".to_owned());
    }
    let names: Vec<String> =
        flat.iter().flat_map(|header| header.channels.list.iter().map(|channel| channel.name.to_string())).collect();
    let name = match names.as_slice() {
        [only] => only.clone(),
        _ => match ["H", "Y", "R"].into_iter().find(|&wanted| names.iter().any(|name| name == wanted)) {
            Some(name) => name.to_owned(),
            None => {
                return Err(format!(
                    "has the channels {}: rename the one with the heights to H, or leave only one",
                    names.join(", ")
                ));
            }
        },
    };
    // Every part is checked, not only the one that is read: they all are decoded on the way.
    let mut size = [0, 0];
    for header in &meta.headers {
        let own = check_size(header.layer_size.width() as u64, header.layer_size.height() as u64)?;
        if let Some(channel) = header.channels.list.iter().find(|channel| channel.name == *name.as_str()) {
            if channel.sampling != exr::math::Vec2(1, 1) {
                return Err(format!("has a subsampled channel {name}: save it with a value for every pixel"));
            }
            size = own;
        }
    }
    Ok((name, size))
}

fn read_exr(mut file: BufReader<File>) -> Result<HeightImage, String> {
    let (name, size) = read_exr_header(&mut file)?;
    file.rewind().map_err(|error| damaged_exr(error.into()))?;
    let width = size[0] as usize;
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required(name.as_str())
        .collect_pixels(
            |size, _| vec![0.0_f32; size.area()],
            move |heights, position, (height,): (f32,)| heights[position.y() * width + position.x()] = height,
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(file)
        .map_err(damaged_exr)?;
    Ok(HeightImage { size, heights: image.layer_data.channel_data.pixels })
}
