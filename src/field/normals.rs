//! Normals: the slope of the height field, by a 3×3 Sobel gradient (\[POM\] §4, "dynamic normals").
//!
//! Reads [`Height`](super::Height), writes every texel of [`Normal`](super::Normal)'s level 0 in the regions given, with the height
//! beside it: [`normal_mips`](super::normal_mips) averages both. 4 bytes in, 8 out a texel, the halo apart. Shader: `shaders/field/normals.wgsl`. Specification: [`crate::reference::normals`].

use super::{Field, Region};
use crate::gpu::kernel::workgroups;
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, Recorder, ShaderError, UniformSlots};
use crate::scene::Addressing;

/// Bytes a texel by design: height in, normal out.
pub const TEXEL_BYTES: u64 = 12;

/// Uniforms of one dispatch.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct NormalsParams {
    /// The texels to derive.
    pub region: Region,
    /// Depth over the texel's width and height: the slope of a difference of 1 between neighbours.
    pub slope_per_height: [f32; 2],
    /// Width and height of the field, texels.
    pub size: [u32; 2],
    /// 1 where the field wraps, 0 where it clamps.
    pub wrap: u32,
    /// Zero.
    pub pad: u32,
}

/// Derives unit normals from heights.
pub struct Normals {
    kernel: Kernel,
    layout: BindingLayout,
}

/// The bindings of one field.
pub struct NormalsSet {
    params: UniformSlots<NormalsParams>,
    group: wgpu::BindGroup,
    size: [u32; 2],
    addressing: Addressing,
}

impl Normals {
    /// The tile and its halo of one stay in cache.
    pub const WORKGROUP: [u32; 2] = [16, 8];

    /// Regions that one frame may derive separately: each that changed, grown, in up to four pieces where the field wraps.
    pub const MAX_REGIONS: u32 = 4 * super::Dirty::MAX_REGIONS as u32;

    /// Builds the pipeline.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        let layout = BindingLayout::new(
            gpu,
            "normals",
            wgpu::ShaderStages::COMPUTE,
            &[
                Binding::UniformSlot,
                Binding::Float(false),
                Binding::Storage(wgpu::TextureFormat::Rgba16Float, wgpu::StorageTextureAccess::WriteOnly),
            ],
        );
        let kernel = Kernel::new(
            gpu,
            "normals",
            &["common/region", "field/normals"],
            "normals",
            &[("WORKGROUP_X", f64::from(Self::WORKGROUP[0])), ("WORKGROUP_Y", f64::from(Self::WORKGROUP[1]))],
            &[None, Some(&layout)],
        )?;
        Ok(Self { kernel, layout })
    }

    /// Binds a field.
    pub fn bind(&self, gpu: &Gpu, field: &Field) -> NormalsSet {
        let params = UniformSlots::new(gpu, "normals", Self::MAX_REGIONS);
        let group = self.layout.bind(
            gpu,
            &[
                params.binding(),
                wgpu::BindingResource::TextureView(&field.height.view),
                wgpu::BindingResource::TextureView(&field.normal.levels[0]),
            ],
        );
        NormalsSet { params, group, size: field.size, addressing: field.addressing }
    }

    /// Derives the regions.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &NormalsSet, regions: &[Region], slope_per_height: [f32; 2]) {
        let params: Vec<_> = regions
            .iter()
            .map(|region| NormalsParams {
                region: *region,
                slope_per_height,
                size: set.size,
                wrap: u32::from(set.addressing == Addressing::Wrap),
                pad: 0,
            })
            .collect();
        set.params.write(recorder.gpu, &params);
        recorder.compute("normals", |pass| {
            pass.set_pipeline(&self.kernel.pipeline);
            for (slot, params) in (0..).zip(&params) {
                let [x, y] = workgroups(params.region.extent, Self::WORKGROUP);
                pass.set_bind_group(1, &set.group, &[set.params.offset(slot)]);
                pass.dispatch_workgroups(x, y, 1);
            }
        });
    }
}
