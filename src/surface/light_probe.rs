//! Light probe: the light model, and the sky, for surfaces and directions that are listed, not seen. Shader: `shaders/surface/light_probe.wgsl`.
//!
//! The same WGSL functions that the fragment shader runs, for tests against the reference.

use glam::DVec3;

use super::{Choice, View, ViewSet, bind_field, field_layout, parts, view};
use crate::field::{Field, bounds, material};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, Readback, ShaderError};
use crate::scene::Addressing;

/// What a surface is made of. Twin of the WGSL struct in `shaders/surface/matter.wgsl`, where each field's meaning stands.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "the WGSL twin documents the fields, and one place is enough")]
pub struct Matter {
    pub albedo: [f32; 3],
    pub specular: f32,
    pub shininess: f32,
    pub pad_shininess: [u32; 3],
    pub glow: [f32; 3],
    pub roughness: f32,
    pub metallic: f32,
    pub reflection: f32,
    pub pad: [u32; 2],
}

/// A surface, an eye and a light. Twin of the WGSL struct in `shaders/surface/light_probe.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Lit {
    /// What it is made of.
    pub matter: Matter,
    /// Its unit normal.
    pub normal: [f32; 3],
    /// Zero.
    pub pad_normal: u32,
    /// The unit direction toward the eye.
    pub toward_eye: [f32; 3],
    /// Zero.
    pub pad_eye: u32,
    /// The unit direction toward the light.
    pub toward_light: [f32; 3],
    /// Zero.
    pub pad_light: u32,
}

impl Lit {
    /// Normal, direction toward the eye, direction toward the light.
    pub fn directions(&self) -> [DVec3; 3] {
        [self.normal, self.toward_eye, self.toward_light].map(|direction| DVec3::from(direction.map(f64::from)).normalize())
    }
}

/// Lights lists of surfaces.
pub struct LightProbe {
    light: Kernel,
    sky: Kernel,
    view_layout: BindingLayout,
    field_layout: BindingLayout,
    /// A texel: the layout asks for a field, nothing here looks at it.
    field: Field,
    list_layout: BindingLayout,
}

impl LightProbe {
    /// One SIMD register's worth on lavapipe, two warps on a GPU.
    pub const WORKGROUP: u32 = 64;

    /// Builds the pipeline for a light model.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu, choice: Choice) -> Result<Self, ShaderError> {
        let view_layout = view::layout(gpu);
        let field_layout = field_layout(gpu);
        let list_layout =
            BindingLayout::new(gpu, "light probe", wgpu::ShaderStages::COMPUTE, &[Binding::Read, Binding::ReadWrite]);
        let parts = parts(gpu.filters_r32float(), choice, &["light_probe"]);
        let parts: Vec<_> = parts.iter().map(String::as_str).collect();
        let groups = [Some(&view_layout), Some(&field_layout), Some(&list_layout)];
        let constants = [&[("WORKGROUP", f64::from(Self::WORKGROUP))], &material::CONSTANTS[..], &bounds::CONSTANTS].concat();
        let kernel = |entry| Kernel::new(gpu, "light probe", &parts, entry, &constants, &groups);
        let (light, sky) = (kernel("probe_light")?, kernel("probe_sky")?);
        let field = Field::new(gpu, [1, 1], Addressing::Clamp, false);
        Ok(Self { light, sky, view_layout, field_layout, field, list_layout })
    }

    /// Lights the surfaces, of which there must be at least one, and returns the radiances toward the eye, four f32 each, on
    /// their way.
    pub fn light(&self, gpu: &Gpu, lit: &[Lit]) -> Readback {
        self.request(gpu, &self.light, &View::default(), lit)
    }

    /// Returns what mirrors of the surfaces' roughness show of the sky in the directions toward their lights, four f32 each, on
    /// its way.
    pub fn sky(&self, gpu: &Gpu, view: &View, lit: &[Lit]) -> Readback {
        self.request(gpu, &self.sky, view, lit)
    }

    fn request(&self, gpu: &Gpu, kernel: &Kernel, view: &View, lit: &[Lit]) -> Readback {
        let field_group = bind_field(gpu, &self.field_layout, &self.field);
        let view_set = ViewSet::new(gpu, &self.view_layout, Addressing::Clamp);
        view_set.uniform.write(gpu, view);
        let buffer = |label, size| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let input = buffer("lit", size_of_val(lit) as u64);
        gpu.queue.write_buffer(&input, 0, bytemuck::cast_slice(lit));
        let output = buffer("radiance", lit.len() as u64 * 16);
        let lists = self.list_layout.bind(gpu, &[input.as_entire_binding(), output.as_entire_binding()]);
        let mut encoder = gpu.encoder("light probe");
        {
            let mut pass =
                encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("light probe"), timestamp_writes: None });
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(0, &view_set.group, &[]);
            pass.set_bind_group(1, &field_group, &[]);
            pass.set_bind_group(2, &lists, &[]);
            pass.dispatch_workgroups(lit.len().div_ceil(Self::WORKGROUP as usize) as u32, 1, 1);
        }
        let readback = Readback::record_buffer(gpu, &mut encoder, &output, output.size());
        gpu.queue.submit([encoder.finish()]);
        readback.start();
        readback
    }
}
