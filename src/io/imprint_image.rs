//! The images of a scene's imprints, each a square: what is wider than high has room above and below.

use super::font;
use super::height_image::HeightImage;
use super::scene_file::SceneFileError;
use crate::field::base;
use crate::field::stamp::StampImage;
use crate::scene::{Addressing, Imprint, Text};

/// Side of the square that a text is set in, texels.
const TEXT_SIDE: u32 = 512;

/// Sets the texts and reads the files, in the order of the scene.
///
/// # Errors
///
/// A font or an image is missing, unreadable or unfit.
pub fn load(imprints: &[Imprint]) -> Result<Vec<StampImage>, SceneFileError> {
    imprints.iter().map(image).collect()
}

fn image(imprint: &Imprint) -> Result<StampImage, SceneFileError> {
    if let Some(path) = &imprint.image {
        return Ok(squared(&HeightImage::read(path, None)?));
    }
    let words = imprint.text.clone().unwrap_or_default();
    let lettering = font::lettering(&words, imprint.font.as_deref())?;
    let text = Text { text: words, size: 0.99, ..Text::default() };
    let size = [TEXT_SIDE; 2];
    Ok(StampImage { size, values: base::text::heights(&text, &lettering, size, 1.0 / f64::from(TEXT_SIDE)) })
}

/// The image in the middle of a square of zeros.
fn squared(image: &HeightImage) -> StampImage {
    let longest = image.size[0].max(image.size[1]);
    let scale = f64::from(longest.min(StampImage::SIDE_MAX)) / f64::from(longest);
    // At least a texel, however long and thin.
    let size = image.size.map(|side| ((f64::from(side) * scale).round() as u32).max(1));
    let image = if scale < 1.0 { image.resampled(size, Addressing::Clamp) } else { image.clone() };
    let side = image.size[0].max(image.size[1]);
    let first = image.size.map(|extent| (side - extent) / 2);
    let mut values = vec![0.0; side as usize * side as usize];
    for (row, line) in (first[1]..).zip(image.heights.chunks(image.size[0] as usize)) {
        let at = row as usize * side as usize + first[0] as usize;
        values[at..at + line.len()].copy_from_slice(line);
    }
    StampImage { size: [side; 2], values }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_stands_in_the_middle_of_its_square() {
        let image = squared(&HeightImage { size: [3, 1], heights: vec![0.1, 0.2, 0.3] });
        assert_eq!((image.size, image.values), ([3, 3], vec![0.0, 0.0, 0.0, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0]));
        let tall = squared(&HeightImage { size: [1, 4000], heights: vec![1.0; 4000] });
        assert_eq!(tall.size, [StampImage::SIDE_MAX; 2]);
    }

    #[test]
    fn a_text_is_ink_on_nothing() {
        let imprint = Imprint { text: Some("Rilievo".to_owned()), ..Imprint::default() };
        let images = load(&[imprint]).expect("the program's own font has it");
        let ink = images[0].values.iter().filter(|value| **value > 0.5).count() as f64 / f64::from(TEXT_SIDE * TEXT_SIDE);
        assert!(ink > 0.03 && ink < 0.3, "{ink}");
    }
}
