//! Surface: the plane with its relief, traced pixel by pixel into radiance. Shader: `shaders/surface/surface.wgsl`.

use std::ops::Range;

use super::{Choice, ViewSet, bind_field, constants, field_layout, parts};
use crate::field::Field;
use crate::gpu::{BindingLayout, Contract, Gpu, Recorder, Role, ShaderError};

/// The picture as it is traced.
#[derive(Clone, Copy, Debug)]
pub enum Radiance {}

impl Role for Radiance {
    const CONTRACT: Contract = Contract {
        name: "radiance",
        // Linear, with room for highlights.
        format: wgpu::TextureFormat::Rgba16Float,
        mips: false,
        share: 1.0,
        content: "radiance, linear",
        writer: "surface",
        readers: "present",
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT.union(wgpu::TextureUsages::TEXTURE_BINDING),
    };
}

/// Traces and shades what the camera sees, with one look.
pub struct Surface {
    pipeline: wgpu::RenderPipeline,
    layout: BindingLayout,
}

/// The bindings of one field.
pub struct SurfaceSet {
    group: wgpu::BindGroup,
}

impl Surface {
    /// Builds the pipeline.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu, view: &BindingLayout, choice: Choice) -> Result<Self, ShaderError> {
        let layout = field_layout(gpu);
        let parts = parts(gpu.filters_r32float(), choice, &["surface"]);
        let parts: Vec<_> = parts.iter().map(String::as_str).collect();
        let module = gpu.shaders.module(gpu, "surface", &parts)?;
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("surface"),
            bind_group_layouts: &[Some(&view.layout), Some(&layout.layout)],
            immediate_size: 0,
        });
        let constants = constants(choice);
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("surface"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("cover"),
                compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("surface"),
                compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
                targets: &[Some(Radiance::CONTRACT.format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Ok(Self { pipeline, layout })
    }

    /// Binds a field.
    pub fn bind(&self, gpu: &Gpu, field: &Field) -> SurfaceSet {
        SurfaceSet { group: bind_field(gpu, &self.layout, field) }
    }

    /// Records one render pass over these columns of `radiance`, under a name of its own; whoever begins at the first begins the
    /// picture.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        name: &str,
        view: &ViewSet,
        set: &SurfaceSet,
        radiance: &wgpu::TextureView,
        columns: Range<u32>,
    ) {
        let height = radiance.texture().height();
        recorder.render_onto(name, radiance, None, columns.start > 0, |pass| {
            pass.set_scissor_rect(columns.start, 0, columns.end - columns.start, height);
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &view.group, &[]);
            pass.set_bind_group(1, &set.group, &[]);
            pass.draw(0..3, 0..1);
        });
    }
}
