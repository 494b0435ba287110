//! Bounds: between which heights the bilinear surface lies over ever larger nodes, in one texture: what the exact traversal goes by.
//!
//! A node of level k, from 1 on, is a square of 2^k cells a side, cut off at the field's end: sizes are halved and rounded up, so that
//! a cell's node is its number shifted right, whatever the field's size. [`super::pyramid`] keeps the levels of \[PDM\] as mips; here they
//! lie side by side in one level. A processor that executes eight pixels at once reads a mip of each pixel's own lane by lane, which
//! took as long as half of all else in the traversal, and a texture without mips at once.
//!
//! A texel holds both ends of the range in the 24 bits of an f32 that are exact: the upper, rounded up to [`HIGH_STEPS`], and the lower,
//! rounded down to [`LOW_STEPS`]. Cells themselves have no node: looking at one costs no more than reading its bound.
//!
//! Reads [`Height`](super::Height), writes [`Bounds`](super::Bounds) in the regions given. 9 bytes in and 1½ out a texel, ½ of them
//! read once more. Shader: `shaders/field/bounds.wgsl`. Specification: [`crate::reference::bounds`].

use super::blocks::{BlockList, Blocks};
use super::{Field, Region};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, List, Recorder, ShaderError, UniformSlots};
use crate::scene::Addressing;

/// Bytes a texel by design: the heights of nine texels for every four in, every level out, and every level but the last in again.
pub const TEXEL_BYTES: u64 = 11;

/// Steps from 0 to 1 of the upper end: 14 bits, a sixtieth of a texel on a field as deep as a thousand of them.
pub const HIGH_STEPS: u32 = (1 << 14) - 1;
/// Steps from 0 to 1 of the lower end, which only says how near a search is: 10 bits.
pub const LOW_STEPS: u32 = (1 << 10) - 1;

/// The `override`s of `shaders/common/range.wgsl`.
pub(crate) const CONSTANTS: [(&str, f64); 2] = [("HIGH_STEPS", HIGH_STEPS as f64), ("LOW_STEPS", LOW_STEPS as f64)];

/// How many levels there are, the first being 1: the last has one node.
pub fn level_count(size: [u32; 2]) -> u32 {
    size[0].max(size[1]).next_power_of_two().trailing_zeros().max(1)
}

/// Nodes of a level along either axis.
pub fn level_size(size: [u32; 2], level: u32) -> [u32; 2] {
    size.map(|size| size.div_ceil(1 << level))
}

/// Where a level's first node lies: level 1 in the corner, the others below one another on its right.
pub fn level_origin(size: [u32; 2], level: u32) -> [u32; 2] {
    // A level has at most one node more than its size halved and rounded down.
    let below = |level: u32| (size[1] >> 1) + level - 2 - (size[1] >> (level - 1));
    if level == 1 { [0, 0] } else { [level_size(size, 1)[0], below(level)] }
}

/// Width and height of the texture of a field of this size.
pub fn texture_size(size: [u32; 2]) -> [u32; 2] {
    let levels = (1..=level_count(size)).map(|level| {
        let (origin, extent) = (level_origin(size, level), level_size(size, level));
        [origin[0] + extent[0], origin[1] + extent[1]]
    });
    levels.fold([1, 1], |whole, end| [whole[0].max(end[0]), whole[1].max(end[1])])
}

/// Uniforms of one dispatch.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct BoundsParams {
    /// The nodes to bound.
    pub blocks: Blocks,
    /// Width and height of what is read: of the field, or of the level below.
    pub source_size: [u32; 2],
    /// Where that lies.
    pub source_origin: [u32; 2],
    /// Width and height of the level that is written.
    pub size: [u32; 2],
    /// Where it lies.
    pub origin: [u32; 2],
    /// 1 where the field wraps, 0 where it clamps.
    pub wrap: u32,
    /// Zero.
    pub pad: u32,
}

/// Rebuilds the bounds.
pub struct BoundsPass {
    cells: Kernel,
    nodes: Kernel,
    layout: BindingLayout,
}

/// The bindings of one field.
pub struct BoundsSet {
    params: UniformSlots<BoundsParams>,
    blocks: List<u32>,
    group: wgpu::BindGroup,
    size: [u32; 2],
    addressing: Addressing,
}

impl BoundsSet {
    /// Bytes of GPU memory of the list of blocks.
    pub fn memory_bytes(&self) -> u64 {
        self.blocks.memory_bytes()
    }
}

impl BoundsPass {
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
            "bounds",
            wgpu::ShaderStages::COMPUTE,
            &[
                Binding::UniformSlot,
                Binding::Float(false),
                Binding::Storage(wgpu::TextureFormat::R32Float, wgpu::StorageTextureAccess::ReadWrite),
                Binding::Read,
            ],
        );
        let [x, y] = Self::WORKGROUP.map(f64::from);
        let constants = [&[("WORKGROUP_X", x), ("WORKGROUP_Y", y)], &CONSTANTS[..]].concat();
        let parts = ["common/region", "common/range", "field/bounds"];
        let kernel = |entry_point| Kernel::new(gpu, "bounds", &parts, entry_point, &constants, &[None, Some(&layout)]);
        let (cells, nodes) = (kernel("bound_cells")?, kernel("bound_nodes")?);
        Ok(Self { cells, nodes, layout })
    }

    /// Binds a field.
    pub fn bind(&self, gpu: &Gpu, field: &Field) -> BoundsSet {
        let params = UniformSlots::new(gpu, "bounds", level_count(field.size));
        let sizes = (1..=level_count(field.size)).map(|level| level_size(field.size, level));
        let blocks = List::new(gpu, "bounds' blocks", BlockList::capacity(sizes, Self::WORKGROUP));
        let group = self.layout.bind(
            gpu,
            &[
                params.binding(),
                wgpu::BindingResource::TextureView(&field.height.view),
                wgpu::BindingResource::TextureView(&field.bounds.view),
                blocks.buffer.as_entire_binding(),
            ],
        );
        BoundsSet { params, blocks, group, size: field.size, addressing: field.addressing }
    }

    /// Rebuilds every level over the nodes that the cells in `cells` touch.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &BoundsSet, cells: &[Region]) {
        let (list, dispatches) = plan(set.size, set.addressing, cells);
        let params: Vec<_> = dispatches.iter().map(|(_, params)| *params).collect();
        set.params.write(recorder.gpu, &params);
        set.blocks.write(recorder.gpu, &list.items);
        recorder.compute("bounds", |pass| {
            for (index, ([x, y], _)) in dispatches.iter().enumerate() {
                let kernel = if index == 0 { &self.cells } else { &self.nodes };
                pass.set_pipeline(&kernel.pipeline);
                pass.set_bind_group(1, &set.group, &[set.params.offset(index as u32)]);
                pass.dispatch_workgroups(*x, *y, 1);
            }
        });
    }
}

/// Workgroups and parameters of each level's dispatch, and the blocks that they list; nothing where there are no cells.
fn plan(size: [u32; 2], addressing: Addressing, cells: &[Region]) -> (BlockList, Vec<([u32; 2], BoundsParams)>) {
    let wrap = u32::from(addressing == Addressing::Wrap);
    let mut regions = cells.to_vec();
    let (mut list, mut dispatches) = (BlockList::default(), Vec::new());
    for level in 1..=level_count(size) {
        let extent = level_size(size, level);
        regions.iter_mut().for_each(|region| *region = region.parents(extent));
        // Far up the regions meet.
        regions.dedup();
        let Some(dispatch) = list.plan(&regions, extent, BoundsPass::WORKGROUP) else { break };
        let (source_size, source_origin) =
            if level == 1 { (size, [0, 0]) } else { (level_size(size, level - 1), level_origin(size, level - 1)) };
        let origin = level_origin(size, level);
        let params = BoundsParams { blocks: dispatch.blocks, source_size, source_origin, size: extent, origin, wrap, pad: 0 };
        dispatches.push((dispatch.workgroups, params));
    }
    (list, dispatches)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_end_with_one_node_and_do_not_overlap() {
        for size in
            [[1, 1], [1, 2], [2, 1], [1, 61], [61, 1], [3, 3], [255, 257], [1000, 640], [1024, 512], [512, 1024], [4096, 4095]]
        {
            let count = level_count(size);
            assert_eq!(level_size(size, count), [1, 1]);
            let whole = texture_size(size);
            let spans: Vec<_> = (1..=count).map(|level| (level_origin(size, level), level_size(size, level))).collect();
            for (index, (origin, extent)) in spans.iter().enumerate() {
                assert!((0..2).all(|axis| origin[axis] + extent[axis] <= whole[axis]), "{size:?}");
                for (other, wide) in &spans[..index] {
                    let apart =
                        (0..2).any(|axis| origin[axis] >= other[axis] + wide[axis] || other[axis] >= origin[axis] + extent[axis]);
                    assert!(apart, "levels of {size:?} overlap");
                }
            }
        }
    }

    #[test]
    fn large_textures_have_three_eighths_of_the_fields_texels() {
        for size in [[512, 512], [1024, 640], [2048, 2048], [4096, 1024]] {
            let [texels, field] = [texture_size(size), size].map(|[width, height]| f64::from(width) * f64::from(height));
            assert!((texels / field - 0.375).abs() < 0.02, "{size:?}: {}", texels / field);
        }
    }
}
