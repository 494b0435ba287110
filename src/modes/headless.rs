//! What every run without a window begins with: a scene, a device, a frame and a picture to draw to.

use std::sync::OnceLock;
use std::time::Instant;

use super::capture::{PICTURE_FORMAT, Picture};
use super::script::{self, Resumed};
use super::{ModeError, load_scene, open_device, start};
use crate::cli::{CommonOptions, ResumeOptions};
use crate::frame::{self, Frame, Start};
use crate::gpu::{Gpu, Timer};
use crate::io::image_sequence::Player;
use crate::io::scene_file;

/// A frame that nobody watches.
pub struct Headless {
    /// The device.
    pub gpu: Gpu,
    /// What the frame starts from.
    pub start: Start,
    /// The frame.
    pub frame: Frame,
    /// What it draws to.
    pub picture: Picture,
    /// What plays its series of images, if it has one.
    pub player: Option<Player>,
    /// Where the run begins.
    pub resumed: Resumed,
}

impl Headless {
    /// Loads the scene, opens the device, and builds the frame. Nothing is written.
    ///
    /// # Errors
    ///
    /// The scene, its image, the journal, the adapter, its limits or the state are unfit, in this order.
    pub fn open(common: &CommonOptions, resume: &ResumeOptions) -> Result<Self, ModeError> {
        let journal = script::journal(resume)?;
        let loaded = match &journal {
            Some(journal) => scene_file::load_whole(journal.scene.clone(), &common.overrides(), common.image_size)?,
            None => load_scene(common)?,
        };
        let gpu = open_device(common)?;
        frame::check_limits(&gpu, &loaded.scene, common.image_size)?;
        let (start, player) = start(&loaded)?;
        let resumed = script::resumed(resume, journal, common.overrides(), &start)?;
        let frame = Frame::new(&gpu, &start, common.image_size, PICTURE_FORMAT)?;
        let picture = Picture::new(&gpu, common.image_size);
        Ok(Self { gpu, start, frame, picture, player, resumed })
    }
}

/// A timer that can be trusted on this adapter: where it is a processor, one that runs every pass alone.
pub fn trusted_timer(gpu: &Gpu) -> Timer {
    match gpu.adapter.get_info().device_type {
        wgpu::DeviceType::Cpu => Timer::alone(gpu, milliseconds_when_idle),
        _ => Timer::new(gpu),
    }
}

/// Waits for the GPU and returns the time since the first call.
pub fn milliseconds_when_idle(gpu: &Gpu) -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    // A device that is lost says so at the end of the frame.
    let _ = gpu.device.poll(wgpu::PollType::wait_indefinitely());
    START.get_or_init(Instant::now).elapsed().as_secs_f64() * 1e3
}
