//! Stamp: presses profiles (craters, discs, cones, bumps) into the relief and its material, thousands a frame.
//!
//! Reads and writes in place, in the tiles that a stamp touches: 8 bytes a texel each way. The CPU bins the stamps into tiles
//! ([`Bins`]), one workgroup a touched tile gathers its own in the order of submission.
//! Shader: `shaders/field/stamp.wgsl`. Specification: [`crate::reference::stamp`].

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

use super::bins::{BinError, Bins, Disc, Ground, Member, Tile, tile_workgroups};
use super::{Dirty, Field};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, List, Recorder, ShaderError, Uniform};
use crate::scene::Addressing;

/// Bytes a texel of a touched tile by design: relief and material in and out.
pub const TEXEL_BYTES: u64 = 16;

/// The form of a stamp: its profile p over ρ, the distance from its centre in radii. Each is 0 from ρ = 1 on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum Profile {
    /// 1 everywhere, with a hard edge.
    Disc = 0,
    /// 1 − ρ.
    Cone = 1,
    /// (1 − ρ²)², smooth everywhere.
    #[default]
    Bump = 2,
    /// A bowl of depth 1 with a bore down its middle, its rim at ρ = [`CRATER_RIM`], the rim's lip [`CRATER_LIP`] high; slopes are
    /// continuous.
    Crater = 3,
}

impl Profile {
    /// Every profile.
    pub const ALL: [Self; 4] = [Self::Disc, Self::Cone, Self::Bump, Self::Crater];

    /// The integral of the profile over its disc, in units of the squared radius.
    pub fn volume(self) -> f64 {
        use std::f64::consts::PI;
        match self {
            Self::Disc => PI,
            Self::Cone | Self::Bump => PI / 3.0,
            // With s = ρ², dA = π ds. Over 0..1 the bowl's x²(3 − 2x) is 1/2, the bore's 1 − (1 − x)⁶ is 6/7, the mean of the two
            // 19/28; the flank's (1 − y)⁴(1 + 4y) is 1/3.
            Self::Crater => {
                let (rim, lip) = (CRATER_RIM * CRATER_RIM, CRATER_LIP);
                PI * (rim * ((1.0 + lip) * 19.0 / 28.0 - 1.0) + (1.0 - rim) * lip / 3.0)
            }
        }
    }
}

/// Radius of a crater's rim, in radii of its stamp. What lies beyond is the lip's flank and the soot.
pub const CRATER_RIM: f64 = 0.5;

/// Height of a crater's lip, in depths of its bowl.
pub const CRATER_LIP: f64 = 0.1;

/// How far grains of the broken material stand out of an irregular crater or lack in it, in depths of its bowl: a texel each, whatever
/// its size.
pub const CRATER_GRAIN: f64 = 0.06;

/// How a stamp meets what is there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum Blend {
    /// layer + height·p.
    #[default]
    Add = 0,
    /// The lower of the layer and level + height·p.
    Min = 1,
    /// The higher of the layer and level + height·p.
    Max = 2,
    /// Mixes the layer toward level + height·p, by alpha.
    Replace = 3,
}

impl Blend {
    /// Every blend.
    pub const ALL: [Self; 4] = [Self::Add, Self::Min, Self::Max, Self::Replace];
}

/// One stamp.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stamp {
    /// Its centre, lattice coordinates.
    pub centre: [f32; 2],
    /// Radius beyond which it changes nothing, texels.
    pub radius: f32,
    /// What its profile is multiplied by, in heights. A crater's depth.
    pub height: f32,
    /// From which height min, max and replace count.
    pub level: f32,
    /// Its form.
    pub profile: Profile,
    /// How it meets what is there.
    pub blend: Blend,
    /// How much of the layer it replaces, 0 to 1.
    pub alpha: f32,
    /// How far its form departs from a circle: 0 none, 1 by up to half its radius. An irregular crater has grains in it, too.
    pub irregularity: f32,
    /// Which of the irregular forms, radians.
    pub phase: f32,
    /// How black the soot is that it lays, 0 to 1.
    pub soot: f32,
    /// How bare it lays the material within, 0 to 1.
    pub bare: f32,
}

impl Default for Stamp {
    fn default() -> Self {
        Self {
            centre: [0.0, 0.0],
            radius: 8.0,
            height: 0.1,
            level: 0.0,
            profile: Profile::default(),
            blend: Blend::default(),
            alpha: 1.0,
            irregularity: 0.0,
            phase: 0.0,
            soot: 0.0,
            bare: 0.0,
        }
    }
}

impl Stamp {
    /// The disc outside which it changes nothing.
    pub const fn disc(&self) -> Disc {
        Disc { centre: self.centre, radius: self.radius }
    }

    /// Whether it is round and leaves the material alone.
    fn is_plain(&self) -> bool {
        self.irregularity == 0.0 && self.soot == 0.0 && self.bare == 0.0
    }
}

/// What the shader needs of a stamp besides its disc.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct StampRecord {
    /// [`Stamp::height`].
    pub height: f32,
    /// [`Stamp::level`].
    pub level: f32,
    /// [`Stamp::alpha`].
    pub alpha: f32,
    /// [`Stamp::irregularity`].
    pub irregularity: f32,
    /// [`Stamp::phase`] as a unit complex number: the shader needs no trigonometry, whose precision WGSL leaves open.
    pub phase: [f32; 2],
    /// [`Stamp::soot`].
    pub soot: f32,
    /// [`Stamp::bare`].
    pub bare: f32,
    /// [`Stamp::profile`].
    pub profile: u32,
    /// [`Stamp::blend`].
    pub blend: u32,
}

impl From<&Stamp> for StampRecord {
    fn from(stamp: &Stamp) -> Self {
        let (sin, cos) = f64::from(stamp.phase).sin_cos();
        Self {
            height: stamp.height,
            level: stamp.level,
            alpha: stamp.alpha,
            irregularity: stamp.irregularity,
            phase: [cos as f32, sin as f32],
            soot: stamp.soot,
            bare: stamp.bare,
            profile: stamp.profile as u32,
            blend: stamp.blend as u32,
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
    /// Fills the last 16 bytes.
    pub spare: u32,
}

/// Presses stamps.
pub struct Stamps {
    /// For stamps that are round and leave the material alone, all of them.
    plain: Kernel,
    /// For any.
    full: Kernel,
    layout: BindingLayout,
}

/// The bindings of one field, and the lists of a frame's stamps.
pub struct StampSet {
    ground: Ground,
    bins: Bins,
    records: Vec<StampRecord>,
    buffers: Buffers,
    layers: [wgpu::TextureView; 2],
    group: wgpu::BindGroup,
}

struct Buffers {
    params: Uniform<StampParams>,
    tiles: List<Tile>,
    members: List<Member>,
    records: List<StampRecord>,
}

impl StampSet {
    /// Texels of the tiles that the last stamps touched, a tile at the border counted whole.
    pub fn touched_texels(&self) -> u64 {
        self.bins.tiles.len() as u64 * self.ground.tile.map(u64::from).iter().product::<u64>()
    }
}

impl Stamps {
    /// Width and height of a tile, texels: one workgroup, of which each invocation takes four texels of a column. Smaller tiles
    /// gather fewer stamps that miss most of them.
    pub const TILE: [u32; 2] = [16, 8];

    /// Builds the pipeline.
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
                Binding::Uniform,
                Binding::Storage(wgpu::TextureFormat::R32Float, in_place),
                Binding::Storage(wgpu::TextureFormat::R32Uint, in_place),
                Binding::Read,
                Binding::Read,
                Binding::Read,
            ],
        );
        // Two kernels, since a branch that no texel takes still costs a software adapter all that it skips.
        let kernel = |plain: bool| {
            let constants = [
                ("STAMP_TILE_X", f64::from(Self::TILE[0])),
                ("STAMP_TILE_Y", f64::from(Self::TILE[1])),
                ("STAMP_RIM_SQUARED", CRATER_RIM * CRATER_RIM),
                ("STAMP_LIP", CRATER_LIP),
                ("STAMP_GRAIN", CRATER_GRAIN),
                ("STAMP_PLAIN", f64::from(u8::from(plain))),
            ];
            Kernel::new(gpu, "stamp", &["common/noise", "field/stamp"], "stamp_press", &constants, &[None, Some(&layout)])
        };
        let (plain, full) = (kernel(true)?, kernel(false)?);
        Ok(Self { plain, full, layout })
    }

    /// Binds a field.
    pub fn bind(&self, gpu: &Gpu, field: &Field) -> StampSet {
        // Room for a few shots; a stress test makes more.
        let buffers = Buffers {
            params: Uniform::new(gpu, "stamp"),
            tiles: List::new(gpu, "stamp tiles", 256),
            members: List::new(gpu, "stamp members", 256),
            records: List::new(gpu, "stamps", 64),
        };
        let layers = [field.relief.view.clone(), field.material.view.clone()];
        let group = self.group(gpu, &layers, &buffers);
        let ground = Ground { size: field.size, wrap: field.addressing == Addressing::Wrap, tile: Self::TILE };
        StampSet { ground, bins: Bins::default(), records: Vec::new(), buffers, layers, group }
    }

    fn group(&self, gpu: &Gpu, [relief, material]: &[wgpu::TextureView; 2], buffers: &Buffers) -> wgpu::BindGroup {
        self.layout.bind(
            gpu,
            &[
                buffers.params.buffer.as_entire_binding(),
                wgpu::BindingResource::TextureView(relief),
                wgpu::BindingResource::TextureView(material),
                buffers.tiles.buffer.as_entire_binding(),
                buffers.members.buffer.as_entire_binding(),
                buffers.records.buffer.as_entire_binding(),
            ],
        )
    }

    /// Presses the stamps in order, and says which texels they may have changed.
    ///
    /// # Errors
    ///
    /// They touch more tiles than a buffer of the adapter holds; then none is pressed.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &mut StampSet, stamps: &[Stamp]) -> Result<Dirty, BinError> {
        let gpu = recorder.gpu;
        set.bins.clear();
        let limit = List::<Member>::limit(gpu).min(List::<Tile>::limit(gpu));
        let batch = set.bins.add(set.ground, stamps.iter().map(Stamp::disc), limit)?;
        if batch.tile_count == 0 {
            return Ok(Dirty::Nothing);
        }
        set.records.clear();
        set.records.extend(stamps.iter().map(StampRecord::from));
        self.upload(gpu, set, batch.tile_count);
        let kernel = if stamps.iter().all(Stamp::is_plain) { &self.plain } else { &self.full };
        recorder.compute("stamp", |pass| {
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(1, &set.group, &[]);
            let [x, y] = tile_workgroups(batch.tile_count);
            pass.dispatch_workgroups(x, y, 1);
        });
        Ok(batch.dirty)
    }

    fn upload(&self, gpu: &Gpu, set: &mut StampSet, tile_count: u32) {
        let buffers = &mut set.buffers;
        let grown = [
            buffers.tiles.reserve(gpu, set.bins.tiles.len()),
            buffers.members.reserve(gpu, set.bins.members.len()),
            buffers.records.reserve(gpu, set.records.len()),
        ];
        buffers.params.write(gpu, &StampParams { size: set.ground.size, tile_count, spare: 0 });
        buffers.tiles.write(gpu, &set.bins.tiles);
        buffers.members.write(gpu, &set.bins.members);
        buffers.records.write(gpu, &set.records);
        if grown.contains(&true) {
            set.group = self.group(gpu, &set.layers, &set.buffers);
        }
    }
}
