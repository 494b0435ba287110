//! Wave: the damped wave equation on the field's texels, with obstacles, four kinds of border, and impulses.
//!
//! A step reads 9 bytes a texel and writes 4. Two heights, now and one step ago, change roles at every step.
//! Shader: `shaders/field/wave.wgsl`. Specification: [`crate::reference::wave`].

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

use super::bins::{BinError, Bins, Disc, Ground, Member, Tile, tile_workgroups};
use super::source::{Heights, Source, SourceInput, State};
use super::{Dirty, Field, LAYER, roles};
use crate::clock::Simulation;
use crate::gpu::kernel::workgroups;
use crate::gpu::{
    Binding, BindingLayout, Contract, Gpu, Kernel, List, Recorder, Role, ShaderError, Texture, Uniform, UniformSlots,
};
use crate::scene::{self, Boundary, Layer, Obstacle, Scene};

roles! {
    /// What a texel of the waves is free to do.
    WaveMask = "wave mask", R8Uint, mips false, wgpu::TextureUsages::TEXTURE_BINDING.union(wgpu::TextureUsages::COPY_DST), "bits of wave::Mask", from "upload", to "wave";
    /// The state of the waves at one step.
    WaveState = "wave", R32Float, mips false, LAYER, "displacement, amplitudes", from "wave", to "wave, compose";
}

/// The textures of waves, each as often as there are of it.
pub const CONTRACT: &[(Contract, u32)] = &[(WaveMask::CONTRACT, 1), (WaveState::CONTRACT, 2)];

/// Bytes a texel of one step by design: both states and the mask in, one state out.
pub const TEXEL_BYTES: u64 = 13;

/// The largest C² that is accepted. At ½ the checkerboard grows linearly; beyond it, exponentially.
pub const MAX_COURANT_SQUARED: f64 = 0.49;

/// Part of a wave's energy that crosses the sponge and comes back, were the sponge ideal: the exponent of its strength.
const SPONGE_RETURN: f64 = 1e-4;

/// The settings of a wave that cannot be simulated, and what to do about it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WaveError {
    /// The time step is too long for the texels.
    #[error(
        "the wave's courant number {courant} is unstable: its square, {squared:.4}, must be at most {MAX_COURANT_SQUARED}; \
         set courant to 0.7 or less"
    )]
    Unstable {
        /// The Courant number.
        courant: f32,
        /// Its square.
        squared: f64,
    },
    /// A setting is not a positive number.
    #[error("the wave's {name} is {value}; it must be a positive, finite number")]
    NotPositive {
        /// The setting's name in a scene.
        name: &'static str,
        /// Its value.
        value: f32,
    },
    /// The damping would turn the velocity round within a step.
    #[error(
        "the wave's damping_per_second is {rate}; with steps of {step_seconds:.3e} s it must be between 0 and {limit:.3e}, so that \
         a step takes no more than all the velocity"
    )]
    Damping {
        /// The damping, 1/s.
        rate: f32,
        /// The time step, seconds.
        step_seconds: f64,
        /// The largest damping for it, 1/s.
        limit: f64,
    },
    /// The sponge would cover the whole field.
    #[error("the wave's sponge of {sponge} texels does not fit a field of {width}×{height}; it must be 1 to {limit} texels wide")]
    Sponge {
        /// Width of the sponge, texels.
        sponge: u32,
        /// Width of the field, texels.
        width: u32,
        /// Height of the field, texels.
        height: u32,
        /// The widest sponge that fits.
        limit: u32,
    },
}

/// The wave's own time step: the Courant number over the speed, for texels of this size. Seconds.
pub fn step_seconds(wave: &scene::Wave, texel_metres: f64) -> f64 {
    f64::from(wave.courant) * texel_metres / f64::from(wave.speed_metres_per_second)
}

/// Whether a wave can be simulated on a field of this size.
///
/// # Errors
///
/// A setting is out of range; the error says which, by how much, and what would do.
pub fn check(wave: &scene::Wave, size: [u32; 2], texel_metres: f64) -> Result<(), WaveError> {
    let positive = |name, value: f32| {
        if value.is_finite() && value > 0.0 { Ok(()) } else { Err(WaveError::NotPositive { name, value }) }
    };
    positive("speed_metres_per_second", wave.speed_metres_per_second)?;
    positive("courant", wave.courant)?;
    let squared = f64::from(wave.courant).powi(2);
    if squared > MAX_COURANT_SQUARED {
        return Err(WaveError::Unstable { courant: wave.courant, squared });
    }
    let step_seconds = step_seconds(wave, texel_metres);
    let limit = 2.0 / step_seconds;
    if !(0.0..=limit).contains(&f64::from(wave.damping_per_second)) {
        return Err(WaveError::Damping { rate: wave.damping_per_second, step_seconds, limit });
    }
    let widest = size[0].min(size[1]) / 2;
    if wave.boundary == Boundary::Absorbing && !(1..=widest).contains(&wave.sponge_texels) {
        return Err(WaveError::Sponge { sponge: wave.sponge_texels, width: size[0], height: size[1], limit: widest });
    }
    Ok(())
}

/// What the sponge adds to the damping of a step at the very border, for a sponge of this width.
///
/// It grows with the square of the depth: a wave that crosses it twice meets 2·γ/3 times the steps that its width takes, and
/// keeps e^(−γ) of its energy in each.
pub fn sponge_damping(courant: f64, sponge_texels: u32) -> f64 {
    let steps_across = f64::from(sponge_texels.max(1)) / courant;
    -SPONGE_RETURN.ln() / (2.0 * steps_across / 3.0)
}

/// Whether an obstacle stands on a point of the plane: a box with rounded corners. Where the wave is periodic so is the obstacle.
pub fn stands_on(obstacle: &Obstacle, uv: [f64; 2], plane_metres: [f64; 2], periodic: bool) -> bool {
    // A negative extent, or one that is no number, is none.
    let half = obstacle.half_extent_metres.map(|half| f64::from(half).max(0.0));
    let corner = f64::from(obstacle.corner_metres).clamp(0.0, half[0].min(half[1]));
    let outside = [0, 1].map(|axis| {
        let apart = uv[axis] - f64::from(obstacle.centre[axis]);
        let apart = if periodic { apart - apart.round() } else { apart };
        (apart * plane_metres[axis]).abs() - (half[axis] - corner)
    });
    outside[0].max(0.0).hypot(outside[1].max(0.0)) + outside[0].max(outside[1]).min(0.0) <= corner
}

/// What each texel is free to do: the one place that knows borders and obstacles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    size: [u32; 2],
    periodic: bool,
    bits: Vec<u8>,
}

impl Mask {
    /// It exchanges with its western neighbour.
    pub const WEST: u8 = 1;
    /// It exchanges with its eastern neighbour.
    pub const EAST: u8 = 2;
    /// It exchanges with its northern neighbour (a lower row).
    pub const NORTH: u8 = 4;
    /// It exchanges with its southern neighbour.
    pub const SOUTH: u8 = 8;
    /// It moves. Others stay at 0: the texels of obstacles, with which nothing is exchanged, and a held border, with which all is.
    pub const FREE: u8 = 16;

    /// The mask of a field with this border, where `closed` texels are obstacles.
    ///
    /// A sponge ends in a held border: a reflecting one would keep for ever whatever mean level the sponge takes in.
    pub fn new(size: [u32; 2], boundary: Boundary, closed: impl Fn(u32, u32) -> bool) -> Self {
        let [width, height] = size;
        let periodic = boundary == Boundary::Periodic;
        let held = matches!(boundary, Boundary::Fixed | Boundary::Absorbing);
        let open: Vec<bool> = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| !closed(x, y)).collect();
        let is_open = |x: i64, y: i64| {
            let [x, y] = if periodic {
                [x.rem_euclid(i64::from(width)), y.rem_euclid(i64::from(height))]
            } else if x < 0 || y < 0 || x >= i64::from(width) || y >= i64::from(height) {
                return false;
            } else {
                [x, y]
            };
            open[y as usize * width as usize + x as usize]
        };
        let bits = (0..i64::from(height))
            .flat_map(|y| (0..i64::from(width)).map(move |x| (x, y)))
            .map(|(x, y)| {
                if !is_open(x, y) {
                    return 0;
                }
                let border = x == 0 || y == 0 || x == i64::from(width) - 1 || y == i64::from(height) - 1;
                let bit = |is: bool, bit: u8| if is { bit } else { 0 };
                bit(is_open(x - 1, y), Self::WEST)
                    | bit(is_open(x + 1, y), Self::EAST)
                    | bit(is_open(x, y - 1), Self::NORTH)
                    | bit(is_open(x, y + 1), Self::SOUTH)
                    | bit(!(held && border), Self::FREE)
            })
            .collect();
        Self { size, periodic, bits }
    }

    /// The mask of a scene's wave on a field of this size.
    pub fn of_scene(wave: &scene::Wave, size: [u32; 2], plane_metres: [f64; 2]) -> Self {
        let periodic = wave.boundary == Boundary::Periodic;
        Self::new(size, wave.boundary, |x, y| {
            let uv = [(f64::from(x) + 0.5) / f64::from(size[0]), (f64::from(y) + 0.5) / f64::from(size[1])];
            wave.obstacles.iter().any(|obstacle| stands_on(obstacle, uv, plane_metres, periodic))
        })
    }

    /// Its bytes, row by row.
    pub fn bytes(&self) -> &[u8] {
        &self.bits
    }

    /// Its size, texels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Whether the field repeats beyond its border.
    pub fn periodic(&self) -> bool {
        self.periodic
    }

    /// Whether the texel moves; false outside a field that does not repeat.
    pub fn is_free(&self, x: i64, y: i64) -> bool {
        let [width, height] = self.size.map(i64::from);
        let (x, y) = if self.periodic { (x.rem_euclid(width), y.rem_euclid(height)) } else { (x, y) };
        let inside = (0..width).contains(&x) && (0..height).contains(&y);
        inside && self.bits[(y * width + x) as usize] & Self::FREE != 0
    }
}

/// A dent in the water, and the ring that it pushes aside: its net is nothing.
///
/// With s the squared distance in radii it is strength·(1 − s)²·(1 − ring·s), smooth, and 0 from the radius on. On an infinitely
/// fine lattice, ring = 4 makes its net zero; on a real one, cut by obstacles, [`Impulse::ring`] says what does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Impulse {
    centre: [f32; 2],
    radius: f32,
    strength: f32,
}

impl Impulse {
    /// A smaller one would be all centre and no ring.
    pub const MIN_RADIUS: f32 = 2.0;

    /// The largest radius, texels: the sum over its texels, on the CPU, is the price of each.
    pub const MAX_RADIUS: f32 = 256.0;

    /// An impulse at a position in lattice coordinates, its radius in texels (brought into [`Impulse::MIN_RADIUS`] to
    /// [`Impulse::MAX_RADIUS`]), its strength what it adds at its centre, in the wave's own unit.
    pub fn new(centre: [f32; 2], radius: f32, strength: f32) -> Self {
        Self { centre, radius: radius.clamp(Self::MIN_RADIUS, Self::MAX_RADIUS), strength }
    }

    /// Its centre, lattice coordinates.
    pub fn centre(&self) -> [f32; 2] {
        self.centre
    }

    /// Its radius, texels.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// What it adds at its centre.
    pub fn strength(&self) -> f32 {
        self.strength
    }

    /// The disc outside which it changes nothing.
    pub const fn disc(&self) -> Disc {
        Disc { centre: self.centre, radius: self.radius }
    }

    /// The factor of the ring that makes the sum over the free texels zero; nothing where there is no free texel to take it, or where
    /// the impulse is no number.
    pub fn ring(&self, mask: &Mask) -> Option<f64> {
        if !(self.strength.is_finite() && self.radius.is_finite() && self.centre.iter().all(|value| value.is_finite())) {
            return None;
        }
        let radius = f64::from(self.radius);
        let centre = self.centre.map(f64::from);
        let range = |axis: usize| (centre[axis] - radius).ceil() as i64..=(centre[axis] + radius).floor() as i64;
        let (mut plain, mut weighted) = (0.0, 0.0);
        for y in range(1) {
            for x in range(0) {
                let s = ((x as f64 - centre[0]).powi(2) + (y as f64 - centre[1]).powi(2)) / (radius * radius);
                if s < 1.0 && mask.is_free(x, y) {
                    let w = (1.0 - s) * (1.0 - s);
                    plain += w;
                    weighted += w * s;
                }
            }
        }
        // A lone free texel at the very centre leaves 0; next to it, a few ulp, which would blow up the f32 of the shader.
        (weighted > 1e-6 * plain).then(|| plain / weighted)
    }
}

/// What the shader needs of an impulse besides its disc.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct WaveImpulse {
    /// [`Impulse::strength`].
    pub strength: f32,
    /// [`Impulse::ring`].
    pub ring: f32,
}

/// Uniforms of a step.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct WaveParams {
    /// Size of the field, texels.
    pub size: [u32; 2],
    /// (1 − γ/2) / (1 + γ/2).
    pub velocity_kept: f32,
    /// C² / (1 + γ/2).
    pub pull: f32,
    /// C².
    pub courant_squared: f32,
    /// γ, the damping of a step.
    pub damping: f32,
    /// What the sponge adds to γ at the border.
    pub sponge_damping: f32,
    /// Width of the sponge, texels; 0 where there is none.
    pub sponge_width: f32,
}

impl WaveParams {
    /// The uniforms of a scene's wave on a field of this size.
    pub fn new(wave: &scene::Wave, size: [u32; 2], texel_metres: f64) -> Self {
        let courant = f64::from(wave.courant);
        let half_damping = 0.5 * f64::from(wave.damping_per_second) * step_seconds(wave, texel_metres);
        let sponge = wave.boundary == Boundary::Absorbing;
        Self {
            size,
            velocity_kept: ((1.0 - half_damping) / (1.0 + half_damping)) as f32,
            pull: (courant * courant / (1.0 + half_damping)) as f32,
            courant_squared: (courant * courant) as f32,
            damping: (2.0 * half_damping) as f32,
            sponge_damping: if sponge { sponge_damping(courant, wave.sponge_texels) as f32 } else { 0.0 },
            sponge_width: if sponge { wave.sponge_texels as f32 } else { 0.0 },
        }
    }
}

/// Uniforms of one step's impulses.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct WaveBatch {
    /// The first of its tiles.
    pub first: u32,
    /// The number of its tiles.
    pub count: u32,
}

/// Steps waves and disturbs them.
pub struct Waves {
    step: Kernel,
    splash: Kernel,
    step_layout: BindingLayout,
    splash_layout: BindingLayout,
}

/// The bindings of one field, and the lists of a frame's impulses.
pub struct WaveSet {
    ground: Ground,
    mask: Mask,
    bins: Bins,
    impulses: Vec<WaveImpulse>,
    batches: Vec<WaveBatch>,
    buffers: Buffers,
    mask_texture: Texture<WaveMask>,
    /// The waves at this step and the last, in turn.
    pub states: [Texture<WaveState>; 2],
    /// One for each side of the ping-pong: the one whose state is current.
    step_groups: [wgpu::BindGroup; 2],
    splash_groups: [wgpu::BindGroup; 2],
    current: usize,
}

struct Buffers {
    params: Uniform<WaveParams>,
    tiles: List<Tile>,
    members: List<Member>,
    impulses: List<WaveImpulse>,
    batches: UniformSlots<WaveBatch>,
}

impl WaveSet {
    /// Which of [`WaveSet::states`] is the current one.
    pub fn current(&self) -> usize {
        self.current
    }

    /// Stills the water.
    pub fn reset(&mut self, gpu: &Gpu) {
        let [width, height] = self.ground.size;
        let still = vec![0.0_f32; width as usize * height as usize];
        self.states.iter().for_each(|state| state.write(gpu, &still));
    }

    /// Takes over a scene's wave, whose boundary and obstacles may be others: the water goes on as it is.
    pub fn set_scene(&mut self, gpu: &Gpu, wave: &scene::Wave, plane_metres: [f64; 2]) {
        let size = self.ground.size;
        self.mask = Mask::of_scene(wave, size, plane_metres);
        self.ground.wrap = self.mask.periodic();
        self.mask_texture.write(gpu, self.mask.bytes());
        self.buffers.params.write(gpu, &WaveParams::new(wave, size, plane_metres[0] / f64::from(size[0])));
    }
}

impl Waves {
    /// Workgroup of a step. 16×8 keeps a row of texels contiguous.
    pub const STEP: [u32; 2] = [16, 8];

    /// Side of a tile of impulses, texels: one workgroup.
    pub const TILE: u32 = 16;

    /// Builds the pipelines.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        let compute = wgpu::ShaderStages::COMPUTE;
        let state = Binding::Storage(wgpu::TextureFormat::R32Float, wgpu::StorageTextureAccess::ReadWrite);
        let step_layout =
            BindingLayout::new(gpu, "wave step", compute, &[Binding::Uniform, Binding::Uint, state, Binding::Float(false)]);
        let splash_layout = BindingLayout::new(
            gpu,
            "wave splash",
            compute,
            &[Binding::Uniform, Binding::Uint, state, state, Binding::Read, Binding::Read, Binding::Read, Binding::UniformSlot],
        );
        let constants = [
            ("WAVE_STEP_X", f64::from(Self::STEP[0])),
            ("WAVE_STEP_Y", f64::from(Self::STEP[1])),
            ("WAVE_TILE", f64::from(Self::TILE)),
            ("WAVE_WEST", f64::from(Mask::WEST)),
            ("WAVE_EAST", f64::from(Mask::EAST)),
            ("WAVE_NORTH", f64::from(Mask::NORTH)),
            ("WAVE_SOUTH", f64::from(Mask::SOUTH)),
            ("WAVE_FREE", f64::from(Mask::FREE)),
        ];
        let kernel =
            |entry_point, layout| Kernel::new(gpu, "wave", &["field/wave"], entry_point, &constants, &[None, Some(layout)]);
        let (step, splash) = (kernel("wave_step", &step_layout)?, kernel("wave_splash", &splash_layout)?);
        Ok(Self { step, splash, step_layout, splash_layout })
    }

    /// Makes still water for a scene's wave on a plane of this size, of so many texels.
    pub fn bind(&self, gpu: &Gpu, size: [u32; 2], wave: &scene::Wave, plane_metres: [f64; 2]) -> WaveSet {
        // Room for a few drops; a stress test makes more.
        let buffers = Buffers {
            params: Uniform::new(gpu, "wave"),
            tiles: List::new(gpu, "wave tiles", 256),
            members: List::new(gpu, "wave members", 256),
            impulses: List::new(gpu, "wave impulses", 64),
            batches: UniformSlots::new(gpu, "wave batches", 64),
        };
        let mask_texture = Texture::new(gpu, size);
        let states = [Texture::new(gpu, size), Texture::new(gpu, size)];
        let (step_groups, splash_groups) = self.groups(gpu, &mask_texture, &states, &buffers);
        let mut set = WaveSet {
            ground: Ground { size, wrap: false, tile: [Self::TILE; 2] },
            mask: Mask::new(size, wave.boundary, |_, _| false),
            bins: Bins::default(),
            impulses: Vec::new(),
            batches: Vec::new(),
            buffers,
            mask_texture,
            states,
            step_groups,
            splash_groups,
            current: 0,
        };
        set.set_scene(gpu, wave, plane_metres);
        set
    }

    fn groups(
        &self,
        gpu: &Gpu,
        mask: &Texture<WaveMask>,
        states: &[Texture<WaveState>; 2],
        buffers: &Buffers,
    ) -> ([wgpu::BindGroup; 2], [wgpu::BindGroup; 2]) {
        let texture = wgpu::BindingResource::TextureView;
        let step = |current: usize| {
            let resources = [
                buffers.params.buffer.as_entire_binding(),
                texture(&mask.view),
                texture(&states[1 - current].view),
                texture(&states[current].view),
            ];
            self.step_layout.bind(gpu, &resources)
        };
        let splash = |current: usize| {
            let resources = [
                buffers.params.buffer.as_entire_binding(),
                texture(&mask.view),
                texture(&states[1 - current].view),
                texture(&states[current].view),
                buffers.tiles.buffer.as_entire_binding(),
                buffers.members.buffer.as_entire_binding(),
                buffers.impulses.buffer.as_entire_binding(),
                buffers.batches.binding(),
            ];
            self.splash_layout.bind(gpu, &resources)
        };
        ([step(0), step(1)], [splash(0), splash(1)])
    }

    /// Advances by `steps`, with the impulses that fall before each (sorted by step), and says whether anything can have changed.
    /// While no step is owed, those of step 0 fall all the same: one can paint on water that stands still.
    ///
    /// # Errors
    ///
    /// The impulses touch more tiles than a buffer of the adapter holds; then nothing is recorded.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        set: &mut WaveSet,
        steps: u32,
        splashes: &[(u32, Impulse)],
    ) -> Result<bool, BinError> {
        let gpu = recorder.gpu;
        // Before which step each batch of impulses falls.
        let falls = set.list(gpu, splashes)?;
        if steps == 0 && falls.is_empty() {
            return Ok(false);
        }
        self.upload(gpu, set);
        recorder.compute("wave", |pass| {
            for step in 0..steps.max(1) {
                for (slot, _) in (0..).zip(&falls).filter(|(_, falls_before)| **falls_before == step) {
                    let batch = set.batches[slot as usize];
                    let [x, y] = tile_workgroups(batch.count);
                    pass.set_pipeline(&self.splash.pipeline);
                    pass.set_bind_group(1, &set.splash_groups[set.current], &[set.buffers.batches.offset(slot)]);
                    pass.dispatch_workgroups(x, y, 1);
                }
                if step < steps {
                    let [x, y] = workgroups(set.ground.size, Self::STEP);
                    pass.set_pipeline(&self.step.pipeline);
                    pass.set_bind_group(1, &set.step_groups[set.current], &[]);
                    pass.dispatch_workgroups(x, y, 1);
                    set.current = 1 - set.current;
                }
            }
        });
        Ok(true)
    }

    fn upload(&self, gpu: &Gpu, set: &mut WaveSet) {
        let buffers = &mut set.buffers;
        let mut grown = [
            buffers.tiles.reserve(gpu, set.bins.tiles.len()),
            buffers.members.reserve(gpu, set.bins.members.len()),
            buffers.impulses.reserve(gpu, set.impulses.len()),
        ]
        .contains(&true);
        let batches = set.batches.len() as u32;
        if batches > buffers.batches.capacity() {
            buffers.batches = UniformSlots::new(gpu, "wave batches", batches.next_power_of_two());
            grown = true;
        }
        buffers.tiles.write(gpu, &set.bins.tiles);
        buffers.members.write(gpu, &set.bins.members);
        buffers.impulses.write(gpu, &set.impulses);
        buffers.batches.write(gpu, &set.batches);
        if grown {
            (set.step_groups, set.splash_groups) = self.groups(gpu, &set.mask_texture, &set.states, &set.buffers);
        }
    }
}

impl WaveSet {
    /// Lists a frame's impulses, and answers with the step before which each batch of them falls.
    fn list(&mut self, gpu: &Gpu, splashes: &[(u32, Impulse)]) -> Result<Vec<u32>, BinError> {
        let limit = List::<Member>::limit(gpu).min(List::<Tile>::limit(gpu));
        self.bins.clear();
        self.impulses.clear();
        self.batches.clear();
        let mut falls = Vec::new();
        for of_step in splashes.chunk_by(|(a, _), (b, _)| a == b) {
            // An impulse with no free texel to push water to does nothing.
            let effective = of_step.iter().filter_map(|(_, impulse)| Some((impulse, impulse.ring(&self.mask)?)));
            let impulses = &mut self.impulses;
            let discs = effective.map(|(impulse, ring)| {
                impulses.push(WaveImpulse { strength: impulse.strength, ring: ring as f32 });
                impulse.disc()
            });
            let batch = self.bins.add(self.ground, discs, limit)?;
            if batch.tile_count > 0 {
                self.batches.push(WaveBatch { first: batch.first_tile, count: batch.tile_count });
                falls.push(of_step[0].0);
            }
        }
        Ok(falls)
    }
}

/// The waves of a scene, as a layer of its stack.
pub struct WaveSource {
    waves: Waves,
    set: WaveSet,
    /// Steps of the last frame.
    steps: u32,
}

impl WaveSource {
    /// Still water over a field.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu, field: &Field, scene: &Scene, wave: &scene::Wave) -> Result<Self, ShaderError> {
        let waves = Waves::new(gpu)?;
        let set = waves.bind(gpu, field.size, wave, scene.plane_size_metres());
        Ok(Self { waves, set, steps: 0 })
    }
}

impl Source for WaveSource {
    fn name(&self) -> &'static str {
        "wave"
    }

    fn layer(&self, scene: &Scene) -> Layer {
        scene.wave.as_ref().map_or(Layer { blend: scene::LayerBlend::Add, amplitude: 0.0 }, |wave| Layer {
            blend: wave.blend,
            amplitude: wave.amplitude,
        })
    }

    fn reset(&mut self, gpu: &Gpu, _scene: &Scene) {
        self.set.reset(gpu);
    }

    fn set_scene(&mut self, gpu: &Gpu, scene: &Scene) {
        if let Some(wave) = &scene.wave {
            self.set.set_scene(gpu, wave, scene.plane_size_metres());
        }
    }

    fn reload(&mut self, gpu: &Gpu) -> Result<(), ShaderError> {
        self.waves = Waves::new(gpu)?;
        Ok(())
    }

    fn advance(&mut self, recorder: &mut Recorder<'_>, input: &SourceInput<'_>) -> Result<Dirty, BinError> {
        self.steps = input.tick.owed(Simulation::Wave).steps;
        let moved = self.waves.record(recorder, &mut self.set, self.steps, &input.strokes.splashes)?;
        Ok(if moved { Dirty::All } else { Dirty::Nothing })
    }

    fn contract(&self) -> &'static [(Contract, u32)] {
        CONTRACT
    }

    fn heights(&self) -> Heights<'_> {
        Heights { views: [&self.set.states[0].view, &self.set.states[1].view], current: self.set.current }
    }

    fn state(&self) -> State<'_> {
        State {
            textures: self.set.states.iter().map(|state| &state.texture).collect(),
            buffers: Vec::new(),
            numbers: vec![self.set.current as u64],
        }
    }

    fn restore(&mut self, numbers: &[u64]) {
        self.set.current = usize::from(numbers.first() == Some(&1));
    }

    fn traffic_bytes(&self) -> u64 {
        u64::from(self.steps) * TEXEL_BYTES * self.set.ground.size.map(u64::from).iter().product::<u64>()
    }

    fn memory_bytes(&self) -> u64 {
        let Buffers { params: _, tiles, members, impulses, batches: _ } = &self.set.buffers;
        let lists = tiles.memory_bytes() + members.memory_bytes() + impulses.memory_bytes();
        self.set.mask_texture.memory_bytes() + self.set.states.iter().map(Texture::memory_bytes).sum::<u64>() + lists
    }
}
