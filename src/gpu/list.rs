//! Storage buffers that hold a list, of another length every frame.

use std::marker::PhantomData;

use super::Gpu;

/// A list of `T` that shaders read, whose layout a test compares with its WGSL twin.
pub struct List<T> {
    /// The buffer.
    pub buffer: wgpu::Buffer,
    label: &'static str,
    capacity: usize,
    item: PhantomData<T>,
}

impl<T: bytemuck::Pod> List<T> {
    /// Makes one with room for `capacity` items.
    pub fn new(gpu: &Gpu, label: &'static str, capacity: usize) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: (capacity * size_of::<T>()) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, label, capacity, item: PhantomData }
    }

    /// Makes room for so many items. If that took another buffer the answer is true, and its bind groups must be made anew: it
    /// doubles, so that a stress test settles within a few frames.
    #[must_use]
    pub fn reserve(&mut self, gpu: &Gpu, count: usize) -> bool {
        let grows = count > self.capacity;
        if grows {
            let limit = Self::limit(gpu) as usize;
            *self = Self::new(gpu, self.label, count.next_power_of_two().min(limit).max(count));
        }
        grows
    }

    /// The most items that this adapter can bind.
    pub fn limit(gpu: &Gpu) -> u64 {
        gpu.device.limits().max_storage_buffer_binding_size / size_of::<T>() as u64
    }

    /// Bytes of GPU memory.
    pub fn memory_bytes(&self) -> u64 {
        self.buffer.size()
    }

    /// Sets the first items for the next submission; there must be room.
    pub fn write(&self, gpu: &Gpu, items: &[T]) {
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(items));
    }
}
