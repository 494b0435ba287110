//! Gas, forces: viscosity, confinement, buoyancy, turning, and the pull of each row. Reads 16 bytes a cell and writes 24.
//!
//! Shader: `shaders/field/gas_force.wgsl`. Specification: [`crate::reference::gas_force`].

use bytemuck::{Pod, Zeroable};

use super::gas::{Buffers, Role, tile_constants};
use super::gas_activity::{self, HEADER, POISON};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, ShaderError};
use crate::reference::gas_force::Row;

/// Bytes a cell by design.
pub const CELL_BYTES: u64 = 40;

/// A push that leads beyond stillness within so many steps keeps a tile awake: two seconds.
pub const FORESIGHT: f64 = 64.0;

/// What a row of cells tends to.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct GasRow {
    /// Its wind along u, m/s.
    pub wind: f32,
    /// Its density.
    pub density: f32,
    /// Its dye.
    pub dye: f32,
    /// Part of the way to the wind that a step goes.
    pub wind_pull: f32,
    /// Part of the velocity along v that a step takes.
    pub calm_pull: f32,
    /// Part of the way to density and dye that a step goes.
    pub gas_pull: f32,
    /// Cosine of the angle by which the planet turns a velocity in a step.
    pub turn_cosine: f32,
    /// Its sine.
    pub turn_sine: f32,
}

impl From<&Row> for GasRow {
    fn from(row: &Row) -> Self {
        Self {
            wind: row.wind as f32,
            density: row.density as f32,
            dye: row.dye as f32,
            wind_pull: row.wind_pull as f32,
            calm_pull: row.calm_pull as f32,
            gas_pull: row.gas_pull as f32,
            turn_cosine: row.turn.cos() as f32,
            turn_sine: row.turn.sin() as f32,
        }
    }
}

/// Lets forces act on the gas.
pub struct GasForce {
    kernel: Kernel,
    layout: BindingLayout,
}

impl GasForce {
    /// Builds the pipeline.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        use Binding::{Read, ReadWrite, Uniform};
        let bindings = [Uniform, Read, Read, Read, ReadWrite, ReadWrite, ReadWrite];
        let layout = BindingLayout::new(gpu, "gas force", wgpu::ShaderStages::COMPUTE, &bindings);
        let mut constants = tile_constants().to_vec();
        constants.extend([("GAS_POISON", f64::from(POISON)), ("GAS_HEADER", f64::from(HEADER)), ("GAS_FORESIGHT", FORESIGHT)]);
        let parts = ["common/gas", "field/gas_force"];
        let kernel = Kernel::new(gpu, "gas force", &parts, "gas_force", &constants, &[None, Some(&layout)])?;
        Ok(Self { kernel, layout })
    }

    /// Binds the buffers, whose current state is the one of this role.
    pub fn bind(&self, gpu: &Gpu, buffers: &Buffers, role: Role) -> wgpu::BindGroup {
        let resources = [
            &buffers.params.buffer,
            &buffers.active,
            &buffers.carried[role.between()],
            &buffers.rows.buffer,
            &buffers.velocity[role.between()],
            &buffers.carried[role.last()],
            &buffers.activity,
        ];
        self.layout.bind(gpu, &resources.map(wgpu::Buffer::as_entire_binding))
    }

    /// Records one dispatch over the active tiles.
    pub fn record(&self, pass: &mut wgpu::ComputePass<'_>, group: &wgpu::BindGroup, dispatches: &wgpu::Buffer) {
        pass.set_pipeline(&self.kernel.pipeline);
        pass.set_bind_group(1, group, &[]);
        pass.dispatch_workgroups_indirect(dispatches, gas_activity::ACTIVE_TILES);
    }
}
