//! Normal mips: for each texel of a level the means of the normals and of the heights beneath it.
//!
//! [`Normal`](super::Normal) holds them in its mip levels. A mean of unit normals is shorter than 1 by as much as they differ: what
//! a pixel averages away comes back as roughness (`shaders/surface/level_of_detail.wgsl`). The mean height beside it is what a
//! trace reads that looks no closer than a pixel does, as \[POM\]'s one texture for both is filtered.
//!
//! Levels have the sizes and parents of the [`pyramid`](super::pyramid)'s. 8 bytes in and 2⅔ out a texel, 2⅔ of them read once more.
//! Shader: `shaders/field/normal_mips.wgsl`. Specification: [`crate::reference::normal_mips`].

use super::blocks::{BlockList, Blocks};
use super::{Field, Region};
use crate::gpu::texture::mip_level_count;
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, List, Recorder, ShaderError, UniformSlots};

/// Bytes a texel by design: every level but the last in, every level but the first out: 10⅔ + 2⅔ and a little.
pub const TEXEL_BYTES: u64 = 14;

/// Uniforms of one dispatch.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct NormalMipsParams {
    /// The texels of the level to average.
    pub blocks: Blocks,
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
    blocks: List<u32>,
    /// For each level from 1, what reads the one below it.
    groups: Vec<wgpu::BindGroup>,
    size: [u32; 2],
}

impl NormalMipsSet {
    /// Bytes of GPU memory of the list of blocks.
    pub fn memory_bytes(&self) -> u64 {
        self.blocks.memory_bytes()
    }
}

impl NormalMips {
    /// A row of texels is contiguous in memory.
    pub const WORKGROUP: [u32; 2] = [16, 8];

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
                Binding::Read,
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
        let params = UniformSlots::new(gpu, "normal mips", levels);
        let blocks = List::new(gpu, "normal mips' blocks", BlockList::capacity(level_sizes(field.size), Self::WORKGROUP));
        let groups = (1..levels as usize)
            .map(|level| {
                self.layout.bind(
                    gpu,
                    &[
                        params.binding(),
                        wgpu::BindingResource::TextureView(&field.normal.levels[level - 1]),
                        wgpu::BindingResource::TextureView(&field.normal.levels[level]),
                        blocks.buffer.as_entire_binding(),
                    ],
                )
            })
            .collect();
        NormalMipsSet { params, blocks, groups, size: field.size }
    }

    /// Averages anew whatever has one of these texels of level 0 beneath it.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &NormalMipsSet, texels: &[Region]) {
        let (list, dispatches) = plan(set.size, texels);
        let params: Vec<_> = dispatches.iter().map(|(_, params)| *params).collect();
        set.params.write(recorder.gpu, &params);
        set.blocks.write(recorder.gpu, &list.items);
        recorder.compute("normal mips", |pass| {
            pass.set_pipeline(&self.kernel.pipeline);
            for (group, ([x, y], _)) in dispatches.iter().enumerate() {
                pass.set_bind_group(1, &set.groups[group], &[set.params.offset(group as u32)]);
                pass.dispatch_workgroups(*x, *y, 1);
            }
        });
    }
}

/// The sizes of the levels from 1, finest first.
fn level_sizes(field: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
    (1..mip_level_count(field)).map(move |level| field.map(|size| (size >> level).max(1)))
}

/// Workgroups and parameters of each level's dispatch, from level 1, and the blocks that they list; nothing where there are no texels.
fn plan(field: [u32; 2], texels: &[Region]) -> (BlockList, Vec<([u32; 2], NormalMipsParams)>) {
    let mut regions = texels.to_vec();
    let mut source_size = field;
    let (mut list, mut dispatches) = (BlockList::default(), Vec::new());
    for (level, size) in (1_u32..).zip(level_sizes(field)) {
        regions.iter_mut().for_each(|region| *region = region.parents(size));
        // Far up the regions meet.
        regions.dedup();
        let last_weight = [0, 1].map(|axis| {
            // Texels of the field under the last of the source, over those under any other. A single one weighs nothing else.
            let whole = 1_u32 << (level - 1);
            let before = (source_size[axis] - 1) * whole;
            if source_size[axis] == 1 { 1.0 } else { (field[axis] - before) as f32 / whole as f32 }
        });
        let Some(dispatch) = list.plan(&regions, size, NormalMips::WORKGROUP) else { break };
        dispatches.push((dispatch.workgroups, NormalMipsParams { blocks: dispatch.blocks, source_size, size, last_weight }));
        source_size = size;
    }
    (list, dispatches)
}
