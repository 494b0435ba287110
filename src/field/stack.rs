//! The stack: the sources over the relief, and their composition into the height field, from the ground up.

use super::bins::BinError;
use super::compose::{self, Compose, ComposeSet};
use super::gas_source::GasSource;
use super::noise::NoiseSource;
use super::sequence::SequenceSource;
use super::shallow_water::ShallowWaterSource;
use super::source::{Health, Source, SourceInput, State};
use super::wave::WaveSource;
use super::{Dirty, Field, Region};
use crate::clock::Tick;
use crate::gpu::{Gpu, Recorder, ShaderError};
use crate::scene::Scene;
use crate::stroke::Strokes;

/// The sources of a scene, from the ground up. Adding a source is its stem and its line here.
fn sources(gpu: &Gpu, field: &Field, scene: &Scene) -> Result<Vec<Box<dyn Source>>, ShaderError> {
    let mut sources: Vec<Box<dyn Source>> = Vec::new();
    if scene.noise.is_some() {
        sources.push(Box::new(NoiseSource::new(gpu, field.size)?));
    }
    if scene.sequence.is_some() {
        sources.push(Box::new(SequenceSource::new(gpu, field.size)));
    }
    if let Some(gas) = &scene.gas {
        sources.push(Box::new(GasSource::new(gpu, field, scene, gas)?));
    }
    if let Some(water) = &scene.shallow_water {
        sources.push(Box::new(ShallowWaterSource::new(gpu, field, scene, water)?));
    }
    if let Some(wave) = &scene.wave {
        sources.push(Box::new(WaveSource::new(gpu, field, scene, wave)?));
    }
    Ok(sources)
}

/// Which sources a scene has. Scenes that agree in this differ in no more than what [`Source::set_scene`] takes over.
pub fn kinds(scene: &Scene) -> [bool; 5] {
    [scene.noise.is_some(), scene.sequence.is_some(), scene.gas.is_some(), scene.shallow_water.is_some(), scene.wave.is_some()]
}

/// Whether any source of two scenes of the same kinds has other settings.
pub fn differ(a: &Scene, b: &Scene) -> bool {
    a.noise != b.noise || a.sequence != b.sequence || a.gas != b.gas || a.shallow_water != b.shallow_water || a.wave != b.wave
}

/// Whether a source of the scene writes [`Cover`](super::Cover).
pub fn covers(scene: &Scene) -> bool {
    scene.gas.is_some() || scene.shallow_water.is_some()
}

/// Layers that are composed together: those above a bed, or the relief, up to the next bed or the top.
struct Segment {
    compose: Compose,
    set: ComposeSet,
    /// Of the stack's sources.
    layers: std::ops::Range<usize>,
}

/// The sources of a scene, and what composes them.
pub struct Stack {
    sources: Vec<Box<dyn Source>>,
    segments: Vec<Segment>,
    /// What changed in the relief since the sources advanced last.
    fresh: Dirty,
    /// What changed anywhere since the height field was composed last.
    dirty: Dirty,
    /// Texels that were composed in the last frame, with the bytes of each.
    composed_bytes: u64,
}

impl Stack {
    /// Makes the sources of a scene, at their start.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu, field: &Field, scene: &Scene) -> Result<Self, ShaderError> {
        let sources = sources(gpu, field, scene)?;
        let segments = segments(gpu, field, &sources)?;
        Ok(Self { sources, segments, fresh: Dirty::All, dirty: Dirty::All, composed_bytes: 0 })
    }

    /// Puts every source back to its start.
    pub fn reset(&mut self, gpu: &Gpu, scene: &Scene) {
        self.sources.iter_mut().for_each(|source| source.reset(gpu, scene));
        self.fresh = Dirty::All;
    }

    /// Takes over a scene with the same kinds of sources.
    pub fn set_scene(&mut self, gpu: &Gpu, scene: &Scene) {
        self.sources.iter_mut().for_each(|source| source.set_scene(gpu, scene));
        self.fresh = Dirty::All;
    }

    /// Builds every kernel anew from the device's present shaders.
    ///
    /// # Errors
    ///
    /// A shader does not compile: the stack goes on as it was, but that sources may have changed theirs already.
    pub fn reload(&mut self, gpu: &Gpu, field: &Field) -> Result<(), ShaderError> {
        let segments = segments(gpu, field, &self.sources)?;
        self.sources.iter_mut().try_for_each(|source| source.reload(gpu))?;
        self.segments = segments;
        self.fresh = Dirty::All;
        Ok(())
    }

    /// Notes that these texels of the relief changed.
    pub fn relief_changed(&mut self, dirty: &Dirty, size: [u32; 2]) {
        self.fresh.merge(dirty, size);
    }

    /// Advances every source, from the ground up, by what the clock owes it; a source that stands on a bed finds there what lies
    /// beneath it.
    ///
    /// # Errors
    ///
    /// What disturbs a source is too much for the adapter.
    pub fn advance(
        &mut self,
        recorder: &mut Recorder<'_>,
        scene: &Scene,
        tick: &Tick,
        strokes: &Strokes,
        size: [u32; 2],
    ) -> Result<(), BinError> {
        self.composed_bytes = 0;
        let mut changed = std::mem::take(&mut self.fresh);
        for index in 0..self.segments.len() {
            for layer in self.segments[index].layers.clone() {
                let input = SourceInput { scene, tick, strokes, beneath: &changed };
                let of_layer = self.sources[layer].advance(recorder, &input)?;
                changed.merge(&of_layer, size);
            }
            if index + 1 < self.segments.len() {
                self.compose(recorder, scene, index, &changed.regions(size));
            }
        }
        self.dirty.merge(&changed, size);
        Ok(())
    }

    /// Composes the height field where anything changed, and says where that was and to how many texels it came.
    pub fn compose_top(&mut self, recorder: &mut Recorder<'_>, scene: &Scene, size: [u32; 2]) -> (Vec<Region>, u64) {
        let changed = std::mem::take(&mut self.dirty).regions(size);
        let texels = self.compose(recorder, scene, self.segments.len() - 1, &changed);
        (changed, texels)
    }

    fn compose(&mut self, recorder: &mut Recorder<'_>, scene: &Scene, segment: usize, changed: &[Region]) -> u64 {
        if changed.is_empty() {
            return 0;
        }
        let Segment { compose, set, layers } = &self.segments[segment];
        let sources = &self.sources[layers.clone()];
        let layers: Vec<_> = sources.iter().map(|source| (source.layer(scene), source.heights().current)).collect();
        let texels = compose.record(recorder, set, changed, &layers);
        let texel_bytes = compose::TEXEL_BYTES + compose::LAYER_BYTES * layers.len() as u64;
        self.composed_bytes += texel_bytes * texels;
        texels
    }

    /// The source of this name, if the scene has it.
    pub fn source(&self, name: &str) -> Option<&dyn Source> {
        self.sources.iter().find(|source| source.name() == name).map(Box::as_ref)
    }

    /// Where what lies beneath a source is composed to, if one stands on that.
    pub fn bed(&self) -> Option<&wgpu::TextureView> {
        self.sources.iter().find_map(|source| source.bed())
    }

    /// What each source remembers, with its name, from the ground up.
    pub fn states(&self) -> impl Iterator<Item = (&'static str, State<'_>)> {
        self.sources.iter().map(|source| (source.name(), source.state()))
    }

    /// Takes over the numbers of each source's state.
    pub fn restore(&mut self, numbers: &[Vec<u64>]) {
        self.sources.iter_mut().zip(numbers).for_each(|(source, numbers)| source.restore(numbers));
        self.fresh = Dirty::All;
    }

    /// How each source fares, with its name.
    pub fn health(&mut self, gpu: &Gpu) -> Vec<(&'static str, Health)> {
        self.sources.iter_mut().map(|source| (source.name(), source.health(gpu))).collect()
    }

    /// Bytes a texel of the field that the sources take.
    pub fn bytes_per_texel(&self) -> f64 {
        self.sources.iter().map(|source| source.bytes_per_texel()).sum()
    }

    /// Bytes that the sources and the composition moved in the last frame, by design.
    pub fn traffic_bytes(&self) -> u64 {
        self.composed_bytes + self.sources.iter().map(|source| source.traffic_bytes()).sum::<u64>()
    }

    /// Bytes that this source alone moved, if there is one of this name.
    pub fn traffic_bytes_of(&self, name: &str) -> Option<u64> {
        self.source(name).map(Source::traffic_bytes)
    }

    /// Bytes of GPU memory of the sources, and of the lists of what composes them.
    pub fn memory_bytes(&self) -> u64 {
        let segments = self.segments.iter().map(|segment| segment.set.memory_bytes()).sum::<u64>();
        self.sources.iter().map(|source| source.memory_bytes()).sum::<u64>() + segments
    }
}

/// Cuts the stack where a source stands on a bed, and binds each piece.
fn segments(gpu: &Gpu, field: &Field, sources: &[Box<dyn Source>]) -> Result<Vec<Segment>, ShaderError> {
    let mut cuts = vec![0];
    cuts.extend(sources.iter().enumerate().filter(|(_, source)| source.bed().is_some()).map(|(index, _)| index));
    let mut segments = Vec::with_capacity(cuts.len());
    for (number, &first) in cuts.iter().enumerate() {
        let end = cuts.get(number + 1).copied();
        let layers = first..end.unwrap_or(sources.len());
        // The first segment lies on the relief, every other on the bed of its first source.
        let bed = |index: usize| sources.get(index).and_then(|source| source.bed());
        let beneath = if number == 0 { &field.relief.view } else { bed(first).unwrap_or(&field.relief.view) };
        let composed = end.and_then(bed).unwrap_or(&field.height.view);
        let compose = Compose::new(gpu, layers.len(), end.is_none())?;
        let heights: Vec<_> = sources[layers.clone()].iter().map(|source| source.heights()).collect();
        let set = compose.bind(gpu, field, beneath, &heights, composed);
        segments.push(Segment { compose, set, layers });
    }
    Ok(segments)
}
