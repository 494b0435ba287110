//! Source: a layer of the stack that changes in time, and what the frame asks of it.

use super::Dirty;
use super::bins::BinError;
use crate::clock::{StepSeconds, Tick};
use crate::gpu::{Contract, Gpu, Recorder, ShaderError};
use crate::scene::{Layer, Scene};
use crate::stroke::Strokes;

/// What one frame asks of a source.
#[derive(Clone, Copy, Debug)]
pub struct SourceInput<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The time that the frame shows, and the steps that it owes.
    pub tick: &'a Tick,
    /// What is done to the field in it.
    pub strokes: &'a Strokes,
    /// Which texels of what lies beneath may have changed since the source last advanced.
    pub beneath: &'a Dirty,
}

/// The heights of a source: one texture, or two that change roles.
#[derive(Clone, Copy, Debug)]
pub struct Heights<'a> {
    /// r32float views of the field's size; the same one twice where there is no second.
    pub views: [&'a wgpu::TextureView; 2],
    /// Which of them holds the present heights.
    pub current: usize,
}

/// All that a source remembers from frame to frame, in a fixed order: what a saved state holds.
#[derive(Clone, Debug, Default)]
pub struct State<'a> {
    /// Its textures, of one level each.
    pub textures: Vec<&'a wgpu::Texture>,
    /// Its buffers.
    pub buffers: Vec<&'a wgpu::Buffer>,
    /// The numbers beside them.
    pub numbers: Vec<u64>,
}

/// How a source fares.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Health {
    /// Simulated time that it gave up since its start, because its substeps reached their cap, seconds.
    pub behind_seconds: f64,
    /// Why it has stopped, if it has: one sentence.
    pub halted: Option<String>,
}

/// A layer of the stack that changes in time. Its textures and bind groups are made with it; none is made in a frame.
pub trait Source {
    /// Its name: of its passes, in tables, and its table's in a scene.
    fn name(&self) -> &'static str;

    /// How its heights meet what lies beneath it.
    fn layer(&self, scene: &Scene) -> Layer;

    /// Puts it back to its start.
    fn reset(&mut self, gpu: &Gpu, scene: &Scene);

    /// Takes over a scene's settings, which leave its textures as they are. What follows from the scene of each frame needs nothing.
    fn set_scene(&mut self, _gpu: &Gpu, _scene: &Scene) {}

    /// Builds its kernels anew from the device's present shaders. What fails leaves it as it was.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    fn reload(&mut self, gpu: &Gpu) -> Result<(), ShaderError>;

    /// Advances it to the frame's time, with what disturbs it, and says which texels of its heights may have changed.
    ///
    /// # Errors
    ///
    /// What disturbs it is too much for the adapter; then nothing is recorded.
    fn advance(&mut self, recorder: &mut Recorder<'_>, input: &SourceInput<'_>) -> Result<Dirty, BinError>;

    /// The contract of its textures, each as often as there are of it.
    fn contract(&self) -> &'static [(Contract, u32)];

    /// Bytes a texel of the field that these take.
    fn bytes_per_texel(&self) -> f64 {
        super::bytes_per_texel(self.contract())
    }

    /// Its heights.
    fn heights(&self) -> Heights<'_>;

    /// Where what lies beneath it is composed to before it advances, unclamped, if it stands on that: water's bed.
    fn bed(&self) -> Option<&wgpu::TextureView> {
        None
    }

    /// All that it remembers. A function of time alone has nothing to.
    fn state(&self) -> State<'_> {
        State::default()
    }

    /// Takes over the numbers of a [`State`]; its textures and buffers have been overwritten already.
    fn restore(&mut self, numbers: &[u64]);

    /// How it fares, as far as is known without waiting for the GPU.
    fn health(&mut self, _gpu: &Gpu) -> Health {
        Health::default()
    }

    /// Bytes that it moved in the last frame, by design.
    fn traffic_bytes(&self) -> u64;

    /// Bytes of GPU memory of its textures, buffers and lists.
    fn memory_bytes(&self) -> u64;
}

/// The step of each simulation of a scene, seconds; none where it does not run.
pub fn step_seconds(scene: &Scene) -> StepSeconds {
    let wave = scene.wave.as_ref().map(|wave| super::wave::step_seconds(wave, scene.texel_metres()));
    let water = scene.shallow_water.as_ref().map(|water| f64::from(water.step_seconds));
    let gas = scene.gas.as_ref().map(|gas| f64::from(gas.step_seconds));
    [wave, water, gas]
}
