//! Textures that know their contract.

use std::marker::PhantomData;

use super::Gpu;

/// What a texture holds: one row of the table in [`crate::field`].
#[derive(Clone, Copy, Debug)]
pub struct Contract {
    /// Its name, in labels and tables.
    pub name: &'static str,
    /// Its format.
    pub format: wgpu::TextureFormat,
    /// Whether it has a full chain of mip levels, of floor sizes.
    pub mips: bool,
    /// Its own texels for each texel of a large field, mip levels apart.
    pub share: f64,
    /// What its channels hold, with units.
    pub content: &'static str,
    /// The pass that writes it.
    pub writer: &'static str,
    /// The passes that read it.
    pub readers: &'static str,
    /// How it may be used.
    pub usage: wgpu::TextureUsages,
}

impl Contract {
    /// Bytes of one texel of the finest level.
    pub fn texel_bytes(&self) -> u32 {
        // Every format of the table is uncompressed and of one aspect, for which wgpu knows the size.
        self.format.block_copy_size(None).unwrap_or(0)
    }

    /// Bytes a texel of the field, its mip levels included (a full chain adds a third).
    pub fn bytes_per_texel(&self) -> f64 {
        f64::from(self.texel_bytes()) * self.share * if self.mips { 4.0 / 3.0 } else { 1.0 }
    }
}

/// The part that a texture plays, which its type carries.
pub trait Role {
    /// The row of the table.
    const CONTRACT: Contract;
}

/// A texture in the role `R`.
pub struct Texture<R: Role> {
    /// The texture.
    pub texture: wgpu::Texture,
    /// All its levels.
    pub view: wgpu::TextureView,
    /// Each level alone.
    pub levels: Vec<wgpu::TextureView>,
    role: PhantomData<R>,
}

impl<R: Role> Texture<R> {
    /// Makes one of this size, zero everywhere.
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let contract = R::CONTRACT;
        let mip_level_count = if contract.mips { mip_level_count(size) } else { 1 };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(contract.name),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: contract.format,
            usage: contract.usage,
            view_formats: &[],
        });
        let levels = (0..mip_level_count)
            .map(|level| {
                texture.create_view(&wgpu::TextureViewDescriptor {
                    label: Some(contract.name),
                    base_mip_level: level,
                    mip_level_count: Some(1),
                    ..Default::default()
                })
            })
            .collect();
        let view = texture.create_view(&wgpu::TextureViewDescriptor { label: Some(contract.name), ..Default::default() });
        Self { texture, view, levels, role: PhantomData }
    }

    /// Width and height of the finest level, texels.
    pub fn size(&self) -> [u32; 2] {
        [self.texture.width(), self.texture.height()]
    }

    /// Overwrites the finest level; `texels` holds `width · height` texels, row by row.
    pub fn write<T: bytemuck::Pod>(&self, gpu: &Gpu, texels: &[T]) {
        self.write_level(gpu, 0, texels);
    }

    /// Overwrites one level; `texels` holds as many as it has, row by row.
    pub fn write_level<T: bytemuck::Pod>(&self, gpu: &Gpu, level: u32, texels: &[T]) {
        let [width, height] = self.size().map(|side| (side >> level).max(1));
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo { mip_level: level, ..self.texture.as_image_copy() },
            bytemuck::cast_slice(texels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(width * R::CONTRACT.texel_bytes()),
                rows_per_image: Some(height),
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
    }

    /// Bytes of memory that it takes, all levels.
    pub fn memory_bytes(&self) -> u64 {
        let [width, height] = self.size();
        (0..self.texture.mip_level_count())
            .map(|level| u64::from((width >> level).max(1)) * u64::from((height >> level).max(1)))
            .sum::<u64>()
            * u64::from(R::CONTRACT.texel_bytes())
    }
}

/// A sampler that does not filter: what gathers go through. Beyond the border it goes on at the opposite one, or stays at the last texel.
pub fn nearest_sampler(gpu: &Gpu, wraps: bool) -> wgpu::Sampler {
    let mode = if wraps { wgpu::AddressMode::Repeat } else { wgpu::AddressMode::ClampToEdge };
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("nearest"),
        address_mode_u: mode,
        address_mode_v: mode,
        ..Default::default()
    })
}

/// Levels of a full chain of floor sizes, down to 1×1.
pub fn mip_level_count(size: [u32; 2]) -> u32 {
    u32::BITS - size[0].max(size[1]).max(1).leading_zeros()
}
