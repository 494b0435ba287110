//! Derive: everything that follows from the layers of a field alone, over the texels that changed.
//!
//! The order of the passes and how far each looks beyond what changed stand here once, for the field that lives and for those that
//! stay as they are.

use super::compose::{Compose, ComposeSet};
use super::normal_mips::{NormalMips, NormalMipsSet};
use super::normals::{Normals, NormalsSet};
use super::pyramid::{Pyramid, PyramidSet};
use super::{Field, Region};
use crate::gpu::{Gpu, Recorder, ShaderError};
use crate::scene::Addressing;

/// The passes.
pub struct Derive {
    compose: Compose,
    normals: Normals,
    normal_mips: NormalMips,
    pyramid: Pyramid,
}

/// The bindings of one field.
pub struct DeriveSet {
    compose: ComposeSet,
    normals: NormalsSet,
    normal_mips: NormalMipsSet,
    pyramid: PyramidSet,
    size: [u32; 2],
    addressing: Addressing,
}

/// What a field is derived from beside its layers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivation {
    /// Height that a wave of displacement 1 adds; 0 where there are no waves.
    pub amplitude: f32,
    /// Which of the two textures of the waves holds their current state.
    pub wave: usize,
    /// Depth over the texel's width and height.
    pub slope_per_height: [f32; 2],
    /// Whether means of normals and heights are wanted.
    pub with_mips: bool,
}

impl Derive {
    /// Builds the pipelines.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        Ok(Self {
            compose: Compose::new(gpu)?,
            normals: Normals::new(gpu)?,
            normal_mips: NormalMips::new(gpu)?,
            pyramid: Pyramid::new(gpu)?,
        })
    }

    /// Binds a field.
    pub fn bind(&self, gpu: &Gpu, field: &Field) -> DeriveSet {
        DeriveSet {
            compose: self.compose.bind(gpu, field),
            normals: self.normals.bind(gpu, field),
            normal_mips: self.normal_mips.bind(gpu, field),
            pyramid: self.pyramid.bind(gpu, field),
            size: field.size,
            addressing: field.addressing,
        }
    }

    /// Derives what depends on the texels that changed.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &DeriveSet, changed: &[Region], derivation: &Derivation) {
        let grown = |low, high| -> Vec<Region> {
            changed.iter().flat_map(|region| region.grown(low, high, set.size, set.addressing)).collect()
        };
        // Compose relief and waves into the height field proper.
        self.compose.record(recorder, &set.compose, changed, derivation.amplitude, derivation.wave);
        // Everything below depends on that height alone: its slope, which a texel's neighbours see …
        let leaning = grown(1, 1);
        self.normals.record(recorder, &set.normals, &leaning, derivation.slope_per_height);
        // … what is left of that from afar, where the scene looks so …
        if derivation.with_mips {
            self.normal_mips.record(recorder, &set.normal_mips, &leaning);
        }
        // … and its bounds, which the cells before a texel see.
        self.pyramid.record(recorder, &set.pyramid, &grown(1, 0));
    }
}
