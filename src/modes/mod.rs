//! How the frame is run: live in a window, to files, to numbers, against the truth. The modes differ in who owns the clock and where the picture goes.

pub mod adapters;
pub mod capture;
pub mod compare;
pub mod export;
pub mod headless;
pub mod live;
mod progress;
pub mod script;
pub mod state;
pub mod statistics;
pub mod stress;

use std::time::{Duration, Instant};

use crate::cli::CommonOptions;
use crate::frame::{Frame, FrameError, Start};
use crate::gpu::readback::ReadbackError;
use crate::gpu::{AdapterError, Gpu, Readback, ShaderError};
use crate::interruption;
use crate::io::atomic::WriteError;
use crate::io::height_image::ImageError;
use crate::io::image_sequence::Player;
use crate::io::journal::JournalError;
use crate::io::scene_file::{self, LoadedScene, SceneFileError};
use crate::io::state_file::StateFileError;

/// Why a mode did not do what it was asked.
#[derive(Debug, thiserror::Error)]
pub enum ModeError {
    /// The scene or its image is unfit.
    #[error(transparent)]
    Scene(#[from] SceneFileError),
    /// There is no device.
    #[error(transparent)]
    Adapter(#[from] AdapterError),
    /// The frame cannot be made.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// A pass cannot be made.
    #[error(transparent)]
    Shader(#[from] ShaderError),
    /// The specification does not say what the scene shows.
    #[error(
        "--truth reference knows the bare plane alone, and this scene has a mesh, a shell, balls or further reliefs: leave it out for exact"
    )]
    NoReference,
    /// There is no such layer to export.
    #[error("--export {export} asks for what this scene does not have: leave it out, or name a scene that has it")]
    NoLayer {
        /// What was asked for.
        export: &'static str,
    },
    /// An image of a series is unfit.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// A journal is unfit.
    #[error(transparent)]
    Journal(#[from] JournalError),
    /// A saved state is unfit.
    #[error(transparent)]
    State(#[from] StateFileError),
    /// The table does not hold against an earlier one.
    #[error(transparent)]
    Check(#[from] compare::check::CheckError),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The picture did not arrive.
    #[error(transparent)]
    Readback(#[from] ReadbackError),
    /// A source has stopped.
    #[error("{name} has stopped: {sentence}")]
    Halted {
        /// The source.
        name: &'static str,
        /// Why, and what to do about it.
        sentence: String,
    },
    /// The device failed on the way.
    #[error("the graphics device failed: {0}; run it again, or choose another with --adapter")]
    Device(String),
    /// The run was interrupted; see [`crate::interruption`].
    #[error("interrupted: {left}")]
    Interrupted {
        /// What is left of it.
        left: &'static str,
    },
    /// There is no window.
    #[error("{0}")]
    Window(String),
}

/// Asks whether a run without a window may go on to its next frame.
///
/// # Errors
///
/// It was interrupted.
pub fn check_interruption() -> Result<(), ModeError> {
    let left = "what was written by then is whole, and the rest was not written";
    if interruption::is_asked() { Err(ModeError::Interrupted { left }) } else { Ok(()) }
}

/// Opens the device that the command line asks for, hardware first.
///
/// # Errors
///
/// There is none, none matches, or none is able.
pub fn open_device(common: &CommonOptions) -> Result<Gpu, AdapterError> {
    pollster::block_on(Gpu::new(&common.machine.preference()))
}

/// Loads the scene that the command line asks for.
///
/// # Errors
///
/// The scene or its image is unfit.
pub fn load_scene(common: &CommonOptions) -> Result<LoadedScene, SceneFileError> {
    scene_file::load(&common.scene, &common.overrides(), common.image_size)
}

/// What a frame starts from, and what plays the scene's series of images, if it has one. Makes as many heights as the field has texels: check the size against the adapter first.
///
/// # Errors
///
/// The first image of its series is damaged.
pub fn start(loaded: &LoadedScene) -> Result<(Start, Option<Player>), ModeError> {
    let (heights, mut colours) = loaded.layers();
    let mut player = loaded.player();
    if let Some(player) = &mut player {
        // Pictures of a series follow one another in a texture of the first one's size.
        colours = player.at(0.0)?.colours.as_deref().cloned().or(colours);
    }
    // What stands beside it is still: nothing plays there.
    let reliefs = loaded.reliefs.iter().map(|relief| Ok(start(relief)?.0)).collect::<Result<_, ModeError>>()?;
    let start = Start::new(&loaded.scene, heights, loaded.mesh.clone()).with_colours(colours);
    Ok((start.with_images(loaded.images.clone()).with_reliefs(reliefs), player))
}

/// How the sources of a frame fare, whose GPU is idle.
///
/// # Errors
///
/// One has stopped: what it would show from here on is not what it simulates.
pub fn check_health(gpu: &Gpu, frame: &mut Frame) -> Result<Vec<(&'static str, f64)>, ModeError> {
    // The first call asks, the second has the answer.
    frame.health(gpu);
    wait_for_gpu(gpu)?;
    frame
        .health(gpu)
        .into_iter()
        .map(|(name, health)| match health.halted {
            Some(sentence) => Err(ModeError::Halted { name, sentence }),
            None => Ok((name, health.behind_seconds)),
        })
        .collect()
}

/// Waits for bytes on their way from the GPU.
///
/// # Errors
///
/// The device was lost.
pub fn wait_for(gpu: &Gpu, readback: &Readback) -> Result<Vec<u8>, ModeError> {
    wait_for_gpu(gpu)?;
    // The GPU is done, but another thread that polls the same device may be the one that runs this readback's callback, and not have
    // come to it yet. wgpu runs every callback, so that the limit is for a bug alone.
    let deadline = Instant::now() + CALLBACK_LIMIT;
    loop {
        if let Some(bytes) = readback.take() {
            return bytes.map_err(ModeError::from);
        }
        if Instant::now() > deadline {
            return Err(ReadbackError::missing().into());
        }
        std::thread::yield_now();
    }
}

/// How long another thread may take to run a callback that is due. It takes microseconds, on a loaded machine milliseconds.
const CALLBACK_LIMIT: Duration = Duration::from_secs(10);

/// Waits until the GPU has done all that was submitted.
///
/// # Errors
///
/// The device was lost, or reported an error since the last call.
pub fn wait_for_gpu(gpu: &Gpu) -> Result<(), ModeError> {
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| ModeError::Device(error.to_string()))?;
    gpu.take_error().map_or(Ok(()), |error| Err(ModeError::Device(error)))
}
