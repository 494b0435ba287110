//! The still reliefs beside a frame's own: each a field that is derived once, and again when its depth changes.

use super::{Derivation, Start, slope_per_height};
use crate::field::derive::{Derive, DeriveSet};
use crate::field::{Field, Region};
use crate::gpu::{Gpu, Recorder};
use crate::mesh::Mesh;
use crate::scene::{Relief, Scene};
use crate::surface::albedo_image;

/// One of them.
pub(super) struct Still {
    pub(super) field: Field,
    set: DeriveSet,
    mesh: Option<Mesh>,
    /// Whether its layers or its depth changed since it was derived.
    is_stale: bool,
}

impl Still {
    /// Makes one of a relief's start.
    pub(super) fn new(gpu: &Gpu, derive: &Derive, start: &Start) -> Self {
        let mut field = Field::new(gpu, start.scene.field.size, start.scene.field.addressing, false);
        if let Some(colours) = &start.colours {
            field.albedo_map = albedo_image::upload(gpu, colours);
        }
        let set = derive.bind(gpu, &field);
        let mut still = Self { field, set, mesh: start.mesh.clone(), is_stale: true };
        still.reset(gpu, start);
        still
    }

    /// Fills it again with what it starts from.
    pub(super) fn reset(&mut self, gpu: &Gpu, start: &Start) {
        self.field.relief.write(gpu, &start.heights);
        self.field.material.write(gpu, &start.material);
        self.is_stale = true;
    }

    /// What it is derived from may have changed.
    pub(super) fn touch(&mut self) {
        self.is_stale = true;
    }

    /// Derives it, unless it is.
    pub(super) fn derive(&mut self, recorder: &mut Recorder<'_>, derive: &Derive, scene: &Scene, relief: &Relief) {
        if !std::mem::take(&mut self.is_stale) {
            return;
        }
        let slope_per_height = slope_per_height(&relief.plane, relief.field.size);
        let derivation = Derivation { amplitude: 0.0, wave: 0, slope_per_height, with_mips: scene.lod.filters() };
        derive.record(recorder, &self.set, &[Region::all(self.field.size)], &derivation);
    }

    /// Its mesh where it lies in the world: its own, or its plane's.
    pub(super) fn mesh(&self, scene: &Scene, relief: &Relief) -> Option<Mesh> {
        let own = self.mesh.clone().or_else(|| super::shell_of_plane(scene, &relief.plane, relief.field.size));
        own.map(|mesh| mesh.moved(relief.world_from_own()))
    }
}
