//! Normals: the slope of the height field, by a 3×3 Sobel gradient (\[POM\] §4, "dynamic normals").
//!
//! Reads [`Height`](super::Height), writes every texel of [`Normal`](super::Normal)'s level 0 in the regions given, with the height
//! beside it: [`normal_mips`](super::normal_mips) averages both. 4 bytes in, 8 out a texel, the halo apart. Shader: `shaders/field/normals.wgsl`. Specification: [`crate::reference::normals`].

use super::blocks::{BlockList, Blocks};
use super::{Field, Region};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, List, Recorder, ShaderError, Uniform, nearest_sampler};
use crate::scene::Addressing;

/// Bytes a texel by design: height in, normal out.
pub const TEXEL_BYTES: u64 = 12;

/// Uniforms of one dispatch.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct NormalsParams {
    /// The texels to derive.
    pub blocks: Blocks,
    /// Depth over the texel's width and height: the slope of a difference of 1 between neighbours.
    pub slope_per_height: [f32; 2],
    /// Width and height of the field, texels.
    pub size: [u32; 2],
}

/// Derives unit normals from heights.
pub struct Normals {
    kernel: Kernel,
    layout: BindingLayout,
}

/// The bindings of one field.
pub struct NormalsSet {
    params: Uniform<NormalsParams>,
    blocks: List<u32>,
    group: wgpu::BindGroup,
    size: [u32; 2],
}

impl NormalsSet {
    /// Bytes of GPU memory of the list of blocks.
    pub fn memory_bytes(&self) -> u64 {
        self.blocks.memory_bytes()
    }
}

impl Normals {
    /// The tile and its halo of one stay in cache.
    pub const WORKGROUP: [u32; 2] = [16, 8];

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
                Binding::Uniform,
                Binding::Float(false),
                Binding::Storage(wgpu::TextureFormat::Rgba16Float, wgpu::StorageTextureAccess::WriteOnly),
                Binding::Read,
                Binding::Sampler(false),
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
        let params = Uniform::new(gpu, "normals");
        let blocks = List::new(gpu, "normals' blocks", BlockList::capacity(std::iter::once(field.size), Self::WORKGROUP));
        let group = self.layout.bind(
            gpu,
            &[
                params.buffer.as_entire_binding(),
                wgpu::BindingResource::TextureView(&field.height.view),
                wgpu::BindingResource::TextureView(&field.normal.levels[0]),
                blocks.buffer.as_entire_binding(),
                wgpu::BindingResource::Sampler(&nearest_sampler(gpu, field.addressing == Addressing::Wrap)),
            ],
        );
        NormalsSet { params, blocks, group, size: field.size }
    }

    /// Derives the regions.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &NormalsSet, regions: &[Region], slope_per_height: [f32; 2]) {
        let mut list = BlockList::default();
        let Some(dispatch) = list.plan(regions, set.size, Self::WORKGROUP) else { return };
        set.blocks.write(recorder.gpu, &list.items);
        let params = NormalsParams { blocks: dispatch.blocks, slope_per_height, size: set.size };
        set.params.write(recorder.gpu, &params);
        recorder.compute("normals", |pass| {
            let [x, y] = dispatch.workgroups;
            pass.set_pipeline(&self.kernel.pipeline);
            pass.set_bind_group(1, &set.group, &[]);
            pass.dispatch_workgroups(x, y, 1);
        });
    }
}
