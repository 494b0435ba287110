//! Present: from radiance to what a screen or a file shows. Shader: `shaders/present.wgsl`.

use crate::gpu::{Binding, BindingLayout, Gpu, Recorder, ShaderError, Uniform};
use crate::surface::{Display, Shows};

/// Uniforms of the pass.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PresentParams {
    /// Traced pixels along each side of a shown one.
    pub supersampling: u32,
    /// The first shown column on the right side; 0: the picture is not split, all of it is the left side.
    pub divider: u32,
    /// How the left side is shown.
    pub left: PresentSide,
    /// How the right side is shown.
    pub right: PresentSide,
}

/// How one side of a picture is shown.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PresentSide {
    /// 0: show the numbers as they are.
    pub tone_map: u32,
    /// What the brightest heat stands for; 0: it has no legend.
    pub legend: f32,
}

impl PresentSide {
    /// A side that shows this, of a display with this gain.
    pub fn new(shows: Shows, gain: f32) -> Self {
        Self { tone_map: u32::from(shows.is_picture()), legend: shows.heat_top(gain).unwrap_or(0.0) }
    }
}

/// Tone-maps radiance to a target.
pub struct Present {
    /// Without and with legends and a divider.
    pipelines: [wgpu::RenderPipeline; 2],
    layout: BindingLayout,
    target: wgpu::TextureFormat,
}

/// The bindings of one radiance texture.
pub struct PresentSet {
    params: Uniform<PresentParams>,
    group: wgpu::BindGroup,
}

impl Present {
    /// Builds the pipelines for targets of a format.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu, target: wgpu::TextureFormat) -> Result<Self, ShaderError> {
        let layout =
            BindingLayout::new(gpu, "present", wgpu::ShaderStages::VERTEX_FRAGMENT, &[Binding::Uniform, Binding::Float(false)]);
        let module = gpu.shaders.module(gpu, "present", &["common/heat", "common/legend", "present"])?;
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("present"),
            bind_group_layouts: &[None, Some(&layout.layout)],
            immediate_size: 0,
        });
        let pipelines = [false, true].map(|annotated| {
            let switches = [("ENCODES", !target.is_srgb()), ("ANNOTATED", annotated)];
            let constants = switches.map(|(name, on)| (name, f64::from(u8::from(on))));
            let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
            gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("present"),
                layout: Some(&pipeline_layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("cover"),
                    compilation_options: options.clone(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some("present"),
                    compilation_options: options,
                    targets: &[Some(target.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
        });
        Ok(Self { pipelines, layout, target })
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

    /// Records one render pass over the whole of `target`, which is `width` pixels wide.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        set: &PresentSet,
        supersampling: u32,
        display: &Display,
        width: u32,
        target: &wgpu::TextureView,
    ) {
        let right = display.split.map_or(display.shows, |split| split.shows);
        let params = PresentParams {
            supersampling,
            divider: display.divider(width, 1).unwrap_or(0),
            left: PresentSide::new(display.shows, display.gain),
            right: PresentSide::new(right, display.gain),
        };
        let is_annotated = params.divider > 0 || params.left.legend > 0.0;
        set.params.write(recorder.gpu, &params);
        recorder.render("present", target, |pass| {
            pass.set_pipeline(&self.pipelines[usize::from(is_annotated)]);
            pass.set_bind_group(1, &set.group, &[]);
            pass.draw(0..3, 0..1);
        });
    }
}
