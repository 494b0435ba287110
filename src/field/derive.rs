//! Derive: everything that follows from the heights of a field alone, over the texels that changed.
//!
//! The order of the passes and how far each looks beyond what changed stand here once, for the field that lives and for those that
//! stay as they are.

use std::cell::Cell;

use super::bounds::{BoundsPass, BoundsSet};
use super::normal_mips::{NormalMips, NormalMipsSet};
use super::normals::{Normals, NormalsSet};
use super::pyramid::{Pyramid, PyramidSet};
use super::{Field, Region};
use crate::gpu::{Gpu, Recorder, ShaderError};
use crate::scene::Addressing;

/// The passes.
pub struct Derive {
    normals: Normals,
    normal_mips: NormalMips,
    pyramid: Pyramid,
    bounds: BoundsPass,
}

/// The bindings of one field.
pub struct DeriveSet {
    normals: NormalsSet,
    normal_mips: NormalMipsSet,
    pyramid: PyramidSet,
    bounds: BoundsSet,
    /// Whether heights changed since the pyramid was built, which nothing read then.
    pyramid_is_stale: Cell<bool>,
    size: [u32; 2],
    addressing: Addressing,
}

/// What a field is derived from beside its heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivation {
    /// Depth over the texel's width and height.
    pub slope_per_height: [f32; 2],
    /// Whether means of normals and heights are wanted.
    pub with_mips: bool,
    /// Whether anything reads the pyramid. It costs a software adapter twice what the bounds do, and \[PDM\] alone needs it.
    pub with_pyramid: bool,
}

impl DeriveSet {
    /// Bytes of GPU memory of the lists of blocks.
    pub fn memory_bytes(&self) -> u64 {
        let passes = self.normals.memory_bytes() + self.normal_mips.memory_bytes();
        passes + self.pyramid.memory_bytes() + self.bounds.memory_bytes()
    }
}

impl Derive {
    /// Builds the pipelines.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu) -> Result<Self, ShaderError> {
        Ok(Self {
            normals: Normals::new(gpu)?,
            normal_mips: NormalMips::new(gpu)?,
            pyramid: Pyramid::new(gpu)?,
            bounds: BoundsPass::new(gpu)?,
        })
    }

    /// Binds a field.
    pub fn bind(&self, gpu: &Gpu, field: &Field) -> DeriveSet {
        DeriveSet {
            normals: self.normals.bind(gpu, field),
            normal_mips: self.normal_mips.bind(gpu, field),
            pyramid: self.pyramid.bind(gpu, field),
            bounds: self.bounds.bind(gpu, field),
            pyramid_is_stale: Cell::new(true),
            size: field.size,
            addressing: field.addressing,
        }
    }

    /// Derives what depends on the texels that changed.
    pub fn record(&self, recorder: &mut Recorder<'_>, set: &DeriveSet, changed: &[Region], derivation: Derivation) {
        let grown = |low, high| -> Vec<Region> {
            changed.iter().flat_map(|region| region.grown(low, high, set.size, set.addressing)).collect()
        };
        // Its slope, which a texel's neighbours see …
        let leaning = grown(1, 1);
        self.normals.record(recorder, &set.normals, &leaning, derivation.slope_per_height);
        // … what is left of that from afar, where the scene looks so …
        if derivation.with_mips {
            self.normal_mips.record(recorder, &set.normal_mips, &leaning);
        }
        // … and its bounds, which the cells before a texel see.
        let cells = grown(1, 0);
        if derivation.with_pyramid {
            let whole = set.pyramid_is_stale.replace(false).then(|| Region::all(set.size));
            self.pyramid.record(recorder, &set.pyramid, whole.as_ref().map_or(&cells, std::slice::from_ref));
        } else if !changed.is_empty() {
            set.pyramid_is_stale.set(true);
        }
        self.bounds.record(recorder, &set.bounds, &cells);
    }
}
