//! The frame's uniform and sampler: bind group 0.

use glam::{DMat3, DMat4, DVec2, DVec4};

use crate::camera::Camera;
use crate::field::{base, material};
use crate::gpu::{Binding, BindingLayout, Gpu, Uniform, nearest_sampler};
use crate::scene::{Addressing, DirectionalLight, LIGHTS_MAX, Scene};

use super::level_of_detail::ViewDetail;
use super::ray_map::{self, LinearForm, Placement, RayMap, Target};
use super::reliefs::{self, SLABS_MAX, Slab};
use super::{Display, micropolygon, outline};

/// A ball beside the relief. Twin of the WGSL struct in `shaders/common/view.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "the WGSL twin documents the fields, and one place is enough")]
pub struct Ball {
    pub centre: [f32; 3],
    pub radius: f32,
    pub colour: [f32; 3],
    pub pad: u32,
}

/// The most balls of a scene.
pub const BALLS_MAX: usize = 4;

/// A directional light. Twin of the WGSL struct in `shaders/common/view.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "the WGSL twin documents the fields, and one place is enough")]
pub struct ViewLight {
    pub toward: [f32; 3],
    pub casts_shadow: u32,
    pub radiance: [f32; 3],
    pub pad: u32,
}

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
    pub pom_counts: u32,
    pub steep_layers: f32,
    pub relief_linear_steps: f32,
    pub relief_binary_steps: u32,
    pub relief_depth_bias: u32,
    pub pyramid_leaf: u32,
    pub pad_trace: [u32; 2],
    pub u_world: [f32; 3],
    pub first_row: u32,
    pub v_world: [f32; 3],
    pub displaced_depth: u32,
    pub up_world: [f32; 3],
    pub mesh_quads: u32,
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
    pub roughness: f32,
    pub image_size: [u32; 2],
    pub planar: u32,
    pub ball_count: u32,
    pub metallic: f32,
    pub reflection: f32,
    pub index: f32,
    pub gain: f32,
    pub light_radius: f32,
    pub area_samples: u32,
    pub level_cap: u32,
    pub pad_lights: u32,
    pub lights: [ViewLight; LIGHTS_MAX],
    pub direction_x: LinearForm,
    pub direction_y: LinearForm,
    pub direction_z: LinearForm,
    pub clip_from_eye: [f32; 16],
    pub eye_rest: [f32; 3],
    pub near_metres: f32,
    pub forward_world: [f32; 3],
    pub pad_forward: u32,
    pub balls: [Ball; BALLS_MAX],
    pub repeat: [f32; 2],
    pub slab_count: u32,
    pub own_slab: u32,
    pub moment: f32,
    pub glow: f32,
    pub detail: ViewDetail,
    pub pad_detail: [u32; 2],
    pub slabs: [Slab; SLABS_MAX],
    pub water_absorption: [f32; 3],
    pub slab_penumbra: f32,
    pub water_scatter: [f32; 3],
    pub pad_water: u32,
    pub core_centre: [f32; 3],
    pub core_radius: f32,
    pub outline: [[f32; 2]; outline::CORNERS_MAX],
    pub pad_outline: [u32; 2],
}

impl View {
    /// What `camera` sees of `scene` at a time, in a picture of `image_size` traced pixels.
    pub fn new(scene: &Scene, camera: &Camera, time_seconds: f64, image_size: [u32; 2], display: impl Into<Display>) -> Self {
        let display = display.into();
        let all_lights = scene.all_lights();
        let mut lights = [ViewLight::default(); LIGHTS_MAX];
        for (slot, light) in lights.iter_mut().zip(&all_lights) {
            *slot = ViewLight {
                toward: light.direction(time_seconds).as_vec3().to_array(),
                casts_shadow: u32::from(light.casts_shadow),
                radiance: light.colour.map(|colour| colour * light.intensity),
                pad: 0,
            };
        }
        let depth_metres = f64::from(scene.plane.depth_metres);
        let plane_size_metres = scene.plane_size_metres();
        let target = Target { placement: Placement::default(), field_size: scene.field.size, plane_size_metres, depth_metres };
        let direction = ray_map::direction_forms(camera, image_size).map(|form| LinearForm::new(form, image_size));
        let eye = camera.eye();
        let mut balls = [Ball::default(); BALLS_MAX];
        for (ball, settings) in balls.iter_mut().zip(&scene.balls) {
            *ball = Ball { centre: settings.centre, radius: settings.radius_metres, colour: settings.colour, pad: 0 };
        }
        let light = light_direction(scene, time_seconds);
        let texel_metres = scene.texel_metres();
        let view = Self {
            field_size: scene.field.size,
            wrap: u32::from(scene.field.addressing == Addressing::Wrap),
            step_cap: scene.trace.step_cap,
            depth_metres: scene.plane.depth_metres,
            pom_samples_min: scene.trace.pom_samples_min as f32,
            pom_samples_max: scene.trace.pom_samples_max as f32,
            shadow_samples: scene.trace.shadow_samples as f32,
            shadow_strength: scene.trace.shadow_strength,
            pom_counts: scene.trace.pom_counts as u32,
            steep_layers: scene.trace.steep_layers as f32,
            relief_linear_steps: scene.trace.relief_linear_steps as f32,
            relief_binary_steps: scene.trace.relief_binary_steps,
            relief_depth_bias: u32::from(scene.trace.relief_depth_bias),
            pyramid_leaf: scene.trace.pyramid_leaf as u32,
            pad_trace: [0; 2],
            displaced_depth: u32::from(scene.trace.displaced_depth),
            mesh_quads: micropolygon::pieces(scene.trace.mesh_triangles, 2),
            eye_world: eye.as_vec3().to_array(),
            specular: scene.material.specular,
            light_world: light.as_vec3().to_array(),
            shininess: scene.material.shininess,
            light_radiance: scene.light.colour.map(|colour| colour * scene.light.intensity),
            rest_height: base::rest_height(&scene.base),
            sky: scene.light.sky,
            texel_metres: texel_metres as f32,
            ground: scene.light.ground,
            shows: display.shows as u32,
            tint: scene.material.tint,
            roughness: scene.material.roughness,
            image_size,
            metallic: scene.material.metallic,
            reflection: scene.material.reflection,
            index: scene.material.refractive_index,
            gain: display.gain,
            level_cap: display.level_cap,
            light_radius: scene.light.half_angle_degrees.to_radians().tan(),
            area_samples: scene.trace.area_samples,
            lights,
            // Validation refuses more balls than there is room for.
            ball_count: scene.balls.len() as u32,
            direction_x: direction[0],
            direction_y: direction[1],
            direction_z: direction[2],
            clip_from_eye: clip_from_eye(camera, image_size).as_mat4().to_cols_array(),
            eye_rest: (eye - eye.as_vec3().as_dvec3()).as_vec3().to_array(),
            near_metres: camera.near_metres as f32,
            forward_world: camera.forward().as_vec3().to_array(),
            balls,
            repeat: scene.plane.repeat.map(|times| times as f32),
            moment: scene.cooling_seconds().map_or(0.0, |cooling_seconds| material::moment(time_seconds, cooling_seconds)),
            glow: scene.explosions.as_ref().map_or(0.0, |explosions| explosions.glow),
            detail: ViewDetail::new(scene),
            water_absorption: scene.shallow_water.as_ref().map_or([0.0; 3], |water| water.absorption_per_metre),
            water_scatter: scene.shallow_water.as_ref().map_or([0.0; 3], |water| water.scatter),
            ..Self::default()
        };
        view.over(camera, &target)
    }

    /// The same view of what stands among the reliefs of a scene, and is one of them or none: the others cast their shadows on it.
    #[must_use]
    pub fn among(self, scene: &Scene, own: Option<usize>) -> Self {
        let all = reliefs::slabs(scene);
        let mut slabs = [Slab::default(); SLABS_MAX];
        // Validation refuses more reliefs than there is room for.
        for (slot, slab) in slabs.iter_mut().zip(&all) {
            *slot = *slab;
        }
        let own_slab = own.map_or(u32::MAX, |index| index as u32);
        Self { slabs, slab_count: all.len() as u32, own_slab, slab_penumbra: reliefs::penumbra(scene), ..self }
    }

    /// The same view of another flat relief.
    #[must_use]
    pub fn over(self, camera: &Camera, target: &Target) -> Self {
        let rays = RayMap::new(camera, self.image_size, target);
        let placement = &target.placement;
        let size = DVec2::from(target.field_size.map(f64::from));
        let half_extent = 0.5 * DVec2::from(self.repeat.map(f64::from)) * size;
        let forms = ray_map::exact_forms(camera, self.image_size, target);
        let eye_height = placement.local(camera.eye()).y;
        Self {
            outline: outline::corners(&forms, eye_height, self.image_size, half_extent, 0.5 * size - 0.5),
            lattice_x: rays.lattice[0],
            lattice_y: rays.lattice[1],
            travel_x: rays.travel[0],
            travel_y: rays.travel[1],
            denominator: rays.denominator,
            nearest: rays.nearest,
            plane_size_metres: target.plane_size_metres.map(|metres| metres as f32),
            u_world: placement.u.as_vec3().to_array(),
            v_world: placement.v.as_vec3().to_array(),
            up_world: placement.up.as_vec3().to_array(),
            origin_world: placement.origin.as_vec3().to_array(),
            ..self
        }
    }
}

/// From what is counted from the eye, in the world's axes, to clip space: x and y as the picture has them, depth the near distance
/// over the distance along the view axis.
fn clip_from_eye(camera: &Camera, image_size: [u32; 2]) -> DMat4 {
    let [width, height] = image_size.map(f64::from);
    let per_half_height = 1.0 / (0.5 * camera.vertical_fov_radians).tan();
    let per_half_width = per_half_height * height / width;
    let clip_from_view = DMat4::from_cols(
        DVec4::new(per_half_width, 0.0, 0.0, 0.0),
        DVec4::new(0.0, per_half_height, 0.0, 0.0),
        DVec4::new(-2.0 * camera.lens_shift.x * height / width, 2.0 * camera.lens_shift.y, 0.0, -1.0),
        DVec4::new(0.0, 0.0, camera.near_metres, 0.0),
    );
    clip_from_view * DMat4::from_mat3(DMat3::from_mat4(camera.world_from_view).transpose())
}

/// The unit direction toward the scene's light at a time, in the world.
pub fn light_direction(scene: &Scene, time_seconds: f64) -> glam::DVec3 {
    DirectionalLight::of(&scene.light).direction(time_seconds)
}

/// Bind group 0: the frame's uniform, its bilinear sampler and one that does not filter.
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
        wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE,
        &[Binding::Uniform, Binding::Sampler(true), Binding::Sampler(false)],
    )
}

impl ViewSet {
    /// Makes one for a field of this addressing.
    pub fn new(gpu: &Gpu, layout: &BindingLayout, addressing: Addressing) -> Self {
        let address_mode = match addressing {
            Addressing::Wrap => wgpu::AddressMode::Repeat,
            Addressing::Clamp => wgpu::AddressMode::ClampToEdge,
        };
        let bilinear = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("bilinear"),
            address_mode_u: address_mode,
            address_mode_v: address_mode,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            // Between levels as well as texels: what is read at a level of detail moves smoothly with it.
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let nearest = nearest_sampler(gpu, addressing == Addressing::Wrap);
        let uniform = Uniform::new(gpu, "view");
        let [bilinear, nearest] = [&bilinear, &nearest].map(wgpu::BindingResource::Sampler);
        let group = layout.bind(gpu, &[uniform.buffer.as_entire_binding(), bilinear, nearest]);
        Self { uniform, group }
    }
}
