//! Fonts from files: TTF, OTF, or the first of a collection.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::height_image::explain;
use crate::field::base::lettering::{EMBEDDED_FONT, Lettering, LetteringError};

/// No font is larger: the largest that cover Chinese have a quarter of it.
const BYTES_MAX: u64 = 64 << 20;

/// Why a text has no outlines.
#[derive(Debug, thiserror::Error)]
pub enum FontError {
    /// The font's file cannot be read.
    #[error("cannot read the font {}: {}", path.display(), explain(cause))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// It is no font, or not for this text.
    #[error("{} {problem}", path.as_ref().map_or("the program's own font".to_owned(), |path| path.display().to_string()))]
    Unfit {
        /// The file; none: the font that comes with the program.
        path: Option<PathBuf>,
        /// What is the matter, and what to do about it.
        problem: String,
    },
}

/// Sets a text in the font of a file, or in the program's own.
///
/// # Errors
///
/// The file is missing, unreadable or no font; the font lacks glyphs that the text needs.
pub fn lettering(text: &str, path: Option<&Path>) -> Result<Lettering, FontError> {
    let set = |font: &[u8]| {
        Lettering::new(text, font)
            .map_err(|error: LetteringError| FontError::Unfit { path: path.map(Path::to_owned), problem: error.to_string() })
    };
    match path {
        None => set(EMBEDDED_FONT),
        Some(path) => set(&read(path)?),
    }
}

fn read(path: &Path) -> Result<Vec<u8>, FontError> {
    let unreadable = |cause| FontError::Unreadable { path: path.to_owned(), cause };
    let unfit = |problem: String| FontError::Unfit { path: Some(path.to_owned()), problem };
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(unreadable(ErrorKind::IsADirectory.into()));
    }
    if !metadata.is_file() {
        return Err(unfit("is not a regular file: name a TTF or OTF font".to_owned()));
    }
    if metadata.len() > BYTES_MAX {
        return Err(unfit(format!("has {} bytes, and no font has more than {BYTES_MAX}: name a font", metadata.len())));
    }
    std::fs::read(path).map_err(unreadable)
}
