//! Undo: what was under the last strokes of the hand, to be put back to the bit.
//!
//! Before a stroke is pressed the rectangles of relief and material that it may change are copied to buffers; undoing copies them
//! back, the last first. A stroke is all that one press of the button does until it is released. What a simulation or the scene itself
//! did there since goes with it.

use std::collections::VecDeque;

use super::{Dirty, Field, Region};
use crate::gpu::{Gpu, Recorder};

/// The most strokes that are kept.
pub const STROKES_MAX: usize = 32;

/// The most bytes that they take, older ones being forgotten first. A stroke that alone takes more cannot be undone, nor can what was
/// before it.
pub const BYTES_MAX: u64 = 64 << 20;

/// See the module's documentation.
#[derive(Debug, Default)]
pub struct Undo {
    strokes: VecDeque<Kept>,
    /// A stroke too large to keep.
    lost: Option<u64>,
}

/// What was under one stroke.
#[derive(Debug)]
struct Kept {
    number: u64,
    /// In the order in which they were copied.
    copies: Vec<(Region, wgpu::Buffer)>,
    bytes: u64,
}

impl Undo {
    /// How many strokes can be undone.
    pub fn len(&self) -> usize {
        self.strokes.len()
    }

    /// Whether there is nothing to undo.
    pub fn is_empty(&self) -> bool {
        self.strokes.is_empty()
    }

    /// Bytes of GPU memory that the copies take.
    pub fn memory_bytes(&self) -> u64 {
        self.strokes.iter().map(|stroke| stroke.bytes).sum()
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.strokes.clear();
        self.lost = None;
    }

    /// Copies what the stroke of this number is about to change. Strokes come in the order of their numbers, in as many pieces as
    /// there are frames in them.
    pub fn keep(&mut self, recorder: &mut Recorder<'_>, field: &Field, number: u64, dirty: &Dirty) {
        let regions = merged(dirty.regions(field.size));
        let added: u64 = regions.iter().map(|region| 2 * plane_bytes(*region)).sum();
        if self.lost == Some(number) || added == 0 {
            return;
        }
        if self.strokes.back().is_none_or(|stroke| stroke.number != number) {
            self.strokes.push_back(Kept { number, copies: Vec::new(), bytes: 0 });
        }
        while self.strokes.len() > STROKES_MAX || (self.strokes.len() > 1 && self.memory_bytes() + added > BYTES_MAX) {
            self.strokes.pop_front();
        }
        if self.memory_bytes() + added > BYTES_MAX {
            self.strokes.clear();
            self.lost = Some(number);
            return;
        }
        let copies = regions.into_iter().map(|region| (region, copy(recorder, field, region)));
        if let Some(stroke) = self.strokes.back_mut() {
            stroke.copies.extend(copies);
            stroke.bytes += added;
        }
    }

    /// Puts back what was under the last stroke, and says where; nothing where none is kept.
    pub fn undo(&mut self, recorder: &mut Recorder<'_>, field: &Field) -> Dirty {
        let mut dirty = Dirty::Nothing;
        let Some(stroke) = self.strokes.pop_back() else { return dirty };
        for (region, buffer) in stroke.copies.iter().rev() {
            for (texture, offset) in [(&field.relief.texture, 0), (&field.material.texture, plane_bytes(*region))] {
                recorder.encoder.copy_buffer_to_texture(
                    wgpu::TexelCopyBufferInfo { buffer, layout: layout(*region, offset) },
                    place(texture, *region),
                    extent(*region),
                );
            }
            dirty.add(*region, field.size);
        }
        dirty
    }
}

/// A copy of a region of both layers: the relief, then the material.
fn copy(recorder: &mut Recorder<'_>, field: &Field, region: Region) -> wgpu::Buffer {
    let buffer = buffer(recorder.gpu, 2 * plane_bytes(region));
    for (texture, offset) in [(&field.relief.texture, 0), (&field.material.texture, plane_bytes(region))] {
        recorder.encoder.copy_texture_to_buffer(
            place(texture, region),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout: layout(region, offset) },
            extent(region),
        );
    }
    buffer
}

fn buffer(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("under a stroke"),
        size,
        usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn place(texture: &wgpu::Texture, region: Region) -> wgpu::TexelCopyTextureInfo<'_> {
    wgpu::TexelCopyTextureInfo {
        origin: wgpu::Origin3d { x: region.origin[0], y: region.origin[1], z: 0 },
        ..texture.as_image_copy()
    }
}

fn extent(region: Region) -> wgpu::Extent3d {
    wgpu::Extent3d { width: region.extent[0], height: region.extent[1], depth_or_array_layers: 1 }
}

/// Bytes of a row: copies want them in multiples of 256.
fn row_bytes(region: Region) -> u32 {
    (4 * region.extent[0]).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}

/// Bytes of a region of one layer.
fn plane_bytes(region: Region) -> u64 {
    u64::from(row_bytes(region)) * u64::from(region.extent[1])
}

fn layout(region: Region, offset: u64) -> wgpu::TexelCopyBufferLayout {
    wgpu::TexelCopyBufferLayout { offset, bytes_per_row: Some(row_bytes(region)), rows_per_image: None }
}

/// The regions, joined where that takes no more texels: one stroke's stamps lie on top of one another.
fn merged(regions: Vec<Region>) -> Vec<Region> {
    let mut apart: Vec<Region> = Vec::new();
    for mut region in regions {
        while let Some(index) = apart.iter().position(|other| union(*other, region).area() <= other.area() + region.area()) {
            region = union(region, apart.swap_remove(index));
        }
        apart.push(region);
    }
    apart
}

/// The smallest region that holds both.
fn union(a: Region, b: Region) -> Region {
    let end = |region: Region, axis: usize| region.origin[axis] + region.extent[axis];
    let origin = [0, 1].map(|axis| a.origin[axis].min(b.origin[axis]));
    Region { origin, extent: [0, 1].map(|axis| end(a, axis).max(end(b, axis)) - origin[axis]) }
}
