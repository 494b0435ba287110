//! Gas, showing: density as heights, and the cover for the albedo, at the field's size. Reads 24 bytes a cell, writes 12 a texel.
//!
//! Shader: `shaders/field/gas_show.wgsl`. Specification: [`crate::reference::gas_show`].

use super::gas::{Buffers, Role, tile_constants};
use super::gas_activity::{LONGEST, SHOWN_TILES};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, ShaderError};

/// Bytes a cell by design.
pub const CELL_BYTES: u64 = 24;
/// Bytes a texel of the field by design.
pub const TEXEL_BYTES: u64 = 12;

/// Writes heights and cover.
pub struct GasShow {
    kernel: Kernel,
    layout: BindingLayout,
    coarsening: u32,
}

/// The bindings of one state.
pub struct GasShowSet {
    active: wgpu::BindGroup,
    everything: wgpu::BindGroup,
    tiles: u32,
}

impl GasShow {
    /// Builds the pipeline for cells that cover so many texels along each axis.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu, coarsening: u32) -> Result<Self, ShaderError> {
        use Binding::{Read, Storage, Uniform};
        let write = |format| Storage(format, wgpu::StorageTextureAccess::WriteOnly);
        let textures = [write(wgpu::TextureFormat::R32Float), write(wgpu::TextureFormat::Rgba16Float)];
        let bindings = [Uniform, Read, Read, Read, textures[0], textures[1]];
        let layout = BindingLayout::new(gpu, "gas show", wgpu::ShaderStages::COMPUTE, &bindings);
        let constants = [tile_constants()[0], ("GAS_COARSENING", f64::from(coarsening))];
        let parts = ["common/gas", "field/gas_show"];
        let kernel = Kernel::new(gpu, "gas show", &parts, "gas_show", &constants, &[None, Some(&layout)])?;
        Ok(Self { kernel, layout, coarsening })
    }

    /// Binds the state that this role leaves when its step is done, and where it is shown.
    pub fn bind(
        &self,
        gpu: &Gpu,
        buffers: &Buffers,
        role: Role,
        heights: &wgpu::TextureView,
        cover: &wgpu::TextureView,
    ) -> GasShowSet {
        let group = |tiles: &wgpu::Buffer| {
            let [params, tiles, velocity, carried] =
                [&buffers.params.buffer, tiles, &buffers.velocity[role.start()], &buffers.carried[role.start()]]
                    .map(wgpu::Buffer::as_entire_binding);
            let [heights, cover] = [heights, cover].map(wgpu::BindingResource::TextureView);
            self.layout.bind(gpu, &[params, tiles, velocity, carried, heights, cover])
        };
        let tiles = buffers.tiles[0] * buffers.tiles[1];
        GasShowSet { active: group(&buffers.active), everything: group(&buffers.everything), tiles }
    }

    /// Records it over the active tiles.
    pub fn record(&self, pass: &mut wgpu::ComputePass<'_>, set: &GasShowSet, dispatches: &wgpu::Buffer) {
        pass.set_pipeline(&self.kernel.pipeline);
        pass.set_bind_group(1, &set.active, &[]);
        pass.dispatch_workgroups_indirect(dispatches, SHOWN_TILES);
    }

    /// Records it over all tiles.
    pub fn record_everything(&self, pass: &mut wgpu::ComputePass<'_>, set: &GasShowSet) {
        pass.set_pipeline(&self.kernel.pipeline);
        pass.set_bind_group(1, &set.everything, &[]);
        pass.dispatch_workgroups(set.tiles.min(LONGEST), set.tiles.div_ceil(LONGEST), self.coarsening * self.coarsening);
    }
}
