//! Gas, projection: V-cycles of geometric multigrid, three a step.
//!
//! The finest level of a cycle moves 34 bytes a cell, the coarser ones 22 bytes of a quarter of the cells each: 42 in all. The last
//! cycle reads 16 more and writes 16, for the velocity that the next step carries: 158 bytes a cell for the three.
//! Shader: `shaders/field/gas_project.wgsl`. Specification: [`crate::reference::gas_project`].

use bytemuck::{Pod, Zeroable};

use super::gas::{Buffers, Role, TILE, tile_constants};
use super::gas_activity::{self, ACTIVE_TILES, HEADER};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, ShaderError};
use crate::reference::gas::{Grid, LEAD};
use crate::reference::gas_project::{AFTER, BEFORE, CYCLES, Level};

/// Bytes a cell of all cycles of a step by design: 34 and a third of 22 a cycle, rounded up, and 32 in the last.
pub const CELL_BYTES: u64 = 42 * CYCLES as u64 + 32;

/// Uniforms of one level.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct GasLevel {
    /// Its cells.
    pub size: [i32; 2],
    /// 1 where an axis repeats, 0 where it is closed.
    pub periodic: [i32; 2],
    /// The next level's cells.
    pub coarse: [i32; 2],
    /// What two neighbours along u, along v exchange for a unit of difference.
    pub exchange: [f32; 2],
    /// Cells that 1 m/s crosses in a step.
    pub courant: f32,
    /// Tiles along u.
    pub tiles_across: i32,
}

impl GasLevel {
    /// The uniforms of every level of a grid.
    pub fn all(grid: &Grid, courant: f32) -> Vec<Self> {
        let levels = Level::all(grid);
        let coarser = levels.iter().skip(1).chain(levels.last());
        levels
            .iter()
            .zip(coarser)
            .map(|(level, coarse)| {
                let side = [0, 1].map(|axis| level.side(axis));
                Self {
                    size: level.size.map(|side| side as i32),
                    periodic: level.periodic.map(i32::from),
                    coarse: coarse.size.map(|side| side as i32),
                    exchange: [(side[1] / side[0]) as f32, (side[0] / side[1]) as f32],
                    courant,
                    tiles_across: level.size[0].div_ceil(TILE as usize) as i32,
                }
            })
            .collect()
    }

    /// How many cells it has.
    pub fn cells(&self) -> u64 {
        self.size.map(|side| side as u64).iter().product()
    }
}

/// Takes the divergence from a velocity.
pub struct GasProject {
    down_finest: Kernel,
    down: Kernel,
    solve: Kernel,
    up: Kernel,
    up_finest: Kernel,
    up_finest_last: Kernel,
    down_finest_layout: BindingLayout,
    down_layout: BindingLayout,
    solve_layout: BindingLayout,
    up_layout: BindingLayout,
    up_finest_layout: BindingLayout,
}

/// The bindings of the coarser levels.
pub struct GasProjectSet {
    down: Vec<wgpu::BindGroup>,
    solve: wgpu::BindGroup,
    up: Vec<wgpu::BindGroup>,
}

/// The bindings of the finest level for one role: there and back.
pub struct GasProjectFinest {
    down: [wgpu::BindGroup; 2],
    up: [wgpu::BindGroup; 2],
}

impl GasProject {
    /// Builds the pipelines.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        use Binding::{Read, ReadWrite, Uniform};
        let layout = |bindings: &[Binding]| BindingLayout::new(gpu, "gas project", wgpu::ShaderStages::COMPUTE, bindings);
        let down_finest_layout = layout(&[Uniform, Read, Read, ReadWrite, ReadWrite]);
        let down_layout = layout(&[Uniform, Read, ReadWrite, ReadWrite]);
        let solve_layout = layout(&[Uniform, Read, Read, ReadWrite]);
        let up_layout = layout(&[Uniform, Read, Read, Read, ReadWrite]);
        let up_finest_layout = layout(&[Uniform, Read, Read, Read, Read, ReadWrite, ReadWrite, ReadWrite]);
        let weights = ["GAS_BEFORE_0", "GAS_BEFORE_1", "GAS_AFTER_0", "GAS_AFTER_1", "GAS_AFTER_2"];
        let kernel = |entry, layout, last| {
            let mut constants = tile_constants().to_vec();
            constants.extend(weights.into_iter().zip(BEFORE.into_iter().chain(AFTER)));
            constants.extend([("GAS_LAST", f64::from(u8::from(last))), ("GAS_LEAD", LEAD), ("GAS_HEADER", f64::from(HEADER))]);
            let parts = ["field/gas_project_smooth", "field/gas_project"];
            Kernel::new(gpu, "gas project", &parts, entry, &constants, &[None, Some(layout)])
        };
        Ok(Self {
            down_finest: kernel("gas_down_finest", &down_finest_layout, false)?,
            down: kernel("gas_down", &down_layout, false)?,
            solve: kernel("gas_solve", &solve_layout, false)?,
            up: kernel("gas_up", &up_layout, false)?,
            up_finest: kernel("gas_up_finest", &up_finest_layout, false)?,
            up_finest_last: kernel("gas_up_finest", &up_finest_layout, true)?,
            down_finest_layout,
            down_layout,
            solve_layout,
            up_layout,
            up_finest_layout,
        })
    }

    /// Binds the coarser levels.
    pub fn bind(&self, gpu: &Gpu, buffers: &Buffers) -> GasProjectSet {
        // Level k has its uniforms and p at k, its b and q at k − 1: the finest has neither.
        let level = |k: usize| &buffers.levels[k].buffer;
        let coarsest = buffers.levels.len() - 1;
        let down = |k: usize| entire(&[level(k), &buffers.b[k - 1], &buffers.p[k], &buffers.b[k]]);
        let up = |k: usize| entire(&[level(k), &buffers.b[k - 1], &buffers.p[k], &buffers.q[k], &buffers.q[k - 1]]);
        let solve = entire(&[level(coarsest), &buffers.b[coarsest - 1], &buffers.inverse, &buffers.q[coarsest - 1]]);
        GasProjectSet {
            down: (1..coarsest).map(|k| self.down_layout.bind(gpu, &down(k))).collect(),
            solve: self.solve_layout.bind(gpu, &solve),
            up: (1..coarsest).map(|k| self.up_layout.bind(gpu, &up(k))).collect(),
        }
    }

    /// Binds the finest level, whose current state is the one of this role.
    pub fn bind_finest(&self, gpu: &Gpu, buffers: &Buffers, role: Role) -> GasProjectFinest {
        let ways = [(role.between(), role.last()), (role.last(), role.between())];
        let down = ways.map(|(from, _)| {
            let resources = [&buffers.levels[0].buffer, &buffers.active, &buffers.velocity[from], &buffers.p[0], &buffers.b[0]];
            self.down_finest_layout.bind(gpu, &entire(&resources))
        });
        let up = ways.map(|(from, to)| {
            let resources = [
                &buffers.levels[0].buffer,
                &buffers.active,
                &buffers.velocity[from],
                &buffers.p[0],
                &buffers.q[0],
                &buffers.velocity[to],
                &buffers.carried[role.last()],
                &buffers.activity,
            ];
            self.up_finest_layout.bind(gpu, &entire(&resources))
        });
        GasProjectFinest { down, up }
    }

    /// Records the cycles of a step.
    pub fn record(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        set: &GasProjectSet,
        finest: &GasProjectFinest,
        dispatches: &wgpu::Buffer,
    ) {
        // To the last velocity, back, and there again: an odd number of cycles ends where the next step begins.
        const { assert!(CYCLES % 2 == 1) };
        for cycle in 0..CYCLES {
            let mut dispatch = |kernel: &Kernel, group: &wgpu::BindGroup, offset: u64| {
                pass.set_pipeline(&kernel.pipeline);
                pass.set_bind_group(1, group, &[]);
                pass.dispatch_workgroups_indirect(dispatches, offset);
            };
            dispatch(&self.down_finest, &finest.down[cycle % 2], ACTIVE_TILES);
            for (index, group) in set.down.iter().enumerate() {
                dispatch(&self.down, group, gas_activity::level(index));
            }
            dispatch(&self.solve, &set.solve, gas_activity::level(set.down.len()));
            for (index, group) in set.up.iter().enumerate().rev() {
                dispatch(&self.up, group, gas_activity::level(index));
            }
            let up = if cycle + 1 == CYCLES { &self.up_finest_last } else { &self.up_finest };
            dispatch(up, &finest.up[cycle % 2], ACTIVE_TILES);
        }
    }
}

/// All of each buffer, as a bind group binds it.
fn entire<'a>(of: &[&'a wgpu::Buffer]) -> Vec<wgpu::BindingResource<'a>> {
    of.iter().map(|buffer| buffer.as_entire_binding()).collect()
}
