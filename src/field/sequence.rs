//! Sequence: a series of images played as heights. Whoever reads files hands over what a moment needs; nothing is read here.
//!
//! An image that is shown already is not uploaded again. 4 bytes a texel where another comes.

use std::sync::Arc;

use super::bins::BinError;
use super::source::{Heights, Source, SourceInput};
use super::{Dirty, LAYER, roles};
use crate::gpu::{Contract, Gpu, Recorder, Role, ShaderError, Texture};
use crate::scene::{Between, Layer, LayerBlend, Scene};
use crate::surface::albedo_image::ColourImage;

/// Bytes a texel of an upload by design: a height in.
pub const TEXEL_BYTES: u64 = 4;

roles! {
    /// The heights of the images.
    SequenceHeights = "sequence", R32Float, mips false, LAYER, "heights of the images, 0 to 1", from "upload", to "compose";
}

/// The textures of a scene with a sequence.
pub const CONTRACT: &[(Contract, u32)] = &[(SequenceHeights::CONTRACT, 1)];

/// What a moment shows of a series.
#[derive(Clone, Debug, PartialEq)]
pub struct Images {
    /// Where it lies in the series: equal places are equal images.
    pub between: Between,
    /// As many heights as the field has texels, row by row.
    pub heights: Arc<[f32]>,
    /// The colours over them, if any.
    pub colours: Option<Arc<ColourImage>>,
}

/// The heights of one field.
pub struct SequenceSet {
    /// The heights.
    pub heights: Texture<SequenceHeights>,
    shown: Option<Arc<Images>>,
}

impl SequenceSet {
    /// Makes the heights of a field of this size, zero.
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        Self { heights: Texture::new(gpu, size), shown: None }
    }

    /// Forgets what it shows: the next images are uploaded whatever they are.
    pub fn forget(&mut self) {
        self.shown = None;
    }

    /// Shows these images from the next submission on; says whether they were others before.
    pub fn show(&mut self, gpu: &Gpu, images: &Arc<Images>) -> bool {
        if self.shown.as_ref().is_some_and(|shown| Arc::ptr_eq(shown, images)) {
            return false;
        }
        self.heights.write(gpu, &images.heights);
        self.shown = Some(images.clone());
        true
    }
}

/// The images of a scene's sequence, as a layer of its stack.
pub struct SequenceSource {
    set: SequenceSet,
    /// Whether the last frame brought others.
    uploaded: bool,
}

impl SequenceSource {
    /// Heights over a field of this size, zero until the first images come.
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        Self { set: SequenceSet::new(gpu, size), uploaded: false }
    }
}

impl Source for SequenceSource {
    fn name(&self) -> &'static str {
        "sequence"
    }

    fn layer(&self, scene: &Scene) -> Layer {
        let layer = scene.sequence.as_ref().map(|sequence| (sequence.blend, sequence.amplitude));
        let (blend, amplitude) = layer.unwrap_or((LayerBlend::Add, 0.0));
        Layer { blend, amplitude }
    }

    fn reset(&mut self, _gpu: &Gpu, _scene: &Scene) {
        self.set.forget();
    }

    fn reload(&mut self, _gpu: &Gpu) -> Result<(), ShaderError> {
        Ok(())
    }

    fn advance(&mut self, recorder: &mut Recorder<'_>, input: &SourceInput<'_>) -> Result<Dirty, BinError> {
        self.uploaded = input.strokes.images.as_ref().is_some_and(|images| self.set.show(recorder.gpu, images));
        Ok(if self.uploaded { Dirty::All } else { Dirty::Nothing })
    }

    fn contract(&self) -> &'static [(Contract, u32)] {
        CONTRACT
    }

    fn heights(&self) -> Heights<'_> {
        Heights { views: [&self.set.heights.view; 2], current: 0 }
    }

    fn restore(&mut self, _numbers: &[u64]) {
        self.set.forget();
    }

    fn traffic_bytes(&self) -> u64 {
        if self.uploaded { TEXEL_BYTES * self.set.heights.size().map(u64::from).iter().product::<u64>() } else { 0 }
    }

    fn memory_bytes(&self) -> u64 {
        self.set.heights.memory_bytes()
    }
}
