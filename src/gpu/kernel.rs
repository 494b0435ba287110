//! Bind group layouts and compute pipelines.

use super::{Gpu, ShaderError};

/// What one binding of a layout is.
#[derive(Clone, Copy, Debug)]
pub enum Binding {
    /// A uniform: see [`super::uniform`] for why it is a storage buffer.
    Uniform,
    /// One slot of a row of uniforms, chosen by a dynamic offset.
    UniformSlot,
    /// A storage buffer that is read.
    Read,
    /// A storage buffer that is read from a dynamic offset.
    ReadSlot,
    /// A storage buffer that is read and written.
    ReadWrite,
    /// A texture of floats; `true` if a sampler filters it.
    Float(bool),
    /// A texture of unsigned integers.
    Uint,
    /// A storage texture.
    Storage(wgpu::TextureFormat, wgpu::StorageTextureAccess),
    /// A sampler; `true` if it filters.
    Sampler(bool),
}

/// A bind group layout, made from its bindings in order.
pub struct BindingLayout {
    /// The layout.
    pub layout: wgpu::BindGroupLayout,
    label: String,
}

impl BindingLayout {
    /// Makes one; binding `i` is `bindings[i]`.
    pub fn new(gpu: &Gpu, label: &str, stages: wgpu::ShaderStages, bindings: &[Binding]) -> Self {
        let entries: Vec<_> = bindings
            .iter()
            .zip(0..)
            .map(|(binding, index)| wgpu::BindGroupLayoutEntry {
                binding: index,
                visibility: stages,
                ty: binding_type(*binding),
                count: None,
            })
            .collect();
        let layout =
            gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries });
        Self { layout, label: label.to_owned() }
    }

    /// A bind group of it; resource `i` goes to binding `i`.
    pub fn bind(&self, gpu: &Gpu, resources: &[wgpu::BindingResource<'_>]) -> wgpu::BindGroup {
        let entries: Vec<_> = resources
            .iter()
            .zip(0..)
            .map(|(resource, binding)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&self.label),
            layout: &self.layout,
            entries: &entries,
        })
    }
}

fn binding_type(binding: Binding) -> wgpu::BindingType {
    let buffer = |ty, has_dynamic_offset| wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None };
    let texture = |sample_type| wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    match binding {
        Binding::Uniform | Binding::Read => buffer(wgpu::BufferBindingType::Storage { read_only: true }, false),
        Binding::UniformSlot | Binding::ReadSlot => buffer(wgpu::BufferBindingType::Storage { read_only: true }, true),
        Binding::ReadWrite => buffer(wgpu::BufferBindingType::Storage { read_only: false }, false),
        Binding::Float(filterable) => texture(wgpu::TextureSampleType::Float { filterable }),
        Binding::Uint => texture(wgpu::TextureSampleType::Uint),
        Binding::Storage(format, access) => {
            wgpu::BindingType::StorageTexture { access, format, view_dimension: wgpu::TextureViewDimension::D2 }
        }
        Binding::Sampler(filtering) => wgpu::BindingType::Sampler(if filtering {
            wgpu::SamplerBindingType::Filtering
        } else {
            wgpu::SamplerBindingType::NonFiltering
        }),
    }
}

/// A compute pipeline. Bind group 0 is the frame's, where the kernel has a use for it; group 1 is its own.
pub struct Kernel {
    /// The pipeline.
    pub pipeline: wgpu::ComputePipeline,
}

impl Kernel {
    /// Builds it from WGSL parts; `constants` are the `override`s that Rust owns.
    ///
    /// # Errors
    ///
    /// The composed WGSL does not parse or validate; the error names the part's own line.
    pub fn new(
        gpu: &Gpu,
        label: &str,
        parts: &[&str],
        entry_point: &str,
        constants: &[(&str, f64)],
        groups: &[Option<&BindingLayout>],
    ) -> Result<Self, ShaderError> {
        let module = gpu.shaders.module(gpu, label, parts)?;
        let layouts: Vec<_> = groups.iter().map(|group| group.map(|group| &group.layout)).collect();
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        });
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(label),
            layout: Some(&layout),
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
            cache: None,
        });
        Ok(Self { pipeline })
    }
}

/// Workgroups that cover `size` items, an axis each.
pub fn workgroups(size: [u32; 2], workgroup: [u32; 2]) -> [u32; 2] {
    [size[0].div_ceil(workgroup[0]), size[1].div_ceil(workgroup[1])]
}
