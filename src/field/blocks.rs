//! The blocks of texels that a dispatch covers: what changed, however scattered, in one dispatch.
//!
//! A thousand small changes are a thousand rectangles. A dispatch for each would cost more than the work; the rectangle round them
//! all may be the whole field. So a pass is given the list of the blocks that they touch, each once, and runs a workgroup for each.
//! WGSL: `shaders/common/region.wgsl`.

use super::Region;
use super::bins::tile_workgroups;

/// Which blocks one dispatch covers. Twin of the WGSL struct of this name.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Blocks {
    /// The first of them in the pass's list.
    pub first: u32,
    /// How many they are; 0 for all that there are.
    pub count: u32,
}

/// One dispatch over blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dispatch {
    /// What the shader is told.
    pub blocks: Blocks,
    /// How many workgroups it has.
    pub workgroups: [u32; 2],
    /// Texels of its blocks, those beyond the border counted.
    pub texels: u64,
}

/// The lists of the dispatches of one pass, one after another.
#[derive(Debug, Default)]
pub struct BlockList {
    /// Column and row of each block, 16 bits each.
    pub items: Vec<u32>,
}

impl BlockList {
    /// Room for the lists of any regions of textures of these sizes.
    pub fn capacity(sizes: impl Iterator<Item = [u32; 2]>, block: [u32; 2]) -> usize {
        sizes.map(|size| grid(size, block).iter().product::<u32>() as usize).sum::<usize>().max(1)
    }

    /// Plans the dispatch over the blocks that regions of a texture touch; none where there are no regions.
    pub fn plan(&mut self, regions: &[Region], size: [u32; 2], block: [u32; 2]) -> Option<Dispatch> {
        if regions.is_empty() {
            return None;
        }
        let [columns, rows] = grid(size, block);
        let all = columns * rows;
        let texels_each = u64::from(block[0]) * u64::from(block[1]);
        let whole = Dispatch { blocks: Blocks::default(), workgroups: [columns, rows], texels: u64::from(all) * texels_each };
        if regions.iter().any(|region| 8 * region.area() > 7 * Region::all(size).area()) {
            return Some(whole);
        }
        // A bit a block: in the order of rows, which is that of memory, and each once.
        let mut touched = vec![0_u64; all.div_ceil(64) as usize];
        for region in regions {
            let [low, high] = [region.origin, [0, 1].map(|axis| region.origin[axis] + region.extent[axis] - 1)]
                .map(|corner| [0, 1].map(|axis| corner[axis] / block[axis]));
            for row in low[1]..=high[1] {
                for index in row * columns + low[0]..=row * columns + high[0] {
                    touched[(index / 64) as usize] |= 1 << (index % 64);
                }
            }
        }
        let count = touched.iter().map(|bits| bits.count_ones()).sum::<u32>();
        // Nearly all: an item less to read for each of them.
        if 8 * count > 7 * all {
            return Some(whole);
        }
        let first = self.items.len() as u32;
        for (word, bits) in (0..).zip(touched) {
            let mut left = bits;
            while left != 0 {
                let index = 64 * word + left.trailing_zeros();
                self.items.push((index % columns) | ((index / columns) << 16));
                left &= left - 1;
            }
        }
        let blocks = Blocks { first, count };
        Some(Dispatch { blocks, workgroups: tile_workgroups(count), texels: u64::from(count) * texels_each })
    }
}

/// Columns and rows of blocks.
fn grid(size: [u32; 2], block: [u32; 2]) -> [u32; 2] {
    [0, 1].map(|axis| size[axis].div_ceil(block[axis]))
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn the_blocks_hold_every_texel_of_the_regions_once_and_no_block_in_vain(
            size in (1..200_u32, 1..90_u32),
            regions in prop::collection::vec((0..200_u32, 0..90_u32, 1..30_u32, 1..30_u32), 0..20),
        ) {
            let size = [size.0, size.1];
            let block = [16, 8];
            let regions: Vec<_> = regions
                .into_iter()
                .filter(|region| region.0 < size[0] && region.1 < size[1])
                .map(|(x, y, width, height)| Region { origin: [x, y], extent: [width.min(size[0] - x), height.min(size[1] - y)] })
                .collect();
            let touched: HashSet<_> = regions
                .iter()
                .flat_map(|region| {
                    let [x, y] = region.origin;
                    (y..y + region.extent[1]).flat_map(move |y| (x..x + region.extent[0]).map(move |x| [x / 16, y / 8]))
                })
                .collect();
            let mut list = BlockList { items: vec![7] };
            let Some(dispatch) = list.plan(&regions, size, block) else { prop_assert!(regions.is_empty()); return Ok(()) };
            let listed: Vec<_> = list.items[1..].iter().map(|item| [item & 0xffff, item >> 16]).collect();
            if dispatch.blocks.count == 0 {
                prop_assert_eq!(dispatch.workgroups, [size[0].div_ceil(16), size[1].div_ceil(8)]);
                prop_assert!(listed.is_empty());
            } else {
                prop_assert_eq!(dispatch.blocks, Blocks { first: 1, count: listed.len() as u32 });
                prop_assert_eq!(listed.len(), touched.len());
                prop_assert!(listed.iter().all(|block| touched.contains(block)));
                prop_assert!(listed.len() <= BlockList::capacity(std::iter::once(size), block));
            }
        }
    }
}
