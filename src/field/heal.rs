//! Heal: a surface that closes to its base within a stated time, and whose marks fade with it.
//!
//! In [`STEPS`] steps of equal length, counted by the clock: a departure d becomes q·d less a constant, so that it is 0 *to the bit*
//! after all of them, however deep it was. Deep prints close fast at first; none is left over. What the frames' lengths are does not
//! matter, since presses and steps are taken in the order of their times.
//!
//! Work follows what is dirty: a tile is healed for as many steps as there are after it was last pressed, and then rests. 12 bytes in
//! and 8 out a texel of those. Shader: `shaders/field/heal.wgsl`. Specification: [`crate::reference::heal`].

use super::bins::tile_workgroups;
use super::stamp::Stamps;
use super::{Dirty, Field, Region, material};
use crate::gpu::{Binding, BindingLayout, Contract, Gpu, Kernel, List, Recorder, Role, ShaderError, Texture, UniformSlots};

/// The heights that a surface heals to.
#[derive(Clone, Copy, Debug)]
pub enum Base {}

impl Role for Base {
    const CONTRACT: Contract = Contract {
        name: "base",
        format: wgpu::TextureFormat::R32Float,
        mips: false,
        share: 1.0,
        content: "height, 0 to 1",
        writer: "upload",
        readers: "heal",
        usage: wgpu::TextureUsages::TEXTURE_BINDING.union(wgpu::TextureUsages::COPY_DST),
    };
}

/// The textures of a surface that heals: 4 bytes a texel.
pub const CONTRACT: &[(Contract, u32)] = &[(Base::CONTRACT, 1)];

/// Steps from a press to its end.
pub const STEPS: u32 = 240;

/// What of a departure of 1 the products alone would leave after all steps; the constants take that.
const LEFT: f64 = 0.05;

/// Bytes a texel of a step by design: relief and material in and out, base in.
pub const TEXEL_BYTES: u64 = 20;

/// The factor and the constant of one step: q^n − c·(1 − qⁿ)/(1 − q) is 0 for n = [`STEPS`].
pub fn law() -> [f64; 2] {
    let kept = LEFT.powf(1.0 / f64::from(STEPS));
    // A little more, so that rounding leaves nothing over.
    [kept, 1.0001 * LEFT * (1.0 - kept) / (1.0 - LEFT)]
}

/// Levels by which a mark of so many levels falls in a step: all of them in [`STEPS`] steps, whole levels in each.
pub fn fades(levels: u32, step: u64) -> u32 {
    let until = |step: u64| step * u64::from(levels) / u64::from(STEPS);
    // At most `levels`.
    (until(step + 1) - until(step)) as u32
}

/// Uniforms of one step.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct HealParams {
    /// Size of the field, texels.
    pub size: [u32; 2],
    /// The first of the step's tiles in the list.
    pub first_tile: u32,
    /// How many they are.
    pub tile_count: u32,
    /// What of a departure is kept.
    pub kept: f32,
    /// What of it closes besides.
    pub closes: f32,
    /// Levels by which soot and bareness fall.
    pub soot: f32,
    /// Levels by which gloss falls.
    pub gloss: f32,
}

impl HealParams {
    /// Those of a step of this number, over tiles of a list.
    pub fn new(size: [u32; 2], step: u64, first_tile: u32, tile_count: u32) -> Self {
        let [kept, closes] = law().map(|number| number as f32);
        Self { size, first_tile, tile_count, kept, closes, soot: fades(255, step) as f32, gloss: fades(31, step) as f32 }
    }
}

/// Heals.
pub struct Heal {
    kernel: Kernel,
    layout: BindingLayout,
}

/// The bindings of one field, and which of its tiles are not yet healed.
pub struct HealSet {
    /// Seconds from a press to its end.
    pub seconds: f64,
    base: Texture<Base>,
    params: UniformSlots<HealParams>,
    tiles: List<u32>,
    layers: [wgpu::TextureView; 2],
    group: wgpu::BindGroup,
    size: [u32; 2],
    /// For each tile the number of the first step that need not heal it.
    due: Vec<u64>,
    /// Those that some step must still heal, in the order in which they were pressed.
    open: Vec<u32>,
    /// What a frame's steps heal, one step after another.
    plan: Vec<u32>,
    steps: Vec<HealParams>,
}

impl HealSet {
    /// Seconds of a step.
    pub fn step_seconds(&self) -> f64 {
        self.seconds / f64::from(STEPS)
    }

    /// The heights that it heals to.
    pub fn reset(&mut self, gpu: &Gpu, base: &[f32]) {
        self.base.write(gpu, base);
        self.due.fill(0);
        self.open.clear();
        self.begin();
    }

    /// Begins a frame.
    pub fn begin(&mut self) {
        self.plan.clear();
        self.steps.clear();
    }

    /// Opens tiles of [`Stamps::TILE`] that are pressed before the step of this number.
    pub fn open(&mut self, tiles: impl Iterator<Item = [u32; 2]>, step: u64) {
        let columns = self.size[0].div_ceil(Stamps::TILE[0]);
        for [x, y] in tiles {
            let index = y * columns + x;
            let due = &mut self.due[index as usize];
            if *due == 0 {
                self.open.push(index);
            }
            *due = (*due).max(step + u64::from(STEPS));
        }
    }

    /// Opens every tile that regions touch.
    pub fn open_regions(&mut self, regions: &[Region], step: u64) {
        let tile = Stamps::TILE;
        for region in regions {
            let [low, high] = [region.origin, [0, 1].map(|axis| region.origin[axis] + region.extent[axis] - 1)]
                .map(|corner| [0, 1].map(|axis| corner[axis] / tile[axis]));
            self.open((low[1]..=high[1]).flat_map(|y| (low[0]..=high[0]).map(move |x| [x, y])), step);
        }
    }

    /// Plans the step of this number, and says which texels it may change. What [`Heal::upload`] uploads, [`Heal::record`] records.
    pub fn plan(&mut self, step: u64) -> Dirty {
        let due = &mut self.due;
        self.open.retain(|index| {
            let due = &mut due[*index as usize];
            if *due <= step {
                *due = 0;
            }
            *due != 0
        });
        let tile = Stamps::TILE;
        let columns = self.size[0].div_ceil(tile[0]);
        let first = self.plan.len() as u32;
        let mut dirty = Dirty::Nothing;
        for index in &self.open {
            let [x, y] = [index % columns, index / columns];
            let origin = [x * tile[0], y * tile[1]];
            let extent = [0, 1].map(|axis| tile[axis].min(self.size[axis] - origin[axis]));
            dirty.add(Region { origin, extent }, self.size);
            self.plan.push(x | y << 16);
        }
        self.steps.push(HealParams::new(self.size, step, first, self.open.len() as u32));
        dirty
    }

    /// Texels that the frame's steps heal, a tile at the border counted whole.
    pub fn healed_texels(&self) -> u64 {
        self.plan.len() as u64 * Stamps::TILE.map(u64::from).iter().product::<u64>()
    }

    /// Whether any tile is still open.
    pub fn is_open(&self) -> bool {
        !self.open.is_empty()
    }

    /// Bytes of GPU memory of the base, and of the list of tiles.
    pub fn memory_bytes(&self) -> u64 {
        self.base.memory_bytes() + self.tiles.memory_bytes()
    }
}

impl Heal {
    /// Builds the pipeline.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        let in_place = wgpu::StorageTextureAccess::ReadWrite;
        let layout = BindingLayout::new(
            gpu,
            "heal",
            wgpu::ShaderStages::COMPUTE,
            &[
                Binding::UniformSlot,
                Binding::Storage(wgpu::TextureFormat::R32Float, in_place),
                Binding::Storage(wgpu::TextureFormat::R32Uint, in_place),
                Binding::Float(false),
                Binding::Read,
            ],
        );
        let tile = [("HEAL_TILE_X", f64::from(Stamps::TILE[0])), ("HEAL_TILE_Y", f64::from(Stamps::TILE[1]))];
        let constants = [&tile[..], &material::CONSTANTS].concat();
        let parts = ["common/material", "field/heal"];
        let kernel = Kernel::new(gpu, "heal", &parts, "heal", &constants, &[None, Some(&layout)])?;
        Ok(Self { kernel, layout })
    }

    /// Binds a field, which has to be told its base: [`HealSet::reset`].
    pub fn bind(&self, gpu: &Gpu, field: &Field, seconds: f64) -> HealSet {
        let params = UniformSlots::new(gpu, "heal", 8);
        let tiles = List::new(gpu, "open tiles", 256);
        let base = Texture::new(gpu, field.size);
        let layers = [field.relief.view.clone(), field.material.view.clone()];
        let group = self.group(gpu, &layers, &base, &params, &tiles);
        let count = [0, 1].map(|axis| field.size[axis].div_ceil(Stamps::TILE[axis])).iter().product::<u32>() as usize;
        HealSet {
            seconds,
            base,
            params,
            tiles,
            layers,
            group,
            size: field.size,
            due: vec![0; count],
            open: Vec::new(),
            plan: Vec::new(),
            steps: Vec::new(),
        }
    }

    fn group(
        &self,
        gpu: &Gpu,
        [relief, material]: &[wgpu::TextureView; 2],
        base: &Texture<Base>,
        params: &UniformSlots<HealParams>,
        tiles: &List<u32>,
    ) -> wgpu::BindGroup {
        self.layout.bind(
            gpu,
            &[
                params.binding(),
                wgpu::BindingResource::TextureView(relief),
                wgpu::BindingResource::TextureView(material),
                wgpu::BindingResource::TextureView(&base.view),
                tiles.buffer.as_entire_binding(),
            ],
        )
    }

    /// Uploads what the frame's steps need. One call serves one submission.
    pub fn upload(&self, gpu: &Gpu, set: &mut HealSet) {
        let more_steps = set.steps.len() > set.params.capacity() as usize;
        if more_steps {
            set.params = UniformSlots::new(gpu, "heal", (set.steps.len() as u32).next_power_of_two());
        }
        if set.tiles.reserve(gpu, set.plan.len()) || more_steps {
            set.group = self.group(gpu, &set.layers, &set.base, &set.params, &set.tiles);
        }
        set.params.write(gpu, &set.steps);
        set.tiles.write(gpu, &set.plan);
    }

    /// Records one of the steps that were planned, the `number`th.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &HealSet, number: usize) {
        let tile_count = set.steps[number].tile_count;
        if tile_count == 0 {
            return;
        }
        recorder.compute("heal", |pass| {
            pass.set_pipeline(&self.kernel.pipeline);
            pass.set_bind_group(1, &set.group, &[set.params.offset(number as u32)]);
            let [x, y] = tile_workgroups(tile_count);
            pass.dispatch_workgroups(x, y, 1);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_level_of_a_mark_fades_in_the_steps_that_there_are() {
        for levels in [255, 31] {
            for first in [0_u64, 7, 1000] {
                let sum: u32 = (first..first + u64::from(STEPS)).map(|step| fades(levels, step)).sum();
                assert_eq!(sum, levels);
            }
        }
    }

    #[test]
    fn a_whole_departure_is_gone_after_the_last_step_and_hardly_before() {
        let [kept, closes] = law();
        let mut departure = 1.0_f64;
        let mut after = Vec::new();
        for _ in 0..STEPS {
            departure = (kept * departure - closes).max(0.0);
            after.push(departure);
        }
        assert_eq!(departure, 0.0);
        assert!(after[STEPS as usize - 3] > 0.0, "it closes with the last steps");
    }
}
