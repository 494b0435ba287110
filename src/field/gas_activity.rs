//! Gas, activity: which tiles there is work in. Still ones are skipped, as \[POM slides\] skip still flow by early z.
//!
//! Moves 20 bytes a tile, and 80 a cell of the tiles that come to rest.
//! Shader: `shaders/field/gas_activity.wgsl`. Specification: [`crate::reference::gas_activity`].

use super::gas::{Buffers, Role, TILE, tile_constants};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, ShaderError};

/// Words before what the activity holds of each tile.
pub const HEADER: u32 = 8;
/// Whether something that is no number was met.
pub const POISON: u32 = 0;
/// The step, from 1, that met it; 0: none did.
pub const STOPPED: u32 = 1;
/// Steps since the start.
pub const STEPS: u32 = 2;
/// Tiles that were active in the last of them.
pub const ACTIVE: u32 = 3;

/// Where the dispatch over the active tiles stands in the buffer of dispatches, bytes.
pub const ACTIVE_TILES: u64 = 0;
/// Where that over the settling tiles stands.
pub const SETTLING_TILES: u64 = 12;
/// Where that over what is shown stands.
pub const SHOWN_TILES: u64 = 24;

/// Where the dispatch over a coarser level stands; 0 is the second finest.
pub const fn level(index: usize) -> u64 {
    36 + 12 * index as u64
}

/// Workgroups in one dimension of a dispatch. WebGPU allows 65,535.
pub const LONGEST: u32 = 32_768;

/// Workgroup of the kernel that marks tiles.
const MARK: u32 = 64;

/// Finds the active tiles, and puts others to rest.
pub struct GasActivity {
    mark: Kernel,
    list: Kernel,
    judge: Kernel,
    settle_carried: Kernel,
    settle_flow: Kernel,
    list_layout: BindingLayout,
    carried_layout: BindingLayout,
    flow_layout: BindingLayout,
}

/// The bindings that do not depend on which state is current.
pub struct GasActivitySet {
    list: wgpu::BindGroup,
    flow: wgpu::BindGroup,
    marks: [u32; 2],
}

impl GasActivity {
    /// Builds the pipelines for cells that cover so many texels along each axis.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu, coarsening: u32) -> Result<Self, ShaderError> {
        use Binding::{Read, ReadWrite, Uniform};
        let layout = |bindings: &[Binding]| BindingLayout::new(gpu, "gas activity", wgpu::ShaderStages::COMPUTE, bindings);
        let list_layout = layout(&[Uniform, Read, ReadWrite, ReadWrite, ReadWrite, ReadWrite, Read]);
        let carried_layout = layout(&[Uniform, Read, ReadWrite, ReadWrite, ReadWrite]);
        let flow_layout = layout(&[Uniform, Read, ReadWrite, ReadWrite, ReadWrite, ReadWrite, ReadWrite]);
        let mut constants = tile_constants().to_vec();
        let words = [("GAS_HEADER", HEADER), ("GAS_POISON", POISON), ("GAS_STOPPED", STOPPED), ("GAS_STEPS", STEPS)];
        let more = [("GAS_ACTIVE", ACTIVE), ("GAS_LONGEST", LONGEST), ("GAS_COARSENING", coarsening)];
        constants.extend(words.into_iter().chain(more).map(|(name, value)| (name, f64::from(value))));
        let parts = ["common/gas", "field/gas_activity"];
        let kernel = |entry, layout| Kernel::new(gpu, "gas activity", &parts, entry, &constants, &[None, Some(layout)]);
        Ok(Self {
            mark: kernel("gas_mark", &list_layout)?,
            list: kernel("gas_list", &list_layout)?,
            judge: kernel("gas_judge", &list_layout)?,
            settle_carried: kernel("gas_settle_carried", &carried_layout)?,
            settle_flow: kernel("gas_settle_flow", &flow_layout)?,
            list_layout,
            carried_layout,
            flow_layout,
        })
    }

    /// Binds the buffers.
    pub fn bind(&self, gpu: &Gpu, buffers: &Buffers) -> GasActivitySet {
        let list = [
            &buffers.params.buffer,
            &buffers.everything,
            &buffers.activity,
            &buffers.active,
            &buffers.settling,
            &buffers.dispatches,
            &buffers.level_workgroups,
        ];
        let [a, b, c] = &buffers.velocity;
        let flow = [&buffers.params.buffer, &buffers.settling, a, b, c, &buffers.p[0], &buffers.b[0]];
        let workgroups = (buffers.tiles[0] * buffers.tiles[1]).div_ceil(MARK);
        GasActivitySet {
            list: self.list_layout.bind(gpu, &list.map(wgpu::Buffer::as_entire_binding)),
            flow: self.flow_layout.bind(gpu, &flow.map(wgpu::Buffer::as_entire_binding)),
            marks: [workgroups.min(LONGEST), workgroups.div_ceil(LONGEST)],
        }
    }

    /// Binds what is carried, whose current state is the one of this role.
    pub fn bind_carried(&self, gpu: &Gpu, buffers: &Buffers, role: Role) -> wgpu::BindGroup {
        let [start, between, last] =
            [role.start(), role.between(), role.last()].map(|index| buffers.carried[index].as_entire_binding());
        let [params, settling] = [&buffers.params.buffer, &buffers.settling].map(wgpu::Buffer::as_entire_binding);
        self.carried_layout.bind(gpu, &[params, settling, start, between, last])
    }

    /// Records what begins a step: marks and lists the tiles, and puts to rest those that are no longer active.
    pub fn record(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        set: &GasActivitySet,
        carried: &wgpu::BindGroup,
        dispatches: &wgpu::Buffer,
    ) {
        pass.set_bind_group(1, &set.list, &[]);
        pass.set_pipeline(&self.mark.pipeline);
        pass.dispatch_workgroups(set.marks[0], set.marks[1], 1);
        pass.set_pipeline(&self.list.pipeline);
        pass.dispatch_workgroups(1, 1, 1);
        for (kernel, group) in [(&self.settle_carried, carried), (&self.settle_flow, &set.flow)] {
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(1, group, &[]);
            pass.dispatch_workgroups_indirect(dispatches, SETTLING_TILES);
        }
    }

    /// Records the judgement after the forces: whether the step goes on.
    pub fn record_judgement(&self, pass: &mut wgpu::ComputePass<'_>, set: &GasActivitySet) {
        pass.set_bind_group(1, &set.list, &[]);
        pass.set_pipeline(&self.judge.pipeline);
        pass.dispatch_workgroups(1, 1, 1);
    }
}

/// The words of the activity of so many tiles at a start: all of them are awake.
pub fn awake(tiles: u32) -> Vec<u32> {
    let mut words = vec![0; HEADER as usize];
    words.resize((HEADER + tiles) as usize, f32::MAX.to_bits());
    words.resize((HEADER + 2 * tiles) as usize, 0);
    words.resize((HEADER + 3 * tiles) as usize, 1);
    words
}

/// Tiles along each axis of a grid.
pub fn tiles(cells: [u32; 2]) -> [u32; 2] {
    cells.map(|side| side.div_ceil(TILE))
}
