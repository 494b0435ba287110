//! Compose: what lies beneath and the layers over it become one height, clamped to [0, 1] at the top of the stack.
//!
//! The stack is composed in segments: from the relief up to the first source that stands on a bed, into that bed; and so on to
//! the top, into [`Height`](super::Height). Each reads what lies beneath and the heights of the layers of its segment, in the
//! regions given, and writes every texel of them; at the top also how many texels of each tile it had to clamp. 4 bytes and 4 more
//! a layer in, 4 out a texel. Shader: `shaders/field/compose.wgsl`. Specification: [`crate::reference::compose`].

use super::blocks::{BlockList, Blocks};
use super::source::Heights;
use super::{Field, Region};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, List, Recorder, ShaderError, Uniform};
use crate::scene::Layer;

/// Edge of a tile, texels: one workgroup, one count of clamped texels.
pub const TILE: u32 = 16;

/// Bytes a texel by design: what lies beneath in, height out.
pub const TEXEL_BYTES: u64 = 8;

/// What each layer adds to [`TEXEL_BYTES`].
pub const LAYER_BYTES: u64 = 4;

/// The most layers of one segment.
pub const LAYERS_MAX: usize = 4;

/// Uniforms of one dispatch.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ComposeParams {
    /// The tiles to compose.
    pub blocks: Blocks,
    /// Width and height of the field, texels.
    pub size: [u32; 2],
    /// Tiles in a row of the field.
    pub tiles_per_row: u32,
    /// The layers of the segment, from the ground up.
    pub layers: [ComposeLayer; LAYERS_MAX],
    /// Fills the last 8 bytes.
    pub spare: u32,
}

/// How one layer meets what lies beneath it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ComposeLayer {
    /// [`Layer::amplitude`].
    pub amplitude: f32,
    /// [`Layer::blend`].
    pub blend: u32,
}

impl From<Layer> for ComposeLayer {
    fn from(layer: Layer) -> Self {
        Self { amplitude: layer.amplitude, blend: layer.blend as u32 }
    }
}

/// Composes one segment of the stack.
pub struct Compose {
    kernel: Kernel,
    layout: BindingLayout,
    layers: usize,
}

/// The bindings of one segment.
pub struct ComposeSet {
    params: Uniform<ComposeParams>,
    blocks: List<u32>,
    /// One for each choice of the layers' current textures: bit i of the index is layer i's.
    groups: Vec<wgpu::BindGroup>,
    size: [u32; 2],
}

impl ComposeSet {
    /// Bytes of GPU memory of the list of blocks.
    pub fn memory_bytes(&self) -> u64 {
        self.blocks.memory_bytes()
    }
}

impl Compose {
    /// Builds the pipeline of a segment of so many layers, at most [`LAYERS_MAX`], at the top of the stack or below it.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu, layers: usize, at_top: bool) -> Result<Self, ShaderError> {
        let float = Binding::Float(false);
        let layout = BindingLayout::new(
            gpu,
            "compose",
            wgpu::ShaderStages::COMPUTE,
            &[
                Binding::Uniform,
                float,
                float,
                float,
                float,
                float,
                Binding::Storage(wgpu::TextureFormat::R32Float, wgpu::StorageTextureAccess::WriteOnly),
                Binding::ReadWrite,
                Binding::Read,
            ],
        );
        let constants = [("TILE", f64::from(TILE)), ("LAYERS", layers as f64), ("AT_TOP", f64::from(u8::from(at_top)))];
        let parts = ["common/region", "field/compose"];
        let kernel = Kernel::new(gpu, "compose", &parts, "compose", &constants, &[None, Some(&layout)])?;
        Ok(Self { kernel, layout, layers })
    }

    /// Binds a segment: what lies beneath, the heights of its layers from the ground up, and what it is composed to.
    pub fn bind(
        &self,
        gpu: &Gpu,
        field: &Field,
        beneath: &wgpu::TextureView,
        layers: &[Heights<'_>],
        composed: &wgpu::TextureView,
    ) -> ComposeSet {
        debug_assert_eq!(layers.len(), self.layers);
        let params = Uniform::new(gpu, "compose");
        let blocks = List::new(gpu, "compose's blocks", BlockList::capacity(std::iter::once(field.size), [TILE, TILE]));
        let groups = (0..1_usize << layers.len())
            .map(|currents| {
                // A layer that is not there is never read; what lies beneath stands in for it.
                let layer = |index: usize| layers.get(index).map_or(beneath, |layer| layer.views[currents >> index & 1]);
                let textures = [beneath, layer(0), layer(1), layer(2), layer(3), composed];
                let mut resources = vec![params.buffer.as_entire_binding()];
                resources.extend(textures.map(wgpu::BindingResource::TextureView));
                resources.push(field.clipped.as_entire_binding());
                resources.push(blocks.buffer.as_entire_binding());
                self.layout.bind(gpu, &resources)
            })
            .collect();
        ComposeSet { params, blocks, groups, size: field.size }
    }

    /// Composes the regions, whole tiles of them, from layers of which each says which of its textures is current; says how many
    /// texels those have.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &ComposeSet, regions: &[Region], layers: &[(Layer, usize)]) -> u64 {
        debug_assert_eq!(layers.len(), self.layers);
        let mut settings = [ComposeLayer::default(); LAYERS_MAX];
        for (setting, (layer, _)) in settings.iter_mut().zip(layers) {
            *setting = ComposeLayer::from(*layer);
        }
        let currents = layers.iter().enumerate().fold(0, |bits, (index, (_, current))| bits | current << index);
        let mut list = BlockList::default();
        let Some(dispatch) = list.plan(regions, set.size, [TILE, TILE]) else { return 0 };
        set.blocks.write(recorder.gpu, &list.items);
        let params = ComposeParams {
            blocks: dispatch.blocks,
            size: set.size,
            tiles_per_row: set.size[0].div_ceil(TILE),
            layers: settings,
            spare: 0,
        };
        set.params.write(recorder.gpu, &params);
        recorder.compute("compose", |pass| {
            let [x, y] = dispatch.workgroups;
            pass.set_pipeline(&self.kernel.pipeline);
            pass.set_bind_group(1, &set.groups[currents], &[]);
            pass.dispatch_workgroups(x, y, 1);
        });
        dispatch.texels.min(Region::all(set.size).area())
    }
}
