//! Surface: the plane with its relief, traced pixel by pixel into radiance. Shader: `shaders/surface/surface.wgsl`.

use std::ops::Range;

use super::{Choice, ViewSet, bind_field, constants, field_layout, outline, parts};
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
    backdrop: wgpu::RenderPipeline,
    pipeline: wgpu::RenderPipeline,
    layout: BindingLayout,
}

/// The bindings of one field.
pub struct SurfaceSet {
    group: wgpu::BindGroup,
}

impl Surface {
    /// Builds the pipelines.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu, view: &BindingLayout, choice: Choice) -> Result<Self, ShaderError> {
        let layout = field_layout(gpu);
        let groups = [view, &layout];
        let backdrop = pipeline(gpu, groups, choice.behind(), ("cover", "backdrop"), None)?;
        let blend = Some(wgpu::BlendState::ALPHA_BLENDING);
        let pipeline = pipeline(gpu, groups, choice, ("outline", "surface"), blend)?;
        Ok(Self { backdrop, pipeline, layout })
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
            pass.set_bind_group(0, &view.group, &[]);
            pass.set_bind_group(1, &set.group, &[]);
            pass.set_pipeline(&self.backdrop);
            pass.draw(0..3, 0..1);
            pass.set_pipeline(&self.pipeline);
            pass.draw(0..outline::VERTICES, 0..1);
        });
    }
}

/// Builds the pipeline with these entry points, of the vertex and of the fragment shader.
fn pipeline(
    gpu: &Gpu,
    groups: [&BindingLayout; 2],
    choice: Choice,
    (vertex, fragment): (&str, &str),
    blend: Option<wgpu::BlendState>,
) -> Result<wgpu::RenderPipeline, ShaderError> {
    let parts = parts(gpu.filters_r32float(), choice, &["surface"]);
    let parts: Vec<_> = parts.iter().map(String::as_str).collect();
    let module = gpu.shaders.module(gpu, fragment, &parts)?;
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(fragment),
        bind_group_layouts: &groups.map(|group| Some(&group.layout)),
        immediate_size: 0,
    });
    let constants = constants(choice);
    let compilation_options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    let format = Radiance::CONTRACT.format;
    Ok(gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(fragment),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(vertex),
            compilation_options: compilation_options.clone(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options,
            targets: &[Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL })],
        }),
        multiview_mask: None,
        cache: None,
    }))
}
