//! State files: all that a running field remembers, so that another run goes on from there.
//!
//! A file is a line of magic, the length of the header (u64), the header in JSON, the bytes of every texture and buffer in the header's
//! order, and the CRC-32 of all that. Numbers are little-endian. It holds what one build of the program on one kind of adapter needs
//! to go on to the byte; it is no exchange format.

use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::atomic::{self, WriteError};
use super::height_image::explain;
use super::sums::Sums;
use crate::clock::Clock;
use crate::scene::Scene;

/// The version of the format that this program reads and writes.
pub const VERSION: u32 = 3;

/// What every state file begins with.
const MAGIC: &[u8] = b"rilievo state\n";

/// The longest header. A scene takes some kilobytes, each part a hundred bytes.
const HEADER_BYTES_MAX: u64 = 1 << 24;

/// All that a running field remembers.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedState {
    /// The scene as it was.
    pub scene: Scene,
    /// What the field started from.
    pub start: Sums,
    /// Its clock: the next frame comes after the last that was shown.
    pub clock: Clock,
    /// What the field and each source remember.
    pub parts: Vec<Part>,
    /// The bytes of each part's textures and then its buffers, in order.
    pub blobs: Vec<Vec<u8>>,
}

/// What the field itself, or one source, remembers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Its name.
    pub name: String,
    /// Format, width and height of each of its textures.
    pub textures: Vec<(String, u32, u32)>,
    /// The size of each of its buffers, bytes.
    pub buffers: Vec<u64>,
    /// The numbers beside them.
    pub numbers: Vec<u64>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    version: u32,
    program: String,
    scene: Scene,
    start: Sums,
    clock: Clock,
    parts: Vec<Part>,
    blob_bytes: Vec<u64>,
}

/// Why there is no state to go on from.
#[derive(Debug, thiserror::Error)]
pub enum StateFileError {
    /// The file cannot be read.
    #[error("cannot read the state {}: {}", path.display(), explain(cause))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// The file is no whole state of this version.
    #[error("the state {} {problem}", path.display())]
    Unfit {
        /// The file.
        path: PathBuf,
        /// What is the matter, and what to do about it.
        problem: String,
    },
}

/// Writes a state, whole or not at all.
///
/// # Errors
///
/// The file cannot be written.
pub fn write(path: &Path, state: &SavedState) -> Result<(), WriteError> {
    atomic::write(path, |file| {
        let header = serde_json::to_vec(&Header {
            version: VERSION,
            program: env!("CARGO_PKG_VERSION").to_owned(),
            scene: state.scene.clone(),
            start: state.start,
            clock: state.clock.clone(),
            parts: state.parts.clone(),
            blob_bytes: state.blobs.iter().map(|blob| blob.len() as u64).collect(),
        })?;
        let length = (header.len() as u64).to_le_bytes();
        let mut sum = crc32fast::Hasher::new();
        for piece in [MAGIC, &length, &header].into_iter().chain(state.blobs.iter().map(Vec::as_slice)) {
            sum.update(piece);
            file.write_all(piece)?;
        }
        file.write_all(&sum.finalize().to_le_bytes())
    })
}

/// Reads a state. Nothing is made of a file that is not whole.
///
/// # Errors
///
/// The file cannot be read, is of another version, truncated or damaged.
pub fn read(path: &Path) -> Result<SavedState, StateFileError> {
    let unfit = |problem: String| StateFileError::Unfit { path: path.to_owned(), problem };
    let mut bytes = Vec::new();
    std::fs::File::open(path)
        .and_then(|mut file| file.read_to_end(&mut bytes))
        .map_err(|cause| StateFileError::Unreadable { path: path.to_owned(), cause })?;
    let truncated = || unfit("is truncated or damaged: save it again with --save-state".to_owned());
    let Some(body) = bytes.strip_prefix(MAGIC) else {
        return Err(unfit("is no state of a field: --load-state takes what --save-state wrote".to_owned()));
    };
    let (length, body) = body.split_first_chunk::<8>().ok_or_else(truncated)?;
    let length = u64::from_le_bytes(*length);
    if length > HEADER_BYTES_MAX || length > body.len() as u64 {
        return Err(truncated());
    }
    // At most the file's own length, by the line above.
    let (header, body) = body.split_at(length as usize);
    // Another version may have another header: it is named before anything else is read.
    let version = serde_json::from_slice::<serde_json::Value>(header).ok().and_then(|value| value["version"].as_u64());
    match version {
        Some(version) if version != u64::from(VERSION) => {
            return Err(unfit(format!(
                "is of version {version}, and this program reads version {VERSION}: save it again with this program"
            )));
        }
        Some(_) => {}
        None => return Err(truncated()),
    }
    let (content, sum) = bytes.split_last_chunk::<4>().ok_or_else(truncated)?;
    if crc32fast::hash(content) != u32::from_le_bytes(*sum) {
        return Err(truncated());
    }
    let header: Header = serde_json::from_slice(header).map_err(|error| {
        unfit(format!("holds a scene that this program does not know ({error}): save it again with this program"))
    })?;
    let mut blobs = Vec::with_capacity(header.blob_bytes.len());
    let mut rest = &body[..body.len() - sum.len()];
    for &length in &header.blob_bytes {
        let length = usize::try_from(length).ok().filter(|&length| length <= rest.len()).ok_or_else(truncated)?;
        let (blob, after) = rest.split_at(length);
        blobs.push(blob.to_vec());
        rest = after;
    }
    if !rest.is_empty() {
        return Err(truncated());
    }
    let Header { scene, start, clock, parts, .. } = header;
    Ok(SavedState { scene, start, clock, parts, blobs })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::Pace;

    fn saved() -> SavedState {
        let mut clock = Clock::new([Some(0.01), None, None]);
        clock.advance(Pace::Fixed { dt_seconds: 1.0 / 60.0 });
        clock.advance(Pace::Fixed { dt_seconds: 1.0 / 60.0 });
        let part =
            Part { name: "field".to_owned(), textures: vec![("R32Float".to_owned(), 2, 1)], buffers: vec![3], numbers: vec![7] };
        SavedState {
            scene: Scene::default(),
            start: Sums { heights: 1, images: 2 },
            clock,
            parts: vec![part],
            blobs: vec![vec![1, 2, 3, 4, 5, 6, 7, 8], vec![9, 10, 11]],
        }
    }

    #[test]
    fn what_was_written_is_read() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("state");
        write(&path, &saved()).unwrap();
        assert_eq!(read(&path).unwrap(), saved());
    }

    #[test]
    fn every_truncation_and_every_flipped_byte_is_refused() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("state");
        write(&path, &saved()).unwrap();
        let whole = std::fs::read(&path).unwrap();
        for length in 0..whole.len() {
            std::fs::write(&path, &whole[..length]).unwrap();
            let error = read(&path).expect_err("it is not whole").to_string();
            assert!(!error.contains('\n'), "{error}");
        }
        for index in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[index] ^= 1;
            std::fs::write(&path, &damaged).unwrap();
            assert!(read(&path).is_err(), "byte {index}");
        }
    }

    #[test]
    fn another_version_is_named() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("state");
        write(&path, &saved()).unwrap();
        let whole = std::fs::read(&path).unwrap();
        let at = whole.windows(11).position(|window| window == b"\"version\":3").unwrap();
        for version in [1, 9] {
            let mut other = whole.clone();
            other[at + 10] = b'0' + version;
            std::fs::write(&path, &other).unwrap();
            let sentence = read(&path).expect_err("it is another version").to_string();
            assert!(sentence.contains(&format!("is of version {version}, and this program reads version 3")), "{sentence}");
        }
    }
}
