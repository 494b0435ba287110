//! Compose: relief and waves become the height field, clamped to [0, 1].
//!
//! Reads [`Relief`](super::Relief) and, where there are waves, [`WaveState`](super::WaveState); writes every texel of
//! [`Height`](super::Height) in the regions given, and how many texels of each tile it had to clamp. 4 or 8 bytes in, 4 out a
//! texel. Shader: `shaders/field/compose.wgsl`. Specification: [`crate::reference::compose`].

use super::{Field, Region};
use crate::gpu::kernel::workgroups;
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, Recorder, ShaderError, UniformSlots};

/// Edge of a tile, texels: one workgroup, one count of clamped texels.
pub const TILE: u32 = 16;

/// Bytes a texel by design: relief in, height out; a wave adds four.
pub const TEXEL_BYTES: u64 = 8;

/// Regions that one frame may compose separately: as many as [`Dirty`](super::Dirty) keeps apart.
pub const MAX_REGIONS: u32 = super::Dirty::MAX_REGIONS as u32;

/// Uniforms of one dispatch.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ComposeParams {
    /// The texels to compose: whole tiles, cut at the field's border.
    pub region: Region,
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
    params: UniformSlots<ComposeParams>,
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
                Binding::UniformSlot,
                Binding::Float(false),
                Binding::Float(false),
                Binding::Storage(wgpu::TextureFormat::R32Float, wgpu::StorageTextureAccess::WriteOnly),
                Binding::ReadWrite,
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
        let params = UniformSlots::new(gpu, "compose", MAX_REGIONS);
        let group = |wave: usize| {
            self.layout.bind(
                gpu,
                &[
                    params.binding(),
                    wgpu::BindingResource::TextureView(&field.relief.view),
                    wgpu::BindingResource::TextureView(&field.wave[wave].view),
                    wgpu::BindingResource::TextureView(&field.height.view),
                    field.clipped.as_entire_binding(),
                ],
            )
        };
        let groups = [group(0), group(1)];
        ComposeSet { params, groups, size: field.size }
    }

    /// Composes the regions, whole tiles of them. `wave` says which of the two textures holds the current state.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &ComposeSet, regions: &[Region], amplitude: f32, wave: usize) {
        let params: Vec<_> = regions
            .iter()
            .map(|region| ComposeParams {
                region: region.tiles(TILE, set.size),
                amplitude,
                tiles_per_row: set.size[0].div_ceil(TILE),
                size: set.size,
            })
            .collect();
        set.params.write(recorder.gpu, &params);
        recorder.compute("compose", |pass| {
            pass.set_pipeline(&self.kernel.pipeline);
            for (slot, params) in (0..).zip(&params) {
                let [x, y] = workgroups(params.region.extent, [TILE, TILE]);
                pass.set_bind_group(1, &set.groups[wave], &[set.params.offset(slot)]);
                pass.dispatch_workgroups(x, y, 1);
            }
        });
    }
}
