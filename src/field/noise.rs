//! Noise: procedural heights, each a closed form of place, seed and time.
//!
//! Reads nothing, writes every texel of [`NoiseHeights`]: 4 bytes a texel. An evaluation at 512² takes lavapipe 3 ms of a core's time for
//! columns, 11 for dunes, 12 for scales, 4 a wheel and 5 an octave (200 of them, user time). Time is reduced here, in f64, to phases and lattice cells, so that
//! the shader's f32 is as fine after a million seconds as at the start. Shaders: `shaders/field/noise.wgsl` and the patterns beside it.
//! Specification: [`crate::reference::noise`].

use std::f64::consts::TAU;

use bytemuck::{Pod, Zeroable, bytes_of, cast_slice};
use wgpu::{StorageTextureAccess, TextureFormat};

use super::bins::BinError;
use super::source::{Heights, Source, SourceInput};
use super::{Dirty, LAYER, roles};
use crate::gpu::kernel::workgroups;
use crate::gpu::{Binding, BindingLayout, Contract, Gpu, Kernel, Recorder, Role, ShaderError, Texture};
use crate::scene::{
    Addressing, ColumnShape, Columns, Dunes, FractalNoise, GEARS_MAX, Gears, Layer, LayerBlend, NoisePattern, OCTAVES_MAX,
    Scales, Scene,
};

/// Bytes a texel by design: a height out.
pub const TEXEL_BYTES: u64 = 4;

roles! {
    /// Procedural heights.
    NoiseHeights = "noise", R32Float, mips false, LAYER, "height of the pattern, 0 to 1", from "noise", to "compose";
}

/// The textures of a scene with noise.
pub const CONTRACT: &[(Contract, u32)] = &[(NoiseHeights::CONTRACT, 1)];

/// What is the same for every pattern.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct NoiseParams {
    /// Size of the field, texels.
    pub size: [u32; 2],
    /// Side of a texel, metres.
    pub texel_metres: f32,
    /// How many octaves or wheels there are.
    pub count: u32,
    /// The seed.
    pub salt: u32,
    /// 1 where the field wraps, 0 where it clamps.
    pub wrap: u32,
    /// Extent of the field, metres.
    pub field_metres: [f32; 2],
}

/// A lattice of gradient noise over the field, and the slice of time.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct NoiseLattice {
    /// Cells a texel.
    pub scale: [f32; 2],
    /// Where in its cell the field's upper left corner lies.
    pub fraction: [f32; 2],
    /// Which cell that is.
    pub cell: [i32; 2],
    /// Cells after which the lattice repeats; 0: never.
    pub period: [i32; 2],
    /// Hashes of the slices of time before and after.
    pub slices: [u32; 2],
    /// From the first of them, in distances from slice to slice.
    pub slice_fraction: f32,
    /// What the octave is multiplied by.
    pub weight: f32,
    /// Its seed.
    pub salt: u32,
    /// Zero.
    pub pad: u32,
}

/// Of [`FractalNoise`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct NoiseFractal {
    /// What the sum is multiplied by.
    pub contrast: f32,
    /// A [`crate::scene::Fold`].
    pub fold: u32,
}

/// Of [`Columns`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct NoiseColumns {
    /// From axis to axis and from row to row, metres.
    pub pitch: [f32; 2],
    /// Where the axis of column 0 of row 0 stands, metres.
    pub origin: [f32; 2],
    /// Columns and rows of the field, where it wraps; else 0.
    pub period: [i32; 2],
    /// Phase from column to column and from row to row, turns.
    pub turns: [f32; 2],
    /// Phase of the time, turns.
    pub phase: f32,
    /// Share of chance in the phase.
    pub disorder: f32,
    /// The lowest top.
    pub low: f32,
    /// The highest.
    pub high: f32,
    /// Height in the gaps.
    pub ground: f32,
    /// Half the width of a gap, metres.
    pub half_gap: f32,
    /// Width of the rounded edges, metres.
    pub edge: f32,
    /// 1: six sides, 0: four.
    pub hexagons: u32,
}

/// Of [`Scales`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct NoiseScales {
    /// From scale to scale and from row to row, metres.
    pub pitch: [f32; 2],
    /// Centre of scale 0 of row 0, metres.
    pub origin: [f32; 2],
    /// Scales of a row and rows of the field, where it wraps; else 0.
    pub period: [i32; 2],
    /// Phase from scale to scale and from row to row, turns.
    pub turns: [f32; 2],
    /// Phase of the time, turns.
    pub phase: f32,
    /// Share of chance in the phase.
    pub disorder: f32,
    /// Radius of a scale, metres.
    pub radius: f32,
    /// Width of the rounded edges, metres.
    pub edge: f32,
    /// How much of their height they lose.
    pub lift: f32,
    /// How much their ridge stands out.
    pub keel: f32,
}

/// Of [`Gears`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct NoiseGears {
    /// Half of the pitch circle's diameter for each tooth, metres.
    pub half_module: f32,
    /// Width of the rounded edges, metres.
    pub edge: f32,
    /// Height of the teeth.
    pub top: f32,
}

/// One wheel at one time.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct NoiseGear {
    /// Its centre, metres.
    pub centre: [f32; 2],
    /// Cosine and sine of the angle that it has turned by.
    pub rotation: [f32; 2],
    /// How many teeth it has.
    pub teeth: f32,
    /// How many spokes.
    pub spokes: f32,
}

/// Of [`Dunes`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct NoiseDunes {
    /// Phase a texel, turns.
    pub turns: [f32; 2],
    /// Phase at the field's upper left corner, turns.
    pub phase: f32,
    /// Share of a dune before its crest.
    pub crest: f32,
    /// How far crests wander, wavelengths.
    pub meander: f32,
    /// How much lower than the highest the lowest are.
    pub variety: f32,
    /// Phase of the ripples a texel, turns.
    pub ripple_turns: [f32; 2],
    /// Their phase at the field's upper left corner, turns.
    pub ripple_phase: f32,
    /// Their height, of the whole.
    pub ripple_height: f32,
}

/// The parts that define the patterns, each in the place of its [`Instant::kernel`].
pub const PATTERNS: [&str; 5] =
    ["field/noise_fractal", "field/noise_columns", "field/noise_scales", "field/noise_gears", "field/noise_dunes"];

/// A pattern at one time, as its shader reads it. Equal instants are equal heights.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant {
    /// Which of [`PATTERNS`].
    pub kernel: usize,
    /// What is the same for every pattern.
    pub params: NoiseParams,
    /// The pattern's own struct.
    pub pattern: Vec<u8>,
    /// Its octaves or wheels.
    pub rows: Vec<u8>,
}

/// The seed in 32 bits.
pub fn salt(seed: u64) -> u32 {
    hash(seed as u32 ^ hash((seed >> 32) as u32))
}

/// C. Wellons' lowbias32 (hash-prospector, 2018); the twin of the shader's `noise_hash`.
pub fn hash(x: u32) -> u32 {
    let h = (x ^ x >> 16).wrapping_mul(0x7feb_352d);
    let h = (h ^ h >> 15).wrapping_mul(0x846c_a68b);
    h ^ h >> 16
}

/// The field under a pattern.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Its size, texels.
    pub size: [u32; 2],
    /// Side of a texel, metres.
    pub texel_metres: f64,
    /// Whether the pattern repeats where the field does.
    pub addressing: Addressing,
    /// The seed, as [`salt`] has it.
    pub salt: u32,
}

impl Ground {
    /// The ground of a scene.
    pub fn of_scene(scene: &Scene) -> Self {
        Self {
            size: scene.field.size,
            texel_metres: scene.texel_metres(),
            addressing: scene.field.addressing,
            salt: salt(scene.seed),
        }
    }

    /// Extent of the field along u and v, metres.
    pub fn metres(&self) -> [f64; 2] {
        self.size.map(|texels| f64::from(texels) * self.texel_metres)
    }

    /// Whether the field repeats.
    pub fn wraps(&self) -> bool {
        self.addressing == Addressing::Wrap
    }

    /// How often something of this size fits each side: whole where the field wraps, four times a texel at most.
    fn cells_across(&self, metres: f64) -> [f64; 2] {
        [0, 1].map(|axis| {
            let cells = (self.metres()[axis] / metres).min(4.0 * f64::from(self.size[axis]));
            if self.wraps() { cells.round().max(1.0) } else { cells }
        })
    }

    /// A lattice of cells of this size that has travelled so far, at so many slices of time.
    fn lattice(&self, feature_metres: f64, travelled_metres: [f64; 2], slices: f64, weight: f64, which: u32) -> NoiseLattice {
        let cells = self.cells_across(feature_metres);
        let corner = [0, 1].map(|axis| {
            let corner = -travelled_metres[axis] * cells[axis] / self.metres()[axis];
            // The same cell of another period; else far cells are counted in 32 bits, as their hash is.
            if self.wraps() { corner.rem_euclid(cells[axis]) } else { corner }
        });
        let salt = hash(self.salt.wrapping_add(which));
        NoiseLattice {
            scale: [0, 1].map(|axis| (cells[axis] / f64::from(self.size[axis])) as f32),
            fraction: corner.map(|corner| (corner - corner.floor()) as f32),
            cell: corner.map(|corner| corner.floor() as i64 as i32),
            period: if self.wraps() { cells.map(|count| count as i32) } else { [0; 2] },
            slices: [0, 1].map(|after| hash((slices.floor() as i64 as u32).wrapping_add(after) ^ !salt)),
            slice_fraction: (slices - slices.floor()) as f32,
            weight: weight as f32,
            salt,
            pad: 0,
        }
    }

    /// Things in rows: their pitch and, where the field wraps, how many there are along u and v.
    fn rows(&self, pitch_metres: f32, row: f64, staggered: bool) -> ([f64; 2], [i32; 2]) {
        let metres = self.metres();
        let pitch = f64::from(pitch_metres).max(self.texel_metres / 4.0);
        if !self.wraps() {
            return ([pitch, row * pitch], [0; 2]);
        }
        // Where odd rows stand aside, there must be as many of them as of the others.
        let rows = if staggered { 2.0 } else { 1.0 };
        let fit = [(metres[0] / pitch).round().max(1.0), (metres[1] / (rows * row * pitch)).round().max(1.0) * rows];
        ([0, 1].map(|axis| metres[axis] / fit[axis]), fit.map(|count| count as i32))
    }

    /// Turns from thing to thing of so many waves across the field.
    fn turns(&self, waves: [i32; 2], pitch: [f64; 2]) -> [f32; 2] {
        [0, 1].map(|axis| (f64::from(waves[axis]) * pitch[axis] / self.metres()[axis]) as f32)
    }

    fn origin(&self) -> [f32; 2] {
        self.metres().map(|side| (0.5 * side) as f32)
    }

    /// Waves across the wind, a texel: whole ones of the field where it wraps, one at the least.
    fn waves(&self, wavelength_metres: f32, wind: [f64; 2]) -> [f64; 2] {
        let wavelength = f64::from(wavelength_metres).max(self.texel_metres / 4.0);
        if !self.wraps() {
            return wind.map(|share| share * self.texel_metres / wavelength);
        }
        let across = [0, 1].map(|axis| self.metres()[axis] * wind[axis] / wavelength);
        let mut whole = across.map(f64::round);
        if whole == [0.0; 2] {
            let axis = usize::from(across[1].abs() > across[0].abs());
            whole[axis] = 1_f64.copysign(across[axis]);
        }
        [0, 1].map(|axis| whole[axis] / f64::from(self.size[axis]))
    }

    /// The width of an edge: a thousandth of a texel at least, so that there is one.
    fn edge(&self, metres: f32) -> f32 {
        f64::from(metres).max(1e-3 * self.texel_metres) as f32
    }
}

/// What is left of a phase without its whole turns.
fn fraction(turns: f64) -> f32 {
    (turns - turns.floor()) as f32
}

impl Instant {
    /// A pattern at a time.
    pub fn new(pattern: &NoisePattern, ground: &Ground, time_seconds: f64) -> Self {
        let (kernel, pattern, rows, row_bytes) = match pattern {
            NoisePattern::Fractal(fractal) => {
                let (own, lattices) = fractal_at(fractal, ground, time_seconds);
                (0, bytes_of(&own).to_vec(), cast_slice(&lattices).to_vec(), size_of::<NoiseLattice>())
            }
            NoisePattern::Columns(columns) => (1, bytes_of(&columns_at(columns, ground, time_seconds)).to_vec(), Vec::new(), 1),
            NoisePattern::Scales(scales) => (2, bytes_of(&scales_at(scales, ground, time_seconds)).to_vec(), Vec::new(), 1),
            NoisePattern::Gears(gears) => {
                let (own, train) = gears_at(gears, ground, time_seconds);
                (3, bytes_of(&own).to_vec(), cast_slice(&train).to_vec(), size_of::<NoiseGear>())
            }
            NoisePattern::Dunes(dunes) => {
                let (own, lattices) = dunes_at(dunes, ground, time_seconds);
                (4, bytes_of(&own).to_vec(), cast_slice(&lattices).to_vec(), size_of::<NoiseLattice>())
            }
        };
        let params = NoiseParams {
            size: ground.size,
            texel_metres: ground.texel_metres as f32,
            count: (rows.len() / row_bytes) as u32,
            salt: ground.salt,
            wrap: u32::from(ground.wraps()),
            field_metres: ground.metres().map(|side| side as f32),
        };
        Self { kernel, params, pattern, rows }
    }
}

fn fractal_at(fractal: &FractalNoise, ground: &Ground, time_seconds: f64) -> (NoiseFractal, Vec<NoiseLattice>) {
    let travelled = fractal.drift_metres_per_second.map(|speed| f64::from(speed) * time_seconds);
    let (lacunarity, gain) = (f64::from(fractal.lacunarity), f64::from(fractal.gain));
    let weights: f64 = (0..fractal.octaves).map(|octave| gain.powi(octave as i32)).sum();
    let lattices = (0..fractal.octaves.min(OCTAVES_MAX)).map(|octave| {
        let fineness = lacunarity.powi(octave as i32);
        let slices = time_seconds * f64::from(fractal.evolution_per_second) * fineness.powf(2.0 / 3.0);
        let weight = gain.powi(octave as i32) / weights;
        ground.lattice(f64::from(fractal.feature_metres) / fineness, travelled, slices, weight, octave)
    });
    (NoiseFractal { contrast: fractal.contrast, fold: fractal.fold as u32 }, lattices.collect())
}

fn columns_at(columns: &Columns, ground: &Ground, time_seconds: f64) -> NoiseColumns {
    let hexagons = columns.shape == ColumnShape::Hexagons;
    let (pitch, period) = ground.rows(columns.pitch_metres, if hexagons { 0.75_f64.sqrt() } else { 1.0 }, hexagons);
    NoiseColumns {
        pitch: pitch.map(|metres| metres as f32),
        origin: ground.origin(),
        period,
        turns: ground.turns(columns.waves, pitch),
        phase: fraction(time_seconds / f64::from(columns.period_seconds)),
        disorder: columns.disorder,
        low: columns.low,
        high: columns.high,
        ground: columns.ground,
        half_gap: 0.5 * columns.gap_metres,
        edge: ground.edge(columns.edge_metres),
        hexagons: u32::from(hexagons),
    }
}

/// Radius of a scale, pitches: it lies over half of the next row and reaches the one after.
const SCALE_RADIUS: f64 = 0.62;

fn scales_at(scales: &Scales, ground: &Ground, time_seconds: f64) -> NoiseScales {
    let (pitch, period) = ground.rows(scales.pitch_metres, 0.5, true);
    NoiseScales {
        pitch: pitch.map(|metres| metres as f32),
        origin: ground.origin(),
        period,
        turns: ground.turns(scales.waves, pitch),
        phase: fraction(time_seconds / f64::from(scales.period_seconds)),
        disorder: scales.disorder,
        radius: (SCALE_RADIUS * pitch[0].min(2.0 * pitch[1])) as f32,
        edge: ground.edge(scales.edge_metres),
        lift: scales.lift,
        keel: scales.keel,
    }
}

/// Angles are kept in turns, of which the whole ones are dropped before f32 sees them.
fn gears_at(gears: &Gears, ground: &Ground, time_seconds: f64) -> (NoiseGears, Vec<NoiseGear>) {
    let module = f64::from(gears.module_metres);
    let metres = ground.metres();
    let mut centre = [0, 1].map(|axis| f64::from(gears.centre[axis]) * metres[axis]);
    let mut turned = f64::from(gears.turns_per_second) * time_seconds;
    let mut train: Vec<NoiseGear> = Vec::with_capacity(GEARS_MAX);
    let mut driver_teeth = None;
    for gear in gears.train.iter().take(GEARS_MAX) {
        let teeth = f64::from(gear.teeth);
        if let Some(driver_teeth) = driver_teeth {
            let toward = f64::from(gear.toward_degrees) / 360.0;
            let apart = 0.5 * module * (driver_teeth + teeth);
            let (sin, cos) = (TAU * toward).sin_cos();
            centre = [centre[0] + apart * cos, centre[1] + apart * sin];
            // Where a tooth of the driver points to this wheel, a gap of this one points back.
            turned = toward + 0.5 - (0.5 - (toward - turned) * driver_teeth) / teeth;
        }
        let (sin, cos) = (TAU * (turned - turned.floor())).sin_cos();
        train.push(NoiseGear {
            centre: centre.map(|metres| metres as f32),
            rotation: [cos as f32, sin as f32],
            teeth: teeth as f32,
            spokes: gear.spokes as f32,
        });
        driver_teeth = Some(teeth);
    }
    let own = NoiseGears { half_module: (0.5 * module) as f32, edge: ground.edge(gears.edge_metres), top: gears.top };
    (own, train)
}

fn dunes_at(dunes: &Dunes, ground: &Ground, time_seconds: f64) -> (NoiseDunes, [NoiseLattice; 4]) {
    let (sin, cos) = f64::from(dunes.wind_degrees).to_radians().sin_cos();
    let wind = [cos, sin];
    let travelled = |speed: f32| wind.map(|share| share * f64::from(speed) * time_seconds);
    let (dune, ripple) = (travelled(dunes.speed_metres_per_second), travelled(dunes.ripple_speed_metres_per_second));
    let phase = |waves: [f64; 2], travelled: [f64; 2]| {
        let texels = travelled.map(|metres| metres / ground.texel_metres);
        fraction(-(waves[0] * texels[0] + waves[1] * texels[1]))
    };
    let waves = ground.waves(dunes.wavelength_metres, wind);
    let ripple_waves = ground.waves(dunes.ripple_metres, wind);
    let narrow = |waves: [f64; 2]| waves.map(|turns| turns as f32);
    let own = NoiseDunes {
        turns: narrow(waves),
        phase: phase(waves, dune),
        crest: dunes.crest,
        meander: dunes.meander,
        variety: dunes.variety,
        ripple_turns: narrow(ripple_waves),
        ripple_phase: phase(ripple_waves, ripple),
        ripple_height: dunes.ripple_height,
    };
    let wavelength = f64::from(dunes.wavelength_metres);
    let lattices = [
        ground.lattice(2.2 * wavelength, dune, 0.0, 1.0, 0),
        ground.lattice(0.8 * wavelength, dune, 0.0, 1.0, 1),
        ground.lattice(1.6 * wavelength, dune, 0.0, 1.0, 2),
        ground.lattice(7.0 * f64::from(dunes.ripple_metres), ripple, 0.0, 1.0, 3),
    ];
    (own, lattices)
}

/// Evaluates patterns.
pub struct Patterns {
    kernels: [Kernel; PATTERNS.len()],
    layout: BindingLayout,
}

/// The heights of one field, and what they show.
pub struct NoiseSet {
    /// The heights.
    pub heights: Texture<NoiseHeights>,
    params: wgpu::Buffer,
    pattern: wgpu::Buffer,
    rows: wgpu::Buffer,
    group: wgpu::BindGroup,
    shown: Option<Instant>,
}

impl NoiseSet {
    /// Forgets what it shows: the next record writes every texel.
    pub fn forget(&mut self) {
        self.shown = None;
    }
}

impl Patterns {
    /// A row of texels in a cache line or two.
    pub const WORKGROUP: [u32; 2] = [16, 8];

    /// Builds the pipelines.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        let storage = Binding::Storage(TextureFormat::R32Float, StorageTextureAccess::WriteOnly);
        let bindings = [Binding::Uniform, storage, Binding::Uniform, Binding::Read];
        let layout = BindingLayout::new(gpu, "noise", wgpu::ShaderStages::COMPUTE, &bindings);
        let constants = [("NOISE_X", f64::from(Self::WORKGROUP[0])), ("NOISE_Y", f64::from(Self::WORKGROUP[1]))];
        let kernel = |part: &str| Kernel::new(gpu, "noise", &["field/noise", part], "noise", &constants, &[None, Some(&layout)]);
        let [a, b, c, d, e] = PATTERNS.map(kernel);
        Ok(Self { kernels: [a?, b?, c?, d?, e?], layout })
    }

    /// Makes the heights of a field of this size.
    pub fn bind(&self, gpu: &Gpu, size: [u32; 2]) -> NoiseSet {
        let heights = Texture::<NoiseHeights>::new(gpu, size);
        let buffer = |label, bytes: usize| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes as u64,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let params = buffer("noise params", size_of::<NoiseParams>());
        // Room for the largest.
        let pattern = buffer("noise pattern", size_of::<NoiseColumns>());
        let rows = buffer("noise rows", OCTAVES_MAX as usize * size_of::<NoiseLattice>());
        let group = self.layout.bind(
            gpu,
            &[
                params.as_entire_binding(),
                wgpu::BindingResource::TextureView(&heights.view),
                pattern.as_entire_binding(),
                rows.as_entire_binding(),
            ],
        );
        NoiseSet { heights, params, pattern, rows, group, shown: None }
    }

    /// Evaluates the pattern at this instant, unless that is what the heights show; says whether it did.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &mut NoiseSet, instant: Instant) -> bool {
        if set.shown.as_ref() == Some(&instant) {
            return false;
        }
        let queue = &recorder.gpu.queue;
        queue.write_buffer(&set.params, 0, bytes_of(&instant.params));
        queue.write_buffer(&set.pattern, 0, &instant.pattern);
        queue.write_buffer(&set.rows, 0, &instant.rows);
        let [x, y] = workgroups(instant.params.size, Self::WORKGROUP);
        recorder.compute("noise", |pass| {
            pass.set_pipeline(&self.kernels[instant.kernel].pipeline);
            pass.set_bind_group(1, &set.group, &[]);
            pass.dispatch_workgroups(x, y, 1);
        });
        set.shown = Some(instant);
        true
    }
}

/// The procedural heights of a scene, as a layer of its stack.
pub struct NoiseSource {
    patterns: Patterns,
    set: NoiseSet,
    /// Whether the last frame evaluated them.
    evaluated: bool,
}

impl NoiseSource {
    /// Heights over a field of this size.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Result<Self, ShaderError> {
        let patterns = Patterns::new(gpu)?;
        let set = patterns.bind(gpu, size);
        Ok(Self { patterns, set, evaluated: false })
    }
}

impl Source for NoiseSource {
    fn name(&self) -> &'static str {
        "noise"
    }

    fn layer(&self, scene: &Scene) -> Layer {
        let (blend, amplitude) = scene.noise.as_ref().map_or((LayerBlend::Add, 0.0), |noise| (noise.blend, noise.amplitude));
        Layer { blend, amplitude }
    }

    fn reset(&mut self, _gpu: &Gpu, _scene: &Scene) {
        self.set.forget();
    }

    fn reload(&mut self, gpu: &Gpu) -> Result<(), ShaderError> {
        self.patterns = Patterns::new(gpu)?;
        self.set.forget();
        Ok(())
    }

    fn advance(&mut self, recorder: &mut Recorder<'_>, input: &SourceInput<'_>) -> Result<Dirty, BinError> {
        self.evaluated = input.scene.noise.as_ref().is_some_and(|noise| {
            let instant = Instant::new(&noise.pattern, &Ground::of_scene(input.scene), input.tick.time_seconds);
            self.patterns.record(recorder, &mut self.set, instant)
        });
        Ok(if self.evaluated { Dirty::All } else { Dirty::Nothing })
    }

    fn contract(&self) -> &'static [(Contract, u32)] {
        CONTRACT
    }

    fn heights(&self) -> Heights<'_> {
        Heights { views: [&self.set.heights.view; 2], current: 0 }
    }

    fn restore(&mut self, _numbers: &[u64]) {
        self.set.forget();
    }

    fn traffic_bytes(&self) -> u64 {
        if self.evaluated { TEXEL_BYTES * self.set.heights.size().map(u64::from).iter().product::<u64>() } else { 0 }
    }

    fn memory_bytes(&self) -> u64 {
        self.set.heights.memory_bytes()
    }
}
