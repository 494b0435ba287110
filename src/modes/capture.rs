//! Capture: frames to files, headless.

use std::collections::BTreeMap;

use super::headless::Headless;
use super::script::Script;
use super::{ModeError, check_health, export, progress, state, wait_for, wait_for_gpu};
use crate::cli::{CaptureOptions, Channel, Verbosity};
use crate::frame::{Frame, FrameInput};
use crate::gpu::{Gpu, Readback};
use crate::io::atomic;
use crate::io::manifest::{self, Manifest};
use crate::io::output_dir::{OutputDir, Owner};
use crate::io::{exr_file, png_file};
use crate::scene::Scene;
use crate::surface::channels::Channel as Numbers;
use crate::surface::{Channels, Choice, View};

/// The format of the picture that becomes a PNG.
pub const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// Runs the mode.
///
/// # Errors
///
/// The scene, its image, the adapter, its limits or the output directory are unfit, in this order; nothing is left behind.
pub fn run(options: &CaptureOptions, verbosity: Verbosity) -> Result<(), ModeError> {
    let Headless { gpu, mut start, mut frame, picture, player, resumed } = Headless::open(&options.common, &options.resume)?;
    let total = u64::from(options.warmup) + u64::from(options.frames);
    let mut script = Script::open(&gpu, &mut frame, resumed, player, options.dt, total)?;
    let scene = &start.scene.clone();
    let channels = ChannelFiles::new(&gpu, scene, &options.channels())?;
    let exports = options.exports();
    export::check(&frame, &exports)?;
    if let Some(path) = &options.save_state {
        atomic::check(path)?;
    }
    let directory = OutputDir::create(&options.out, Owner::Capture)?;

    let mut manifest = Manifest::new(scene, &gpu.adapter.get_info(), options.common.image_size, options.dt, options.warmup);
    let progress = progress::bar(total, &scene.name, verbosity == Verbosity::Quiet);
    for number in 0..total {
        let moment = script.next(&gpu, &mut frame, &mut start)?;
        let input = moment.input(options.common.display.display(scene));
        let file_index = number.checked_sub(u64::from(options.warmup));
        let target = file_index.map(|_| picture.view());
        let mut encoder = gpu.encoder("capture");
        frame.record(&gpu, &mut encoder, &input, target)?;
        frame.finish(&gpu, encoder);
        wait_for_gpu(&gpu)?;
        if let Some(index) = file_index {
            // Fewer frames than u32 can count were asked for.
            let index = index as u32;
            let mut files = write_files(&gpu, &frame, &picture, &channels, &input, &directory, index)?;
            // The field's exact heights are one file, whichever way they were asked for.
            for name in export::write(&gpu, &frame, &exports, &directory, index)? {
                if !files.contains(&name) {
                    files.push(name);
                }
            }
            manifest.frames.push(manifest::Frame::new(index, moment.tick.time_seconds, &moment.camera, files));
        }
        progress.inc(1);
    }
    progress.finish_and_clear();
    for (name, behind_seconds) in check_health(&gpu, &mut frame)? {
        if behind_seconds > 0.0 {
            log::warn!("{name} fell {behind_seconds:.3} s behind: a frame would have taken too many substeps");
        }
    }
    if let Some(path) = &options.save_state {
        state::save(&gpu, &frame, &start, script.clock(), path)?;
    }
    manifest.write(directory.path())?;
    directory.finish();
    Ok(())
}

/// Writes the last frame of a live session as a capture would have: the picture and the manifest.
///
/// # Errors
///
/// The device was lost, or a file cannot be written; nothing is left behind.
pub fn write_last_frame(
    gpu: &Gpu,
    frame: &mut Frame,
    input: &FrameInput<'_>,
    dt_seconds: f64,
    warmup: u32,
    out: &std::path::Path,
) -> Result<(), ModeError> {
    let picture = Picture::new(gpu, frame.image_size());
    let channels = ChannelFiles::default();
    let directory = OutputDir::create(out, Owner::Capture)?;
    picture.draw(gpu, frame, input)?;
    let files = write_files(gpu, frame, &picture, &channels, input, &directory, 0)?;
    let mut manifest = Manifest::new(frame.scene(), &gpu.adapter.get_info(), frame.image_size(), dt_seconds, warmup);
    manifest.frames.push(manifest::Frame::new(0, input.tick.time_seconds, input.camera, files));
    manifest.write(directory.path())?;
    directory.finish();
    Ok(())
}

/// A target that is read back as a picture.
pub struct Picture {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
}

impl Picture {
    /// Makes one.
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: PICTURE_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view }
    }

    /// Draws the field as it stands, whatever format the frame's own target has, and leaves the field alone.
    ///
    /// # Errors
    ///
    /// The presentation cannot be built.
    pub fn draw(&self, gpu: &Gpu, frame: &mut Frame, input: &FrameInput<'_>) -> Result<(), ModeError> {
        let present = crate::present::Present::new(gpu, PICTURE_FORMAT)?;
        let mut encoder = gpu.encoder("picture");
        frame.show_with(gpu, &mut encoder, &present, input, &self.view)?;
        gpu.queue.submit([encoder.finish()]);
        Ok(())
    }

    /// What a frame draws to.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// Its pixels, RGBA in sRGB, row by row.
    ///
    /// # Errors
    ///
    /// The device was lost.
    pub fn read(&self, gpu: &Gpu) -> Result<Vec<u8>, ModeError> {
        read_texture(gpu, &self.texture)
    }
}

/// The finest level of a texture, row by row.
///
/// # Errors
///
/// The device was lost.
pub fn read_texture(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Vec<u8>, ModeError> {
    let mut encoder = gpu.encoder("read");
    let readback = Readback::record_texture(gpu, &mut encoder, texture, 0);
    gpu.queue.submit([encoder.finish()]);
    readback.start();
    wait_for(gpu, &readback)
}

/// What is written beside the picture.
#[derive(Default)]
struct ChannelFiles {
    wanted: Vec<Channel>,
    pass: Option<Channels>,
}

impl ChannelFiles {
    fn new(gpu: &Gpu, scene: &Scene, wanted: &[Channel]) -> Result<Self, ModeError> {
        let wanted: Vec<_> = wanted.iter().copied().filter(|channel| *channel != Channel::Color).collect();
        let pass = match wanted.is_empty() {
            true => None,
            false => Some(Channels::new(gpu, Choice::of(scene))?),
        };
        Ok(Self { wanted, pass })
    }
}

/// Writes one frame's files and returns their names.
fn write_files(
    gpu: &Gpu,
    frame: &Frame,
    picture: &Picture,
    channels: &ChannelFiles,
    input: &FrameInput<'_>,
    directory: &OutputDir,
    index: u32,
) -> Result<Vec<String>, ModeError> {
    let mut files = vec![format!("frame_{index:05}.png")];
    png_file::write(&directory.file(&files[0]), frame.image_size(), &picture.read(gpu)?)?;
    if let Some(pass) = &channels.pass {
        let numbers = read_channels(gpu, frame, pass, input)?;
        let name = format!("frame_{index:05}.exr");
        exr_file::write(&directory.file(&name), frame.image_size(), exr_channels(&numbers, &channels.wanted))?;
        files.push(name);
    }
    if channels.wanted.contains(&Channel::Height) {
        let heights = bytemuck::pod_collect_to_vec(&read_texture(gpu, &frame.field.height.texture)?);
        let name = format!("field_{index:05}.exr");
        exr_file::write(&directory.file(&name), frame.field.size, BTreeMap::from([("H".to_owned(), heights)]))?;
        files.push(name);
    }
    Ok(files)
}

/// What every pixel of the picture shows, row by row, one ray a pixel.
///
/// # Errors
///
/// The device was lost.
pub fn read_channels(gpu: &Gpu, frame: &Frame, pass: &Channels, input: &FrameInput<'_>) -> Result<Vec<Numbers>, ModeError> {
    let [width, height] = frame.image_size();
    if let Some(stage) = frame.stage() {
        let parts = stage.request_channels(gpu, &input.seen(frame.scene()), [width, height])?;
        let parts = parts.iter().map(|part| wait_for(gpu, part)).collect::<Result<Vec<_>, _>>()?;
        let parts: Vec<Vec<[f32; 4]>> = parts.iter().map(|bytes| bytemuck::pod_collect_to_vec(bytes)).collect();
        return Ok((0..parts[0].len()).map(|i| Numbers::from_parts([parts[0][i], parts[1][i], parts[2][i]])).collect());
    }
    let view = View::new(frame.scene(), input.camera, input.tick.time_seconds, [width, height], input.display);
    let rows = Channels::rows_per_band(gpu, width);
    let mut numbers = Vec::with_capacity(width as usize * height as usize);
    for first_row in (0..height).step_by(rows as usize) {
        let readback = pass.request(gpu, &frame.field, &view, first_row, rows.min(height - first_row));
        numbers.extend(bytemuck::pod_collect_to_vec::<u8, Numbers>(&wait_for(gpu, &readback)?));
    }
    Ok(numbers)
}

/// The channels of an EXR file. A pixel that shows no surface has position = +inf and zeros elsewhere.
fn exr_channels(numbers: &[Numbers], wanted: &[Channel]) -> BTreeMap<String, Vec<f32>> {
    let mut channels = BTreeMap::new();
    let mut add = |name: &str, background: f32, value: &dyn Fn(&Numbers) -> f32| {
        let values = numbers.iter().map(|pixel| if pixel.steps < 0.0 { background } else { value(pixel) }).collect();
        channels.insert(name.to_owned(), values);
    };
    for channel in wanted {
        match channel {
            Channel::Color => {}
            Channel::Position => {
                add("position.X", f32::INFINITY, &|pixel| pixel.position[0]);
                add("position.Y", f32::INFINITY, &|pixel| pixel.position[1]);
                add("position.Z", f32::INFINITY, &|pixel| pixel.position[2]);
            }
            Channel::Normal => {
                add("normal.X", 0.0, &|pixel| pixel.normal[0]);
                add("normal.Y", 0.0, &|pixel| pixel.normal[1]);
                add("normal.Z", 0.0, &|pixel| pixel.normal[2]);
            }
            Channel::Uv => {
                add("uv.U", 0.0, &|pixel| pixel.uv[0]);
                add("uv.V", 0.0, &|pixel| pixel.uv[1]);
            }
            Channel::Height => add("height.H", 0.0, &|pixel| pixel.height),
            Channel::Visibility => add("visibility.V", 0.0, &|pixel| pixel.visibility),
            Channel::Steps => add("steps.S", 0.0, &|pixel| pixel.steps),
            Channel::Lod => add("lod.L", 0.0, &|pixel| pixel.lod),
        }
    }
    channels
}
