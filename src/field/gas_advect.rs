//! Gas, advection: MacCormack's scheme with a limiter. Reads 64 bytes a cell and writes 32.
//!
//! Shader: `shaders/field/gas_advect.wgsl`. Specification: [`crate::reference::gas_advect`].

use super::gas::{Buffers, Role, tile_constants};
use super::gas_activity;
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, ShaderError};

/// Bytes a cell by design: 24 in and 16 out ahead, 40 in and 16 out for the correction.
pub const CELL_BYTES: u64 = 96;

/// Carries the gas along its flow.
pub struct GasAdvect {
    ahead: Kernel,
    limited: Kernel,
    ahead_layout: BindingLayout,
    limited_layout: BindingLayout,
}

/// The bindings of one state.
pub struct GasAdvectSet {
    ahead: wgpu::BindGroup,
    limited: wgpu::BindGroup,
}

impl GasAdvect {
    /// Builds the pipelines.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        use Binding::{Read, ReadWrite, Uniform};
        let layout = |bindings: &[Binding]| BindingLayout::new(gpu, "gas advect", wgpu::ShaderStages::COMPUTE, bindings);
        let ahead_layout = layout(&[Uniform, Read, Read, Read, ReadWrite, ReadWrite]);
        let limited_layout = layout(&[Uniform, Read, Read, Read, Read, ReadWrite]);
        let constants = [tile_constants()[0], ("GAS_POISON", f64::from(gas_activity::POISON))];
        let parts = ["common/gas", "field/gas_advect"];
        let kernel = |entry, layout| Kernel::new(gpu, "gas advect", &parts, entry, &constants, &[None, Some(layout)]);
        let (ahead, limited) = (kernel("gas_ahead", &ahead_layout)?, kernel("gas_limited", &limited_layout)?);
        Ok(Self { ahead, limited, ahead_layout, limited_layout })
    }

    /// Binds the buffers, whose current state is the one of this role.
    pub fn bind(&self, gpu: &Gpu, buffers: &Buffers, role: Role) -> GasAdvectSet {
        let [params, active, velocity, carried] =
            [&buffers.params.buffer, &buffers.active, &buffers.velocity[role.start()], &buffers.carried[role.start()]]
                .map(wgpu::Buffer::as_entire_binding);
        let ahead = buffers.carried[role.last()].as_entire_binding();
        let limited = buffers.carried[role.between()].as_entire_binding();
        let activity = buffers.activity.as_entire_binding();
        GasAdvectSet {
            ahead: self
                .ahead_layout
                .bind(gpu, &[params.clone(), active.clone(), velocity.clone(), carried.clone(), ahead.clone(), activity]),
            limited: self.limited_layout.bind(gpu, &[params, active, velocity, carried, ahead, limited]),
        }
    }

    /// Records both kernels over the active tiles, whose dispatch stands first in `dispatches`.
    pub fn record(&self, pass: &mut wgpu::ComputePass<'_>, set: &GasAdvectSet, dispatches: &wgpu::Buffer) {
        for (kernel, group) in [(&self.ahead, &set.ahead), (&self.limited, &set.limited)] {
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(1, group, &[]);
            pass.dispatch_workgroups_indirect(dispatches, gas_activity::ACTIVE_TILES);
        }
    }
}
