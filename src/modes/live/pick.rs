//! Picking: which point of the displaced surface a pixel shows. By the very function that drew it ([`Probe`]).
//!
//! It is the scene's own relief that is picked, as if nothing stood before it: reliefs beside it are still, and no stroke reaches them.

use std::collections::hash_map::Entry;
use std::collections::{HashMap, VecDeque};

use glam::DVec2;

use crate::camera::Camera;
use crate::frame::Frame;
use crate::gpu::{Gpu, Readback, ShaderError};
use crate::surface::probe::{Hit, Ray};
use crate::surface::ray_map::{Placement, Target, pixel_ray};
use crate::surface::{Probe, Shadow, Shows, Technique, View, facet};

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
        let target = Target {
            placement: Placement::default(),
            field_size: scene.field.size,
            plane_size_metres: scene.plane_size_metres(),
            depth_metres: f64::from(scene.plane.depth_metres),
        };
        let posed = frame.mesh().map(|mesh| (mesh.posed(time_seconds), &mesh.indices));
        let ray = |pixel: &DVec2| match &posed {
            None => pixel_ray(camera, image_size, &target, pixel.to_array()),
            Some((vertices, indices)) => {
                let direction = camera.direction(*pixel, image_size);
                facet::pick(vertices, indices, target.field_size, target.depth_metres, camera.eye(), direction)
            }
        };
        let rays: Vec<Ray> = pixels.iter().filter_map(ray).collect();
        if rays.is_empty() || self.pending.len() >= Self::MOST_PENDING {
            return Ok(());
        }
        let technique = scene.trace.technique;
        let probe = match self.probes.entry(technique) {
            Entry::Occupied(entry) => entry.into_mut(),
            Entry::Vacant(entry) => entry.insert(Probe::new(gpu, technique, Shadow::None)?),
        };
        let view = View::new(scene, camera, time_seconds, image_size, Shows::Picture);
        self.pending.push_back(probe.trace(gpu, &frame.field, &view, &rays));
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
