//! The frame's uniform and sampler: bind group 0.

use crate::camera::Camera;
use crate::field::base;
use crate::gpu::{Binding, BindingLayout, Gpu, Uniform};
use crate::scene::{Addressing, Scene};

use super::Shows;
use super::ray_map::{LinearForm, RayMap, Target};

/// What is seen, how it is traced, how it is lit. Twin of the WGSL struct in `shaders/common/view.wgsl`, where each field's meaning
/// and unit stand.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "the WGSL twin documents the fields, and one place is enough")]
pub struct View {
    pub lattice_x: LinearForm,
    pub lattice_y: LinearForm,
    pub travel_x: LinearForm,
    pub travel_y: LinearForm,
    pub denominator: LinearForm,
    pub field_size: [u32; 2],
    pub wrap: u32,
    pub step_cap: u32,
    pub plane_size_metres: [f32; 2],
    pub depth_metres: f32,
    pub nearest: f32,
    pub pom_samples_min: f32,
    pub pom_samples_max: f32,
    pub shadow_samples: f32,
    pub shadow_strength: f32,
    pub u_world: [f32; 3],
    pub first_row: u32,
    pub v_world: [f32; 3],
    pub displaced_depth: u32,
    pub up_world: [f32; 3],
    pub pad_up: u32,
    pub origin_world: [f32; 3],
    pub pad_origin: u32,
    pub eye_world: [f32; 3],
    pub specular: f32,
    pub light_world: [f32; 3],
    pub shininess: f32,
    pub light_radiance: [f32; 3],
    pub rest_height: f32,
    pub sky: [f32; 3],
    pub texel_metres: f32,
    pub ground: [f32; 3],
    pub shows: u32,
    pub tint: [f32; 3],
    pub pad_tint: u32,
    pub image_size: [u32; 2],
    pub pad: [u32; 2],
}

impl View {
    /// What `camera` sees of `scene` at a time, in a picture of `image_size` traced pixels.
    pub fn new(scene: &Scene, camera: &Camera, time_seconds: f64, image_size: [u32; 2], shows: Shows) -> Self {
        let plane_size = scene.plane_size_metres();
        let depth_metres = f64::from(scene.plane.depth_metres);
        let rays = RayMap::new(
            camera,
            image_size,
            &Target { field_size: scene.field.size, plane_size_metres: plane_size, depth_metres },
        );
        let light = light_direction(scene, time_seconds);
        let texel_metres = scene.texel_metres();
        Self {
            lattice_x: rays.lattice[0],
            lattice_y: rays.lattice[1],
            travel_x: rays.travel[0],
            travel_y: rays.travel[1],
            denominator: rays.denominator,
            field_size: scene.field.size,
            wrap: u32::from(scene.field.addressing == Addressing::Wrap),
            step_cap: scene.trace.step_cap,
            plane_size_metres: plane_size.map(|metres| metres as f32),
            depth_metres: scene.plane.depth_metres,
            nearest: rays.nearest,
            pom_samples_min: scene.trace.pom_samples_min as f32,
            pom_samples_max: scene.trace.pom_samples_max as f32,
            shadow_samples: scene.trace.shadow_samples as f32,
            shadow_strength: scene.trace.shadow_strength,
            u_world: [1.0, 0.0, 0.0],
            first_row: 0,
            v_world: [0.0, 0.0, 1.0],
            displaced_depth: 0,
            up_world: [0.0, 1.0, 0.0],
            pad_up: 0,
            origin_world: [0.0; 3],
            pad_origin: 0,
            eye_world: camera.eye().as_vec3().to_array(),
            specular: scene.material.specular,
            light_world: light.as_vec3().to_array(),
            shininess: scene.material.shininess,
            light_radiance: scene.light.colour.map(|colour| colour * scene.light.intensity),
            rest_height: base::rest_height(&scene.base),
            sky: scene.light.sky,
            texel_metres: texel_metres as f32,
            ground: scene.light.ground,
            shows: shows as u32,
            tint: scene.material.tint,
            pad_tint: 0,
            image_size,
            pad: [0; 2],
        }
    }
}

/// The unit direction toward the scene's light at a time, in the world.
pub fn light_direction(scene: &Scene, time_seconds: f64) -> glam::DVec3 {
    let light = &scene.light;
    let turned = f64::from(light.turn_degrees_per_second) * time_seconds;
    let azimuth = (f64::from(light.azimuth_degrees) + turned).to_radians();
    let elevation = f64::from(light.elevation_degrees).to_radians();
    glam::DVec3::new(elevation.cos() * azimuth.cos(), elevation.sin(), elevation.cos() * azimuth.sin())
}

/// Bind group 0: the frame's uniform and its bilinear sampler.
pub struct ViewSet {
    /// The uniform.
    pub uniform: Uniform<View>,
    /// Its bind group.
    pub group: wgpu::BindGroup,
}

/// Bind group layout 0.
pub fn layout(gpu: &Gpu) -> BindingLayout {
    BindingLayout::new(
        gpu,
        "view",
        wgpu::ShaderStages::FRAGMENT | wgpu::ShaderStages::COMPUTE,
        &[Binding::Uniform, Binding::Sampler(true)],
    )
}

impl ViewSet {
    /// Makes one for a field of this addressing.
    pub fn new(gpu: &Gpu, layout: &BindingLayout, addressing: Addressing) -> Self {
        let address_mode = match addressing {
            Addressing::Wrap => wgpu::AddressMode::Repeat,
            Addressing::Clamp => wgpu::AddressMode::ClampToEdge,
        };
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("bilinear"),
            address_mode_u: address_mode,
            address_mode_v: address_mode,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let uniform = Uniform::new(gpu, "view");
        let group = layout.bind(gpu, &[uniform.buffer.as_entire_binding(), wgpu::BindingResource::Sampler(&sampler)]);
        Self { uniform, group }
    }
}
