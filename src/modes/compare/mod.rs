//! Compare: techniques and shadows against the truth, headless.
//!
//! One instant of one field is shown by each technique with each shadow from each camera. Rows differ in nothing else; their times are
//! taken in turn, frame by frame, so that a machine that is busy for a while slows all of them.

mod bench;
pub mod check;
mod curves;
mod equal_error;
mod flip;
mod heat;
mod metrics;
mod plot;
pub mod table;
mod truth;
mod variant;

use std::path::Path;

use bench::{Bench, Shown};
use check::Earlier;
use flip::Seen;
use metrics::{Point, Positions};
use table::{Errors, Key, Row, Table, Viewpoint};
use variant::Variant;

use super::headless::Headless;
use super::statistics::{Spread, Steps};
use super::{ModeError, progress};
use crate::camera::Camera;
use crate::cli::{CompareOptions, ResumeOptions, Truth, Verbosity};
use crate::frame;
use crate::gpu::Gpu;
use crate::io::atomic::{self, WriteError};
use crate::io::manifest::write_json;
use crate::io::output_dir::{OutputDir, Owner, TABLE_CSV, TABLE_JSON};
use crate::io::png_file;
use crate::scene::{self, Scene};
use crate::surface::{Shadow, Technique};

/// Runs the mode and returns the table as text.
///
/// # Errors
///
/// The table to check against, the scene, its image, the adapter, its limits or an output are unfit; or a figure got worse, and then
/// all files are written nevertheless.
pub fn run(options: &CompareOptions, verbosity: Verbosity) -> Result<String, ModeError> {
    let earlier = options.check.as_deref().map(Earlier::read).transpose()?;
    let Headless { gpu, start, frame, picture, player, .. } = Headless::open(&options.common, &ResumeOptions::default())?;
    if options.truth == Truth::Reference && !truth::knows(&start.scene) {
        return Err(ModeError::NoReference);
    }
    let plan = Plan::new(options, &start.scene);
    for size in &plan.field_sizes {
        frame::check_limits(&gpu, &bench::resized(&start.scene, *size), options.common.image_size)?;
    }
    let mut table = Table {
        version: table::VERSION,
        program: env!("CARGO_PKG_VERSION").to_owned(),
        adapter: (&gpu.adapter.get_info()).into(),
        scene: start.scene.clone(),
        image_size: options.common.image_size,
        warmup: options.warmup,
        frames: options.frames,
        truth: options.truth,
        cameras: plan.cameras.iter().map(|camera| viewpoint(camera, options.warmup)).collect(),
        rows: Vec::new(),
    };
    if let Some(earlier) = &earlier {
        earlier.fits(&table, &plan.keys())?;
    }
    for path in [&options.csv, &options.json].into_iter().flatten() {
        atomic::check(path)?;
    }
    let directory = options.out.as_deref().map(|out| OutputDir::create(out, Owner::Compare)).transpose()?;

    let total = plan.keys().len() as u64 * (1 + u64::from(options.frames));
    let progress = progress::bar(total, &table.scene.name, verbosity == Verbosity::Quiet);
    let mut own = Bench::after(&gpu, &start, frame, picture, player, options.warmup)?;
    let mut gallery = Gallery {
        directory: directory.as_ref(),
        size: options.common.image_size,
        gain: options.common.display.gain(),
        truths: 0,
    };
    for &size in &plan.field_sizes {
        let mut run = Run { gpu: &gpu, plan: &plan, frames: options.frames, progress: &progress };
        let first = table.rows.len();
        table.rows.extend(match options.sweep_fields.is_empty() {
            true => run.rows(&mut own, first, &mut gallery)?,
            false => run.rows(&mut own.resampled(&gpu, size)?, first, &mut gallery)?,
        });
    }
    progress.finish_and_clear();

    if let Some(path) = &options.csv {
        write_text(path, &table.csv())?;
    }
    if let Some(path) = &options.json {
        write_json(path, &table)?;
    }
    if let Some(directory) = directory {
        let curves = match (options.sweep_samples.is_empty(), options.sweep_fields.is_empty()) {
            (false, _) => curves::samples(&table),
            (_, false) => curves::fields(&table),
            _ => Vec::new(),
        };
        for (number, curve) in curves.iter().enumerate() {
            png_file::write(&directory.file(&format!("curve_{number:05}.png")), plot::SIZE, &plot::draw(&gpu, curve)?)?;
        }
        write_text(&directory.file(TABLE_CSV), &table.csv())?;
        write_json(&directory.file(TABLE_JSON), &table)?;
        directory.finish();
    }
    if let Some(earlier) = &earlier {
        earlier.holds(&table)?;
    }
    Ok(table.text())
}

/// All that is compared.
struct Plan {
    field_sizes: Vec<[u32; 2]>,
    cameras: Vec<scene::Camera>,
    variants: Vec<Variant>,
    truth: Truth,
    /// The one shadow of all true pictures; none: each row's own.
    truth_shadow: Option<Shadow>,
}

impl Plan {
    fn new(options: &CompareOptions, scene: &Scene) -> Self {
        let shadows = options.shadows(scene.trace.shadow);
        let of_width = |width: u32| {
            let [own_width, own_height] = scene.field.size.map(f64::from);
            // A float beyond u32 becomes the largest, which the adapter's limits refuse.
            [width, ((f64::from(width) * own_height / own_width).round() as u32).max(1)]
        };
        let field_sizes = match options.sweep_fields()[..] {
            [] => vec![scene.field.size],
            ref widths => widths.iter().map(|width| of_width(*width)).collect(),
        };
        let placed = |place: &crate::io::scene_file::CameraPlacement| scene::Camera {
            eye: place.eye,
            target: place.target,
            orbit_degrees_per_second: 0.0,
            swing: None,
            fly_metres_per_second: [0.0; 3],
            ..scene.camera.clone()
        };
        let cameras = match &options.view_from[..] {
            [] => vec![scene.camera.clone()],
            places => places.iter().map(placed).collect(),
        };
        // Among several shadows the one that makes no compromise is the truth; one alone only asks which technique shows it.
        let truth_shadow = options.truth_shadow.or((shadows.len() > 1).then_some(Shadow::Area));
        let variants = Variant::all(&options.techniques(), &shadows, &options.sweep_samples());
        Self { field_sizes, cameras, variants, truth: options.truth, truth_shadow }
    }

    fn key(&self, field_size: [u32; 2], camera: usize, variant: &Variant) -> Key {
        let Variant { technique, shadow, samples } = *variant;
        Key { camera: camera + 1, field_size, technique, samples, shadow, truth_shadow: self.truth_shadow.unwrap_or(shadow) }
    }

    /// Every row, in order.
    fn keys(&self) -> Vec<Key> {
        let cameras = || 0..self.cameras.len();
        let views = self.field_sizes.iter().flat_map(|size| cameras().map(|camera| (*size, camera)));
        views.flat_map(|(size, camera)| self.variants.iter().map(move |variant| self.key(size, camera, variant))).collect()
    }
}

/// Where a camera stands after so many frames.
fn viewpoint(camera: &scene::Camera, warmup: u32) -> Viewpoint {
    let eye = Camera::at(camera, f64::from(warmup) * bench::DT_SECONDS).eye().to_array();
    Viewpoint { eye, target: camera.target, vertical_fov_degrees: camera.vertical_fov_degrees }
}

/// What a picture is held against.
struct TruePicture {
    shadow: Shadow,
    shown: Shown,
    seen: Seen,
    file: Option<String>,
}

/// The rows of one field.
struct Run<'a> {
    gpu: &'a Gpu,
    plan: &'a Plan,
    frames: u32,
    progress: &'a indicatif::ProgressBar,
}

impl Run<'_> {
    /// Measures every row of a field; the first is number `first` of the table.
    fn rows(&mut self, bench: &mut Bench, first: usize, gallery: &mut Gallery<'_>) -> Result<Vec<Row>, ModeError> {
        let plan = self.plan;
        let cameras: Vec<Camera> = plan.cameras.iter().map(|camera| Camera::at(camera, bench.time_seconds())).collect();
        let mut rows = Vec::new();
        for (number, camera) in cameras.iter().enumerate() {
            let mut truths: Vec<TruePicture> = Vec::new();
            let mut points: Option<Vec<Option<Point>>> = None;
            for variant in &plan.variants {
                let key = plan.key(bench.scene().field.size, number, variant);
                let truth = match truths.iter().position(|truth| truth.shadow == key.truth_shadow) {
                    Some(known) => &truths[known],
                    None => {
                        let truth = Variant { technique: Technique::Exact, shadow: key.truth_shadow, samples: None };
                        let shown = bench.show(self.gpu, &truth, camera)?;
                        let seen = Seen::new(&shown.picture, gallery.size);
                        let file = gallery.hang_truth(&shown.picture)?;
                        truths.push(TruePicture { shadow: key.truth_shadow, shown, seen, file });
                        &truths[truths.len() - 1]
                    }
                };
                if points.is_none() {
                    points = Some(match plan.truth {
                        Truth::Exact => metrics::points(&truth.shown.pixels, key.field_size),
                        Truth::Reference => truth::reference(bench.scene(), bench.heights(self.gpu)?, camera, gallery.size),
                    });
                }
                let shown = bench.show(self.gpu, variant, camera)?;
                let positions =
                    metrics::positions(points.as_deref().unwrap_or_default(), &metrics::points(&shown.pixels, key.field_size));
                let differences = truth.seen.differences(&Seen::new(&shown.picture, gallery.size));
                let texel_metres = bench.scene().texel_metres();
                let mut files = gallery.hang_row(first + rows.len(), &shown.picture, &positions, texel_metres, &differences)?;
                files.extend(truth.file.clone());
                let flip = differences.iter().map(|difference| f64::from(*difference)).sum::<f64>() / differences.len() as f64;
                rows.push(row(key, &truth.shown, &shown, &positions, flip, texel_metres, bench.memory_bytes(), files));
                self.progress.inc(1);
            }
        }
        self.time(bench, &cameras, &mut rows)?;
        Ok(rows)
    }

    /// Times every row, in turn.
    fn time(&self, bench: &mut Bench, cameras: &[Camera], rows: &mut [Row]) -> Result<(), ModeError> {
        let views: Vec<(&Camera, &Variant)> =
            cameras.iter().flat_map(|camera| self.plan.variants.iter().map(move |variant| (camera, variant))).collect();
        let mut surface = vec![Vec::new(); views.len()];
        let mut frame = vec![Vec::new(); views.len()];
        // Every pipeline was compiled when the rows were shown; one round more fills the caches.
        for round in 0..=self.frames {
            for (number, (camera, variant)) in views.iter().enumerate() {
                let times = bench.time(self.gpu, variant, camera)?;
                if round > 0 {
                    surface[number].extend(times.surface);
                    frame[number].extend(times.frame);
                    self.progress.inc(1);
                }
            }
        }
        let median = |times: &[f64]| Spread::of(times).map(|spread| spread.median);
        for (number, row) in rows.iter_mut().enumerate() {
            row.surface_ms = median(&surface[number]);
            row.frame_ms = median(&frame[number]);
        }
        Ok(())
    }
}

/// A row, but for its times.
#[expect(clippy::too_many_arguments, reason = "what a row is made of, once")]
fn row(
    key: Key,
    truth: &Shown,
    shown: &Shown,
    positions: &Positions,
    flip: f64,
    texel_metres: f64,
    memory_bytes: u64,
    files: Vec<String>,
) -> Row {
    let Key { camera, field_size, technique, samples, shadow, truth_shadow } = key;
    let errors = |unit: f64| Errors { rms: positions.rms / unit, p99: positions.p99 / unit, max: positions.max / unit };
    let steps = Steps::of(&shown.pixels);
    Row {
        camera,
        field_size,
        technique,
        samples,
        shadow,
        truth_shadow,
        pixels: positions.pixels,
        position_error_texels: errors(texel_metres),
        position_error_metres: errors(1.0),
        wrong_cell_share: positions.wrong_cell_share,
        visibility_rms: metrics::visibility_rms(&truth.pixels, &shown.pixels),
        flip,
        psnr_db: metrics::psnr_db(&truth.picture, &shown.picture),
        steps_per_pixel: steps,
        capped: steps.capped,
        surface_ms: None,
        frame_ms: None,
        memory_bytes,
        files,
    }
}

/// Where pictures go, if anywhere.
struct Gallery<'a> {
    directory: Option<&'a OutputDir>,
    size: [u32; 2],
    gain: f64,
    truths: usize,
}

impl Gallery<'_> {
    fn hang(&self, name: String, picture: &[u8]) -> Result<Option<String>, WriteError> {
        let Some(directory) = self.directory else { return Ok(None) };
        png_file::write(&directory.file(&name), self.size, picture)?;
        Ok(Some(name))
    }

    fn hang_truth(&mut self, picture: &[u8]) -> Result<Option<String>, WriteError> {
        self.truths += 1;
        self.hang(format!("truth_{:05}.png", self.truths - 1), picture)
    }

    /// The picture, where its hits are wrong, and where one sees it.
    fn hang_row(
        &self,
        number: usize,
        picture: &[u8],
        positions: &Positions,
        texel_metres: f64,
        differences: &[f32],
    ) -> Result<Vec<String>, WriteError> {
        if self.directory.is_none() {
            return Ok(Vec::new());
        }
        let errors = heat::of_deviations(&positions.deviations, texel_metres / self.gain);
        let files = [
            self.hang(format!("row_{number:05}.png"), picture)?,
            self.hang(format!("row_{number:05}_error.png"), &errors)?,
            self.hang(format!("row_{number:05}_flip.png"), &heat::of_shares(differences))?,
        ];
        Ok(files.into_iter().flatten().collect())
    }
}

fn write_text(path: &Path, text: &str) -> Result<(), WriteError> {
    atomic::write(path, |file| std::io::Write::write_all(file, text.as_bytes()))
}
