//! Probe: the trace and the shadow for rays that are listed, not seen. Shader: `shaders/surface/probe.wgsl`.
//!
//! The same WGSL functions that the fragment shader runs, for tests against the reference and for the pointer of a mouse.

use super::{Choice, Shadow, Technique, View, ViewSet, bind_field, field_layout, parts, view};
use crate::field::{Field, bounds, material};
use crate::gpu::{Binding, BindingLayout, Gpu, Kernel, Readback, ShaderError};

/// A ray in field space. Twin of the WGSL struct in `shaders/surface/ray.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Ray {
    /// Lattice position at t = 0, counted from `cell`.
    pub lattice: [f32; 2],
    /// Lattice displacement while t grows by 1.
    pub travel: [f32; 2],
    /// Height at t = 0.
    pub height: f32,
    /// Height gained while t grows by 1: −1 for a view ray over a flat polygon, +1 for a shadow ray.
    pub rise: f32,
    /// A lattice position near the start: what is counted from it keeps the bits that its own size would cost.
    pub cell: [i32; 2],
    /// Where it ends: at the floor, at the top of the slab, or where it leaves its piece of a shell.
    pub t_end: f32,
    /// What it has met there: [`Hit::HIT`] the floor, [`Hit::MISS`] nothing.
    pub ends: u32,
}

/// What became of a ray. Twin of the WGSL struct in `shaders/surface/ray.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Hit {
    /// Lattice position of the hit, on the ray; not wrapped.
    pub lattice: [f32; 2],
    /// Height of the ray there.
    pub height: f32,
    /// The ray's parameter there.
    pub t: f32,
    /// Height samples or nodes visited; a node and the cell in it that is looked at beside it count one.
    pub steps: u32,
    /// [`Hit::HIT`], [`Hit::MISS`] or [`Hit::CAPPED`].
    pub status: u32,
}

impl Hit {
    /// The ray met the surface.
    pub const HIT: u32 = 0;
    /// It left the slab, or its piece of a shell.
    pub const MISS: u32 = 1;
    /// It visited as many nodes as it may and gave up.
    pub const CAPPED: u32 = 2;
}

/// Traces lists of rays.
pub struct Probe {
    trace: Kernel,
    shadow: Kernel,
    view_layout: BindingLayout,
    field_layout: BindingLayout,
    list_layout: BindingLayout,
}

impl Probe {
    /// One SIMD register's worth on lavapipe, two warps on a GPU.
    pub const WORKGROUP: u32 = 64;

    /// Builds the pipelines for a technique and a shadow.
    ///
    /// # Errors
    ///
    /// The shader does not compile.
    pub fn new(gpu: &Gpu, technique: Technique, shadow: Shadow) -> Result<Self, ShaderError> {
        let view_layout = view::layout(gpu);
        let field_layout = field_layout(gpu);
        let list_layout = BindingLayout::new(
            gpu,
            "probe",
            wgpu::ShaderStages::COMPUTE,
            &[Binding::Read, Binding::ReadWrite, Binding::ReadWrite],
        );
        let parts = parts(gpu.filters_r32float(), Choice::tracing(technique, shadow), &["probe"]);
        let parts: Vec<_> = parts.iter().map(String::as_str).collect();
        let groups = [Some(&view_layout), Some(&field_layout), Some(&list_layout)];
        let constants = [&[("WORKGROUP", f64::from(Self::WORKGROUP))], &material::CONSTANTS[..], &bounds::CONSTANTS].concat();
        let kernel = |entry_point| Kernel::new(gpu, "probe", &parts, entry_point, &constants, &groups);
        let (trace, shadow) = (kernel("probe_trace")?, kernel("probe_shadow")?);
        Ok(Self { trace, shadow, view_layout, field_layout, list_layout })
    }

    /// Traces the rays, of which there must be at least one, and returns their [`Hit`]s on their way.
    pub fn trace(&self, gpu: &Gpu, field: &Field, view: &View, rays: &[Ray]) -> Readback {
        self.request(gpu, field, view, rays, &self.trace)
    }

    /// Returns the visibility, an f32 each, at the start of the shadow rays, of which there must be at least one.
    pub fn shadow(&self, gpu: &Gpu, field: &Field, view: &View, rays: &[Ray]) -> Readback {
        self.request(gpu, field, view, rays, &self.shadow)
    }

    fn request(&self, gpu: &Gpu, field: &Field, view: &View, rays: &[Ray], kernel: &Kernel) -> Readback {
        let view_set = ViewSet::new(gpu, &self.view_layout, field.addressing);
        view_set.uniform.write(gpu, view);
        let count = rays.len() as u64;
        let buffer = |label, size| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let input = buffer("rays", count * size_of::<Ray>() as u64);
        gpu.queue.write_buffer(&input, 0, bytemuck::cast_slice(rays));
        let hits = buffer("hits", count * size_of::<Hit>() as u64);
        let seen = buffer("seen", count * 4);
        let field_group = bind_field(gpu, &self.field_layout, field);
        let lists = self.list_layout.bind(gpu, &[input.as_entire_binding(), hits.as_entire_binding(), seen.as_entire_binding()]);
        let mut encoder = gpu.encoder("probe");
        {
            let mut pass =
                encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("probe"), timestamp_writes: None });
            let groups = rays.len().div_ceil(Self::WORKGROUP as usize) as u32;
            let columns = groups.min(gpu.device.limits().max_compute_workgroups_per_dimension);
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(0, &view_set.group, &[]);
            pass.set_bind_group(1, &field_group, &[]);
            pass.set_bind_group(2, &lists, &[]);
            pass.dispatch_workgroups(columns, groups.div_ceil(columns), 1);
        }
        let output = if std::ptr::eq(kernel, &self.trace) { &hits } else { &seen };
        let readback = Readback::record_buffer(gpu, &mut encoder, output, output.size());
        gpu.queue.submit([encoder.finish()]);
        readback.start();
        readback
    }
}
