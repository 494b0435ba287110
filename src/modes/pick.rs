//! Picking: which point of the displaced surface a pixel shows. By the very function that drew it ([`Probe`]).

use std::collections::{HashMap, VecDeque};

use glam::{DVec2, DVec3};

use crate::camera::Camera;
use crate::frame::Frame;
use crate::gpu::{Gpu, Readback, ShaderError};
use crate::scene::Scene;
use crate::surface::probe::{Hit, Ray};
use crate::surface::ray_map::{self, Target};
use crate::surface::{Probe, Shadow, Shows, Technique, View, view};

/// The ray through a pixel of a picture, from the plane inward; `None` above the horizon, or behind the eye.
pub fn ray(scene: &Scene, camera: &Camera, image_size: [u32; 2], pixel: DVec2) -> Option<Ray> {
    let target = Target {
        field_size: scene.field.size,
        plane_size_metres: view::plane_size_metres(scene),
        depth_metres: f64::from(scene.plane.depth_metres),
    };
    let forms = ray_map::exact_forms(camera, image_size, &target);
    let pixel = DVec3::new(pixel.x, pixel.y, 1.0);
    let denominator = forms.denominator.dot(pixel);
    if denominator <= 0.0 || camera.eye().y <= 0.0 {
        return None;
    }
    let at = |form: DVec3| (form.dot(pixel) / denominator) as f32;
    Some(Ray { lattice: forms.lattice.map(at), travel: forms.travel.map(at), height: 1.0, rise: -1.0 })
}

/// Asks the GPU what pixels show, and has the answers some frames later.
#[derive(Default)]
pub struct Picker {
    /// One for each technique that was asked: a shader takes a while to build.
    probes: HashMap<Technique, Probe>,
    pending: VecDeque<Readback>,
}

impl Picker {
    /// As many questions as may be open: more would only pile up behind a slow GPU.
    const MOST_PENDING: usize = 4;

    /// Asks what pixels of the picture that is on show hold. Pixels that look past the plane are left out.
    ///
    /// # Errors
    ///
    /// The technique's shader does not compile.
    pub fn ask(
        &mut self,
        gpu: &Gpu,
        frame: &Frame,
        camera: &Camera,
        time_seconds: f64,
        pixels: &[DVec2],
    ) -> Result<(), ShaderError> {
        let (scene, image_size) = (frame.scene(), frame.image_size());
        let rays: Vec<Ray> = pixels.iter().filter_map(|&pixel| ray(scene, camera, image_size, pixel)).collect();
        if rays.is_empty() || self.pending.len() >= Self::MOST_PENDING {
            return Ok(());
        }
        let technique = scene.trace.technique;
        if !self.probes.contains_key(&technique) {
            self.probes.insert(technique, Probe::new(gpu, technique, Shadow::None)?);
        }
        let view = View::new(scene, camera, time_seconds, image_size, Shows::Picture);
        self.pending.push_back(self.probes[&technique].trace(gpu, &frame.field, &view, &rays));
        Ok(())
    }

    /// Whether answers are on their way.
    pub fn waits(&self) -> bool {
        !self.pending.is_empty()
    }

    /// Forgets what was asked: another field is on show.
    pub fn forget(&mut self) {
        self.pending.clear();
    }

    /// The lattice positions of the surface that have arrived, in the order of the questions. The device must have been polled.
    pub fn answers(&mut self) -> Vec<[f32; 2]> {
        let mut hits = Vec::new();
        while let Some(answer) = self.pending.front().and_then(Readback::take) {
            self.pending.pop_front();
            match answer {
                Ok(bytes) => hits.extend(bytemuck::pod_collect_to_vec::<u8, Hit>(&bytes)),
                Err(error) => log::warn!("a click is lost: {error}"),
            }
        }
        hits.into_iter().filter(|hit| hit.status == Hit::HIT).map(|hit| hit.lattice).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_meets_the_plane_where_the_camera_sees_it() {
        let mut scene = Scene::default();
        scene.field.size = [256, 128];
        let camera = Camera::at(&scene.camera, 0.0);
        let (pixel, size) = (DVec2::new(100.5, 333.5), [640, 480]);
        let ray = ray(&scene, &camera, size, pixel).expect("this pixel looks down");
        let direction = camera.direction(pixel, size);
        let texel = f64::from(scene.plane.width_metres) / 256.0;
        let at = |y: f64| {
            let point = camera.eye() + direction * ((y - camera.eye().y) / direction.y);
            [point.x / texel + 127.5, point.z / texel + 63.5]
        };
        let (top, bottom) = (at(0.0), at(-f64::from(scene.plane.depth_metres)));
        for axis in 0..2 {
            assert!((f64::from(ray.lattice[axis]) - top[axis]).abs() < 1e-3);
            assert!((f64::from(ray.travel[axis]) - (bottom[axis] - top[axis])).abs() < 1e-3);
        }
    }

    #[test]
    fn the_sky_is_not_picked() {
        let scene = Scene::default();
        let camera = Camera::look_at(DVec3::new(0.0, 0.5, 2.0), DVec3::new(0.0, 0.5, 0.0), 1.0, 0.01);
        assert!(ray(&scene, &camera, [100, 100], DVec2::new(50.0, 10.0)).is_none());
        assert!(ray(&scene, &camera, [100, 100], DVec2::new(50.0, 90.0)).is_some());
    }
}
