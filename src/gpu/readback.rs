//! Reading the GPU's memory without waiting for it.

use std::sync::{Arc, Mutex};

use super::Gpu;

type Arrival = Arc<Mutex<Option<Result<(), wgpu::BufferAsyncError>>>>;

/// Bytes on their way from the GPU. [`Readback::record_buffer`] or [`Readback::record_texture`] copies them in an encoder;
/// after its submission [`Readback::start`] asks for them, and [`Readback::take`] has them once the device was polled.
pub struct Readback {
    buffer: wgpu::Buffer,
    /// Bytes from row to row in the buffer, and bytes of a row that count.
    rows: Option<(usize, usize)>,
    arrival: Arrival,
}

/// Why bytes did not arrive.
#[derive(Debug, thiserror::Error)]
#[error(
    "the GPU's memory could not be read back ({0}); the device may have been lost: run it again, or choose another with --adapter"
)]
pub struct ReadbackError(String);

impl ReadbackError {
    /// The device says that it is done, but nothing came.
    pub fn missing() -> Self {
        Self("nothing arrived".to_owned())
    }
}

impl Readback {
    /// Records the copy of a buffer's first `bytes`.
    pub fn record_buffer(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, source: &wgpu::Buffer, bytes: u64) -> Self {
        let readback = Self::with_capacity(gpu, bytes, None);
        encoder.copy_buffer_to_buffer(source, 0, &readback.buffer, 0, bytes);
        readback
    }

    /// Records the copy of one level of a texture; the bytes arrive row by row without padding.
    pub fn record_texture(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, source: &wgpu::Texture, level: u32) -> Self {
        let (width, height) = ((source.width() >> level).max(1), (source.height() >> level).max(1));
        // Every texture of ours is uncompressed and of one aspect, for which wgpu knows the size.
        let row = width * source.format().block_copy_size(None).unwrap_or(0);
        let pitch = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let readback = Self::with_capacity(gpu, u64::from(pitch) * u64::from(height), Some((pitch as usize, row as usize)));
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo { mip_level: level, ..source.as_image_copy() },
            wgpu::TexelCopyBufferInfo {
                buffer: &readback.buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(pitch), rows_per_image: Some(height) },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        readback
    }

    fn with_capacity(gpu: &Gpu, size: u64, rows: Option<(usize, usize)>) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, rows, arrival: Arrival::default() }
    }

    /// Asks for the bytes. Call it once, after the submission of the encoder that recorded the copy.
    pub fn start(&self) {
        let arrival = self.arrival.clone();
        self.buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            if let Ok(mut slot) = arrival.lock() {
                *slot = Some(result);
            }
        });
    }

    /// The bytes, if they have arrived: the device must have been polled since the GPU finished.
    ///
    /// # Errors
    ///
    /// The device was lost, or the mapping failed otherwise.
    pub fn take(&self) -> Option<Result<Vec<u8>, ReadbackError>> {
        let arrived = self.arrival.lock().ok()?.take()?;
        Some(self.read(arrived))
    }

    fn read(&self, arrived: Result<(), wgpu::BufferAsyncError>) -> Result<Vec<u8>, ReadbackError> {
        arrived.map_err(|error| ReadbackError(error.to_string()))?;
        let mapped = self.buffer.get_mapped_range(..).map_err(|error| ReadbackError(error.to_string()))?;
        let bytes = match self.rows {
            None => mapped.to_vec(),
            Some((pitch, row)) => mapped.chunks_exact(pitch).flat_map(|line| &line[..row]).copied().collect(),
        };
        drop(mapped);
        self.buffer.unmap();
        Ok(bytes)
    }
}
