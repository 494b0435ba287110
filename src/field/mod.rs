//! How the height field comes to be: the layers beneath it, what is derived from it, and the contract of every texture.
//!
//! # The contract table
//!
//! Each row is a [`Role`]; [`CONTRACT`] lists them, and `rilievo stress` prints their sum as `field_bytes_per_texel`.
//!
//! | name | format | bytes a texel | holds | writer | readers |
//! |---|---|---|---|---|---|
//! | relief | r32float | 4 | base height with every stamp pressed into it, unclamped | stamp, heal | compose |
//! | material | r32uint | 4 | soot, bare (freshly broken), post, gloss, heat: bits of `material::Marks` | stamp, heal, cool | surface |
//! | wave mask | r8uint | 1 | whether a texel moves, and with which neighbours it exchanges | upload | wave |
//! | wave (two) | r32float | 8 | displacement u at this step and the last, in units of the amplitude | wave | wave, compose |
//! | height | r32float | 4 | the height field, 0 to 1 | compose | normals, pyramid, surface |
//! | normal | rgba16float, mips | 10⅔ | unit normal in field space (u right, v down, out), height; above level 0 their means | normals, normal mips | surface |
//! | pyramid | r32float, mips | 5⅓ | upper bound of the bilinear surface over a node | pyramid | surface |
//!
//! Together 37 bytes a texel. A scene without waves has the wave's rows at 1×1. The bound on the sum is 40. A scene that heals has
//! [`heal::CONTRACT`] besides.

pub mod base;
pub mod bins;
pub mod blocks;
pub mod compose;
pub mod cool;
pub mod dirty;
pub mod groundwork;
pub mod heal;
pub mod material;
pub mod normal_mips;
pub mod normals;
pub mod pyramid;
pub mod region;
pub mod stamp;
pub mod undo;
pub mod wave;

use wgpu::{TextureFormat, TextureUsages};

use crate::gpu::{Contract, Gpu, Role, Texture};
use crate::scene::Addressing;
use crate::surface::albedo_image::{self, AlbedoMap, ColourImage};

pub use dirty::Dirty;
pub use region::Region;

/// How a layer is used that kernels write in place and tests read back.
const LAYER: TextureUsages = TextureUsages::TEXTURE_BINDING
    .union(TextureUsages::STORAGE_BINDING)
    .union(TextureUsages::COPY_DST)
    .union(TextureUsages::COPY_SRC);

macro_rules! roles {
    ($($(#[$doc:meta])* $role:ident = $name:literal, $format:ident, mips $mips:literal, $usage:expr, $content:literal, from $writer:literal, to $readers:literal;)+) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug)]
            pub enum $role {}
            impl Role for $role {
                const CONTRACT: Contract = Contract {
                    name: $name, format: TextureFormat::$format, mips: $mips, content: $content, writer: $writer, readers: $readers, usage: $usage,
                };
            }
        )+
    };
}

roles! {
    /// The base with every stamp pressed into it.
    Relief = "relief", R32Float, mips false, LAYER, "height, unclamped", from "stamp, heal", to "compose";
    /// What stamps leave on the material.
    Material = "material", R32Uint, mips false, LAYER, "bits of material::Marks", from "stamp, heal, cool", to "surface";
    /// What a texel of the waves is free to do.
    WaveMask = "wave mask", R8Uint, mips false, TextureUsages::TEXTURE_BINDING.union(TextureUsages::COPY_DST), "bits of wave::Mask", from "upload", to "wave";
    /// The state of the waves at one step.
    WaveState = "wave", R32Float, mips false, LAYER, "displacement, amplitudes", from "wave", to "wave, compose";
    /// The height field.
    Height = "height", R32Float, mips false, LAYER, "height, 0 to 1", from "compose", to "normals, pyramid, surface";
    /// Its normals and heights, and the means of both over ever larger texels.
    Normal = "normal", Rgba16Float, mips true, LAYER, "normal in field space, height", from "normals, normal mips", to "surface";
    /// Its bounds.
    Pyramid = "pyramid", R32Float, mips true, LAYER, "maximum over a node", from "pyramid", to "surface";
}

/// Every texture of the field, each as often as there are of it.
pub const CONTRACT: &[(Contract, u32)] = &[
    (Relief::CONTRACT, 1),
    (Material::CONTRACT, 1),
    (WaveMask::CONTRACT, 1),
    (WaveState::CONTRACT, 2),
    (Height::CONTRACT, 1),
    (Normal::CONTRACT, 1),
    (Pyramid::CONTRACT, 1),
];

/// Bytes a texel of the field that all its textures take together, at most.
pub fn bytes_per_texel() -> f64 {
    CONTRACT.iter().map(|(contract, count)| contract.bytes_per_texel() * f64::from(*count)).sum()
}

/// The textures of one height field.
pub struct Field {
    /// Width and height, texels.
    pub size: [u32; 2],
    /// What lies beyond the border.
    pub addressing: Addressing,
    /// The base with every stamp pressed into it.
    pub relief: Texture<Relief>,
    /// What stamps leave on the material.
    pub material: Texture<Material>,
    /// What a texel of the waves is free to do; 1×1 without waves.
    pub wave_mask: Texture<WaveMask>,
    /// The waves, two steps of them; 1×1 without waves.
    pub wave: [Texture<WaveState>; 2],
    /// The height field.
    pub height: Texture<Height>,
    /// Its normals.
    pub normal: Texture<Normal>,
    /// Its bounds.
    pub pyramid: Texture<Pyramid>,
    /// The picture over it; one white texel where there is none. Outside of the table: its size is its own.
    pub albedo_map: Texture<AlbedoMap>,
    /// How many texels composition clamped, a count for each tile of [`compose::TILE`]² texels.
    pub clipped: wgpu::Buffer,
}

impl Field {
    /// Makes a field, zero everywhere.
    pub fn new(gpu: &Gpu, size: [u32; 2], addressing: Addressing, with_waves: bool) -> Self {
        let wave_size = if with_waves { size } else { [1, 1] };
        Self {
            size,
            addressing,
            relief: Texture::new(gpu, size),
            material: Texture::new(gpu, size),
            wave_mask: Texture::new(gpu, wave_size),
            wave: [Texture::new(gpu, wave_size), Texture::new(gpu, wave_size)],
            height: Texture::new(gpu, size),
            normal: Texture::new(gpu, size),
            pyramid: Texture::new(gpu, size),
            albedo_map: albedo_image::upload(gpu, &ColourImage::white()),
            clipped: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("clipped"),
                size: u64::from(size[0].div_ceil(compose::TILE)) * u64::from(size[1].div_ceil(compose::TILE)) * 4,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
        }
    }

    /// Bytes of GPU memory that it takes.
    pub fn memory_bytes(&self) -> u64 {
        self.relief.memory_bytes()
            + self.material.memory_bytes()
            + self.wave_mask.memory_bytes()
            + self.wave.iter().map(Texture::memory_bytes).sum::<u64>()
            + self.height.memory_bytes()
            + self.normal.memory_bytes()
            + self.pyramid.memory_bytes()
            + self.albedo_map.memory_bytes()
            + self.clipped.size()
    }
}
