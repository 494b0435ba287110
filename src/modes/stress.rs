//! Stress: frames to numbers, headless.

use std::fmt::Write as _;
use std::time::Instant;

use serde::Serialize;

use super::capture::read_channels;
use super::headless::{self, Headless};
use super::script::Script;
use super::statistics::{Spread, Steps, counted};
use super::{ModeError, check_health, progress, wait_for, wait_for_gpu};
use crate::cli::{StressOptions, Verbosity};
use crate::field::{gas, shallow_water};
use crate::frame::Frame;
use crate::gpu::{Gpu, PassTime, Readback};
use crate::io::atomic;
use crate::io::manifest::{Adapter, write_json};
use crate::stroke;
use crate::surface::{Channels, Choice};

/// Frames before the first that counts: pipelines compile and caches fill in them.
const WARMUP_FRAMES: u64 = 5;

/// Time from frame to frame, seconds.
const DT_SECONDS: f64 = 1.0 / 60.0;

/// The time of one pass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassReport {
    /// Its name.
    pub name: String,
    /// GPU time a frame, milliseconds; none where the adapter has no timestamps.
    pub gpu_ms: Option<Spread>,
}

/// The time of a whole frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrameReport {
    /// From submission until the GPU is done, milliseconds.
    pub wall_ms: Spread,
    /// The sum of its passes on the GPU, milliseconds.
    pub gpu_ms: Option<Spread>,
}

/// All that a stress run measures.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the report's own; --help and the README say what they mean")]
pub struct Report {
    pub adapter: Adapter,
    pub scene: String,
    pub technique: String,
    pub shadow: String,
    pub field_size: [u32; 2],
    pub image_size: [u32; 2],
    pub frames: u32,
    pub passes: Vec<PassReport>,
    pub frame: FrameReport,
    pub steps_per_pixel: Steps,
    pub bytes_per_frame: f64,
    pub gb_per_s: f64,
    pub field_bytes_per_texel: f64,
    pub gpu_memory_bytes: u64,
    pub clipped_texels: u64,
    /// Bytes a texel that a substep of shallow water moves by design; none where there is none.
    pub water_substep_bytes_per_texel: Option<u64>,
    /// What the water moved by design in a second of its pass; none without timestamps, too.
    pub water_gb_per_s: Option<f64>,
    /// Bytes a cell that a step of gas moves by design, in a tile that moves and emits nothing; none where there is none.
    pub gas_step_bytes_per_cell: Option<u64>,
    /// What the gas moved by design in a second of its passes.
    pub gas_gb_per_s: Option<f64>,
    /// Simulated time that sources gave up because their substeps reached their cap, seconds.
    pub behind_seconds: f64,
}

/// Runs the mode: prints the table, and writes the JSON file if one was asked for.
///
/// # Errors
///
/// The scene, its image, the adapter, its limits or the JSON file are unfit.
pub fn run(options: &StressOptions, verbosity: Verbosity) -> Result<String, ModeError> {
    let Headless { gpu, mut start, mut frame, picture, player, resumed } = Headless::open(&options.common, &options.resume)?;
    let total = WARMUP_FRAMES + u64::from(options.frames);
    let mut script = Script::open(&gpu, &mut frame, resumed, player, DT_SECONDS, total)?;
    let scene = &start.scene.clone();
    frame.timer = headless::trusted_timer(&gpu);
    let pass = Channels::new(&gpu, Choice::of(scene))?;

    if let Some(path) = &options.json {
        atomic::check(path)?;
    }
    let mut samples = Samples::default();
    let mut bytes = Vec::new();
    let mut flows = ["shallow-water", "gas"].map(Flow::new);
    let progress = progress::bar(total, &scene.name, verbosity == Verbosity::Quiet);
    let mut steps = Steps::default();
    let mut behind_seconds = 0.0;
    for number in 0..total {
        let mut moment = script.next(&gpu, &mut frame, &mut start)?;
        let (count, radius) = (options.stamps, options.stamp_radius);
        moment.strokes.presses.extend(stroke::stress_discs(scene.seed, number, count, radius, scene.field.size));
        let input = moment.input(options.common.display.display(scene));
        let mut encoder = gpu.encoder("stress");
        let recording = Instant::now();
        frame.record(&gpu, &mut encoder, &input, Some(picture.view()))?;
        // Where every pass is submitted alone, the work is done by now.
        let submitted = if frame.timer.submits_passes_alone() { recording } else { Instant::now() };
        frame.finish(&gpu, encoder);
        wait_for_gpu(&gpu)?;
        let wall_ms = submitted.elapsed().as_secs_f64() * 1e3;
        // Asked every frame: what a simulation moved, it alone knows.
        behind_seconds = check_health(&gpu, &mut frame)?.iter().map(|(_, seconds)| *seconds).fold(0.0, f64::max);
        let times = frame.timer.finished_frame();
        if number >= WARMUP_FRAMES {
            bytes.push(frame.field_traffic_bytes() as f64);
            flows.iter_mut().for_each(|flow| flow.add(&frame, times.as_deref().unwrap_or_default()));
            samples.add(wall_ms, times.unwrap_or_default());
        }
        if number + 1 == total {
            steps = Steps::of(&read_channels(&gpu, &frame, &pass, &input)?);
        }
        progress.inc(1);
    }
    progress.finish_and_clear();

    let frame_report = samples.frame();
    let field_bytes = bytes.iter().sum::<f64>() / bytes.len() as f64;
    let bytes_per_frame = field_bytes + frame.picture_traffic_bytes(steps.mean);
    let frame_ms = frame_report.gpu_ms.unwrap_or(frame_report.wall_ms).median;
    let report = Report {
        adapter: (&gpu.adapter.get_info()).into(),
        scene: scene.name.clone(),
        technique: scene.trace.technique.name().to_owned(),
        shadow: scene.trace.shadow.name().to_owned(),
        field_size: scene.field.size,
        image_size: options.common.image_size,
        frames: options.frames,
        passes: samples.passes(),
        frame: frame_report,
        steps_per_pixel: steps,
        bytes_per_frame,
        gb_per_s: bytes_per_frame / frame_ms / 1e6,
        field_bytes_per_texel: frame.field_bytes_per_texel(),
        gpu_memory_bytes: frame.memory_bytes(),
        clipped_texels: clipped_texels(&gpu, &frame)?,
        water_substep_bytes_per_texel: scene.shallow_water.as_ref().map(|_| shallow_water::TEXEL_BYTES),
        water_gb_per_s: flows[0].gb_per_s(),
        gas_step_bytes_per_cell: scene.gas.as_ref().map(|gas| gas::step_bytes(gas.coarsening)),
        gas_gb_per_s: flows[1].gb_per_s(),
        behind_seconds,
    };
    if let Some(path) = &options.json {
        write_json(path, &report)?;
    }
    Ok(table(&report))
}

/// What was measured, frame by frame.
#[derive(Default)]
struct Samples {
    wall_ms: Vec<f64>,
    gpu_ms: Vec<f64>,
    passes: Vec<(String, Vec<f64>)>,
}

impl Samples {
    fn add(&mut self, wall_ms: f64, times: Vec<PassTime>) {
        self.wall_ms.push(wall_ms);
        self.gpu_ms.extend(times.iter().map(|time| time.milliseconds).sum::<Option<f64>>().filter(|_| !times.is_empty()));
        for time in times {
            match self.passes.iter_mut().find(|(name, _)| *name == time.name) {
                Some((_, all)) => all.extend(time.milliseconds),
                None => self.passes.push((time.name, time.milliseconds.into_iter().collect())),
            }
        }
    }

    fn passes(&self) -> Vec<PassReport> {
        self.passes.iter().map(|(name, times)| PassReport { name: name.clone(), gpu_ms: Spread::of(times) }).collect()
    }

    fn frame(&self) -> FrameReport {
        // At least one frame was asked for, so there is a wall time.
        let nothing = Spread { median: 0.0, p95: 0.0, min: 0.0 };
        FrameReport { wall_ms: Spread::of(&self.wall_ms).unwrap_or(nothing), gpu_ms: Spread::of(&self.gpu_ms) }
    }
}

/// What a source moved, and how long its passes took.
struct Flow {
    source: &'static str,
    /// What the names of its passes begin with.
    passes: String,
    bytes: u64,
    milliseconds: f64,
}

impl Flow {
    fn new(source: &'static str) -> Self {
        Self { source, passes: source.replace('-', " "), bytes: 0, milliseconds: 0.0 }
    }

    /// Adds a frame's.
    fn add(&mut self, frame: &Frame, times: &[PassTime]) {
        self.bytes += frame.source_traffic_bytes(self.source).unwrap_or_default();
        let own = times.iter().filter(|time| time.name.starts_with(&self.passes));
        self.milliseconds += own.filter_map(|time| time.milliseconds).sum::<f64>();
    }

    fn gb_per_s(&self) -> Option<f64> {
        (self.milliseconds > 0.0).then(|| self.bytes as f64 / self.milliseconds / 1e6)
    }
}

/// How many texels composition clamped.
///
/// # Errors
///
/// The device was lost.
fn clipped_texels(gpu: &Gpu, frame: &Frame) -> Result<u64, ModeError> {
    let mut encoder = gpu.encoder("clipped");
    let readback = Readback::record_buffer(gpu, &mut encoder, &frame.field.clipped, frame.field.clipped.size());
    gpu.queue.submit([encoder.finish()]);
    readback.start();
    let counts: Vec<u32> = bytemuck::pod_collect_to_vec(&wait_for(gpu, &readback)?);
    Ok(counts.into_iter().map(u64::from).sum())
}

/// The report for people.
fn table(report: &Report) -> String {
    let mut text = String::new();
    let mut line = |arguments: std::fmt::Arguments<'_>| {
        // Writing to a String cannot fail.
        let _ = text.write_fmt(arguments);
        text.push('\n');
    };
    let [field_width, field_height] = report.field_size;
    let [width, height] = report.image_size;
    line(format_args!("{} ({}, {})", report.adapter.name, report.adapter.backend, report.adapter.driver));
    line(format_args!(
        "{}, {}, shadow {}: field {field_width}×{field_height}, picture {width}×{height}, {}\n",
        report.scene,
        report.technique,
        report.shadow,
        counted(u64::from(report.frames), "frame")
    ));
    line(format_args!("{:<22}{:>10}{:>10}{:>10}", "milliseconds a frame", "median", "95 %", "least"));
    let mut row = |name: &str, spread: Option<Spread>| match spread {
        Some(spread) => {
            line(format_args!("{name:<22}{:>10.3}{:>10.3}{:>10.3}", spread.median, spread.p95, spread.min));
        }
        None => line(format_args!("{name:<22}{:>10}{:>10}{:>10}", "–", "–", "–")),
    };
    for pass in &report.passes {
        row(&pass.name, pass.gpu_ms);
    }
    row("all passes, GPU", report.frame.gpu_ms);
    row("submission to done", Some(report.frame.wall_ms));
    let steps = report.steps_per_pixel;
    line(format_args!(
        "\nsteps a pixel          {:.1} mean, {:.0} at 99 %, {:.0} at most, {} gave up",
        steps.mean,
        steps.p99,
        steps.max,
        counted(steps.capped as u64, "ray")
    ));
    line(format_args!("bytes a frame          {:.1} MB by design, {:.2} GB/s", report.bytes_per_frame / 1e6, report.gb_per_s));
    line(format_args!("field                  {:.2} bytes a texel", report.field_bytes_per_texel));
    line(format_args!("GPU memory             {:.1} MB", report.gpu_memory_bytes as f64 / 1e6));
    line(format_args!("clipped texels         {}", report.clipped_texels));
    let a_second = |flow: Option<f64>| flow.map_or_else(|| "–".to_owned(), |flow| format!("{flow:.2}"));
    if let Some(bytes) = report.gas_step_bytes_per_cell {
        let flow = a_second(report.gas_gb_per_s);
        line(format_args!("gas step               {bytes} bytes a cell by design, {flow} GB/s"));
    }
    if let Some(bytes) = report.water_substep_bytes_per_texel {
        let flow = a_second(report.water_gb_per_s);
        line(format_args!("shallow-water substep  {bytes} bytes a texel by design, {flow} GB/s"));
        line(format_args!("fallen behind          {:.3} s", report.behind_seconds));
    }
    text
}
