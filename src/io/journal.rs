//! Journals: what was done to a field, frame by frame, so that another run does the same.
//!
//! A journal is lines of JSON: a header, an [`Entry`] a frame, and an end that says how many there were, without which it is
//! not whole. What a scene does by itself is a function of its seed and of the time: a journal holds the time, what the hand did, and
//! whatever changed in the scene.

use std::fs::File;
use std::io::{BufRead as _, BufReader, BufWriter, Write as _};
use std::path::{Path, PathBuf};

use glam::{DMat4, DVec2};
use serde::{Deserialize, Serialize};

use super::atomic::{Partial, WriteError};
use super::height_image::explain;
use super::sums::Sums;
use crate::camera::Camera;
use crate::clock::Tick;
use crate::scene::Scene;
use crate::stroke::Stroke;

/// The version of the format that this program reads and writes.
pub const VERSION: u32 = 2;

/// What a journal begins with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    /// [`VERSION`].
    rilievo_journal: u32,
    /// The version of the program.
    program: String,
    /// The scene that it begins with.
    scene: Scene,
    /// What the field started from.
    start: Sums,
}

/// One frame of a journal.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// What the frame spans.
    pub tick: Tick,
    /// What the hand did in it, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub strokes: Vec<Stroke>,
    /// The scene from this frame on, where it changed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<Box<Scene>>,
    /// Whether the field goes back to its start before this frame.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub restart: bool,
    /// Where it is seen from, from this frame on, where that changed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<View>,
}

/// A camera, as a journal holds it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    world_from_view: [f64; 16],
    vertical_fov_radians: f64,
    near_metres: f64,
}

impl From<&Camera> for View {
    /// Without the shift of the lens, which is the window's.
    fn from(camera: &Camera) -> Self {
        Self {
            world_from_view: camera.world_from_view.to_cols_array(),
            vertical_fov_radians: camera.vertical_fov_radians,
            near_metres: camera.near_metres,
        }
    }
}

impl From<View> for Camera {
    fn from(view: View) -> Self {
        Self {
            world_from_view: DMat4::from_cols_array(&view.world_from_view),
            vertical_fov_radians: view.vertical_fov_radians,
            near_metres: view.near_metres,
            lens_shift: DVec2::ZERO,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct End {
    frames: u64,
}

/// Why there is no journal to replay.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// The file cannot be read.
    #[error("cannot read the journal {}: {}", path.display(), explain(cause))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// The file is no whole journal of this version.
    #[error("the journal {} {problem}", path.display())]
    Unfit {
        /// The file.
        path: PathBuf,
        /// What is the matter, and what to do about it.
        problem: String,
    },
}

/// A whole journal.
#[derive(Clone, Debug, PartialEq)]
pub struct Journal {
    /// The scene that it begins with.
    pub scene: Scene,
    /// What the field started from.
    pub start: Sums,
    /// Its frames, in order.
    pub entries: Vec<Entry>,
}

/// Reads a journal. Nothing is made of a file that is not whole.
///
/// # Errors
///
/// The file cannot be read, is of another version, truncated or malformed.
pub fn read(path: &Path) -> Result<Journal, JournalError> {
    let unreadable = |cause| JournalError::Unreadable { path: path.to_owned(), cause };
    let unfit = |problem: String| JournalError::Unfit { path: path.to_owned(), problem };
    let lines = BufReader::new(File::open(path).map_err(unreadable)?).lines().collect::<Result<Vec<_>, _>>();
    let lines = match lines {
        Err(error) if error.kind() == std::io::ErrorKind::InvalidData => {
            return Err(unfit("is no journal: --replay takes what --record wrote".to_owned()));
        }
        lines => lines.map_err(unreadable)?,
    };
    let first = lines.first().and_then(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    match first.as_ref().map(|header| &header["rilievo_journal"]).and_then(serde_json::Value::as_u64) {
        Some(version) if version == u64::from(VERSION) => {}
        Some(version) => {
            return Err(unfit(format!(
                "is of version {version}, and this program reads version {VERSION}: record it again with this program"
            )));
        }
        None => return Err(unfit("is no journal: --replay takes what --record wrote".to_owned())),
    }
    let malformed = |number: usize, error: &serde_json::Error| {
        unfit(format!("cannot be understood, line {} ({error}): record it again with this program", number + 1))
    };
    let header: Header = serde_json::from_str(&lines[0]).map_err(|error| malformed(0, &error))?;
    // The end is checked first: of a journal without one nothing else matters.
    let frames = lines.len().saturating_sub(2) as u64;
    if lines.last().and_then(|line| serde_json::from_str(line).ok()) != Some(End { frames }) {
        return Err(unfit("is truncated, its end is missing: let the recording run to its end".to_owned()));
    }
    let entries = lines[1..lines.len() - 1]
        .iter()
        .enumerate()
        .map(|(number, line)| serde_json::from_str(line).map_err(|error| malformed(number + 1, &error)))
        .collect::<Result<Vec<Entry>, _>>()?;
    Ok(Journal { scene: header.scene, start: header.start, entries })
}

/// A journal that is being written, beside its place until it is whole.
#[derive(Debug)]
pub struct Writer {
    path: PathBuf,
    file: BufWriter<Partial>,
    frames: u64,
    scene: Scene,
    camera: Option<View>,
}

impl Writer {
    /// Begins one, of a field that starts as this scene, from what has these sums.
    ///
    /// # Errors
    ///
    /// No file can be made there.
    pub fn create(path: &Path, scene: &Scene, start: Sums) -> Result<Self, WriteError> {
        let file = BufWriter::new(Partial::beside(path)?);
        let mut writer = Self { path: path.to_owned(), file, frames: 0, scene: scene.clone(), camera: None };
        writer.line(&Header {
            rilievo_journal: VERSION,
            program: env!("CARGO_PKG_VERSION").to_owned(),
            scene: scene.clone(),
            start,
        })?;
        Ok(writer)
    }

    /// Adds a frame: what it spans, what the hand did, the scene and the camera as they are.
    ///
    /// # Errors
    ///
    /// The file cannot be written.
    pub fn add(
        &mut self,
        tick: &Tick,
        strokes: &[Stroke],
        restart: bool,
        scene: &Scene,
        camera: &Camera,
    ) -> Result<(), WriteError> {
        let view = View::from(camera);
        let scene_changed = (self.scene != *scene).then(|| Box::new(scene.clone()));
        let camera_changed = (self.camera != Some(view)).then_some(view);
        let entry = Entry { tick: *tick, strokes: strokes.to_vec(), scene: scene_changed, restart, camera: camera_changed };
        self.line(&entry)?;
        if entry.scene.is_some() {
            self.scene = scene.clone();
        }
        self.camera = Some(view);
        self.frames += 1;
        Ok(())
    }

    fn line(&mut self, value: &impl Serialize) -> Result<(), WriteError> {
        let line = serde_json::to_string(value).map_err(std::io::Error::from);
        line.and_then(|line| writeln!(self.file, "{line}")).map_err(|cause| WriteError::new(&self.path, cause))
    }

    /// Ends it and puts it in its place.
    ///
    /// # Errors
    ///
    /// The file cannot be written.
    pub fn finish(mut self) -> Result<(), WriteError> {
        self.line(&End { frames: self.frames })?;
        let file = self.file.into_inner().map_err(|error| WriteError::new(&self.path, error.into_error()))?;
        file.persist()
    }
}
