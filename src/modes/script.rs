//! Scripts: what a run without a hand does, frame by frame, by a clock of its own or by a journal.

use std::path::{Path, PathBuf};

use super::statistics::counted;
use super::{ModeError, check_interruption, state};
use crate::camera::Camera;
use crate::cli::ResumeOptions;
use crate::clock::{Clock, Pace, Tick};
use crate::frame::{Frame, FrameError, FrameInput, Start};
use crate::gpu::Gpu;
use crate::io::height_image::ImageError;
use crate::io::image_sequence::Player;
use crate::io::journal::{self, Entry, Journal, JournalError};
use crate::io::scene_file::SceneOverrides;
use crate::io::state_file::SavedState;
use crate::scene::Scene;
use crate::stroke::Strokes;
use crate::surface::Display;

/// What one frame is asked, whoever asks it.
#[derive(Clone, Debug)]
pub struct Moment {
    /// The time that it shows and the steps that it owes.
    pub tick: Tick,
    /// What is done to the field in it.
    pub strokes: Strokes,
    /// Where it is seen from.
    pub camera: Camera,
}

impl Moment {
    /// The input of its frame.
    pub fn input(&self, display: Display) -> FrameInput<'_> {
        FrameInput { tick: &self.tick, strokes: &self.strokes, camera: &self.camera, display }
    }
}

/// A scene by itself, at a fixed pace.
pub struct Solo {
    clock: Clock,
    dt_seconds: f64,
}

impl Solo {
    /// From its start.
    pub fn new(frame: &Frame, dt_seconds: f64) -> Self {
        Self { clock: Clock::new(frame.step_seconds()), dt_seconds }
    }

    /// The next frame.
    pub fn next(&mut self, scene: &Scene) -> Moment {
        let tick = self.clock.advance(Pace::Fixed { dt_seconds: self.dt_seconds });
        let strokes = Strokes::of_scene(scene, scene.seed, &tick);
        Moment { tick, strokes, camera: Camera::at(&scene.camera, tick.time_seconds) }
    }
}

/// What a run does, frame by frame: the scene by itself, or what was recorded.
pub struct Script {
    solo: Solo,
    replay: Option<Replay>,
    player: Option<Player>,
}

/// A journal that is being replayed.
pub struct Replay {
    entries: std::vec::IntoIter<Entry>,
    camera: Option<Camera>,
    looks: SceneOverrides,
}

impl Replay {
    /// Begins a journal, whose scenes are seen as `looks` says.
    pub fn new(journal: Journal, looks: SceneOverrides) -> Self {
        Self { entries: journal.entries.into_iter(), camera: None, looks }
    }

    /// How many frames are left.
    pub fn frames_left(&self) -> usize {
        self.entries.len()
    }

    /// The times that the frames left show, seconds.
    fn times_seconds(&self) -> impl Iterator<Item = f64> {
        self.entries.as_slice().iter().map(|entry| entry.tick.time_seconds)
    }

    /// The time that the next frame spans, seconds; none after the last.
    pub fn next_span_seconds(&self) -> Option<f64> {
        self.entries.as_slice().first().map(|entry| entry.tick.time_seconds - entry.tick.previous_seconds)
    }

    /// The next frame, after the frame's scene has become what it was then; none after the last.
    ///
    /// # Errors
    ///
    /// A scene of the journal cannot be shown on this adapter.
    pub fn next(&mut self, gpu: &Gpu, frame: &mut Frame, start: &mut Start) -> Result<Option<Moment>, FrameError> {
        let Some(entry) = self.entries.next() else { return Ok(None) };
        if let Some(scene) = entry.scene {
            let mut scene = *scene;
            self.looks.look(&mut scene);
            frame.set_scene(gpu, &scene)?;
        }
        if entry.restart {
            start.take_scene(frame.scene());
            frame.reset(gpu, start);
        }
        if let Some(view) = entry.camera {
            self.camera = Some(view.into());
        }
        let scene = frame.scene();
        let mut strokes = Strokes::of_scene(scene, scene.seed, &entry.tick);
        strokes.add_hand(scene, &entry.strokes);
        let recorded = self.camera.filter(|_| !self.looks.moves_camera());
        let camera = recorded.unwrap_or_else(|| Camera::at(&scene.camera, entry.tick.time_seconds));
        Ok(Some(Moment { tick: entry.tick, strokes, camera }))
    }
}

impl Script {
    /// What a run of so many frames does: from the start of its scene, from a saved state on, or as a journal says. Every image that
    /// it needs is read once: none fails on the way.
    ///
    /// # Errors
    ///
    /// The state or an image is unfit, or the journal has fewer frames.
    pub fn open(
        gpu: &Gpu,
        frame: &mut Frame,
        resumed: Resumed,
        player: Option<Player>,
        dt_seconds: f64,
        frames: u64,
    ) -> Result<Self, ModeError> {
        let mut script = Self { solo: Solo::new(frame, dt_seconds), replay: None, player };
        match resumed {
            Resumed::No => {}
            Resumed::State(state, path) => script.solo.clock = state::restore(gpu, frame, *state, &path)?,
            Resumed::Journal(replay, path) => {
                check_length(replay.frames_left() as u64, frames, &path)?;
                script.replay = Some(*replay);
            }
        }
        if let Some(player) = &mut script.player {
            match &script.replay {
                Some(replay) => player.check(replay.times_seconds().take(frames as usize))?,
                // From where a saved state stopped, one more than there are: the next is not there yet.
                None => {
                    let start_seconds = script.solo.clock.time_seconds();
                    player.check((0..=frames).map(|number| start_seconds + number as f64 * dt_seconds))?;
                }
            }
        }
        Ok(script)
    }

    /// The next frame. A journal is asked for no more frames than it was opened for.
    ///
    /// # Errors
    ///
    /// The run was interrupted, or a scene of a journal cannot be shown on this adapter.
    pub fn next(&mut self, gpu: &Gpu, frame: &mut Frame, start: &mut Start) -> Result<Moment, ModeError> {
        check_interruption()?;
        let recorded = match &mut self.replay {
            Some(replay) => replay.next(gpu, frame, start)?,
            None => None,
        };
        let mut moment = match recorded {
            Some(moment) => {
                self.solo.clock.follow(&moment.tick);
                moment
            }
            None => self.solo.next(frame.scene()),
        };
        hand_images(&mut self.player, frame.scene(), &moment.tick, &mut moment.strokes)?;
        Ok(moment)
    }

    /// The clock that goes on after the last frame.
    pub fn clock(&self) -> &Clock {
        &self.solo.clock
    }
}

/// Hands a frame what its moment shows of the scene's series of images, if it plays one.
///
/// # Errors
///
/// An image is unfit.
pub fn hand_images(player: &mut Option<Player>, scene: &Scene, tick: &Tick, strokes: &mut Strokes) -> Result<(), ImageError> {
    if let (Some(player), Some(sequence)) = (player, &scene.sequence) {
        player.set(sequence);
        strokes.images = Some(player.at(tick.time_seconds)?);
    }
    Ok(())
}

/// Where a run begins, if not at the start of its scene.
pub enum Resumed {
    /// At the start.
    No,
    /// Where another run was saved, in this file.
    State(Box<SavedState>, PathBuf),
    /// At the start, and goes on as this file says.
    Journal(Box<Replay>, PathBuf),
}

/// Reads the journal that the options name, if they name one.
///
/// # Errors
///
/// It is unfit.
pub fn journal(options: &ResumeOptions) -> Result<Option<Journal>, JournalError> {
    options.replay.as_deref().map(journal::read).transpose()
}

/// Where a run with this start begins, of which `journal` is what [`fn@journal`] read.
///
/// # Errors
///
/// The state is unfit, or the journal began with other heights or images than these.
pub fn resumed(
    options: &ResumeOptions,
    journal: Option<Journal>,
    looks: SceneOverrides,
    start: &Start,
) -> Result<Resumed, ModeError> {
    if let (Some(journal), Some(path)) = (journal, &options.replay) {
        if let Some(problem) = journal.start.problem(start.sums()) {
            return Err(JournalError::Unfit { path: path.clone(), problem: problem.to_owned() }.into());
        }
        return Ok(Resumed::Journal(Box::new(Replay::new(journal, looks)), path.clone()));
    }
    match &options.load_state {
        Some(path) => Ok(Resumed::State(Box::new(state::read(path, start)?), path.clone())),
        None => Ok(Resumed::No),
    }
}

/// Checks that a journal has the frames that a run asks of it.
///
/// # Errors
///
/// It has fewer.
pub fn check_length(there: u64, asked: u64, path: &Path) -> Result<(), JournalError> {
    if asked <= there {
        return Ok(());
    }
    let problem = format!("has {}, and this run asks for {asked}: ask for fewer with --frames", counted(there, "frame"));
    Err(JournalError::Unfit { path: path.to_owned(), problem })
}
