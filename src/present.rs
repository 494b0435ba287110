//! Present: from radiance to what a screen or a file shows. Shader: `shaders/present.wgsl`.

use crate::gpu::{Binding, BindingLayout, Gpu, Recorder, ShaderError, Uniform};

/// Uniforms of the pass.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PresentParams {
    /// Traced pixels along each side of a shown one.
    pub supersampling: u32,
    /// 1: the target stores what is written; the shader encodes to sRGB.
    pub encode: u32,
    /// 0: show the numbers as they are.
    pub tone_map: u32,
    /// Zero.
    pub pad: u32,
}

/// Tone-maps radiance to a target.
pub struct Present {
    pipeline: wgpu::RenderPipeline,
    layout: BindingLayout,
    target: wgpu::TextureFormat,
}

/// The bindings of one radiance texture.
pub struct PresentSet {
    params: Uniform<PresentParams>,
    group: wgpu::BindGroup,
}

impl Present {
    /// Builds the pipeline for targets of a format.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu, target: wgpu::TextureFormat) -> Result<Self, ShaderError> {
        let layout = BindingLayout::new(gpu, "present", wgpu::ShaderStages::FRAGMENT, &[Binding::Uniform, Binding::Float(false)]);
        let module = gpu.shaders.module(gpu, "present", &["present"])?;
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("present"),
            bind_group_layouts: &[None, Some(&layout.layout)],
            immediate_size: 0,
        });
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("present"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("cover"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("present"),
                compilation_options: Default::default(),
                targets: &[Some(target.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Ok(Self { pipeline, layout, target })
    }

    /// The format of its targets.
    pub fn target(&self) -> wgpu::TextureFormat {
        self.target
    }

    /// Binds a radiance texture.
    pub fn bind(&self, gpu: &Gpu, radiance: &wgpu::TextureView) -> PresentSet {
        let params = Uniform::new(gpu, "present");
        let group = self.layout.bind(gpu, &[params.buffer.as_entire_binding(), wgpu::BindingResource::TextureView(radiance)]);
        PresentSet { params, group }
    }

    /// Records one render pass over the whole of `target`.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        set: &PresentSet,
        supersampling: u32,
        tone_map: bool,
        target: &wgpu::TextureView,
    ) {
        set.params.write(
            recorder.gpu,
            &PresentParams { supersampling, encode: u32::from(!self.target.is_srgb()), tone_map: u32::from(tone_map), pad: 0 },
        );
        recorder.render("present", target, |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(1, &set.group, &[]);
            pass.draw(0..3, 0..1);
        });
    }
}
