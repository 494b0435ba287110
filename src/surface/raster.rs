//! Raster: the buffers of a mesh, and the pipelines of everything that is drawn with a depth buffer. Shader parts:
//! `shaders/surface/raster.wgsl` and the geometries that need it.

use super::micropolygon::MicroVertex;
use super::{Choice, constants, facet, parts, shell};
use crate::gpu::{Binding, BindingLayout, Gpu, Role, ShaderError};
use crate::mesh::Vertex;
use crate::surface::surface::Radiance;

/// The format of the depth buffer.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The format of a part of the channels.
pub const CHANNEL_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// How many passes write the channels, a part each.
pub const CHANNEL_PARTS: u32 = 3;

/// A vertex as shaders pull it. Twin of the WGSL struct.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "the WGSL twin documents the fields, and one place is enough")]
pub struct RasterVertex {
    pub position: [f32; 3],
    pub u: f32,
    pub normal: [f32; 3],
    pub v: f32,
    pub tangent: [f32; 3],
    pub handedness: f32,
    pub inward: [f32; 3],
    pub pad: f32,
    pub metres_per_uv: [f32; 2],
    pub pad_end: [f32; 2],
}

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Geometry {
    /// What is behind everything.
    Backdrop,
    /// The plane among other things.
    Plane,
    /// A mesh's triangles; `true`: their depth is the relief's.
    Facets(bool),
    /// A mesh as a shell.
    Shell,
    /// A mesh, or the plane alone, as micropolygons.
    Micropolygons,
    /// The walls over a mesh's borders, of micropolygons.
    Walls,
    /// The balls.
    Balls,
}

/// Where it goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// Into the picture.
    Radiance,
    /// Into one part of the channels.
    Channels(u32),
}

impl Geometry {
    /// Every geometry.
    pub const ALL: [Self; 8] = [
        Self::Backdrop,
        Self::Plane,
        Self::Facets(false),
        Self::Facets(true),
        Self::Shell,
        Self::Micropolygons,
        Self::Walls,
        Self::Balls,
    ];

    /// The WGSL parts with its entry points, in order, under `shaders/surface`.
    pub const fn stems(self) -> &'static [&'static str] {
        match self {
            Self::Backdrop => &["surface"],
            Self::Plane => &["surface", "raster", "plane"],
            Self::Facets(_) => &["raster", "facet"],
            Self::Shell => &["raster", "shell"],
            Self::Micropolygons | Self::Walls => &["raster", "micropolygon"],
            Self::Balls => &["surface", "raster", "ball"],
        }
    }

    const fn vertex_entry(self) -> &'static str {
        match self {
            Self::Backdrop | Self::Balls => "cover",
            Self::Plane => "outline",
            Self::Facets(_) => "facet_vertex",
            Self::Shell => "shell_vertex",
            Self::Micropolygons | Self::Walls => "micropolygon_vertex",
        }
    }

    const fn fragment_entry(self, output: Output) -> &'static str {
        match (self, output) {
            (Self::Backdrop, _) => "backdrop",
            (Self::Plane, Output::Radiance) => "plane",
            (Self::Plane, Output::Channels(_)) => "plane_channel",
            (Self::Facets(false), Output::Radiance) => "facet",
            (Self::Facets(true), Output::Radiance) => "facet_displaced",
            (Self::Facets(_), Output::Channels(_)) => "facet_channel",
            (Self::Shell, Output::Radiance) => "shell",
            (Self::Shell, Output::Channels(_)) => "shell_channel",
            (Self::Micropolygons, Output::Radiance) => "micropolygon",
            (Self::Micropolygons, Output::Channels(_)) => "micropolygon_channel",
            (Self::Walls, Output::Radiance) => "micropolygon_wall",
            (Self::Walls, Output::Channels(_)) => "micropolygon_wall_channel",
            (Self::Balls, Output::Radiance) => "ball",
            (Self::Balls, Output::Channels(_)) => "ball_channel",
        }
    }

    const fn cull_mode(self) -> Option<wgpu::Face> {
        match self {
            Self::Facets(_) | Self::Micropolygons | Self::Walls => Some(wgpu::Face::Back),
            // The far sides of a tetrahedron are seen even when the eye is inside.
            Self::Shell => Some(wgpu::Face::Front),
            Self::Backdrop | Self::Plane | Self::Balls => None,
        }
    }
}

/// Bind group layout 2: a mesh's vertices and triangles.
pub fn mesh_layout(gpu: &Gpu) -> BindingLayout {
    BindingLayout::new(gpu, "mesh", wgpu::ShaderStages::VERTEX_FRAGMENT, &[Binding::Read, Binding::Read])
}

/// Builds the pipeline that draws a geometry with these choices.
///
/// # Errors
///
/// The shader does not compile.
pub fn pipeline(
    gpu: &Gpu,
    groups: [&BindingLayout; 3],
    choice: Choice,
    geometry: Geometry,
    output: Output,
) -> Result<wgpu::RenderPipeline, ShaderError> {
    let label = geometry.fragment_entry(output);
    let parts = parts(gpu.filters_r32float(), choice, geometry.stems());
    let parts: Vec<_> = parts.iter().map(String::as_str).collect();
    let module = gpu.shaders.module(gpu, label, &parts)?;
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &groups.map(|group| Some(&group.layout)),
        immediate_size: 0,
    });
    let mut constants = constants(choice);
    if let Output::Channels(part) = output {
        constants.push(("CHANNEL_PART", f64::from(part)));
    }
    if geometry == Geometry::Shell {
        constants.push(("SHELL_FLAT", shell::FLAT));
    }
    let is_clipped = matches!(geometry, Geometry::Plane | Geometry::Micropolygons);
    let blend = (output == Output::Radiance && is_clipped).then_some(wgpu::BlendState::ALPHA_BLENDING);
    let micro_vertices = [Some(wgpu::VertexBufferLayout {
        array_stride: size_of::<MicroVertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &MicroVertex::ATTRIBUTES,
    })];
    let format = match output {
        Output::Radiance => Radiance::CONTRACT.format,
        Output::Channels(_) => CHANNEL_FORMAT,
    };
    let is_behind = geometry == Geometry::Backdrop;
    let compilation_options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    Ok(gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(geometry.vertex_entry()),
            compilation_options: compilation_options.clone(),
            buffers: if matches!(geometry, Geometry::Micropolygons | Geometry::Walls) { &micro_vertices } else { &[] },
        },
        primitive: wgpu::PrimitiveState { cull_mode: geometry.cull_mode(), ..Default::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(!is_behind),
            // Depth falls with distance.
            depth_compare: Some(if is_behind { wgpu::CompareFunction::Always } else { wgpu::CompareFunction::Greater }),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(label),
            compilation_options,
            targets: &[Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL })],
        }),
        multiview_mask: None,
        cache: None,
    }))
}

/// A mesh's buffers on the GPU.
pub struct MeshBuffers {
    vertices: wgpu::Buffer,
    triangles: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// Bind group 2.
    pub group: wgpu::BindGroup,
}

impl MeshBuffers {
    /// Makes them for a mesh as it is now; `as_shell` says whether its shell may be drawn.
    pub fn new(gpu: &Gpu, layout: &BindingLayout, vertices: &[Vertex], indices: &[u32], as_shell: bool) -> Self {
        let storage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let buffer = |label, contents: &[u8], usage| {
            let size = contents.len().max(16) as u64;
            let buffer =
                gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false });
            gpu.queue.write_buffer(&buffer, 0, contents);
            buffer
        };
        let triangles = if as_shell { shell::triangles(vertices, indices) } else { Vec::new() };
        let vertices = buffer("mesh vertices", bytemuck::cast_slice(&raster_vertices(vertices, indices)), storage);
        let triangles = buffer("shell triangles", bytemuck::cast_slice(&triangles), storage);
        let indices =
            buffer("mesh indices", bytemuck::cast_slice(indices), wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST);
        let group = layout.bind(gpu, &[vertices.as_entire_binding(), triangles.as_entire_binding()]);
        Self { vertices, triangles, indices, group }
    }

    /// Moves the vertices, of which there are as many as before.
    pub fn pose(&self, gpu: &Gpu, vertices: &[Vertex], indices: &[u32]) {
        gpu.queue.write_buffer(&self.vertices, 0, bytemuck::cast_slice(&raster_vertices(vertices, indices)));
    }

    /// Three indices a triangle, u32.
    pub fn indices(&self) -> wgpu::BufferSlice<'_> {
        self.indices.slice(..)
    }

    /// Bytes of GPU memory that they take.
    pub fn memory_bytes(&self) -> u64 {
        self.vertices.size() + self.triangles.size() + self.indices.size()
    }
}

/// The vertices of a mesh as shaders pull them.
pub(super) fn raster_vertices(vertices: &[Vertex], indices: &[u32]) -> Vec<RasterVertex> {
    let metres = facet::metres_per_uv(vertices, indices);
    let inward = shell::inward(vertices);
    let vertex = |((vertex, metres_per_uv), inward): ((&Vertex, [f32; 2]), glam::Vec3)| RasterVertex {
        position: vertex.position.to_array(),
        u: vertex.uv.x,
        normal: vertex.normal.to_array(),
        v: vertex.uv.y,
        tangent: vertex.tangent.truncate().to_array(),
        handedness: vertex.tangent.w,
        inward: inward.to_array(),
        pad: 0.0,
        metres_per_uv,
        pad_end: [0.0; 2],
    };
    vertices.iter().zip(metres).zip(inward).map(vertex).collect()
}
