//! The images that stamps may have for their form, beside one another in one texture.

use crate::gpu::Gpu;

/// An image whose values, row by row, are a profile: 0 leaves the layer alone, 1 is the stamp's full height.
#[derive(Clone, Debug, PartialEq)]
pub struct StampImage {
    /// Width and height, texels.
    pub size: [u32; 2],
    /// `width · height` values.
    pub values: Vec<f32>,
}

impl StampImage {
    /// The longest side of one, texels: sixteen stand beside one another in a texture that every adapter has.
    pub const SIDE_MAX: u32 = 1024;

    /// The most there may be.
    pub const COUNT_MAX: usize = 8;
}

/// Images on the GPU: r32float, one below the other. Outside of the contract table: its size is its own.
pub struct StampImages {
    /// All of them.
    pub view: wgpu::TextureView,
    /// Origin and size of each.
    places: Vec<[[u32; 2]; 2]>,
}

impl StampImages {
    /// Uploads them; without any there is one texel of 0.
    pub fn new(gpu: &Gpu, images: &[StampImage]) -> Self {
        let mut places: Vec<[[u32; 2]; 2]> = Vec::new();
        let (mut width, mut height) = (1, 0);
        for image in images {
            places.push([[0, height], image.size]);
            width = width.max(image.size[0]);
            height += image.size[1];
        }
        let extent = wgpu::Extent3d { width, height: height.max(1), depth_or_array_layers: 1 };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("stamp images"),
            size: extent,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for (image, [origin, [width, height]]) in images.iter().zip(&places) {
            gpu.queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &texture,
                    mip_level: 0,
                    origin: wgpu::Origin3d { x: origin[0], y: origin[1], z: 0 },
                    aspect: wgpu::TextureAspect::All,
                },
                bytemuck::cast_slice(&image.values),
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None },
                wgpu::Extent3d { width: *width, height: *height, depth_or_array_layers: 1 },
            );
        }
        Self { view: texture.create_view(&wgpu::TextureViewDescriptor::default()), places }
    }

    /// Origin and size of an image, if there are so many.
    pub fn place(&self, number: u32) -> Option<[[u32; 2]; 2]> {
        self.places.get(number as usize).copied()
    }

    /// Width over height of an image, if there are so many.
    pub fn aspect(&self, number: u32) -> Option<f32> {
        self.place(number).map(|[_, [width, height]]| width as f32 / height as f32)
    }

    /// Bytes of GPU memory that they take.
    pub fn memory_bytes(&self) -> u64 {
        let texture = self.view.texture();
        4 * u64::from(texture.width()) * u64::from(texture.height())
    }
}
