//! Stamp: presses profiles (craters, discs, cones, bumps) into the relief and its material, thousands a frame.
//!
//! Reads and writes in place, in the tiles that a stamp touches: 8 bytes a texel each way. The CPU bins the stamps into tiles
//! ([`Bins`]), one workgroup a touched tile gathers its own in the order of submission.
//! Shader: `shaders/field/stamp.wgsl`. Specification: [`crate::reference::stamp`].

mod form;
mod images;

use bytemuck::{Pod, Zeroable};

use super::bins::{BinError, Bins, Ground, Member, Tile, tile_workgroups};
use super::{Dirty, Field, material};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, List, Recorder, ShaderError, UniformSlots};
use crate::scene::Addressing;

/// Bytes a texel of a touched tile by design: relief and material in and out.
pub const TEXEL_BYTES: u64 = 16;

pub use form::{Blend, CRATER_GRAIN, CRATER_LIP, CRATER_RIM, ImageForm, Profile, RUT_FLOOR, RUT_RIM, Stamp};
pub use images::{StampImage, StampImages};

/// What the shader needs of any stamp besides its disc. Fields are those of [`Stamp`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[expect(missing_docs, reason = "the WGSL twin documents the fields, and one place is enough")]
pub struct StampRecord {
    pub height: f32,
    pub level: f32,
    pub alpha: f32,
    pub profile: u32,
    pub blend: u32,
}

impl From<&Stamp> for StampRecord {
    fn from(stamp: &Stamp) -> Self {
        let Stamp { height, level, alpha, profile, blend, .. } = *stamp;
        Self { height, level, alpha, profile: profile as u32, blend: blend as u32 }
    }
}

/// What the shader needs besides of a stamp that is not plain.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[expect(missing_docs, reason = "the WGSL twin documents the fields, and one place is enough")]
pub struct StampExtra {
    pub phase: [f32; 2],
    pub span: [f32; 2],
    pub joins: [f32; 2],
    pub axis: [f32; 2],
    pub half_extent: [f32; 2],
    pub image_origin: [u32; 2],
    pub image_size: [u32; 2],
    pub irregularity: f32,
    pub soot: f32,
    pub bare: f32,
    pub gloss: f32,
    pub heat: f32,
    pub moment: f32,
    pub along: f32,
    pub tread: f32,
    pub lugs_per_texel: f32,
    pub spare: f32,
}

impl StampExtra {
    /// Angles become unit vectors: the shader needs no trigonometry, whose precision WGSL leaves open.
    fn new(stamp: &Stamp, images: &StampImages, cooling_seconds: f64) -> Self {
        let unit = |angle: f32| [f64::from(angle).cos() as f32, f64::from(angle).sin() as f32];
        // Where there is no such image the profile serves.
        let image = stamp.image.and_then(|form| Some((form, images.place(form.number)?)));
        let (half_extent, [image_origin, image_size]) =
            image.map_or(([0.0; 2], [[0; 2]; 2]), |(form, place)| (form.half_extent, place));
        let lugs_per_texel = if stamp.tread > 0.0 { 1.0 / stamp.lug_texels.max(1e-3) } else { 0.0 };
        Self {
            phase: unit(stamp.phase),
            span: stamp.span,
            joins: if stamp.blend == Blend::Add { stamp.joins } else { [0.0; 2] },
            axis: unit(stamp.image.map_or(0.0, |form| form.turn)),
            half_extent,
            image_origin,
            image_size,
            irregularity: stamp.irregularity,
            soot: stamp.soot,
            bare: stamp.bare,
            gloss: stamp.gloss,
            heat: stamp.heat,
            moment: material::moment(stamp.at_seconds, cooling_seconds),
            // The count of lugs before it does not matter, and would cost precision.
            along: (f64::from(stamp.along) * f64::from(lugs_per_texel)).fract() as f32,
            tread: stamp.tread,
            lugs_per_texel,
            spare: 0.0,
        }
    }
}

/// Uniforms of the pass.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct StampParams {
    /// Size of the field, texels.
    pub size: [u32; 2],
    /// Number of touched tiles.
    pub tile_count: u32,
    /// The first of them.
    pub first_tile: u32,
}

/// Presses stamps.
pub struct Stamps {
    /// For stamps that are round and leave the material alone, all of them.
    plain: Kernel,
    /// For any that are round.
    round: Kernel,
    /// For any.
    any: Kernel,
    layout: BindingLayout,
}

/// The bindings of one field, and the lists of a frame's stamps.
pub struct StampSet {
    /// In how many seconds what glows falls to 1/e.
    pub cooling_seconds: f64,
    ground: Ground,
    bins: Bins,
    records: Vec<StampRecord>,
    extras: Vec<StampExtra>,
    buffers: Buffers,
    layers: [wgpu::TextureView; 2],
    images: StampImages,
    group: wgpu::BindGroup,
}

struct Buffers {
    params: UniformSlots<StampParams>,
    tiles: List<Tile>,
    members: List<Member>,
    records: List<StampRecord>,
    extras: List<StampExtra>,
}

/// The stamps of one call, in a dispatch for each of their parts, which are pressed one after another.
pub struct Pressing {
    kernel: Kind,
    /// First tile and number of tiles of each part.
    parts: Vec<[u32; 2]>,
    /// What each changes.
    dirty: Vec<Dirty>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Plain,
    Round,
    Any,
}

impl Pressing {
    /// The texels that a part may change.
    pub fn dirty(&self, part: usize) -> &Dirty {
        &self.dirty[part]
    }
}

impl StampSet {
    /// Texels of the tiles that the last stamps touched, a tile at the border counted whole.
    pub fn touched_texels(&self) -> u64 {
        self.bins.tiles.len() as u64 * self.ground.tile.map(u64::from).iter().product::<u64>()
    }

    /// Column and row of every tile that a part touches.
    pub fn tiles(&self, pressing: &Pressing, part: usize) -> impl Iterator<Item = [u32; 2]> {
        let [first, count] = pressing.parts[part].map(|number| number as usize);
        self.bins.tiles[first..first + count].iter().map(|tile| tile.tile)
    }

    /// Bytes of GPU memory of its lists, and of the images.
    pub fn memory_bytes(&self) -> u64 {
        let Buffers { params: _, tiles, members, records, extras } = &self.buffers;
        let lists = tiles.memory_bytes() + members.memory_bytes() + records.memory_bytes() + extras.memory_bytes();
        lists + self.images.memory_bytes()
    }

    /// The images that stamps may have for their form.
    pub fn images(&self) -> &StampImages {
        &self.images
    }
}

impl Stamps {
    /// Width and height of a tile, texels: one workgroup, of which each invocation takes four texels of a column. Smaller tiles
    /// gather fewer stamps that miss most of them.
    pub const TILE: [u32; 2] = [16, 8];

    /// The WGSL that it is made of.
    pub const PARTS: [&str; 5] = ["common/noise", "common/material", "common/profile", "common/marks", "field/stamp"];

    /// Builds the pipelines.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        let in_place = wgpu::StorageTextureAccess::ReadWrite;
        let layout = BindingLayout::new(
            gpu,
            "stamp",
            wgpu::ShaderStages::COMPUTE,
            &[
                Binding::UniformSlot,
                Binding::Storage(wgpu::TextureFormat::R32Float, in_place),
                Binding::Storage(wgpu::TextureFormat::R32Uint, in_place),
                Binding::Read,
                Binding::Read,
                Binding::Read,
                Binding::Read,
                Binding::Float(false),
            ],
        );
        // Three kernels, since a branch that no texel takes still costs a software adapter all that it skips.
        let kernel = |plain: bool, forms: bool| {
            let constants = [
                ("STAMP_TILE_X", f64::from(Self::TILE[0])),
                ("STAMP_TILE_Y", f64::from(Self::TILE[1])),
                ("STAMP_RIM_SQUARED", CRATER_RIM * CRATER_RIM),
                ("STAMP_LIP", CRATER_LIP),
                ("STAMP_RUT_FLOOR_SQUARED", RUT_FLOOR * RUT_FLOOR),
                ("STAMP_RUT_RIM_SQUARED", RUT_RIM * RUT_RIM),
                ("STAMP_GRAIN", CRATER_GRAIN),
                ("STAMP_PLAIN", f64::from(u8::from(plain))),
                ("STAMP_FORMS", f64::from(u8::from(forms))),
            ];
            let constants = [&constants[..], &material::CONSTANTS].concat();
            Kernel::new(gpu, "stamp", &Self::PARTS, "stamp_press", &constants, &[None, Some(&layout)])
        };
        let (plain, round, any) = (kernel(true, false)?, kernel(false, false)?, kernel(false, true)?);
        Ok(Self { plain, round, any, layout })
    }

    /// Binds a field, and the images that its stamps may have.
    pub fn bind(&self, gpu: &Gpu, field: &Field, images: &[StampImage]) -> StampSet {
        // Room for a few shots; a stress test makes more.
        let buffers = Buffers {
            params: UniformSlots::new(gpu, "stamp", 8),
            tiles: List::new(gpu, "stamp tiles", 256),
            members: List::new(gpu, "stamp members", 256),
            records: List::new(gpu, "stamps", 64),
            extras: List::new(gpu, "stamps' extras", 64),
        };
        let images = StampImages::new(gpu, images);
        let layers = [field.relief.view.clone(), field.material.view.clone()];
        let group = self.group(gpu, &layers, &images, &buffers);
        let ground = Ground { size: field.size, wrap: field.addressing == Addressing::Wrap, tile: Self::TILE };
        let (records, extras) = (Vec::new(), Vec::new());
        StampSet { cooling_seconds: 1.0, ground, bins: Bins::default(), records, extras, buffers, layers, images, group }
    }

    fn group(
        &self,
        gpu: &Gpu,
        [relief, material]: &[wgpu::TextureView; 2],
        images: &StampImages,
        buffers: &Buffers,
    ) -> wgpu::BindGroup {
        self.layout.bind(
            gpu,
            &[
                buffers.params.binding(),
                wgpu::BindingResource::TextureView(relief),
                wgpu::BindingResource::TextureView(material),
                buffers.tiles.buffer.as_entire_binding(),
                buffers.members.buffer.as_entire_binding(),
                buffers.records.buffer.as_entire_binding(),
                buffers.extras.buffer.as_entire_binding(),
                wgpu::BindingResource::TextureView(&images.view),
            ],
        )
    }

    /// Presses the stamps in order, and says which texels they may have changed.
    ///
    /// # Errors
    ///
    /// They touch more tiles than a buffer of the adapter holds; then none is pressed.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &mut StampSet, stamps: &[Stamp]) -> Result<Dirty, BinError> {
        let pressing = self.prepare(recorder.gpu, set, &[stamps])?;
        self.press(recorder, set, &pressing, 0);
        Ok(pressing.dirty.into_iter().next().unwrap_or_default())
    }

    /// Bins and uploads stamps in several parts, so that others can work on the layers in between. One call serves one submission.
    ///
    /// # Errors
    ///
    /// They touch more tiles than a buffer of the adapter holds.
    pub fn prepare(&self, gpu: &Gpu, set: &mut StampSet, parts: &[&[Stamp]]) -> Result<Pressing, BinError> {
        let limit = List::<Member>::limit(gpu).min(List::<Tile>::limit(gpu));
        let stamps = || parts.iter().copied().flatten();
        let kernel = match () {
            () if stamps().all(Stamp::is_plain) => Kind::Plain,
            () if stamps().any(Stamp::has_form) => Kind::Any,
            () => Kind::Round,
        };
        let records = List::<StampRecord>::limit(gpu);
        BinError::check(
            stamps().count(),
            if kernel == Kind::Plain { records } else { List::<StampExtra>::limit(gpu).min(records) },
        )?;
        let mut pressing = Pressing { kernel, parts: Vec::new(), dirty: Vec::new() };
        set.bins.clear();
        set.records.clear();
        set.extras.clear();
        for stamps in parts {
            let batch = set.bins.add(set.ground, stamps.iter().map(Stamp::capsule), limit)?;
            pressing.parts.push([batch.first_tile, batch.tile_count]);
            pressing.dirty.push(batch.dirty);
        }
        if !set.bins.tiles.is_empty() {
            set.records.extend(stamps().map(StampRecord::from));
            if pressing.kernel != Kind::Plain {
                set.extras.extend(stamps().map(|stamp| StampExtra::new(stamp, &set.images, set.cooling_seconds)));
            }
            self.upload(gpu, set, &pressing.parts);
        }
        Ok(pressing)
    }

    /// Presses one part.
    pub fn press(&self, recorder: &mut Recorder<'_>, set: &StampSet, pressing: &Pressing, part: usize) {
        let [_, tile_count] = pressing.parts[part];
        if tile_count == 0 {
            return;
        }
        let kernel = match pressing.kernel {
            Kind::Plain => &self.plain,
            Kind::Round => &self.round,
            Kind::Any => &self.any,
        };
        recorder.compute("stamp", |pass| {
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(1, &set.group, &[set.buffers.params.offset(part as u32)]);
            let [x, y] = tile_workgroups(tile_count);
            pass.dispatch_workgroups(x, y, 1);
        });
    }

    fn upload(&self, gpu: &Gpu, set: &mut StampSet, parts: &[[u32; 2]]) {
        let buffers = &mut set.buffers;
        let grown = [
            buffers.tiles.reserve(gpu, set.bins.tiles.len()),
            buffers.members.reserve(gpu, set.bins.members.len()),
            buffers.records.reserve(gpu, set.records.len()),
            buffers.extras.reserve(gpu, set.extras.len()),
            parts.len() > buffers.params.capacity() as usize,
        ];
        if grown[4] {
            buffers.params = UniformSlots::new(gpu, "stamp", (parts.len() as u32).next_power_of_two());
        }
        let size = set.ground.size;
        let params: Vec<_> = parts.iter().map(|&[first_tile, tile_count]| StampParams { size, tile_count, first_tile }).collect();
        buffers.params.write(gpu, &params);
        buffers.tiles.write(gpu, &set.bins.tiles);
        buffers.members.write(gpu, &set.bins.members);
        buffers.records.write(gpu, &set.records);
        buffers.extras.write(gpu, &set.extras);
        if grown.contains(&true) {
            set.group = self.group(gpu, &set.layers, &set.images, &set.buffers);
        }
    }
}
