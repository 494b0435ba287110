//! Shallow water as a layer of a scene's stack.

use super::{
    CONTRACT, Event, PUBLISHED_BYTES, ShallowWater, ShallowWaterBody, ShallowWaterControl, ShallowWaterParams, ShallowWaterSet,
    ShallowWaterSpell, TEXEL_BYTES, state_bytes,
};
use crate::clock::Simulation;
use crate::field::bins::BinError;
use crate::field::source::{Health, Heights, Source, SourceInput, State};
use crate::field::stamp::{Profile, Stamp};
use crate::field::{Dirty, Field};
use crate::gpu::{Contract, Gpu, Readback, Recorder, ShaderError};
use crate::scene::{self, Layer, LayerBlend, Scene};

/// What a frame's account knows of the substeps of the frames before: the GPU alone decides how many there are.
#[derive(Clone, Copy, Debug, Default)]
struct Known {
    control: ShallowWaterControl,
    /// Substeps of the last frame that is known.
    substeps: u32,
}

/// The water of a scene.
pub struct ShallowWaterSource {
    water: ShallowWater,
    set: ShallowWaterSet,
    size: [u32; 2],
    known: Known,
    /// The control on its way back, and whether it has been asked for.
    readback: Option<(Readback, bool)>,
    /// Whether the last frame published.
    published: bool,
}

impl ShallowWaterSource {
    /// Water over a field, as its scene begins.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu, field: &Field, scene: &Scene, water: &scene::ShallowWater) -> Result<Self, ShaderError> {
        let kernels = ShallowWater::new(gpu)?;
        let bodies: Vec<_> = water.bodies.iter().map(ShallowWaterBody::new).collect();
        let set = kernels.bind(gpu, &field.cover.view, &params(scene, water), water.substep_cap, &bodies);
        Ok(Self { water: kernels, set, size: field.size, known: Known::default(), readback: None, published: false })
    }
}

fn params(scene: &Scene, water: &scene::ShallowWater) -> ShallowWaterParams {
    ShallowWaterParams::new(water, scene.field.size, scene.texel_metres(), f64::from(scene.plane.depth_metres))
}

/// The rings that shots make in water: one a crater, twice as wide, half as deep.
fn rings_of(presses: &[Stamp], depth_metres: f32) -> impl Iterator<Item = Event> {
    let craters = presses.iter().filter(|stamp| matches!(stamp.profile, Profile::Crater));
    craters.map(move |stamp| Event::dent(stamp.centre, 2.0 * stamp.radius, 0.5 * stamp.height.abs() * depth_metres, 0.8))
}

impl Source for ShallowWaterSource {
    fn name(&self) -> &'static str {
        "shallow-water"
    }

    fn layer(&self, _scene: &Scene) -> Layer {
        // Its surface is the bed's where there is no water.
        Layer { blend: LayerBlend::Replace, amplitude: 1.0 }
    }

    fn reset(&mut self, gpu: &Gpu, _scene: &Scene) {
        self.set.reset(gpu);
        self.known = Known::default();
        self.readback = None;
    }

    fn set_scene(&mut self, gpu: &Gpu, scene: &Scene) {
        if let Some(water) = &scene.shallow_water {
            self.set.set_params(gpu, &params(scene, water), water.substep_cap);
        }
    }

    fn reload(&mut self, gpu: &Gpu) -> Result<(), ShaderError> {
        self.water = ShallowWater::new(gpu)?;
        Ok(())
    }

    fn advance(&mut self, recorder: &mut Recorder<'_>, input: &SourceInput<'_>) -> Result<Dirty, BinError> {
        let Some(water) = &input.scene.shallow_water else { return Ok(Dirty::Nothing) };
        let owed = input.tick.owed(Simulation::ShallowWater);
        let spells: Vec<_> =
            (0..owed.steps).map(|step| ShallowWaterSpell::new(water, owed.first_step + u64::from(step))).collect();
        let beneath = *input.beneath != Dirty::Nothing;
        // What craters the ground pushes the water over it aside.
        let depth_metres = input.scene.plane.depth_metres;
        let mut events: Vec<_> = [&input.strokes.presses, &input.strokes.hand]
            .into_iter()
            .flat_map(|stamps| rings_of(stamps, depth_metres))
            .map(|ring| (0, ring))
            .collect();
        events.extend(&input.strokes.waters);
        self.published = self.water.record(recorder, &mut self.set, &spells, &events, beneath);
        if self.published && self.readback.is_none() {
            let bytes = size_of::<ShallowWaterControl>() as u64;
            self.readback = Some((Readback::record_buffer(recorder.gpu, recorder.encoder, &self.set.held.control, bytes), false));
        }
        Ok(if self.published { Dirty::All } else { Dirty::Nothing })
    }

    fn contract(&self) -> &'static [(Contract, u32)] {
        CONTRACT
    }

    fn heights(&self) -> Heights<'_> {
        Heights { views: [&self.set.held.surface.view; 2], current: 0 }
    }

    fn bed(&self) -> Option<&wgpu::TextureView> {
        Some(&self.set.held.bed.view)
    }

    fn state(&self) -> State<'_> {
        let held = &self.set.held;
        State {
            textures: Vec::new(),
            buffers: held.depths.iter().chain(&held.flows).chain([&held.control]).collect(),
            numbers: vec![u64::from(self.set.is_to_fill())],
        }
    }

    fn restore(&mut self, numbers: &[u64]) {
        if numbers.first() == Some(&0) {
            self.set.keep();
        }
    }

    fn health(&mut self, _gpu: &Gpu) -> Health {
        if let Some((readback, asked)) = &mut self.readback {
            if !std::mem::replace(asked, true) {
                readback.start();
            }
            if let Some(arrived) = readback.take() {
                // A device that was lost says so elsewhere.
                let bytes = arrived.unwrap_or_default();
                if bytes.len() == size_of::<ShallowWaterControl>() {
                    let control: ShallowWaterControl = bytemuck::pod_read_unaligned(&bytes);
                    self.known = Known { control, substeps: control.substeps.saturating_sub(self.known.control.substeps) };
                }
                self.readback = None;
            }
        }
        let halted = (self.known.control.halted == 1).then(|| {
            "the shallow water met a number that is none and stands still at its last good state: reset it, or look for heights \
             beyond measure in what it flows over"
                .to_owned()
        });
        Health { behind_seconds: f64::from(self.known.control.behind), halted }
    }

    fn traffic_bytes(&self) -> u64 {
        let texels = state_bytes(self.size) / 8;
        let published = if self.published { PUBLISHED_BYTES } else { 0 };
        texels * (u64::from(self.known.substeps) * TEXEL_BYTES + published)
    }

    fn memory_bytes(&self) -> u64 {
        self.set.held.memory_bytes()
    }
}
