//! One frame: from what was asked to radiance, top to bottom. [`Frame::record`] is the table of contents.

use std::collections::HashMap;

use crate::camera::Camera;
use crate::field::compose::{Compose, ComposeSet};
use crate::field::normals::{Normals, NormalsSet};
use crate::field::pyramid::{Pyramid, PyramidSet};
use crate::field::{Field, Region};
use crate::gpu::{BindingLayout, Gpu, Recorder, Role, ShaderError, Texture, Timer};
use crate::present::{Present, PresentSet};
use crate::scene::Scene;
use crate::surface::surface::{Radiance, SurfaceSet};
use crate::surface::{Albedo, Shadow, Shows, Surface, Technique, View, ViewSet, view};

/// What a frame starts from: a scene whose field size is settled, and the heights that its base stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// The scene.
    pub scene: Scene,
    /// `width · height` heights, row by row.
    pub heights: Vec<f32>,
}

/// What one frame is asked.
#[derive(Clone, Copy, Debug)]
pub struct FrameInput<'a> {
    /// The time that it shows, seconds.
    pub time_seconds: f64,
    /// Where it is seen from.
    pub camera: &'a Camera,
    /// What the picture shows.
    pub shows: Shows,
}

/// Why there is no frame.
#[derive(Debug, thiserror::Error)]
pub enum FrameError {
    /// A shader does not compile.
    #[error(transparent)]
    Shader(#[from] ShaderError),
    /// A size is beyond the adapter.
    #[error("{what} of {width}×{height} is beyond this adapter's limit of {limit} {unit}; {remedy}")]
    Limit {
        /// What is too large.
        what: &'static str,
        /// Its width.
        width: u32,
        /// Its height.
        height: u32,
        /// The limit.
        limit: u64,
        /// The limit's unit.
        unit: &'static str,
        /// What to do about it.
        remedy: &'static str,
    },
}

/// The passes, the field that they work on, and where their picture goes.
pub struct Frame {
    /// How long each pass takes.
    pub timer: Timer,
    /// The field.
    pub field: Field,
    scene: Scene,
    view_layout: BindingLayout,
    view_set: ViewSet,
    compose: Compose,
    compose_set: ComposeSet,
    normals: Normals,
    normals_set: NormalsSet,
    pyramid: Pyramid,
    pyramid_set: PyramidSet,
    /// One for each choice that was ever shown: switching back costs nothing.
    surfaces: HashMap<(Technique, Shadow, Albedo), (Surface, SurfaceSet)>,
    present: Present,
    radiance: Texture<Radiance>,
    present_set: PresentSet,
    image_size: [u32; 2],
    /// Whether the height field must be derived anew.
    stale: bool,
}

impl Frame {
    /// Builds every pass and fills the field; pictures will have `image_size` pixels, in targets of format `target`.
    ///
    /// # Errors
    ///
    /// A size is beyond the adapter's limits, or a shader does not compile.
    pub fn new(gpu: &Gpu, start: &Start, image_size: [u32; 2], target: wgpu::TextureFormat) -> Result<Self, FrameError> {
        let scene = start.scene.clone();
        check_limits(gpu, &scene, image_size)?;
        let field = Field::new(gpu, scene.field.size, scene.field.addressing, scene.wave.is_some());
        let view_layout = view::layout(gpu);
        let view_set = ViewSet::new(gpu, &view_layout, field.addressing);
        let (compose, normals, pyramid) = (Compose::new(gpu)?, Normals::new(gpu)?, Pyramid::new(gpu)?);
        let (compose_set, normals_set, pyramid_set) =
            (compose.bind(gpu, &field), normals.bind(gpu, &field), pyramid.bind(gpu, &field));
        let present = Present::new(gpu, target)?;
        let radiance = Texture::new(gpu, traced_size(&scene, image_size));
        let present_set = present.bind(gpu, &radiance.view);
        let mut frame = Self {
            timer: Timer::new(gpu),
            field,
            scene,
            view_layout,
            view_set,
            compose,
            compose_set,
            normals,
            normals_set,
            pyramid,
            pyramid_set,
            surfaces: HashMap::new(),
            present,
            radiance,
            present_set,
            image_size,
            stale: true,
        };
        frame.reset(gpu, start);
        frame.build_surface(gpu)?;
        Ok(frame)
    }

    /// Puts the field back to its start.
    pub fn reset(&mut self, gpu: &Gpu, start: &Start) {
        self.field.relief.write(gpu, &start.heights);
        self.stale = true;
    }

    /// Takes over what does not change the field's contents: trace, light, material, depth.
    ///
    /// # Errors
    ///
    /// The picture's size with the new supersampling is beyond the adapter's limits, or a shader does not compile: the frame
    /// goes on with what it had.
    pub fn set_scene(&mut self, gpu: &Gpu, scene: &Scene) -> Result<(), FrameError> {
        check_limits(gpu, scene, self.image_size)?;
        let before = std::mem::replace(&mut self.scene, scene.clone());
        if let Err(error) = self.build_surface(gpu) {
            self.scene = before;
            return Err(error.into());
        }
        if before.trace.supersampling != scene.trace.supersampling {
            self.retarget(gpu);
        }
        self.stale = true;
        Ok(())
    }

    /// Changes the size of the picture.
    ///
    /// # Errors
    ///
    /// The size is beyond the adapter's limits; the frame keeps the old one.
    pub fn resize(&mut self, gpu: &Gpu, image_size: [u32; 2]) -> Result<(), FrameError> {
        check_limits(gpu, &self.scene, image_size)?;
        self.image_size = image_size;
        self.retarget(gpu);
        Ok(())
    }

    fn retarget(&mut self, gpu: &Gpu) {
        self.radiance = Texture::new(gpu, traced_size(&self.scene, self.image_size));
        self.present_set = self.present.bind(gpu, &self.radiance.view);
    }

    fn choice(&self) -> (Technique, Shadow, Albedo) {
        (self.scene.trace.technique, self.scene.trace.shadow, self.scene.material.albedo)
    }

    fn build_surface(&mut self, gpu: &Gpu) -> Result<(), ShaderError> {
        let choice = self.choice();
        if !self.surfaces.contains_key(&choice) {
            let surface = Surface::new(gpu, &self.view_layout, choice.0, choice.1, choice.2)?;
            let set = surface.bind(gpu, &self.field);
            self.surfaces.insert(choice, (surface, set));
        }
        Ok(())
    }

    /// The scene that it shows.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Width and height of the picture, pixels.
    pub fn image_size(&self) -> [u32; 2] {
        self.image_size
    }

    /// Bytes of GPU memory of every texture.
    pub fn memory_bytes(&self) -> u64 {
        self.field.memory_bytes() + self.radiance.memory_bytes()
    }

    /// Records one frame.
    pub fn record(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, input: &FrameInput<'_>, target: &wgpu::TextureView) {
        let recorder = &mut Recorder { gpu, encoder, timer: &self.timer };
        if self.stale {
            self.derive(recorder, &[Region::all(self.field.size)]);
        }
        self.show(recorder, input, target);
        self.stale = false;
    }

    /// Derives everything that depends on the layers alone, over the texels that changed.
    fn derive(&self, recorder: &mut Recorder<'_>, changed: &[Region]) {
        let (size, addressing) = (self.field.size, self.field.addressing);
        // Compose relief and waves into the height field proper.
        self.compose.record(recorder, &self.compose_set, changed, 0.0, 0);
        // Everything below depends on that height alone: its slope, which a texel's neighbours see …
        let sloped: Vec<_> = changed.iter().flat_map(|region| region.grown(1, 1, size, addressing)).collect();
        self.normals.record(recorder, &self.normals_set, &sloped, slope_per_height(&self.scene));
        // … and its bounds, which the cells before a texel see.
        let cells: Vec<_> = changed.iter().flat_map(|region| region.grown(1, 0, size, addressing)).collect();
        self.pyramid.record(recorder, &self.pyramid_set, &cells);
    }

    /// Shows the field as it stands.
    fn show(&self, recorder: &mut Recorder<'_>, input: &FrameInput<'_>, target: &wgpu::TextureView) {
        let Some((surface, surface_set)) = self.surfaces.get(&self.choice()) else {
            unreachable!("every change of the choice builds its surface first")
        };
        // March, shade and shadow what the camera sees.
        let traced = traced_size(&self.scene, self.image_size);
        self.view_set.uniform.write(recorder.gpu, &View::new(&self.scene, input.camera, input.time_seconds, traced, input.shows));
        surface.record(recorder, &self.view_set, surface_set, &self.radiance.view);
        // Tone-map to whatever we were given: a window or an image.
        let tone_map = input.shows == Shows::Picture;
        let supersampling = self.scene.trace.supersampling;
        self.present.record(recorder, &self.present_set, supersampling, tone_map, target);
    }
}

/// Traced pixels of a picture of `image_size`.
fn traced_size(scene: &Scene, image_size: [u32; 2]) -> [u32; 2] {
    image_size.map(|pixels| pixels * scene.trace.supersampling)
}

/// Depth over the texel's width and height.
fn slope_per_height(scene: &Scene) -> [f32; 2] {
    let slope = scene.plane.depth_metres * scene.field.size[0] as f32 / scene.plane.width_metres;
    [slope, slope]
}

/// Checks every size against the adapter before anything is made.
fn check_limits(gpu: &Gpu, scene: &Scene, image_size: [u32; 2]) -> Result<(), FrameError> {
    let limits = gpu.device.limits();
    let texture = u64::from(limits.max_texture_dimension_2d);
    let check = |what, size: [u32; 2], remedy| {
        if size.iter().any(|&edge| u64::from(edge) > texture) {
            Err(FrameError::Limit { what, width: size[0], height: size[1], limit: texture, unit: "texels an axis", remedy })
        } else {
            Ok(())
        }
    };
    check("a field", scene.field.size, "ask for a smaller one with --field")?;
    let ways_out = "ask for a smaller one with --size, or for less supersampling in the scene";
    let traced = image_size.map(|pixels| pixels.saturating_mul(scene.trace.supersampling));
    check("a picture", traced, ways_out)?;
    // The buffer that a picture is read back through.
    let bytes = u64::from(traced[0]).saturating_mul(u64::from(traced[1])) * u64::from(Radiance::CONTRACT.texel_bytes());
    if bytes > limits.max_buffer_size {
        return Err(FrameError::Limit {
            what: "a picture",
            width: traced[0],
            height: traced[1],
            limit: limits.max_buffer_size,
            unit: "bytes",
            remedy: ways_out,
        });
    }
    Ok(())
}
