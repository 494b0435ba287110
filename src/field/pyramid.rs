//! Pyramid: upper bounds of the bilinear surface over ever larger nodes (\[PDM\] §3.1, made exact).
//!
//! \[PDM\] takes the bound over texels, which suits a piecewise-constant field. The bilinear surface in a cell depends on its four
//! corners, so level 0 is, for each *cell*, the maximum of those: bounds are then exact at every level. Upper levels are the
//! maximum over their children; levels are mips of floor sizes, and the last node of a row or column takes the remainder.
//!
//! Reads [`Height`](super::Height), writes [`Pyramid`](super::Pyramid) in the regions given. 4 bytes in and 5⅓ out a texel, 1⅓ of them
//! read once more. Shader: `shaders/field/pyramid.wgsl`. Specification: [`crate::reference::pyramid`].

use super::blocks::{BlockList, Blocks};
use super::{Field, Region};
use crate::gpu::texture::mip_level_count;
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, List, Recorder, ShaderError, UniformSlots};
use crate::scene::Addressing;

/// Bytes a texel by design: height in, every level out, and every level but the last in again: 4 + 5⅓ + 1⅓ and a little.
pub const TEXEL_BYTES: u64 = 11;

/// Uniforms of one dispatch.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PyramidParams {
    /// The nodes to bound.
    pub blocks: Blocks,
    /// Width and height of the level that is read.
    pub source_size: [u32; 2],
    /// Width and height of the level that is written.
    pub size: [u32; 2],
    /// 1 where the field wraps, 0 where it clamps.
    pub wrap: u32,
    /// Zero.
    pub pad: u32,
}

/// Rebuilds the pyramid.
pub struct Pyramid {
    cells: Kernel,
    parents: Kernel,
    layout: BindingLayout,
}

/// The bindings of one field.
pub struct PyramidSet {
    params: UniformSlots<PyramidParams>,
    blocks: List<u32>,
    /// For each level, what reads the one below it (for level 0, the heights).
    groups: Vec<wgpu::BindGroup>,
    size: [u32; 2],
    addressing: Addressing,
}

impl PyramidSet {
    /// Bytes of GPU memory of the list of blocks.
    pub fn memory_bytes(&self) -> u64 {
        self.blocks.memory_bytes()
    }
}

impl Pyramid {
    /// A row of texels is contiguous in memory.
    pub const WORKGROUP: [u32; 2] = [16, 8];

    /// Builds the pipelines.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        let layout = BindingLayout::new(
            gpu,
            "pyramid",
            wgpu::ShaderStages::COMPUTE,
            &[
                Binding::UniformSlot,
                Binding::Float(false),
                Binding::Storage(wgpu::TextureFormat::R32Float, wgpu::StorageTextureAccess::WriteOnly),
                Binding::Read,
            ],
        );
        let kernel = |entry_point| {
            Kernel::new(
                gpu,
                "pyramid",
                &["common/region", "field/pyramid"],
                entry_point,
                &[("WORKGROUP_X", f64::from(Self::WORKGROUP[0])), ("WORKGROUP_Y", f64::from(Self::WORKGROUP[1]))],
                &[None, Some(&layout)],
            )
        };
        let (cells, parents) = (kernel("bound_cells")?, kernel("bound_parents")?);
        Ok(Self { cells, parents, layout })
    }

    /// Binds a field.
    pub fn bind(&self, gpu: &Gpu, field: &Field) -> PyramidSet {
        let levels = mip_level_count(field.size);
        let params = UniformSlots::new(gpu, "pyramid", levels);
        let blocks = List::new(gpu, "pyramid' blocks", BlockList::capacity(level_sizes(field.size), Self::WORKGROUP));
        let groups = (0..levels as usize)
            .map(|level| {
                let source = if level == 0 { &field.height.view } else { &field.pyramid.levels[level - 1] };
                self.layout.bind(
                    gpu,
                    &[
                        params.binding(),
                        wgpu::BindingResource::TextureView(source),
                        wgpu::BindingResource::TextureView(&field.pyramid.levels[level]),
                        blocks.buffer.as_entire_binding(),
                    ],
                )
            })
            .collect();
        PyramidSet { params, blocks, groups, size: field.size, addressing: field.addressing }
    }

    /// Rebuilds every level over the nodes that the cells in `cells` touch.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &PyramidSet, cells: &[Region]) {
        let (list, dispatches) = plan(set.size, set.addressing, cells);
        let params: Vec<_> = dispatches.iter().map(|(_, params)| *params).collect();
        set.params.write(recorder.gpu, &params);
        set.blocks.write(recorder.gpu, &list.items);
        recorder.compute("pyramid", |pass| {
            for (level, ([x, y], _)) in dispatches.iter().enumerate() {
                let kernel = if level == 0 { &self.cells } else { &self.parents };
                pass.set_pipeline(&kernel.pipeline);
                pass.set_bind_group(1, &set.groups[level], &[set.params.offset(level as u32)]);
                pass.dispatch_workgroups(*x, *y, 1);
            }
        });
    }
}

/// The sizes of the levels, finest first.
fn level_sizes(size: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
    (0..mip_level_count(size)).map(move |level| size.map(|size| (size >> level).max(1)))
}

/// Workgroups and parameters of each level's dispatch, and the blocks that they list; nothing where there are no cells.
fn plan(size: [u32; 2], addressing: Addressing, cells: &[Region]) -> (BlockList, Vec<([u32; 2], PyramidParams)>) {
    let wrap = u32::from(addressing == Addressing::Wrap);
    let mut regions = cells.to_vec();
    let mut source_size = size;
    let (mut list, mut dispatches) = (BlockList::default(), Vec::new());
    for (level, size) in level_sizes(size).enumerate() {
        if level > 0 {
            regions.iter_mut().for_each(|region| *region = region.parents(size));
            // Far up the regions meet.
            regions.dedup();
        }
        let Some(dispatch) = list.plan(&regions, size, Pyramid::WORKGROUP) else { break };
        dispatches.push((dispatch.workgroups, PyramidParams { blocks: dispatch.blocks, source_size, size, wrap, pad: 0 }));
        source_size = size;
    }
    (list, dispatches)
}
