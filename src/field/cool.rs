//! Cool: forgets the heat of what no longer glows.
//!
//! Heat is stored as the time at which a texel glowed fully ([`material`](super::material)): it cools by itself, e^(−t/τ) exactly,
//! however frames cut time. Such a clock starts over after [`MOMENTS`]; before it does, at fixed times, this pass forgets what is
//! older than [`GLOWING_MOMENTS`], which no one sees any more. 4 bytes in a texel, once in [`EVERY_MOMENTS`].
//! Shader: `shaders/field/cool.wgsl`. Specification: [`crate::reference::cool`].

use super::Field;
use super::material::{CONSTANTS, GLOWING_MOMENTS, MOMENTS, MOMENTS_PER_FALL, moment};
use crate::gpu::kernel::workgroups;
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, Recorder, ShaderError, UniformSlots};

/// Moments from one pass to the next. No heat is older than these and [`GLOWING_MOMENTS`] together, little more than half a turn of
/// the clock.
pub const EVERY_MOMENTS: f64 = 256.0;

const _: () = assert!(EVERY_MOMENTS + GLOWING_MOMENTS < MOMENTS as f64 - 400.0);

/// Bytes a texel by design: material in.
pub const TEXEL_BYTES: u64 = 4;

/// Uniforms of one pass.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct CoolParams {
    /// Size of the field, texels.
    pub size: [u32; 2],
    /// Of the clock, at the time of this pass.
    pub moment: f32,
    /// Fills the last 16 bytes.
    pub spare: u32,
}

/// Forgets heat.
pub struct Cool {
    kernel: Kernel,
    layout: BindingLayout,
}

/// The bindings of one field.
pub struct CoolSet {
    params: UniformSlots<CoolParams>,
    material: wgpu::TextureView,
    group: wgpu::BindGroup,
    size: [u32; 2],
}

/// Seconds from one pass to the next, where a glow falls to 1/e in so many.
pub fn every_seconds(cooling_seconds: f64) -> f64 {
    cooling_seconds * EVERY_MOMENTS / MOMENTS_PER_FALL
}

impl Cool {
    /// Width and height of a workgroup, texels.
    pub const TILE: [u32; 2] = [16, 8];

    /// Builds the pipeline.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        let layout = BindingLayout::new(
            gpu,
            "cool",
            wgpu::ShaderStages::COMPUTE,
            &[Binding::UniformSlot, Binding::Storage(wgpu::TextureFormat::R32Uint, wgpu::StorageTextureAccess::ReadWrite)],
        );
        let tile = [("COOL_TILE_X", f64::from(Self::TILE[0])), ("COOL_TILE_Y", f64::from(Self::TILE[1]))];
        let constants = [&tile[..], &CONSTANTS].concat();
        let kernel = Kernel::new(gpu, "cool", &["common/material", "field/cool"], "cool", &constants, &[None, Some(&layout)])?;
        Ok(Self { kernel, layout })
    }

    /// Binds a field.
    pub fn bind(&self, gpu: &Gpu, field: &Field) -> CoolSet {
        let params = UniformSlots::new(gpu, "cool", 4);
        let material = field.material.view.clone();
        let group = self.group(gpu, &material, &params);
        CoolSet { params, material, group, size: field.size }
    }

    fn group(&self, gpu: &Gpu, material: &wgpu::TextureView, params: &UniformSlots<CoolParams>) -> wgpu::BindGroup {
        self.layout.bind(gpu, &[params.binding(), wgpu::BindingResource::TextureView(material)])
    }

    /// Uploads what passes at these times need. One call serves one submission.
    pub fn upload(&self, gpu: &Gpu, set: &mut CoolSet, times: &[f64], cooling_seconds: f64) {
        if times.len() > set.params.capacity() as usize {
            set.params = UniformSlots::new(gpu, "cool", (times.len() as u32).next_power_of_two());
            set.group = self.group(gpu, &set.material, &set.params);
        }
        let size = set.size;
        let params: Vec<_> =
            times.iter().map(|&seconds| CoolParams { size, moment: moment(seconds, cooling_seconds), spare: 0 }).collect();
        set.params.write(gpu, &params);
    }

    /// Records the `number`th of them.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &CoolSet, number: usize) {
        recorder.compute("cool", |pass| {
            pass.set_pipeline(&self.kernel.pipeline);
            pass.set_bind_group(1, &set.group, &[set.params.offset(number as u32)]);
            let [x, y] = workgroups(set.size, Self::TILE);
            pass.dispatch_workgroups(x, y, 1);
        });
    }
}
