//! Normal mips: for each texel of a level the means of the normals and of the heights beneath it.
//!
//! [`Normal`](super::Normal) holds them in its mip levels. A mean of unit normals is shorter than 1 by as much as they differ: what
//! a pixel averages away comes back as roughness (`shaders/surface/level_of_detail.wgsl`). The mean height beside it is what a
//! trace reads that looks no closer than a pixel does, as \[POM\]'s one texture for both is filtered.
//!
//! Levels have the sizes and parents of the [`pyramid`](super::pyramid)'s. 8 bytes in and 2⅔ out a texel, 2⅔ of them read once more.
//! Shader: `shaders/field/normal_mips.wgsl`. Specification: [`crate::reference::normal_mips`].

use super::{Field, Region};
use crate::gpu::kernel::workgroups;
use crate::gpu::texture::mip_level_count;
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, Recorder, ShaderError, UniformSlots};

/// Bytes a texel by design: every level but the last in, every level but the first out: 10⅔ + 2⅔ and a little.
pub const TEXEL_BYTES: u64 = 14;

/// Uniforms of one dispatch.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct NormalMipsParams {
    /// The texels of the level to average.
    pub region: Region,
    /// Width and height of the level that is read.
    pub source_size: [u32; 2],
    /// Width and height of the level that is written.
    pub size: [u32; 2],
    /// How wide and high the last texel of the level that is read is, in widths and heights of its others.
    pub last_weight: [f32; 2],
}

/// Averages normals and heights over ever larger texels.
pub struct NormalMips {
    kernel: Kernel,
    layout: BindingLayout,
}

/// The bindings of one field.
pub struct NormalMipsSet {
    params: UniformSlots<NormalMipsParams>,
    /// For each level from 1, what reads the one below it.
    groups: Vec<wgpu::BindGroup>,
    size: [u32; 2],
}

impl NormalMips {
    /// A row of texels is contiguous in memory.
    pub const WORKGROUP: [u32; 2] = [16, 8];

    /// Regions that one frame may average separately: those that the normals were derived in.
    pub const MAX_REGIONS: u32 = super::normals::Normals::MAX_REGIONS;

    /// Builds the pipeline.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        let layout = BindingLayout::new(
            gpu,
            "normal mips",
            wgpu::ShaderStages::COMPUTE,
            &[
                Binding::UniformSlot,
                Binding::Float(false),
                Binding::Storage(wgpu::TextureFormat::Rgba16Float, wgpu::StorageTextureAccess::WriteOnly),
            ],
        );
        let kernel = Kernel::new(
            gpu,
            "normal mips",
            &["common/region", "field/normal_mips"],
            "average",
            &[("WORKGROUP_X", f64::from(Self::WORKGROUP[0])), ("WORKGROUP_Y", f64::from(Self::WORKGROUP[1]))],
            &[None, Some(&layout)],
        )?;
        Ok(Self { kernel, layout })
    }

    /// Binds a field.
    pub fn bind(&self, gpu: &Gpu, field: &Field) -> NormalMipsSet {
        let levels = mip_level_count(field.size);
        let params = UniformSlots::new(gpu, "normal mips", levels * Self::MAX_REGIONS);
        let groups = (1..levels as usize)
            .map(|level| {
                self.layout.bind(
                    gpu,
                    &[
                        params.binding(),
                        wgpu::BindingResource::TextureView(&field.normal.levels[level - 1]),
                        wgpu::BindingResource::TextureView(&field.normal.levels[level]),
                    ],
                )
            })
            .collect();
        NormalMipsSet { params, groups, size: field.size }
    }

    /// Averages anew whatever has one of these texels of level 0 beneath it.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &NormalMipsSet, texels: &[Region]) {
        let dispatches = dispatches(set.size, texels);
        let params: Vec<_> = dispatches.iter().map(|(_, params)| *params).collect();
        set.params.write(recorder.gpu, &params);
        recorder.compute("normal mips", |pass| {
            pass.set_pipeline(&self.kernel.pipeline);
            for (slot, (level, params)) in (0..).zip(&dispatches) {
                let [x, y] = workgroups(params.region.extent, Self::WORKGROUP);
                pass.set_bind_group(1, &set.groups[*level - 1], &[set.params.offset(slot)]);
                pass.dispatch_workgroups(x, y, 1);
            }
        });
    }
}

/// Level and parameters of each dispatch, finest level first.
fn dispatches(field: [u32; 2], texels: &[Region]) -> Vec<(usize, NormalMipsParams)> {
    let mut regions = texels.to_vec();
    let mut dispatches = Vec::new();
    let size_of = |level: u32| field.map(|size| (size >> level).max(1));
    for level in 1..mip_level_count(field) {
        let (source_size, size) = (size_of(level - 1), size_of(level));
        regions = regions.iter().map(|region| region.parents(size)).collect();
        // Far up the regions meet.
        regions.dedup();
        let last_weight = [0, 1].map(|axis| {
            // Texels of the field under the last of the source, over those under any other. A single one weighs nothing else.
            let whole = 1_u32 << (level - 1);
            let before = (source_size[axis] - 1) * whole;
            if source_size[axis] == 1 { 1.0 } else { (field[axis] - before) as f32 / whole as f32 }
        });
        dispatches.extend(
            regions.iter().map(|region| (level as usize, NormalMipsParams { region: *region, source_size, size, last_weight })),
        );
    }
    dispatches
}
