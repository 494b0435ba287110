//! Colours from an image file: PNG of any colour type, taken as sRGB; alpha is dropped.

use std::fs::File;
use std::io::{BufReader, ErrorKind};
use std::path::Path;

use super::height_image::{ImageError, check_size, damaged, kind_of, open, png_size};
use crate::surface::albedo_image::ColourImage;

/// Reads an image.
///
/// # Errors
///
/// The file is missing, unreadable, of another kind, damaged or too large.
pub fn read(path: &Path) -> Result<ColourImage, ImageError> {
    let (file, signature) = open(path, "a PNG image")?;
    let image = match signature.as_slice() {
        b"\x89PNG\r\n\x1a\n" => read_png(file),
        start => Err(foreign(start)),
    };
    image.map_err(|problem| ImageError::Unfit { path: path.to_owned(), problem })
}

/// The size that an image states, if its header and its end are sound: nothing is decoded.
///
/// # Errors
///
/// The file is missing, unreadable, of another kind, too large or cut off.
pub fn size(path: &Path) -> Result<[u32; 2], ImageError> {
    let (file, signature) = open(path, "a PNG image")?;
    let size = match signature.as_slice() {
        b"\x89PNG\r\n\x1a\n" => png_size(file),
        start => Err(foreign(start)),
    };
    size.map_err(|problem| ImageError::Unfit { path: path.to_owned(), problem })
}

/// What a file that is no such image is called.
fn foreign(start: &[u8]) -> String {
    match start {
        start if b"\x89PNG\r\n\x1a\n".starts_with(start) => damaged("PNG", "it ends within the signature"),
        [0x76, 0x2f, 0x31, 0x01, ..] => "is an OpenEXR image, and colours must be a PNG: convert it".to_owned(),
        start => format!("is {}, not a PNG image: convert it to one", kind_of(start)),
    }
}

fn read_png(file: BufReader<File>) -> Result<ColourImage, String> {
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
    let (samples, wide) = (colour.samples(), depth == png::BitDepth::Sixteen);

    // Grows with what the file really holds, not with what its header promises. Interlaced rows come in no such order.
    let bytes = size[0] as usize * size[1] as usize * 4;
    let mut rgba = if interlaced { vec![0_u8; bytes] } else { Vec::new() };
    let (mut row_rgba, mut narrowed): (Vec<u8>, Vec<u8>) = (Vec::new(), Vec::new());
    while let Some(row) = reader.next_interlaced_row().map_err(damaged)? {
        // Sixteen bits become the nearest eight.
        let near = |pair: &[u8]| ((u32::from(u16::from_be_bytes([pair[0], pair[1]])) + 128) / 257) as u8;
        narrowed.clear();
        narrowed.extend(row.data().chunks_exact(2).filter(|_| wide).map(near));
        row_rgba.clear();
        row_rgba.extend(if wide { &narrowed } else { row.data() }.chunks_exact(samples).flat_map(|pixel| match *pixel {
            [grey] | [grey, _] => [grey, grey, grey, 255],
            [red, green, blue] | [red, green, blue, _] => [red, green, blue, 255],
            _ => unreachable!("a PNG's pixel has one to four samples"),
        }));
        match row.interlace() {
            png::InterlaceInfo::Null(_) => rgba.extend_from_slice(&row_rgba),
            png::InterlaceInfo::Adam7(adam7) => {
                png::expand_interlaced_row(&mut rgba, size[0] as usize * 4, &row_rgba, adam7, 32);
            }
        }
    }
    if rgba.len() != bytes {
        return Err("is a truncated PNG image: save it anew".to_owned());
    }
    Ok(ColourImage { size, rgba })
}
