//! Uniforms, one value or a row of them: what is the same for every invocation of a dispatch or a draw.
//!
//! They are read-only storage buffers to WGSL (`var<storage, read>`), not uniform buffers. lavapipe (Mesa 22.3) builds a new shader
//! whenever a uniform buffer decides a branch or a loop and was bound anew: 2 to 15 ms and 2 to 4 MB a frame, which it never
//! frees. Hardware reads both through the same cache.

use std::marker::PhantomData;

use super::Gpu;

/// A uniform of type `T`, whose layout a test compares with its WGSL twin.
pub struct Uniform<T> {
    /// The buffer.
    pub buffer: wgpu::Buffer,
    value: PhantomData<T>,
}

impl<T: bytemuck::Pod> Uniform<T> {
    /// Makes one, zero.
    pub fn new(gpu: &Gpu, label: &str) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: size_of::<T>() as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, value: PhantomData }
    }

    /// Sets it for the next submission.
    pub fn write(&self, gpu: &Gpu, value: &T) {
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(value));
    }
}

/// A row of uniforms of type `T`, bound one at a time by a dynamic offset: what varies between the dispatches of one pass.
pub struct UniformSlots<T> {
    /// The buffer.
    pub buffer: wgpu::Buffer,
    stride: u32,
    capacity: u32,
    value: PhantomData<T>,
}

impl<T: bytemuck::Pod> UniformSlots<T> {
    /// Makes a row of `capacity` slots, zero.
    pub fn new(gpu: &Gpu, label: &str, capacity: u32) -> Self {
        let alignment = gpu.device.limits().min_storage_buffer_offset_alignment;
        let stride = (size_of::<T>() as u32).next_multiple_of(alignment);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: u64::from(stride) * u64::from(capacity),
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, stride, capacity, value: PhantomData }
    }

    /// How many slots there are.
    pub fn capacity(&self) -> u32 {
        self.capacity
    }

    /// Sets the first slots for the next submission. Values beyond the capacity are a programming error and are not written.
    pub fn write(&self, gpu: &Gpu, values: &[T]) {
        debug_assert!(values.len() <= self.capacity as usize, "{} values in {} slots", values.len(), self.capacity);
        let mut bytes = vec![0; values.len().min(self.capacity as usize) * self.stride as usize];
        for (slot, value) in bytes.chunks_exact_mut(self.stride as usize).zip(values) {
            slot[..size_of::<T>()].copy_from_slice(bytemuck::bytes_of(value));
        }
        gpu.queue.write_buffer(&self.buffer, 0, &bytes);
    }

    /// The dynamic offset of a slot.
    pub fn offset(&self, slot: u32) -> u32 {
        slot * self.stride
    }

    /// What a bind group binds: one slot.
    pub fn binding(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.buffer,
            offset: 0,
            size: wgpu::BufferSize::new(size_of::<T>() as u64),
        })
    }
}
