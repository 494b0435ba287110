//! Channels: what the picture is made of, as exact numbers. Shader: `shaders/surface/channels.wgsl`.
//!
//! A compute pass, since all channels together are 48 bytes a pixel and a render pass may write 32 by WebGPU's default limits.

use super::{Choice, View, ViewSet, bind_field, constants, field_layout, parts, view};
use crate::field::Field;
use crate::gpu::kernel::workgroups;
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, Readback, ShaderError};

/// What one pixel shows.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Channel {
    /// The point on the view ray where the technique finds the surface, world, metres.
    pub position: [f32; 3],
    /// Height samples or nodes that the view ray took; −1 where the pixel shows no surface, −1 − n where its ray gave up after n.
    pub steps: f32,
    /// The normal as shaded, world.
    pub normal: [f32; 3],
    /// The field's height there.
    pub height: f32,
    /// Texture coordinates, not wrapped.
    pub uv: [f32; 2],
    /// Share of the light that arrives; 0 where the surface faces away from it.
    pub visibility: f32,
    /// Level of detail: the mip level of the pixel, at which the surface was looked at; 0, the full effect, where it is off.
    pub lod: f32,
}

impl Channel {
    /// From the parts that render passes write: see `shaders/surface/channel.wgsl`.
    pub fn from_parts([one, two, three]: [[f32; 4]; 3]) -> Self {
        Self {
            position: [one[0], one[1], one[2]],
            steps: one[3],
            normal: [two[0], two[1], two[2]],
            height: two[3],
            uv: [three[0], three[1]],
            visibility: three[2],
            lod: three[3],
        }
    }
}

/// Writes channels, a band of rows at a time.
pub struct Channels {
    kernel: Kernel,
    field_layout: BindingLayout,
    output_layout: BindingLayout,
    view_layout: BindingLayout,
}

impl Channels {
    /// Lavapipe and GPUs alike trace neighbouring pixels together.
    pub const WORKGROUP: [u32; 2] = [8, 8];

    /// Builds the pipeline.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu, choice: Choice) -> Result<Self, ShaderError> {
        let view_layout = view::layout(gpu);
        let field_layout = field_layout(gpu);
        let output_layout = BindingLayout::new(gpu, "channels", wgpu::ShaderStages::COMPUTE, &[Binding::ReadWrite]);
        let parts = parts(gpu.filters_r32float(), choice, &["channels"]);
        let parts: Vec<_> = parts.iter().map(String::as_str).collect();
        let mut constants = constants(choice);
        constants.extend([("WORKGROUP_X", f64::from(Self::WORKGROUP[0])), ("WORKGROUP_Y", f64::from(Self::WORKGROUP[1]))]);
        let kernel = Kernel::new(
            gpu,
            "channels",
            &parts,
            "write_channels",
            &constants,
            &[Some(&view_layout), Some(&field_layout), Some(&output_layout)],
        )?;
        Ok(Self { kernel, field_layout, output_layout, view_layout })
    }

    /// Rows of a picture of this width that fit one band of at most 32 MiB, or what the adapter can bind.
    pub fn rows_per_band(gpu: &Gpu, width: u32) -> u32 {
        let bytes = gpu.device.limits().max_storage_buffer_binding_size.min(32 << 20);
        let row = u64::from(width) * size_of::<Channel>() as u64;
        (bytes / row).clamp(1, u64::from(u32::MAX)) as u32
    }

    /// Writes rows `first_row..first_row + rows` of the picture that `view` describes, submits the work, and returns the
    /// [`Channel`]s on their way: the caller polls the device.
    pub fn request(&self, gpu: &Gpu, field: &Field, view: &View, first_row: u32, rows: u32) -> Readback {
        let view_set = ViewSet::new(gpu, &self.view_layout, field.addressing);
        view_set.uniform.write(gpu, &View { first_row, ..*view });
        let bytes = u64::from(view.image_size[0]) * u64::from(rows) * size_of::<Channel>() as u64;
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("channels"),
            size: bytes,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let field_group = bind_field(gpu, &self.field_layout, field);
        let output = self.output_layout.bind(gpu, &[buffer.as_entire_binding()]);
        let mut encoder = gpu.encoder("channels");
        {
            let mut pass =
                encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("channels"), timestamp_writes: None });
            let [x, y] = workgroups([view.image_size[0], rows], Self::WORKGROUP);
            pass.set_pipeline(&self.kernel.pipeline);
            pass.set_bind_group(0, &view_set.group, &[]);
            pass.set_bind_group(1, &field_group, &[]);
            pass.set_bind_group(2, &output, &[]);
            pass.dispatch_workgroups(x, y, 1);
        }
        let readback = Readback::record_buffer(gpu, &mut encoder, &buffer, bytes);
        gpu.queue.submit([encoder.finish()]);
        readback.start();
        readback
    }
}
