//! Shallow water: the nonlinear equations with momentum, over a bed that anything may shape.
//!
//! A substep moves 36 bytes a texel: depth, foam and flow in and out, and the bed. Each of the clock's steps goes in as many equal
//! substeps as are stable; the GPU decides how many, by the fastest wave of the last, and dispatches that nobody needs are empty.
//! Where the cap is reached the rest of the step is given up and counted. A substep that brings forth a number which is none is
//! dropped, and the water stands still from then on, at its last good state.
//!
//! The state lies in buffers, because storage textures that are read and written hold one channel only. A bed that is NaN, infinite or
//! beyond [`BED_MAX`] is a wall. Shaders: `shaders/field/shallow_water.wgsl` and those that begin with its name. Specification:
//! [`crate::reference::shallow_water`].

mod event;
mod source;

pub use event::{Event, events_in_step};
pub use source::ShallowWaterSource;

use bytemuck::{Pod, Zeroable};

use super::{LAYER, roles};
use crate::gpu::kernel::workgroups;
use crate::gpu::{
    Binding, BindingLayout, Contract, Gpu, Kernel, List, Recorder, Role, ShaderError, Texture, Uniform, UniformSlots,
};
use crate::scene::{self, Border};

/// Bytes a texel of one substep by design: depth, foam and flow in and out, and the bed.
pub const TEXEL_BYTES: u64 = 36;

/// Bytes a texel of what a frame makes of the state: state and bed in, surface and cover out.
pub const PUBLISHED_BYTES: u64 = 32;

/// Heights beyond which, up or down, a bed is a wall.
pub const BED_MAX: f32 = 1e4;

roles! {
    /// What the water flows over.
    WaterBed = "water bed", R32Float, mips false, LAYER, "height, unclamped", from "compose", to "shallow water";
    /// Its depth and its foam. In buffers.
    WaterDepth = "water depth", Rg32Float, mips false, LAYER, "depth in metres, share of foam", from "shallow water", to "shallow water";
    /// Its flow. In buffers.
    WaterFlow = "water flow", Rg32Float, mips false, LAYER, "depth times velocity, m²/s", from "shallow water", to "shallow water";
    /// Its surface.
    WaterSurface = "water surface", R32Float, mips false, LAYER, "height, unclamped", from "shallow water", to "compose";
}

/// What it adds to a field, each as often as there are of it.
pub const CONTRACT: &[(Contract, u32)] =
    &[(WaterBed::CONTRACT, 1), (WaterDepth::CONTRACT, 2), (WaterFlow::CONTRACT, 2), (WaterSurface::CONTRACT, 1)];

/// Uniforms of the water.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ShallowWaterParams {
    /// Size of the field, texels.
    pub size: [u32; 2],
    /// Side of a texel, metres.
    pub texel_metres: f32,
    /// Depth of height 0 below the reference surface, metres.
    pub depth_metres: f32,
    /// West, east, north, south: numbers of [`Border`].
    pub borders: [u32; 4],
    /// Gravity, m/s².
    pub gravity: f32,
    /// Gravity times the square of Manning's n.
    pub friction: f32,
    /// Depth under which a velocity is no quotient any more, metres.
    pub dry_metres: f32,
    /// What no component of a velocity exceeds, m/s.
    pub speed_cap: f32,
    /// Share of a texel that the fastest wave may cross in a substep.
    pub courant: f32,
    /// Rain, m/s.
    pub rain: f32,
    /// Seepage, m/s.
    pub seepage: f32,
    /// Level of the sea beyond its borders, metres.
    pub sea_metres: f32,
    /// Foam that breaking makes, 1/s.
    pub foam_gain: f32,
    /// What foam loses, 1/s.
    pub foam_loss: f32,
    /// To a multiple of sixteen bytes.
    pub pad: [f32; 2],
}

impl ShallowWaterParams {
    /// The uniforms of a scene's water on a field of this size.
    pub fn new(water: &scene::ShallowWater, size: [u32; 2], texel_metres: f64, depth_metres: f64) -> Self {
        let gravity = f64::from(water.gravity_metres_per_second_squared);
        // Water that falls from the top of the relief to its bottom has √2 of this, a front on dry ground 2; waves that break into one
        // another reach 3. Beyond is nothing but rounding in films.
        let falling = (gravity * depth_metres).sqrt();
        Self {
            size,
            texel_metres: texel_metres as f32,
            depth_metres: depth_metres as f32,
            borders: water.borders.map(|border| border as u32),
            gravity: gravity as f32,
            friction: (gravity * f64::from(water.manning).powi(2)) as f32,
            // A thousandth of a texel: a film that bends no light.
            dry_metres: (1e-3 * texel_metres) as f32,
            speed_cap: (6.0 * falling) as f32,
            courant: water.courant,
            rain: water.rain_metres_per_second,
            seepage: water.seepage_metres_per_second,
            sea_metres: (f64::from(water.sea_level) * depth_metres) as f32,
            foam_gain: water.foam_per_second,
            foam_loss: 1.0 / water.foam_seconds,
            pad: [0.0; 2],
        }
    }
}

/// What the kernels tell one another, and the CPU later.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ShallowWaterControl {
    /// Bits of the fastest wave's speed, m/s.
    pub speed: u32,
    /// Not 0 once a number came out that is none.
    pub fault: u32,
    /// What remains of the step, seconds.
    pub remaining: f32,
    /// The substep, seconds.
    pub dt: f32,
    /// Time given up so far, seconds.
    pub behind: f32,
    /// Rise of the sea by its swell, metres.
    pub rise: f32,
    /// Substeps done so far.
    pub substeps: u32,
    /// Which of the two states is the present one.
    pub current: u32,
    /// Whether a substep was begun whose result is not judged yet.
    pub pending: u32,
    /// Whether it stopped for good.
    pub halted: u32,
}

/// One step that the clock owes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ShallowWaterSpell {
    /// How long it is, seconds.
    pub seconds: f32,
    /// Amplitude of the swell beyond a sea border, metres.
    pub swell_metres: f32,
    /// Its phase at the step's start, radians.
    pub swell_phase: f32,
    /// How fast that grows, radians a second.
    pub swell_rate: f32,
}

impl ShallowWaterSpell {
    /// Step number `step` of a scene's water.
    pub fn new(water: &scene::ShallowWater, step: u64) -> Self {
        let (swell_metres, swell_rate) = water
            .swell
            .as_ref()
            .map_or((0.0, 0.0), |swell| (swell.amplitude_metres, std::f64::consts::TAU / f64::from(swell.period_seconds)));
        let seconds = f64::from(water.step_seconds);
        let phase = (step as f64 * seconds * swell_rate).rem_euclid(std::f64::consts::TAU);
        Self { seconds: water.step_seconds, swell_metres, swell_phase: phase as f32, swell_rate: swell_rate as f32 }
    }
}

/// Which of the list's events fall in one step.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct ShallowWaterBatch {
    /// The first.
    pub first: u32,
    /// How many.
    pub count: u32,
}

/// Water that stands in a part of the plane.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ShallowWaterBody {
    /// Smallest u and v.
    pub low: [f32; 2],
    /// Largest u and v.
    pub high: [f32; 2],
    /// Height of its surface.
    pub level: f32,
    /// To a multiple of eight bytes.
    pub pad: f32,
}

impl ShallowWaterBody {
    /// A scene's body of water.
    pub fn new(body: &scene::Body) -> Self {
        Self { low: body.low, high: body.high, level: body.level, pad: 0.0 }
    }

    /// None.
    pub const NOTHING: Self = Self { low: [1.0; 2], high: [0.0; 2], level: 0.0, pad: 0.0 };
}

/// Moves water.
pub struct ShallowWater {
    kernels: Kernels,
    layouts: Layouts,
}

struct Kernels {
    fill: Kernel,
    disturb: Kernel,
    begin: Kernel,
    plan: Kernel,
    step: Kernel,
    settle: Kernel,
    publish: Kernel,
}

struct Layouts {
    fill: BindingLayout,
    disturb: BindingLayout,
    plan: BindingLayout,
    step: BindingLayout,
    publish: BindingLayout,
}

/// The water of one field.
pub struct ShallowWaterSet {
    /// Its textures and buffers.
    pub held: Held,
    substep_cap: u32,
    groups: Groups,
    /// Whether it must be filled before it moves.
    to_fill: bool,
}

/// The textures and buffers of one field's water.
pub struct Held {
    /// What it flows over.
    pub bed: Texture<WaterBed>,
    /// Its surface.
    pub surface: Texture<WaterSurface>,
    /// Depth and foam, two states.
    pub depths: [wgpu::Buffer; 2],
    /// Flow, two states.
    pub flows: [wgpu::Buffer; 2],
    /// What the kernels tell one another: a [`ShallowWaterControl`].
    pub control: wgpu::Buffer,
    size: [u32; 2],
    grids: wgpu::Buffer,
    params: Uniform<ShallowWaterParams>,
    spells: UniformSlots<ShallowWaterSpell>,
    batches: UniformSlots<ShallowWaterBatch>,
    events: List<Event>,
    bodies: List<ShallowWaterBody>,
    cover: wgpu::TextureView,
}

struct Groups {
    fill: wgpu::BindGroup,
    disturb: wgpu::BindGroup,
    plan: wgpu::BindGroup,
    /// From either state to the other.
    steps: [wgpu::BindGroup; 2],
    publish: wgpu::BindGroup,
}

impl Held {
    fn new(gpu: &Gpu, cover: &wgpu::TextureView, params: &ShallowWaterParams, bodies: usize) -> Self {
        let buffer = |label, size, usage| {
            let usage = usage | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
            gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let none = wgpu::BufferUsages::empty();
        let state = |label| [(); 2].map(|()| buffer(label, state_bytes(params.size), none));
        Self {
            bed: Texture::new(gpu, params.size),
            surface: Texture::new(gpu, params.size),
            depths: state("water depth"),
            flows: state("water flow"),
            control: buffer("water control", size_of::<ShallowWaterControl>() as u64, none),
            size: params.size,
            // Two grids of three numbers, each aligned to four.
            grids: buffer("water grids", 32, wgpu::BufferUsages::INDIRECT),
            params: Uniform::new(gpu, "water"),
            spells: UniformSlots::new(gpu, "water spells", 16),
            batches: UniformSlots::new(gpu, "water batches", 16),
            events: List::new(gpu, "water events", 64),
            bodies: List::new(gpu, "water bodies", bodies.max(1)),
            cover: cover.clone(),
        }
    }

    /// Bytes of GPU memory.
    pub fn memory_bytes(&self) -> u64 {
        let buffers = self.depths.iter().chain(&self.flows).map(wgpu::Buffer::size).sum::<u64>();
        let lists = self.events.memory_bytes() + self.bodies.memory_bytes();
        self.bed.memory_bytes() + self.surface.memory_bytes() + buffers + lists
    }
}

/// Bytes of each of the four buffers of state.
pub fn state_bytes(size: [u32; 2]) -> u64 {
    8 * u64::from(size[0]) * u64::from(size[1])
}

impl ShallowWaterSet {
    /// Puts it back to its start: it is filled before it moves again.
    pub fn reset(&mut self, gpu: &Gpu) {
        gpu.queue.write_buffer(&self.held.control, 0, bytemuck::bytes_of(&ShallowWaterControl::default()));
        self.to_fill = true;
    }

    /// Takes over a scene's settings: the water goes on as it is.
    pub fn set_params(&mut self, gpu: &Gpu, params: &ShallowWaterParams, substep_cap: u32) {
        self.held.params.write(gpu, params);
        self.substep_cap = substep_cap;
    }

    /// Keeps what it holds, instead of filling it.
    pub fn keep(&mut self) {
        self.to_fill = false;
    }

    /// Whether it is still to be filled.
    pub fn is_to_fill(&self) -> bool {
        self.to_fill
    }
}

impl ShallowWater {
    /// Side of the workgroup of the kernels that take a texel an invocation.
    const TILE: u32 = 8;

    /// Invocations of a workgroup that takes a substep: lines of a tile with its halo, and texels of it along the first direction. The
    /// square of it in cells fills the 16 KiB of a workgroup.
    pub const SPAN: u32 = 32;

    /// Texels that a tile sees beyond its own.
    const HALO: u32 = 3;

    /// Invocations that share what falls.
    const LANES: u32 = 256;

    /// Builds the pipelines.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        let layouts = Layouts::new(gpu);
        let shared = [
            ("SHALLOW_WATER_TILE", Self::TILE),
            ("SHALLOW_WATER_SPAN", Self::SPAN),
            ("SHALLOW_WATER_HALO", Self::HALO),
            ("SHALLOW_WATER_WALL", Border::Wall as u32),
            ("SHALLOW_WATER_OPEN", Border::Open as u32),
            ("SHALLOW_WATER_SEA", Border::Sea as u32),
            ("SHALLOW_WATER_PERIODIC", Border::Periodic as u32),
        ];
        let kernel = |stems: &[&str], entry_point, own: &[(&'static str, u32)], layout| {
            let constants: Vec<_> = shared.iter().chain(own).map(|(name, value)| (*name, f64::from(*value))).collect();
            let parts = [&["common/shallow_water"], stems].concat();
            Kernel::new(gpu, "shallow water", &parts, entry_point, &constants, &[None, Some(layout)])
        };
        let cells = [("SHALLOW_WATER_CELLS", Self::SPAN * Self::SPAN)];
        let lanes = [("SHALLOW_WATER_LANES", Self::LANES)];
        let plan = |entry_point| kernel(&["field/shallow_water_plan"], entry_point, &[], &layouts.plan);
        let disturb = &["field/shallow_water_disturb"];
        let step = &["field/shallow_water_flux", "field/shallow_water"];
        let kernels = Kernels {
            fill: kernel(disturb, "shallow_water_fill", &lanes, &layouts.fill)?,
            disturb: kernel(disturb, "shallow_water_disturb", &lanes, &layouts.disturb)?,
            begin: plan("shallow_water_begin")?,
            plan: plan("shallow_water_plan")?,
            step: kernel(step, "shallow_water_step", &cells, &layouts.step)?,
            settle: plan("shallow_water_settle")?,
            publish: kernel(&["field/shallow_water_publish"], "shallow_water_publish", &[], &layouts.publish)?,
        };
        Ok(Self { kernels, layouts })
    }

    /// Makes the water of a field of this size, which covers the field in `cover`; it is filled with these bodies before it moves.
    pub fn bind(
        &self,
        gpu: &Gpu,
        cover: &wgpu::TextureView,
        params: &ShallowWaterParams,
        substep_cap: u32,
        bodies: &[ShallowWaterBody],
    ) -> ShallowWaterSet {
        let held = Held::new(gpu, cover, params, bodies.len());
        held.bodies.write(gpu, if bodies.is_empty() { &[ShallowWaterBody::NOTHING] } else { bodies });
        held.params.write(gpu, params);
        let groups = self.layouts.groups(gpu, &held);
        ShallowWaterSet { held, substep_cap, groups, to_fill: true }
    }

    /// Advances by the steps that are owed, each with the events that fall before it (sorted by step), and says whether anything can
    /// have changed: where the bed did, its surface does. While no step is owed, those of step 0 fall all the same.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        set: &mut ShallowWaterSet,
        spells: &[ShallowWaterSpell],
        events: &[(u32, Event)],
        bed_changed: bool,
    ) -> bool {
        let fills = std::mem::take(&mut set.to_fill);
        if !fills && !bed_changed && spells.is_empty() && events.is_empty() {
            return false;
        }
        let batches = self.upload(recorder.gpu, set, spells, events);
        let ShallowWaterSet { held, groups, substep_cap, .. } = set;
        let [x, y] = workgroups(held.size, [Self::TILE; 2]);
        let kernels = &self.kernels;
        recorder.compute("shallow water", |pass| {
            if fills {
                pass.set_pipeline(&kernels.fill.pipeline);
                pass.set_bind_group(1, &groups.fill, &[]);
                pass.dispatch_workgroups(x, y, 1);
            }
            for step in 0..spells.len().max(1) as u32 {
                for (slot, _) in (0..).zip(&batches).filter(|(_, (falls_before, _))| *falls_before == step) {
                    pass.set_pipeline(&kernels.disturb.pipeline);
                    pass.set_bind_group(1, &groups.disturb, &[held.batches.offset(slot)]);
                    pass.dispatch_workgroups(1, 1, 1);
                }
                if step >= spells.len() as u32 {
                    break;
                }
                let spell = [held.spells.offset(step)];
                let alone = |pass: &mut wgpu::ComputePass<'_>, kernel: &Kernel| {
                    pass.set_pipeline(&kernel.pipeline);
                    pass.set_bind_group(1, &groups.plan, &spell);
                    pass.dispatch_workgroups(1, 1, 1);
                };
                alone(pass, &kernels.begin);
                for _ in 0..*substep_cap {
                    alone(pass, &kernels.plan);
                    // Which of the two states is the present one, the GPU alone knows: the other's grid is empty.
                    pass.set_pipeline(&kernels.step.pipeline);
                    for (group, grid) in groups.steps.iter().zip([0, 16]) {
                        pass.set_bind_group(1, group, &[]);
                        pass.dispatch_workgroups_indirect(&held.grids, grid);
                    }
                }
                alone(pass, &kernels.settle);
            }
            pass.set_pipeline(&kernels.publish.pipeline);
            pass.set_bind_group(1, &groups.publish, &[]);
            pass.dispatch_workgroups(x, y, 1);
        });
        true
    }

    /// Writes what a frame's dispatches read; the answer is the step before which each batch of events falls, and its events.
    fn upload(
        &self,
        gpu: &Gpu,
        set: &mut ShallowWaterSet,
        spells: &[ShallowWaterSpell],
        events: &[(u32, Event)],
    ) -> Vec<(u32, ShallowWaterBatch)> {
        let held = &mut set.held;
        let list: Vec<_> = events.iter().map(|(_, event)| *event).collect();
        let mut batches = Vec::new();
        let mut first = 0;
        for of_step in events.chunk_by(|(a, _), (b, _)| a == b) {
            batches.push((of_step[0].0, ShallowWaterBatch { first, count: of_step.len() as u32 }));
            first += of_step.len() as u32;
        }
        let mut grown = held.events.reserve(gpu, list.len());
        if spells.len() as u32 > held.spells.capacity() {
            held.spells = UniformSlots::new(gpu, "water spells", (spells.len() as u32).next_power_of_two());
            grown = true;
        }
        if batches.len() as u32 > held.batches.capacity() {
            held.batches = UniformSlots::new(gpu, "water batches", (batches.len() as u32).next_power_of_two());
            grown = true;
        }
        held.events.write(gpu, &list);
        held.spells.write(gpu, spells);
        held.batches.write(gpu, &batches.iter().map(|(_, batch)| *batch).collect::<Vec<_>>());
        if grown {
            set.groups = self.layouts.groups(gpu, held);
        }
        batches
    }
}

impl Layouts {
    fn new(gpu: &Gpu) -> Self {
        let layout = |label, bindings: &[Binding]| BindingLayout::new(gpu, label, wgpu::ShaderStages::COMPUTE, bindings);
        let (bed, read, write) = (Binding::Float(false), Binding::Read, Binding::ReadWrite);
        let stored = |format| Binding::Storage(format, wgpu::StorageTextureAccess::WriteOnly);
        let (surface, cover) = (stored(wgpu::TextureFormat::R32Float), stored(wgpu::TextureFormat::Rgba16Float));
        Self {
            fill: layout("water fill", &[Binding::Uniform, write, bed, write, write, read]),
            disturb: layout(
                "water disturb",
                &[Binding::Uniform, write, bed, write, write, write, write, read, Binding::UniformSlot],
            ),
            plan: layout("water plan", &[Binding::Uniform, write, write, Binding::UniformSlot]),
            step: layout("water step", &[Binding::Uniform, write, bed, read, read, write, write]),
            publish: layout("water publish", &[Binding::Uniform, write, bed, read, read, read, read, surface, cover]),
        }
    }

    fn groups(&self, gpu: &Gpu, held: &Held) -> Groups {
        let whole = wgpu::Buffer::as_entire_binding;
        let (params, control) = (whole(&held.params.buffer), whole(&held.control));
        let bed = wgpu::BindingResource::TextureView(&held.bed.view);
        let states: Vec<_> = held.depths.iter().zip(&held.flows).flat_map(|(depth, flow)| [whole(depth), whole(flow)]).collect();
        let [depth_0, flow_0, depth_1, flow_1] = [0, 1, 2, 3].map(|index: usize| states[index].clone());
        let step = |from: usize| {
            let [from, to] = [2 * from, 2 - 2 * from].map(|state| [states[state].clone(), states[state + 1].clone()]);
            let ([depth, flow], [next_depth, next_flow]) = (from, to);
            self.step.bind(gpu, &[params.clone(), control.clone(), bed.clone(), depth, flow, next_depth, next_flow])
        };
        let start = [params.clone(), control.clone(), bed.clone(), depth_0.clone(), flow_0.clone()];
        let bind = |layout: &BindingLayout, rest: &[wgpu::BindingResource<'_>]| layout.bind(gpu, &[&start[..], rest].concat());
        let surface = wgpu::BindingResource::TextureView(&held.surface.view);
        let cover = wgpu::BindingResource::TextureView(&held.cover);
        Groups {
            fill: bind(&self.fill, &[whole(&held.bodies.buffer)]),
            disturb: bind(&self.disturb, &[depth_1.clone(), flow_1.clone(), whole(&held.events.buffer), held.batches.binding()]),
            plan: self.plan.bind(gpu, &[params.clone(), control.clone(), whole(&held.grids), held.spells.binding()]),
            steps: [step(0), step(1)],
            publish: bind(&self.publish, &[depth_1, flow_1, surface, cover]),
        }
    }
}
