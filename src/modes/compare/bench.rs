//! One instant of one field, and what it takes to show it in many ways.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::variant::Variant;
use crate::camera::Camera;
use crate::clock::Tick;
use crate::frame::{Frame, FrameInput, Start};
use crate::gpu::Gpu;
use crate::io::height_image::HeightImage;
use crate::io::image_sequence::Player;
use crate::mesh::Mesh;
use crate::modes::capture::{PICTURE_FORMAT, Picture, read_channels, read_texture};
use crate::modes::headless::trusted_timer;
use crate::modes::script::{Solo, hand_images};
use crate::modes::{ModeError, check_interruption, wait_for_gpu};
use crate::scene::Scene;
use crate::stroke::Strokes;
use crate::surface::albedo_image::ColourImage;
use crate::surface::channels::Channel;
use crate::surface::{Channels, Choice, Display};

/// Time from frame to frame before the instant, seconds: capture's own default.
pub const DT_SECONDS: f64 = 1.0 / 60.0;

/// The pass whose time is told apart.
const SURFACE_PASS: &str = "surface";

/// A field that stands still.
pub struct Bench {
    frame: Frame,
    scene: Scene,
    mesh: Option<Mesh>,
    /// The colours of albedo `image`.
    colours: Option<ColourImage>,
    /// What the reliefs beside it start from.
    reliefs: Vec<Start>,
    picture: Picture,
    tick: Tick,
    /// One for each choice that was shown: a shader takes a while to build.
    passes: HashMap<Choice, Channels>,
}

/// What one picture shows.
pub struct Shown {
    /// RGBA in sRGB, row by row.
    pub picture: Vec<u8>,
    /// The numbers behind it.
    pub pixels: Vec<Channel>,
}

/// What it took to show it, milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Times {
    /// The surface pass.
    pub surface: Option<f64>,
    /// All passes.
    pub frame: Option<f64>,
}

impl Bench {
    /// Runs a scene for so many frames, and holds it at the next: the one that capture writes after such a warm-up.
    ///
    /// # Errors
    ///
    /// The run was interrupted, the strokes of a frame are too many, or the device was lost.
    pub fn after(
        gpu: &Gpu,
        start: &Start,
        mut frame: Frame,
        picture: Picture,
        mut player: Option<Player>,
        warmup: u32,
    ) -> Result<Self, ModeError> {
        let scene = &start.scene;
        let mut colours = start.colours.clone();
        let mut solo = Solo::new(&frame, DT_SECONDS);
        let mut tick = Tick::default();
        for number in 0..=warmup {
            check_interruption()?;
            let mut moment = solo.next(scene);
            hand_images(&mut player, scene, &moment.tick, &mut moment.strokes)?;
            tick = moment.tick;
            let images = moment.strokes.images.as_ref();
            colours = images.and_then(|images| images.colours.as_deref().cloned()).or(colours);
            let input = moment.input(Display::default());
            let target = (number == warmup).then_some(picture.view());
            let mut encoder = gpu.encoder("compare");
            frame.record(gpu, &mut encoder, &input, target)?;
            frame.finish(gpu, encoder);
            wait_for_gpu(gpu)?;
        }
        // What was owed is done: from here on time stands.
        tick = Tick { previous_seconds: tick.time_seconds, owed: Default::default(), ..tick };
        frame.timer = trusted_timer(gpu);
        let (mesh, reliefs) = (start.mesh.clone(), start.reliefs.clone());
        Ok(Self { frame, scene: scene.clone(), mesh, colours, reliefs, picture, tick, passes: HashMap::new() })
    }

    /// The same content over a field of another size, which does not move.
    ///
    /// # Errors
    ///
    /// The field is beyond the adapter's limits, or the device was lost.
    pub fn resampled(&self, gpu: &Gpu, size: [u32; 2]) -> Result<Self, ModeError> {
        let scene = resized(&self.scene, size);
        let (from, addressing) = (self.scene.field.size, self.scene.field.addressing);
        let heights = HeightImage { size: from, heights: self.heights(gpu)? }.resampled(size, addressing).heights;
        // What a texel is made of has no mean: the nearest.
        let material: Vec<u32> = bytemuck::pod_collect_to_vec(&read_texture(gpu, &self.frame.field.material.texture)?);
        let nearest =
            |to: u32, axis: usize| (u64::from(2 * to + 1) * u64::from(from[axis]) / (2 * u64::from(size[axis]))) as usize;
        let row = |y: u32| nearest(y, 1) * from[0] as usize;
        let texels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        let material = texels.map(|(x, y)| material[row(y) + nearest(x, 0)]).collect();
        let (mesh, colours, reliefs) = (self.mesh.clone(), self.colours.clone(), self.reliefs.clone());
        let start = Start { scene, heights, material, mesh, colours, images: Vec::new(), reliefs };
        let image_size = self.frame.image_size();
        let mut frame = Frame::new(gpu, &start, image_size, PICTURE_FORMAT)?;
        frame.timer = trusted_timer(gpu);
        let picture = Picture::new(gpu, image_size);
        Ok(Self {
            frame,
            scene: start.scene,
            mesh: start.mesh,
            colours: start.colours,
            reliefs: start.reliefs,
            picture,
            tick: self.tick,
            passes: HashMap::new(),
        })
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The time that it stands at, seconds.
    pub fn time_seconds(&self) -> f64 {
        self.tick.time_seconds
    }

    /// The height field.
    ///
    /// # Errors
    ///
    /// The device was lost.
    pub fn heights(&self, gpu: &Gpu) -> Result<Vec<f32>, ModeError> {
        Ok(bytemuck::pod_collect_to_vec(&read_texture(gpu, &self.frame.field.height.texture)?))
    }

    /// Bytes of GPU memory that the frame holds.
    pub fn memory_bytes(&self) -> u64 {
        self.frame.memory_bytes()
    }

    /// Shows the field, and reads what it shows.
    ///
    /// # Errors
    ///
    /// The run was interrupted, a shader does not compile, or the device was lost.
    pub fn show(&mut self, gpu: &Gpu, variant: &Variant, camera: &Camera) -> Result<Shown, ModeError> {
        self.time(gpu, variant, camera)?;
        let picture = self.picture.read(gpu)?;
        let choice = Choice::of(self.frame.scene());
        let pass = match self.passes.entry(choice) {
            Entry::Occupied(entry) => entry.into_mut(),
            Entry::Vacant(entry) => entry.insert(Channels::new(gpu, choice)?),
        };
        let input = FrameInput { tick: &self.tick, strokes: &Strokes::default(), camera, display: Display::default() };
        let pixels = read_channels(gpu, &self.frame, pass, &input)?;
        Ok(Shown { picture, pixels })
    }

    /// Shows the field, and tells what that took.
    ///
    /// # Errors
    ///
    /// The run was interrupted, a shader does not compile, or the device was lost.
    pub fn time(&mut self, gpu: &Gpu, variant: &Variant, camera: &Camera) -> Result<Times, ModeError> {
        check_interruption()?;
        let scene = variant.scene(&self.scene);
        if *self.frame.scene() != scene {
            self.frame.set_scene(gpu, &scene)?;
        }
        let input = FrameInput { tick: &self.tick, strokes: &Strokes::default(), camera, display: Display::default() };
        let mut encoder = gpu.encoder("compare");
        self.frame.record(gpu, &mut encoder, &input, Some(self.picture.view()))?;
        self.frame.finish(gpu, encoder);
        wait_for_gpu(gpu)?;
        let passes = self.frame.timer.finished_frame().unwrap_or_default();
        let surface = passes.iter().filter(|pass| pass.name == SURFACE_PASS).map(|pass| pass.milliseconds).sum();
        let frame = passes.iter().map(|pass| pass.milliseconds).sum();
        // No passes have no time, rather than none at all.
        Ok(if passes.is_empty() { Times::default() } else { Times { surface, frame } })
    }
}

/// A scene over a field of another size, which does not move.
pub fn resized(scene: &Scene, size: [u32; 2]) -> Scene {
    let still = Scene { noise: None, sequence: None, gas: None, shallow_water: None, wave: None, shots: None, ..scene.clone() };
    let mut scene = still;
    scene.field.size = size;
    scene
}
