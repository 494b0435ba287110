//! How the height field comes to be: the layers beneath it, what is derived from it, and the contract of every texture.
//!
//! # The contract table
//!
//! Each row is a [`Role`]; [`CONTRACT`] lists those of every field, [`SOURCE_CONTRACTS`] what each source adds, and `rilievo stress`
//! prints the sum of a scene's stack as `field_bytes_per_texel`.
//!
//! | name | format | bytes a texel | holds | writer | readers |
//! |---|---|---|---|---|---|
//! | relief | r32float | 4 | base height with every stamp pressed into it, unclamped | stamp, heal | compose |
//! | material | r32uint | 4 | soot, bare (freshly broken), post, gloss, heat: bits of `material::Marks` | stamp, heal, cool | surface |
//! | height | r32float | 4 | the height field, 0 to 1 | compose | normals, pyramid, bounds, surface |
//! | normal | rgba16float, mips | 10⅔ | unit normal in field space (u right, v down, out), height; above level 0 their means | normals, normal mips | surface |
//! | pyramid | r32float, mips | 5⅓ | upper bound of the bilinear surface over a node | pyramid | surface |
//! | bounds | r32float | 1½ | both ends of the range of the bilinear surface over a node, levels side by side | bounds | surface |
//! | | | | *29½ in every field* | | |
//! | noise | r32float | 4 | height of the pattern, 0 to 1 | noise | compose |
//! | | | | *4 more with noise* | | |
//! | sequence | r32float | 4 | heights of the images, 0 to 1 | upload | compose |
//! | | | | *4 more with sequence* | | |
//! | water bed | r32float | 4 | height of what the water flows over, unclamped | compose | shallow water |
//! | water depth (two) | rg32float | 16 | depth in metres, share of foam; in buffers | shallow water | shallow water |
//! | water flow (two) | rg32float | 16 | depth times velocity, m²/s; in buffers | shallow water | shallow water |
//! | water surface | r32float | 4 | height of the water, or of the bed where there is none, unclamped | shallow water | compose |
//! | | | | *40 more with shallow water* | | |
//! | wave mask | r8uint | 1 | whether a texel moves, and with which neighbours it exchanges | upload | wave |
//! | wave (two) | r32float | 8 | displacement u at this step and the last, in units of the amplitude | wave | wave, compose |
//! | | | | *9 more with wave* | | |
//! | gas | r32float | 4 | density, in units of the amplitude | gas | compose |
//! | gas velocity (three) | rg32float | 24 | m/s at the western and northern face of a cell; in buffers | gas | gas |
//! | gas carried (three) | rgba32float | 48 | leading velocity, density, dye; in buffers | gas | gas |
//! | gas pressure | r32float | 4 | p of the projection; in a buffer | gas | gas |
//! | gas coarser | r32float | 4 | p, b, q of coarser levels, a third of 12; in buffers | gas | gas |
//! | | | | *84 more with gas* | | |
//!
//! What a gas holds in buffers it holds for each of its cells; one may cover several texels. See [`gas`].
//!
//! A field that a simulation covers for its albedo has a row more: cover, rgba16float, 8 bytes a texel, 1×1 elsewhere. The bound on
//! a still field, and on one with waves, is 40.
//! A surface that heals has [`heal::CONTRACT`] besides.

pub mod base;
pub mod bins;
pub mod blocks;
pub mod bounds;
pub mod compose;
pub mod cool;
pub mod derive;
pub mod dirty;
pub mod gas;
pub mod gas_activity;
pub mod gas_advect;
pub mod gas_bands;
pub mod gas_emit;
pub mod gas_force;
pub mod gas_project;
pub mod gas_show;
pub mod gas_source;
pub mod groundwork;
pub mod heal;
pub mod material;
pub mod noise;
pub mod normal_mips;
pub mod normals;
pub mod pyramid;
pub mod region;
pub mod sequence;
pub mod shallow_water;
pub mod source;
pub mod stack;
pub mod stamp;
pub mod undo;
pub mod wave;

use wgpu::TextureUsages;

use crate::gpu::{Contract, Gpu, Role, Texture};
use crate::scene::Addressing;
use crate::surface::albedo_image::{self, AlbedoMap, ColourImage};

pub use dirty::Dirty;
pub use region::Region;
pub use stack::Stack;

/// How a layer is used that kernels write in place and tests read back.
pub(crate) const LAYER: TextureUsages = TextureUsages::TEXTURE_BINDING
    .union(TextureUsages::STORAGE_BINDING)
    .union(TextureUsages::COPY_DST)
    .union(TextureUsages::COPY_SRC);

/// Declares the roles of textures, each a type that carries its row of the table.
macro_rules! roles {
    ($($(#[$doc:meta])* $role:ident = $name:literal, $format:ident, mips $mips:literal, $usage:expr, $content:literal, from $writer:literal, to $readers:literal;)+) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug)]
            pub enum $role {}
            impl $crate::gpu::Role for $role {
                const CONTRACT: $crate::gpu::Contract = $crate::gpu::Contract {
                    name: $name, format: wgpu::TextureFormat::$format, mips: $mips, share: 1.0, content: $content, writer: $writer, readers: $readers, usage: $usage,
                };
            }
        )+
    };
}
pub(crate) use roles;

roles! {
    /// The base with every stamp pressed into it.
    Relief = "relief", R32Float, mips false, LAYER, "height, unclamped", from "stamp, heal", to "compose";
    /// What stamps leave on the material.
    Material = "material", R32Uint, mips false, LAYER, "bits of material::Marks", from "stamp, heal, cool", to "surface";
    /// The height field.
    Height = "height", R32Float, mips false, LAYER, "height, 0 to 1", from "compose", to "normals, pyramid, bounds, surface";
    /// Its normals and heights, and the means of both over ever larger texels.
    Normal = "normal", Rgba16Float, mips true, LAYER, "normal in field space, height", from "normals, normal mips", to "surface";
    /// Its bounds.
    Pyramid = "pyramid", R32Float, mips true, LAYER, "maximum over a node", from "pyramid", to "surface";
    /// What a simulation lays over the surface, for its albedo.
    Cover = "cover", Rgba16Float, mips false, LAYER, "what the albedo takes it for: see the simulation", from "simulation", to "surface";
}

/// Between which heights it lies over ever larger nodes.
#[derive(Clone, Copy, Debug)]
pub enum Bounds {}

impl Role for Bounds {
    const CONTRACT: Contract = Contract {
        name: "bounds",
        format: wgpu::TextureFormat::R32Float,
        mips: false,
        // Its levels side by side: see bounds::texture_size.
        share: 0.375,
        content: "range of heights over a node",
        writer: "bounds",
        readers: "surface",
        usage: LAYER,
    };
}

/// The textures that every field has, each as often as there are of it.
pub const CONTRACT: &[(Contract, u32)] = &[
    (Relief::CONTRACT, 1),
    (Material::CONTRACT, 1),
    (Height::CONTRACT, 1),
    (Normal::CONTRACT, 1),
    (Pyramid::CONTRACT, 1),
    (Bounds::CONTRACT, 1),
];

/// What each kind of source adds to them.
pub const SOURCE_CONTRACTS: &[(&str, &[(Contract, u32)])] = &[
    ("noise", noise::CONTRACT),
    ("sequence", sequence::CONTRACT),
    ("gas", gas_source::CONTRACT),
    ("shallow water", shallow_water::CONTRACT),
    ("wave", wave::CONTRACT),
];

/// Bytes a texel of the field that textures take together.
pub fn bytes_per_texel<'a>(contract: impl IntoIterator<Item = &'a (Contract, u32)>) -> f64 {
    contract.into_iter().map(|(contract, count)| contract.bytes_per_texel() * f64::from(*count)).sum()
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
    /// The height field.
    pub height: Texture<Height>,
    /// Its normals.
    pub normal: Texture<Normal>,
    /// Its bounds.
    pub pyramid: Texture<Pyramid>,
    /// The ranges of its heights.
    pub bounds: Texture<Bounds>,
    /// What a simulation lays over it; 1×1 where none does.
    pub cover: Texture<Cover>,
    /// The picture over it; one white texel where there is none. Outside of the table: its size is its own.
    pub albedo_map: Texture<AlbedoMap>,
    /// How many texels composition clamped, a count for each tile of [`compose::TILE`]² texels.
    pub clipped: wgpu::Buffer,
}

impl Field {
    /// Makes a field, zero everywhere, with or without a cover.
    pub fn new(gpu: &Gpu, size: [u32; 2], addressing: Addressing, covered: bool) -> Self {
        Self {
            size,
            addressing,
            relief: Texture::new(gpu, size),
            material: Texture::new(gpu, size),
            height: Texture::new(gpu, size),
            normal: Texture::new(gpu, size),
            pyramid: Texture::new(gpu, size),
            bounds: Texture::new(gpu, bounds::texture_size(size)),
            cover: Texture::new(gpu, if covered { size } else { [1, 1] }),
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
            + self.height.memory_bytes()
            + self.normal.memory_bytes()
            + self.pyramid.memory_bytes()
            + self.bounds.memory_bytes()
            + self.cover.memory_bytes()
            + self.albedo_map.memory_bytes()
            + self.clipped.size()
    }
}
