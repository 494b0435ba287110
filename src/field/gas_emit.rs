//! Gas, emission: puffs of density, dye and velocity. Reads and writes 48 bytes a cell of the tiles that it touches.
//!
//! Shader: `shaders/field/gas_emit.wgsl`. Specification: [`crate::reference::gas_emit`].

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

use super::bins::{BinError, Bins, Disc, Ground, Member, Tile, tile_workgroups};
use super::gas::{Buffers, Role, TILE, tile_constants};
use super::gas_activity::{HEADER, STOPPED};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, List, ShaderError, UniformSlots};
use crate::reference::gas::Grid;
use crate::reference::gas_emit::Emission;

/// Bytes a cell of a touched tile by design.
pub const CELL_BYTES: u64 = 48;

/// What a particle or a hand emits into the gas at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Puff {
    /// Its middle, lattice coordinates of the field.
    pub centre: [f32; 2],
    /// Its radius, texels of the field.
    pub radius: f32,
    /// What it adds to density and dye, over its area: m².
    pub mass: [f32; 2],
    /// What it adds to the velocity at its middle, m/s.
    pub velocity: [f32; 2],
    /// How fast it turns beside that, 1/s, clockwise on the screen.
    pub spin: f32,
}

impl Puff {
    /// The largest radius, cells: the sum over its cells, on the CPU, is the price of each.
    pub const MAX_RADIUS: f64 = 128.0;

    /// The same in cells of a grid, each of which covers `coarsening` texels along an axis and is `cell_metres` wide. None where
    /// something of it is no number, or its middle lies beyond a wall.
    pub fn emission(&self, grid: &Grid, coarsening: u32, cell_metres: f64) -> Option<Emission> {
        let numbers = self.centre.iter().chain(&self.mass).chain(&self.velocity).chain([&self.radius, &self.spin]);
        if !numbers.into_iter().all(|number| number.is_finite()) {
            return None;
        }
        let centre = self.centre.map(|along| (f64::from(along) + 0.5) / f64::from(coarsening));
        if (0..2).any(|axis| !grid.periodic[axis] && !(0.0..=grid.size[axis] as f64).contains(&centre[axis])) {
            return None;
        }
        // It must not overlap its own image where the grid repeats, nor slip between the centres of cells.
        let fits = (0..2).filter(|&axis| grid.periodic[axis]).map(|axis| 0.5 * grid.size[axis] as f64);
        let radius = (f64::from(self.radius) / f64::from(coarsening)).clamp(1.0, Self::MAX_RADIUS);
        Some(Emission {
            centre,
            radius: fits.fold(radius, f64::min),
            mass: self.mass.map(|mass| f64::from(mass) / (cell_metres * cell_metres)),
            velocity: self.velocity.map(f64::from),
            spin: f64::from(self.spin) * cell_metres,
        })
    }
}

/// What the shader needs of a puff besides where it is.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct GasPuff {
    /// [`Emission::velocity`].
    pub velocity: [f32; 2],
    /// [`Emission::spin`].
    pub spin: f32,
    /// [`Emission::radius`].
    pub radius: f32,
    /// Density at its middle: its mass over the sum of the profile.
    pub density: f32,
    /// Dye at its middle.
    pub dye: f32,
}

impl GasPuff {
    fn new(grid: &Grid, emission: &Emission) -> Self {
        let sum = profile_sum(grid, emission);
        let [density, dye] = emission.mass.map(|mass| if sum > 0.0 { (mass / sum) as f32 } else { 0.0 });
        let velocity = emission.velocity.map(|velocity| velocity as f32);
        Self { velocity, spin: emission.spin as f32, radius: emission.radius as f32, density, dye }
    }
}

/// The sum of a puff's profile over the cells that it reaches.
fn profile_sum(grid: &Grid, emission: &Emission) -> f64 {
    let range = |axis: usize| {
        let [low, high] = [-1.0, 1.0].map(|sign| emission.centre[axis] + sign * emission.radius - 0.5);
        let (low, high) = (low.ceil() as i64, high.floor() as i64);
        if grid.periodic[axis] { low..=high } else { low.max(0)..=high.min(grid.size[axis] as i64 - 1) }
    };
    let squared = |axis: usize, at: i64| (at as f64 + 0.5 - emission.centre[axis]).powi(2);
    let of = |x: i64, y: i64| (1.0 - (squared(0, x) + squared(1, y)) / emission.radius.powi(2)).max(0.0).powi(2);
    range(1).map(|y| range(0).map(|x| of(x, y)).sum::<f64>()).sum()
}

/// Uniforms of one step's puffs.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct GasBatch {
    /// The first of its tiles.
    pub first: u32,
    /// The number of its tiles.
    pub count: u32,
}

/// Emits puffs.
pub struct GasEmit {
    kernel: Kernel,
    layout: BindingLayout,
}

/// The lists of a frame's puffs, and their bindings, one for each role.
pub struct GasEmitSet {
    bins: Bins,
    puffs: Vec<GasPuff>,
    batches: Vec<GasBatch>,
    tile_list: List<Tile>,
    member_list: List<Member>,
    puff_list: List<GasPuff>,
    batch_slots: UniformSlots<GasBatch>,
    groups: Vec<wgpu::BindGroup>,
}

impl GasEmitSet {
    /// Bytes of GPU memory of the lists.
    pub fn memory_bytes(&self) -> u64 {
        self.tile_list.memory_bytes() + self.member_list.memory_bytes() + self.puff_list.memory_bytes()
    }
}

impl GasEmit {
    /// Builds the pipeline.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        use Binding::{Read, ReadWrite, Uniform, UniformSlot};
        let bindings = [Uniform, ReadWrite, ReadWrite, ReadWrite, Read, Read, Read, UniformSlot];
        let layout = BindingLayout::new(gpu, "gas emit", wgpu::ShaderStages::COMPUTE, &bindings);
        let constants = [tile_constants()[0], ("GAS_STOPPED", f64::from(STOPPED)), ("GAS_HEADER", f64::from(HEADER))];
        let parts = ["common/gas", "field/gas_emit"];
        let kernel = Kernel::new(gpu, "gas emit", &parts, "gas_emit", &constants, &[None, Some(&layout)])?;
        Ok(Self { kernel, layout })
    }

    /// Binds the buffers. Room for a few puffs; more make it grow.
    pub fn bind(&self, gpu: &Gpu, buffers: &Buffers) -> GasEmitSet {
        let mut set = GasEmitSet {
            bins: Bins::default(),
            puffs: Vec::new(),
            batches: Vec::new(),
            tile_list: List::new(gpu, "gas emit tiles", 256),
            member_list: List::new(gpu, "gas emit members", 512),
            puff_list: List::new(gpu, "gas puffs", 64),
            batch_slots: UniformSlots::new(gpu, "gas batches", 16),
            groups: Vec::new(),
        };
        set.groups = self.groups(gpu, buffers, &set);
        set
    }

    fn groups(&self, gpu: &Gpu, buffers: &Buffers, set: &GasEmitSet) -> Vec<wgpu::BindGroup> {
        Role::ALL
            .iter()
            .map(|role| {
                let resources = [
                    buffers.params.buffer.as_entire_binding(),
                    buffers.velocity[role.start()].as_entire_binding(),
                    buffers.carried[role.start()].as_entire_binding(),
                    buffers.activity.as_entire_binding(),
                    set.tile_list.buffer.as_entire_binding(),
                    set.member_list.buffer.as_entire_binding(),
                    set.puff_list.buffer.as_entire_binding(),
                    set.batch_slots.binding(),
                ];
                self.layout.bind(gpu, &resources)
            })
            .collect()
    }

    /// Lists and uploads a frame's puffs, sorted by the step that they fall before; says for each batch which step that is.
    ///
    /// # Errors
    ///
    /// They are too many for this adapter's buffers.
    pub fn prepare(
        &self,
        gpu: &Gpu,
        buffers: &Buffers,
        set: &mut GasEmitSet,
        emissions: &[(u32, Emission)],
    ) -> Result<Vec<u32>, BinError> {
        let limit = List::<Member>::limit(gpu).min(List::<Tile>::limit(gpu));
        let grid = &buffers.grid;
        // Images are listed here, an axis at a time: the bins repeat both axes or none.
        let ground = Ground { size: grid.size.map(|side| side as u32), wrap: false, tile: [TILE; 2] };
        set.bins.clear();
        set.puffs.clear();
        set.batches.clear();
        let mut falls = Vec::new();
        for of_step in emissions.chunk_by(|(a, _), (b, _)| a == b) {
            let puffs = &mut set.puffs;
            let discs = of_step.iter().flat_map(|(_, emission)| {
                let puff = GasPuff::new(grid, emission);
                images(grid, emission).map(move |disc| (puff, disc)).collect::<Vec<_>>()
            });
            let discs = discs.map(|(puff, disc)| {
                puffs.push(puff);
                disc
            });
            let batch = set.bins.add(ground, discs, limit)?;
            if batch.tile_count > 0 {
                set.batches.push(GasBatch { first: batch.first_tile, count: batch.tile_count });
                falls.push(of_step[0].0);
            }
        }
        // Each image of a puff is listed, those that touch no tile too.
        BinError::check(set.puffs.len(), List::<GasPuff>::limit(gpu))?;
        let mut grown = [
            set.tile_list.reserve(gpu, set.bins.tiles.len()),
            set.member_list.reserve(gpu, set.bins.members.len()),
            set.puff_list.reserve(gpu, set.puffs.len()),
        ]
        .contains(&true);
        let batches = set.batches.len() as u32;
        if batches > set.batch_slots.capacity() {
            set.batch_slots = UniformSlots::new(gpu, "gas batches", batches.next_power_of_two());
            grown = true;
        }
        set.tile_list.write(gpu, &set.bins.tiles);
        set.member_list.write(gpu, &set.bins.members);
        set.puff_list.write(gpu, &set.puffs);
        set.batch_slots.write(gpu, &set.batches);
        if grown {
            set.groups = self.groups(gpu, buffers, set);
        }
        Ok(falls)
    }

    /// Records one batch, upon the state of this role.
    pub fn record(&self, pass: &mut wgpu::ComputePass<'_>, set: &GasEmitSet, batch: usize, role: Role) {
        let [x, y] = tile_workgroups(set.batches[batch].count);
        pass.set_pipeline(&self.kernel.pipeline);
        pass.set_bind_group(1, &set.groups[role.start()], &[set.batch_slots.offset(batch as u32)]);
        pass.dispatch_workgroups(x, y, 1);
    }
}

impl GasEmitSet {
    /// Cells of the tiles that the frame's puffs touch.
    pub fn touched_cells(&self) -> u64 {
        self.bins.tiles.len() as u64 * u64::from(TILE * TILE)
    }
}

/// A puff in each image of the grid that it meets, lattice coordinates.
fn images(grid: &Grid, emission: &Emission) -> impl Iterator<Item = Disc> {
    // Faces stand half a cell before the centres by which the bins count.
    let radius = emission.radius as f32 + 0.75;
    let (size, periodic) = (grid.size.map(|side| side as f64), grid.periodic);
    let centre = [0, 1].map(|axis| {
        let along = emission.centre[axis];
        (if periodic[axis] { along.rem_euclid(size[axis]) } else { along }) - 0.5
    });
    let along = move |axis: usize| if periodic[axis] { -1..=1 } else { 0..=0 };
    along(1).flat_map(move |y| along(0).map(move |x| [x, y])).map(move |image| {
        let at = [0, 1].map(|axis| (centre[axis] + f64::from(image[axis]) * size[axis]) as f32);
        Disc { centre: at, radius }
    })
}
