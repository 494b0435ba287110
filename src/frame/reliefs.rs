//! The still reliefs beside a frame's own: each a field that is derived once, and again when its depth changes.

use super::{Derivation, FrameError, Start, check_shell, check_texture, shell_of_plane, slope_per_height};
use crate::field::compose::{Compose, ComposeSet};
use crate::field::derive::{Derive, DeriveSet};
use crate::field::{Field, Region};
use crate::gpu::{Gpu, Recorder, ShaderError};
use crate::mesh::Mesh;
use crate::scene::{Relief, Scene};
use crate::surface::albedo_image;

/// All of them, and what makes heights of their bases; nothing where a scene has none.
pub(super) struct Stills {
    compose: Option<Compose>,
    all: Vec<Still>,
}

struct Still {
    field: Field,
    compose_set: ComposeSet,
    derive_set: DeriveSet,
    mesh: Option<Mesh>,
    /// Whether its base or its depth changed since it was derived.
    is_stale: bool,
}

impl Stills {
    /// Makes those of a scene's start.
    ///
    /// # Errors
    ///
    /// An image or a mesh of one is too large, or a shader does not compile.
    pub(super) fn new(gpu: &Gpu, derive: &Derive, start: &Start) -> Result<Self, FrameError> {
        if start.reliefs.is_empty() {
            return Ok(Self { compose: None, all: Vec::new() });
        }
        for (index, relief) in start.reliefs.iter().enumerate() {
            check_shell(&start.scene, relief.mesh.as_ref())?;
            if let Some(colours) = &relief.colours {
                let what = format!("the albedo image of `reliefs[{index}]`");
                check_texture(gpu, &what, colours.size, "scale it down")?;
            }
        }
        let compose = still_compose(gpu)?;
        let all = start.reliefs.iter().map(|start| Still::new(gpu, &compose, derive, start)).collect();
        Ok(Self { compose: Some(compose), all })
    }

    /// Fills them again with what they start from.
    pub(super) fn reset(&mut self, gpu: &Gpu, start: &Start) {
        for (still, start) in self.all.iter_mut().zip(&start.reliefs) {
            still.fill(gpu, start);
        }
    }

    /// Builds what makes their heights anew from the device's present shaders.
    ///
    /// # Errors
    ///
    /// The shader does not compile: they go on as they were.
    pub(super) fn reload(&mut self, gpu: &Gpu) -> Result<(), ShaderError> {
        if let Some(compose) = &mut self.compose {
            *compose = still_compose(gpu)?;
        }
        self.touch();
        Ok(())
    }

    /// What they are derived from may have changed.
    pub(super) fn touch(&mut self) {
        self.all.iter_mut().for_each(|still| still.is_stale = true);
    }

    /// Derives those that are stale, and their pyramids where something reads them.
    pub(super) fn derive(&mut self, recorder: &mut Recorder<'_>, derive: &Derive, scene: &Scene, with_pyramid: bool) {
        let Some(compose) = &self.compose else { return };
        for (still, relief) in self.all.iter_mut().zip(&scene.reliefs) {
            let whole = [Region::all(still.field.size)];
            let changed = if std::mem::take(&mut still.is_stale) { whole.as_slice() } else { &[] };
            if !changed.is_empty() {
                compose.record(recorder, &still.compose_set, changed, &[]);
            }
            let slope_per_height = slope_per_height(&relief.plane, relief.field.size);
            let derivation = Derivation { slope_per_height, with_mips: scene.lod.filters(), with_pyramid };
            derive.record(recorder, &still.derive_set, changed, derivation);
        }
    }

    /// Their fields.
    pub(super) fn fields(&self) -> impl Iterator<Item = &Field> {
        self.all.iter().map(|still| &still.field)
    }

    /// Their meshes where they lie in the world: their own, or their planes'.
    pub(super) fn meshes(&self, scene: &Scene) -> impl Iterator<Item = Option<Mesh>> {
        self.all.iter().zip(&scene.reliefs).map(|(still, relief)| still.mesh(scene, relief))
    }

    /// Bytes of GPU memory of their fields, and of the lists of what derives them.
    pub(super) fn memory_bytes(&self) -> u64 {
        let bytes =
            |still: &Still| still.field.memory_bytes() + still.compose_set.memory_bytes() + still.derive_set.memory_bytes();
        self.all.iter().map(bytes).sum()
    }
}

/// What makes heights of a base under which and over which nothing lives.
fn still_compose(gpu: &Gpu) -> Result<Compose, ShaderError> {
    Compose::new(gpu, 0, true)
}

impl Still {
    fn new(gpu: &Gpu, compose: &Compose, derive: &Derive, start: &Start) -> Self {
        let mut field = Field::new(gpu, start.scene.field.size, start.scene.field.addressing, false);
        if let Some(colours) = &start.colours {
            field.albedo_map = albedo_image::upload(gpu, colours);
        }
        let compose_set = compose.bind(gpu, &field, &field.relief.view, &[], &field.height.view);
        let derive_set = derive.bind(gpu, &field);
        let mut still = Self { field, compose_set, derive_set, mesh: start.mesh.clone(), is_stale: true };
        still.fill(gpu, start);
        still
    }

    fn fill(&mut self, gpu: &Gpu, start: &Start) {
        self.field.relief.write(gpu, &start.heights);
        self.field.material.write(gpu, &start.material);
        self.is_stale = true;
    }

    fn mesh(&self, scene: &Scene, relief: &Relief) -> Option<Mesh> {
        let own = self.mesh.clone().or_else(|| shell_of_plane(scene, &relief.plane, relief.field.size));
        own.map(|mesh| mesh.moved(relief.world_from_own()))
    }
}
