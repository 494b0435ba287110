//! Compose: relief and waves become the height field, clamped to [0, 1].
//!
//! Reads [`Relief`](super::Relief) and, where there are waves, [`WaveState`](super::WaveState); writes every texel of
//! [`Height`](super::Height) in the regions given, and how many texels of each tile it had to clamp. 4 or 8 bytes in, 4 out a
//! texel. Shader: `shaders/field/compose.wgsl`. Specification: [`crate::reference::compose`].

use super::blocks::{BlockList, Blocks};
use super::{Field, Region};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, List, Recorder, ShaderError, Uniform};

/// Edge of a tile, texels: one workgroup, one count of clamped texels.
pub const TILE: u32 = 16;

/// Bytes a texel by design: relief in, height out; a wave adds four.
pub const TEXEL_BYTES: u64 = 8;

/// Uniforms of one dispatch.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ComposeParams {
    /// The tiles to compose.
    pub blocks: Blocks,
    /// Height that a wave of displacement 1 adds; 0: the wave's texture is not read.
    pub amplitude: f32,
    /// Tiles in a row of the field.
    pub tiles_per_row: u32,
    /// Width and height of the field, texels.
    pub size: [u32; 2],
}

/// Composes the height field.
pub struct Compose {
    kernel: Kernel,
    layout: BindingLayout,
}

/// The bindings of one field.
pub struct ComposeSet {
    params: Uniform<ComposeParams>,
    blocks: List<u32>,
    /// One for each side of the wave's ping-pong, the current state first.
    groups: [wgpu::BindGroup; 2],
    size: [u32; 2],
}

impl Compose {
    /// Builds the pipeline.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        let layout = BindingLayout::new(
            gpu,
            "compose",
            wgpu::ShaderStages::COMPUTE,
            &[
                Binding::Uniform,
                Binding::Float(false),
                Binding::Float(false),
                Binding::Storage(wgpu::TextureFormat::R32Float, wgpu::StorageTextureAccess::WriteOnly),
                Binding::ReadWrite,
                Binding::Read,
            ],
        );
        let kernel = Kernel::new(
            gpu,
            "compose",
            &["common/region", "field/compose"],
            "compose",
            &[("TILE", f64::from(TILE))],
            &[None, Some(&layout)],
        )?;
        Ok(Self { kernel, layout })
    }

    /// Binds a field.
    pub fn bind(&self, gpu: &Gpu, field: &Field) -> ComposeSet {
        let params = Uniform::new(gpu, "compose");
        let blocks = List::new(gpu, "compose's blocks", BlockList::capacity(std::iter::once(field.size), [TILE, TILE]));
        let group = |wave: usize| {
            self.layout.bind(
                gpu,
                &[
                    params.buffer.as_entire_binding(),
                    wgpu::BindingResource::TextureView(&field.relief.view),
                    wgpu::BindingResource::TextureView(&field.wave[wave].view),
                    wgpu::BindingResource::TextureView(&field.height.view),
                    field.clipped.as_entire_binding(),
                    blocks.buffer.as_entire_binding(),
                ],
            )
        };
        let groups = [group(0), group(1)];
        ComposeSet { params, blocks, groups, size: field.size }
    }

    /// Composes the regions, whole tiles of them; says how many texels those have. `wave` says which of the two textures holds the
    /// current state.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &ComposeSet, regions: &[Region], amplitude: f32, wave: usize) -> u64 {
        let mut list = BlockList::default();
        let Some(dispatch) = list.plan(regions, set.size, [TILE, TILE]) else { return 0 };
        set.blocks.write(recorder.gpu, &list.items);
        let tiles_per_row = set.size[0].div_ceil(TILE);
        set.params.write(recorder.gpu, &ComposeParams { blocks: dispatch.blocks, amplitude, tiles_per_row, size: set.size });
        recorder.compute("compose", |pass| {
            let [x, y] = dispatch.workgroups;
            pass.set_pipeline(&self.kernel.pipeline);
            pass.set_bind_group(1, &set.groups[wave], &[]);
            pass.dispatch_workgroups(x, y, 1);
        });
        dispatch.texels.min(Region::all(set.size).area())
    }
}
