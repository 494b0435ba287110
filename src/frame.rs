//! One frame: from what was asked to radiance, top to bottom. [`Frame::record`] is the table of contents.

mod reliefs;

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use crate::camera::Camera;
use crate::clock::{StepSeconds, Tick};
use crate::field::bins::BinError;
use crate::field::derive::{Derivation, Derive, DeriveSet};
use crate::field::groundwork::Groundwork;
use crate::field::sequence::Images;
use crate::field::source::{self, Health, Source, State};
use crate::field::stamp::StampImage;
use crate::field::{self, Cover, Dirty, Field, Region, Stack, base, bounds, material, normal_mips, normals, pyramid, stack};
use crate::gpu::{BindingLayout, Gpu, Recorder, Role, ShaderError, Texture, Timer};
use crate::io::sums::Sums;
use crate::mesh::{Mesh, shapes};
use crate::present::{Present, PresentSet};
use crate::scene::{Plane, Scene};
use crate::stroke::Strokes;
use crate::surface::albedo_image::{self, ColourImage};
use crate::surface::surface::{Radiance, SurfaceSet};
use crate::surface::{Choice, Display, Seen, Shows, Stage, Surface, Technique, View, ViewSet, shell, view};
use reliefs::Stills;

/// What a frame starts from: a scene whose field size is settled, and its layers.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// The scene.
    pub scene: Scene,
    /// `width · height` heights, row by row: the base, and the posts that stand on it.
    pub heights: Vec<f32>,
    /// As many texels of [`crate::field::Material`].
    pub material: Vec<u32>,
    /// The mesh that carries the relief; none: the plane.
    pub mesh: Option<Mesh>,
    /// The picture over it, if any.
    pub colours: Option<ColourImage>,
    /// The images that its stamps may have for their form.
    pub images: Vec<StampImage>,
    /// What each of the reliefs beside it starts from, as the scene that it is alone.
    pub reliefs: Vec<Start>,
}

impl Start {
    /// The start of a scene whose base has these heights, and whose mesh, if it has one, is this.
    pub fn new(scene: &Scene, heights: Vec<f32>, mesh: Option<Mesh>) -> Self {
        let mut start = Self {
            scene: scene.clone(),
            material: vec![0; heights.len()],
            heights,
            mesh,
            colours: None,
            images: Vec::new(),
            reliefs: Vec::new(),
        };
        for (texel, top) in base::posts(scene) {
            start.heights[texel] = top;
            start.material[texel] = material::POST;
        }
        start
    }

    /// Takes over a scene with the same field. Another seed makes another base, where the base is the program's own; an image has no
    /// seed, nor has a text.
    pub fn take_scene(&mut self, scene: &Scene) {
        if scene.seed != self.scene.seed
            && let Some(heights) = base::heights(scene)
        {
            let reliefs = std::mem::take(&mut self.reliefs);
            *self = Self::new(scene, heights, self.mesh.take()).with_colours(self.colours.take()).with_reliefs(reliefs);
        }
        self.scene = scene.clone();
        for (start, relief) in self.reliefs.iter_mut().zip(&scene.reliefs) {
            start.take_scene(&relief.alone(scene));
        }
    }

    /// The same under a picture, if there is one.
    pub fn with_colours(self, colours: Option<ColourImage>) -> Self {
        Self { colours, ..self }
    }

    /// The same beside these reliefs, as many as the scene has.
    pub fn with_reliefs(self, reliefs: Vec<Start>) -> Self {
        Self { reliefs, ..self }
    }

    /// What tells it from another start.
    pub fn sums(&self) -> Sums {
        Sums::of(&self.heights, &self.images)
    }

    /// The same with images for its stamps.
    pub fn with_images(self, images: Vec<StampImage>) -> Self {
        Self { images, ..self }
    }
}

/// What one frame is asked.
#[derive(Clone, Copy, Debug)]
pub struct FrameInput<'a> {
    /// The time that it shows and the steps that it owes.
    pub tick: &'a Tick,
    /// What is done to the field in it.
    pub strokes: &'a Strokes,
    /// Where it is seen from.
    pub camera: &'a Camera,
    /// What is shown of it: the picture or a view, and what is beside it.
    pub display: Display,
}

impl<'a> FrameInput<'a> {
    /// What is seen of a scene.
    pub fn seen(&self, scene: &'a Scene) -> Seen<'a> {
        Seen { scene, camera: self.camera, time_seconds: self.tick.time_seconds, display: self.display }
    }
}

/// Why there is no frame.
#[derive(Debug, thiserror::Error)]
pub enum FrameError {
    /// A shader does not compile.
    #[error(transparent)]
    Shader(#[from] ShaderError),
    /// The strokes of one frame are too many.
    #[error(transparent)]
    Strokes(#[from] BinError),
    /// A size is beyond the adapter.
    #[error("{what} of {width}×{height} is beyond this adapter's limit of {limit} {unit}; {remedy}")]
    Limit {
        /// What is too large.
        what: String,
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
    /// A mesh has too many triangles for a shell.
    #[error(
        "a shell of {triangles} triangles is beyond the limit of {}: simplify the mesh, or draw it flat, without --shell",
        shell::TRIANGLES_MAX
    )]
    Shell {
        /// How many it has.
        triangles: usize,
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
    /// The view of the right side, where the picture is split.
    right_view_set: ViewSet,
    stack: Stack,
    groundwork: Groundwork,
    derive: Derive,
    derive_set: DeriveSet,
    /// One for each choice that was ever shown: switching back costs nothing.
    surfaces: HashMap<Choice, (Surface, SurfaceSet)>,
    /// What is seen beside and instead of the bare plane; none where the plane is all.
    stage: Option<Stage>,
    mesh: Option<Mesh>,
    /// The reliefs beside it, as many as the scene has.
    reliefs: Stills,
    /// The display whose pipelines were built last.
    built_for: Option<Display>,
    present: Present,
    radiance: Texture<Radiance>,
    present_set: PresentSet,
    image_size: [u32; 2],
    /// The picture of a series that lies over the field.
    colours: Option<Arc<ColourImage>>,
    /// Whether there may be anything on the material.
    stamped: bool,
    traffic: Traffic,
}

/// What the field's passes of one frame touched, for the account of its bytes.
#[derive(Clone, Copy, Debug, Default)]
struct Traffic {
    derived_texels: u64,
    with_pyramid: bool,
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
        check_shell(&scene, start.mesh.as_ref())?;
        let mut field = Field::new(gpu, scene.field.size, scene.field.addressing, stack::covers(&scene));
        if let Some(colours) = &start.colours {
            check_texture(gpu, "an albedo image", colours.size, "scale it down")?;
            field.albedo_map = albedo_image::upload(gpu, colours);
        }
        let view_layout = view::layout(gpu);
        let [view_set, right_view_set] = [(); 2].map(|()| ViewSet::new(gpu, &view_layout, field.addressing));
        let stack = Stack::new(gpu, &field, &scene)?;
        let groundwork = Groundwork::new(gpu, &field, &scene, &start.images)?;
        let derive = Derive::new(gpu)?;
        let derive_set = derive.bind(gpu, &field);
        let reliefs = Stills::new(gpu, &derive, start)?;
        let present = Present::new(gpu, target)?;
        let radiance = Texture::new(gpu, traced_size(&scene, image_size));
        let present_set = present.bind(gpu, &radiance.view);
        let mut frame = Self {
            timer: Timer::new(gpu),
            field,
            scene,
            view_layout,
            view_set,
            right_view_set,
            stack,
            groundwork,
            derive,
            derive_set,
            surfaces: HashMap::new(),
            stage: None,
            mesh: start.mesh.clone(),
            reliefs,
            built_for: None,
            present,
            radiance,
            present_set,
            image_size,
            colours: None,
            stamped: true,
            traffic: Traffic::default(),
        };
        frame.reset(gpu, start);
        frame.build_surface(gpu)?;
        Ok(frame)
    }

    /// Puts the field back to its start: the relief as it was, every source at its beginning.
    pub fn reset(&mut self, gpu: &Gpu, start: &Start) {
        self.field.relief.write(gpu, &start.heights);
        self.field.material.write(gpu, &start.material);
        self.note_stamped(start.material.iter().any(|bits| *bits != 0));
        self.groundwork.reset(gpu, &start.heights);
        self.stack.reset(gpu, &self.scene);
        self.reliefs.reset(gpu, start);
    }

    /// Builds every pass anew from the device's present shaders, and leaves the field as it is.
    ///
    /// # Errors
    ///
    /// A shader does not compile: the frame goes on with the passes it had.
    pub fn reload(&mut self, gpu: &Gpu) -> Result<(), ShaderError> {
        let _ = gpu.take_error();
        let display = self.built_for.unwrap_or_default();
        let mut surfaces = HashMap::new();
        for choice in self.sides(&display).iter().map(Side::choice) {
            let surface = Surface::new(gpu, &self.view_layout, choice)?;
            let set = surface.bind(gpu, &self.field);
            surfaces.insert(choice, (surface, set));
        }
        let derive = Derive::new(gpu)?;
        let present = Present::new(gpu, self.present.target())?;
        // WGSL that is valid may still not fit its pipeline: a binding or an entry point of another name.
        if let Some(message) = gpu.take_error() {
            return Err(ShaderError::Unfit(message));
        }
        if let Some(stage) = &mut self.stage {
            stage.forget_pipelines();
            stage.prepare(gpu, &self.scene, Shows::Picture, 0)?;
        }
        self.reliefs.reload(gpu)?;
        self.stack.reload(gpu, &self.field)?;
        self.groundwork.reload(gpu)?;
        // Nothing fails from here on. The bindings stay: layouts with the same entries are the same to wgpu.
        self.built_for = None;
        self.surfaces = surfaces;
        (self.derive, self.present) = (derive, present);
        Ok(())
    }

    /// Takes over what does not change the field's contents: trace, light, material, depth, the settings of its sources.
    /// The field's size and addressing, those of the reliefs beside it, and which sources there are, must be what they were.
    ///
    /// # Errors
    ///
    /// The picture's size with the new supersampling is beyond the adapter's limits, or a shader does not compile: the frame
    /// goes on with what it had.
    pub fn set_scene(&mut self, gpu: &Gpu, scene: &Scene) -> Result<(), FrameError> {
        debug_assert!(scene.field == self.scene.field && stack::kinds(scene) == stack::kinds(&self.scene));
        check_limits(gpu, scene, self.image_size)?;
        check_shell(scene, self.mesh.as_ref())?;
        debug_assert!(scene.reliefs.len() == self.scene.reliefs.len(), "each relief has its field");
        let before = std::mem::replace(&mut self.scene, scene.clone());
        if let Err(error) = self.build_surface(gpu) {
            self.scene = before;
            return Err(error.into());
        }
        if before.trace.supersampling != scene.trace.supersampling {
            self.retarget(gpu);
        }
        if before.plane != scene.plane || stack::differ(&before, scene) || before.lod.filters() != scene.lod.filters() {
            self.stack.set_scene(gpu, scene);
        }
        if before.reliefs != scene.reliefs || before.lod.filters() != scene.lod.filters() {
            self.reliefs.touch();
        }
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
        if let Some(stage) = &mut self.stage {
            stage.resize(gpu, traced_size(&self.scene, self.image_size));
        }
    }

    /// What is seen of the scene on each side of what is shown.
    fn sides(&self, display: &Display) -> Vec<Side> {
        let [width, _] = traced_size(&self.scene, self.image_size);
        let stamped = self.stamped;
        let side = |name, scene, shows, columns| Side { name, scene, display: Display { shows, ..*display }, columns, stamped };
        match (display.divider(self.image_size[0], self.scene.trace.supersampling), &display.split) {
            // Two looks at the same instant of the same field, each with a time of its own.
            (Some(column), Some(split)) => vec![
                side(SIDES[0], self.scene.clone(), display.shows, 0..column),
                side(SIDES[1], split.scene(&self.scene), split.shows, column..width),
            ],
            _ => vec![side("surface", self.scene.clone(), display.shows, 0..width)],
        }
    }

    /// Builds what a scene needs, and puts its mesh on the stage.
    fn build_surface(&mut self, gpu: &Gpu) -> Result<(), ShaderError> {
        if self.mesh.is_some() || Stage::is_needed(&self.scene) {
            self.set_stage(gpu);
        } else {
            self.stage = None;
        }
        if let Some(stage) = self.stage.as_mut().filter(|_| self.scene.trace.technique != Technique::Mesh) {
            stage.forget_micropolygons();
        }
        self.build_sides(gpu, &Display::default())
    }

    /// Builds what each side of what is shown needs and is not there yet.
    fn build_sides(&mut self, gpu: &Gpu, display: &Display) -> Result<(), ShaderError> {
        let sides = self.sides(display);
        // One side may need a stage where the scene itself does not.
        if self.stage.is_none() && sides.iter().any(|side| Stage::is_needed(&side.scene)) {
            self.set_stage(gpu);
        }
        for (index, side) in sides.iter().enumerate() {
            if let Some(stage) = &mut self.stage {
                stage.prepare(gpu, &side.scene, side.display.shows, index)?;
                continue;
            }
            let choice = side.choice();
            if !self.surfaces.contains_key(&choice) {
                let surface = Surface::new(gpu, &self.view_layout, choice)?;
                let set = surface.bind(gpu, &self.field);
                self.surfaces.insert(choice, (surface, set));
            }
        }
        self.built_for = Some(*display);
        Ok(())
    }

    /// The same, unless it was the last that was built.
    fn build_for(&mut self, gpu: &Gpu, display: &Display) -> Result<(), ShaderError> {
        if self.built_for != Some(*display) { self.build_sides(gpu, display) } else { Ok(()) }
    }

    fn set_stage(&mut self, gpu: &Gpu) {
        let size = traced_size(&self.scene, self.image_size);
        let scene = &self.scene;
        let own = self.mesh.clone().or_else(|| shell_of_plane(scene, &scene.plane, scene.field.size));
        let fields = || std::iter::once(&self.field).chain(self.reliefs.fields()).collect::<Vec<_>>();
        let stage = self.stage.get_or_insert_with(|| Stage::new(gpu, &fields(), size));
        stage.set_meshes(gpu, std::iter::once(own).chain(self.reliefs.meshes(scene)));
    }

    /// The mesh that carries the relief; none: the plane.
    pub fn mesh(&self) -> Option<&Mesh> {
        self.mesh.as_ref()
    }

    /// The stage on which the scene is seen, where it needs one.
    pub fn stage(&self) -> Option<&Stage> {
        self.stage.as_ref()
    }

    /// What is done to the relief and its material.
    pub fn groundwork(&self) -> &Groundwork {
        &self.groundwork
    }

    /// The scene that it shows.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Depth over the texel's width and height: the slope of a height of 1 a texel.
    pub fn slope_per_height(&self) -> [f32; 2] {
        slope_per_height(&self.scene.plane, self.scene.field.size)
    }

    /// Width and height of the picture, pixels.
    pub fn image_size(&self) -> [u32; 2] {
        self.image_size
    }

    /// The step of each simulation, seconds.
    pub fn step_seconds(&self) -> StepSeconds {
        source::step_seconds(&self.scene)
    }

    /// Records one frame. Where nobody looks (`target` is `None`) it only does to the layers what is to be done.
    ///
    /// # Errors
    ///
    /// The strokes are too many for one frame on this adapter, or a shader that the display asks for does not compile.
    pub fn record(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        input: &FrameInput<'_>,
        target: Option<&wgpu::TextureView>,
    ) -> Result<(), FrameError> {
        // Lay the picture of this moment over the field, where a series brings others.
        self.lay_colours(gpu, input.strokes.images.as_deref());
        let recorder = &mut Recorder { gpu, encoder, timer: &self.timer };
        self.traffic = Traffic::default();
        // Press this frame's stamps into the relief, and let it heal and cool in between.
        let pressed = self.groundwork.record(recorder, &self.field, input.tick, input.strokes)?;
        self.stack.relief_changed(&pressed, self.field.size);
        // Advance what moves over it by the steps that the clock owes, with what disturbs it.
        self.stack.advance(recorder, &self.scene, input.tick, input.strokes, self.field.size)?;
        self.note_stamped(self.stamped || pressed != Dirty::Nothing);
        let Some(target) = target else { return Ok(()) };
        self.build_for(gpu, &input.display)?;
        let recorder = &mut Recorder { gpu, encoder, timer: &self.timer };
        // Compose relief and sources into the height field proper …
        let (changed, texels) = self.stack.compose_top(recorder, &self.scene, self.field.size);
        let with_pyramid = self.sides(&input.display).iter().any(|side| side.choice().reads_pyramid());
        self.traffic = Traffic { derived_texels: texels, with_pyramid };
        self.derive(recorder, &changed, with_pyramid);
        self.reliefs.derive(recorder, &self.derive, &self.scene, with_pyramid);
        // March, shade and shadow what the camera sees, and tone-map it to whatever we were given: a window or an image.
        self.show(recorder, (&self.present, &self.present_set), input, target);
        Ok(())
    }

    fn lay_colours(&mut self, gpu: &Gpu, images: Option<&Images>) {
        let Some(colours) = images.and_then(|images| images.colours.as_ref()) else { return };
        let laid = self.colours.as_ref().is_some_and(|laid| Arc::ptr_eq(laid, colours));
        // The picture that the frame started with has the size of them all.
        if !laid && colours.size == self.field.albedo_map.size() {
            albedo_image::overwrite(gpu, &self.field.albedo_map, colours);
            self.colours = Some(colours.clone());
        }
    }

    /// Submits what was recorded, with the timer's queries.
    pub fn finish(&mut self, gpu: &Gpu, mut encoder: wgpu::CommandEncoder) {
        self.timer.resolve(&mut encoder);
        gpu.queue.submit([encoder.finish()]);
        self.timer.end_frame();
    }

    /// Shows the field as it stands once more, in a target of another format, and leaves everything as it is.
    ///
    /// # Errors
    ///
    /// A shader that the display asks for does not compile.
    pub fn show_with(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        present: &Present,
        input: &FrameInput<'_>,
        target: &wgpu::TextureView,
    ) -> Result<(), ShaderError> {
        self.build_for(gpu, &input.display)?;
        let set = present.bind(gpu, &self.radiance.view);
        self.show(&mut Recorder { gpu, encoder, timer: &self.timer }, (present, &set), input, target);
        Ok(())
    }

    /// Derives everything that depends on the heights alone, over the texels that changed.
    fn derive(&self, recorder: &mut Recorder<'_>, changed: &[Region], with_pyramid: bool) {
        let scene = &self.scene;
        let (slope_per_height, with_mips) = (slope_per_height(&scene.plane, scene.field.size), scene.lod.filters());
        self.derive.record(recorder, &self.derive_set, changed, Derivation { slope_per_height, with_mips, with_pyramid });
    }

    /// Shows the field as it stands.
    fn show(
        &self,
        recorder: &mut Recorder<'_>,
        (present, present_set): (&Present, &PresentSet),
        input: &FrameInput<'_>,
        target: &wgpu::TextureView,
    ) {
        let traced = traced_size(&self.scene, self.image_size);
        let views = [&self.view_set, &self.right_view_set];
        for (index, side) in self.sides(&input.display).into_iter().enumerate() {
            let seen = Seen { display: side.display, ..input.seen(&side.scene) };
            if let Some(stage) = &self.stage {
                stage.record(recorder, side.name, index, &seen, &self.radiance.view, side.columns);
            } else if let Some((surface, surface_set)) = self.surfaces.get(&side.choice()) {
                let view = View::new(&side.scene, input.camera, input.tick.time_seconds, traced, side.display);
                views[index].uniform.write(recorder.gpu, &view);
                surface.record(recorder, side.name, views[index], surface_set, &self.radiance.view, side.columns);
            } else {
                unreachable!("whoever records builds the surfaces of what it shows first")
            }
        }
        let supersampling = self.scene.trace.supersampling;
        present.record(recorder, present_set, supersampling, &input.display, self.image_size[0], target);
    }

    /// Bytes a texel of the field that the textures of its stack take together.
    pub fn field_bytes_per_texel(&self) -> f64 {
        let cover = if stack::covers(&self.scene) { Cover::CONTRACT.bytes_per_texel() } else { 0.0 };
        field::bytes_per_texel(field::CONTRACT) + self.stack.bytes_per_texel() + cover
    }

    /// All that the field remembers from frame to frame, by name: its own layers, and each source's.
    pub fn states(&self) -> Vec<(&'static str, State<'_>)> {
        let layers = vec![&self.field.relief.texture, &self.field.material.texture];
        let own = State { textures: layers, ..State::default() };
        std::iter::once(("field", own)).chain(self.stack.states()).collect()
    }

    /// Takes over the numbers of [`Frame::states`], in their order; textures and buffers have been overwritten already.
    pub fn restore(&mut self, numbers: &[Vec<u64>]) {
        self.stack.restore(numbers.get(1..).unwrap_or_default());
        self.groundwork.resume();
        self.note_stamped(true);
    }

    /// Whether there may be anything on the material: what is not there is not read.
    fn note_stamped(&mut self, stamped: bool) {
        if self.stamped != stamped {
            self.stamped = stamped;
            self.built_for = None;
        }
    }

    /// The source of this name, if the scene has it.
    pub fn source(&self, name: &str) -> Option<&dyn Source> {
        self.stack.source(name)
    }

    /// Where what lies beneath water is composed to, if there is any.
    pub fn bed(&self) -> Option<&wgpu::TextureView> {
        self.stack.bed()
    }

    /// How each source fares, with its name.
    pub fn health(&mut self, gpu: &Gpu) -> Vec<(&'static str, Health)> {
        self.stack.health(gpu)
    }

    /// Bytes of GPU memory of every texture and of every list; uniforms take some kilobytes more.
    pub fn memory_bytes(&self) -> u64 {
        let [width, height] = self.image_size.map(u64::from);
        // The picture itself has four bytes a pixel in every format that is shown.
        let stage = self.stage.as_ref().map_or(0, Stage::memory_bytes);
        let beside = self.reliefs.memory_bytes() + stage;
        let own = self.field.memory_bytes() + self.derive_set.memory_bytes();
        let layers = own + self.groundwork.memory_bytes() + self.stack.memory_bytes();
        layers + beside + self.radiance.memory_bytes() + 4 * width * height
    }

    /// Bytes that the field's passes of the last recorded frame read and wrote by design: see each pass's header. Halos, and the
    /// tiles that a changed region is rounded to, are not counted.
    pub fn field_traffic_bytes(&self) -> u64 {
        let mips = if self.scene.lod.filters() { normal_mips::TEXEL_BYTES } else { 0 };
        let pyramid = if self.traffic.with_pyramid { pyramid::TEXEL_BYTES } else { 0 };
        let derived = normals::TEXEL_BYTES + mips + pyramid + bounds::TEXEL_BYTES;
        self.stack.traffic_bytes() + self.groundwork.traffic_bytes() + self.traffic.derived_texels * derived
    }

    /// The same of one source alone, if the scene has one of this name.
    pub fn source_traffic_bytes(&self, name: &str) -> Option<u64> {
        self.stack.traffic_bytes_of(name)
    }

    /// Bytes that tracing and presenting one picture reads and writes by design, where a view ray takes so many steps.
    pub fn picture_traffic_bytes(&self, mean_steps: f64) -> f64 {
        let traced = traced_size(&self.scene, self.image_size).map(f64::from);
        let shown = self.image_size.map(f64::from);
        // A step reads a node and the four corners of a cell, or a sample of four texels; a shaded pixel its four corners, its normal
        // and its material; radiance is written once and read once.
        traced[0] * traced[1] * (20.0 * mean_steps + 16.0 + 8.0 + 4.0 + 2.0 * 8.0) + shown[0] * shown[1] * 4.0
    }
}

/// One side of what is shown: all of it, where there is no divider.
struct Side {
    name: &'static str,
    scene: Scene,
    display: Display,
    /// Of the traced picture.
    columns: Range<u32>,
    /// Whether there may be anything on the material.
    stamped: bool,
}

impl Side {
    fn choice(&self) -> Choice {
        let choice = Choice::of(&self.scene).showing(self.display.shows);
        // A scene that stamps will: its pipeline need not be built twice.
        Choice { stamped: self.stamped || choice.marks, ..choice }
    }
}

/// What the surface pass is called on each side of a divider.
pub const SIDES: [&str; 2] = ["surface, left", "surface, right"];

/// Traced pixels of a picture of `image_size`.
fn traced_size(scene: &Scene, image_size: [u32; 2]) -> [u32; 2] {
    image_size.map(|pixels| pixels * scene.trace.supersampling)
}

/// Depth over the texel's width and height.
fn slope_per_height(plane: &Plane, field_size: [u32; 2]) -> [f32; 2] {
    let slope = plane.depth_metres * field_size[0] as f32 / plane.width_metres;
    [slope, slope]
}

/// The plane as a mesh, where its shell is drawn.
fn shell_of_plane(scene: &Scene, plane: &Plane, field_size: [u32; 2]) -> Option<Mesh> {
    let tile_metres = plane.size_metres(field_size).map(|metres| metres as f32);
    scene.trace.shell.then(|| shapes::repeated_plane(tile_metres, plane.repeat))
}

/// Checks a texture's size against the adapter.
fn check_texture(gpu: &Gpu, what: &str, size: [u32; 2], remedy: &'static str) -> Result<(), FrameError> {
    let limit = gpu.device.limits().max_texture_dimension_2d;
    if size.iter().any(|&edge| edge > limit) {
        let (limit, unit, what) = (u64::from(limit), "texels an axis", what.to_owned());
        return Err(FrameError::Limit { what, width: size[0], height: size[1], limit, unit, remedy });
    }
    Ok(())
}

/// Checks that a mesh which is drawn as a shell has no more triangles than one may have.
fn check_shell(scene: &Scene, mesh: Option<&Mesh>) -> Result<(), FrameError> {
    let triangles = mesh.map_or(0, Mesh::triangle_count);
    if scene.trace.shell && triangles > shell::TRIANGLES_MAX {
        return Err(FrameError::Shell { triangles });
    }
    Ok(())
}

/// Checks every size against the adapter, before anything is made.
///
/// # Errors
///
/// A size is beyond a limit; the error names it.
pub fn check_limits(gpu: &Gpu, scene: &Scene, image_size: [u32; 2]) -> Result<(), FrameError> {
    let limits = gpu.device.limits();
    check_texture(gpu, "a field", scene.field.size, "ask for a smaller one with --field")?;
    for (index, relief) in scene.reliefs.iter().enumerate() {
        let what = format!("the field of `reliefs[{index}]`");
        check_texture(gpu, &what, relief.field.size, "give it a smaller `field.size` in the scene")?;
    }
    let ways_out = "ask for a smaller one with --size, or for less supersampling in the scene";
    let traced = image_size.map(|pixels| pixels.saturating_mul(scene.trace.supersampling));
    check_texture(gpu, "a picture", traced, ways_out)?;
    // The buffers that a picture and a field are read back through: four bytes a texel, rows padded.
    let readable = |what, size: [u32; 2], remedy| {
        let row = u64::from((4 * size[0]).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT));
        if row * u64::from(size[1]) > limits.max_buffer_size {
            let limit = limits.max_buffer_size;
            let what = str::to_owned(what);
            return Err(FrameError::Limit { what, width: size[0], height: size[1], limit, unit: "bytes", remedy });
        }
        Ok(())
    };
    if let Some(gas) = &scene.gas {
        // What a cell carries: sixteen bytes, in one buffer.
        let cells = gas.cells(scene.field.size);
        let limit = limits.max_storage_buffer_binding_size;
        if 16 * u64::from(cells[0]) * u64::from(cells[1]) > limit {
            let [width, height] = cells;
            let remedy = "ask for a smaller field with --field, or for a larger coarsening of the gas in the scene";
            return Err(FrameError::Limit { what: "a gas".to_owned(), width, height, limit, unit: "bytes in a buffer", remedy });
        }
    }
    readable("a field", scene.field.size, "ask for a smaller one with --field")?;
    readable("a picture", image_size, "ask for a smaller one with --size")
}
