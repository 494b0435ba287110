//! Look: the choices that one pipeline is composed of.

use super::{Albedo, Display, Shading, Shadow, Shows, Technique};
use crate::scene::Scene;

/// A technique, a shadow and what lights them, and whether the truth runs beside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Look {
    /// How the surface is found.
    pub technique: Technique,
    /// What hides it from the light.
    pub shadow: Shadow,
    /// What it is made of.
    pub albedo: Albedo,
    /// What light does to it.
    pub shading: Shading,
    /// Whether the exact traversal runs beside the technique: what the view of errors shows. A part of its own, since an
    /// adapter that runs both sides of every branch would pay for it in every picture.
    pub with_truth: bool,
}

impl Look {
    /// A look that no picture has: what traces alone is asked of.
    pub const fn tracing(technique: Technique, shadow: Shadow) -> Self {
        Self { technique, shadow, albedo: Albedo::Plain, shading: Shading::Phong, with_truth: false }
    }

    /// What a scene asks for, where `display` shows it: its left side, where it is split.
    pub fn of(scene: &Scene, display: &Display) -> Self {
        Self {
            technique: scene.trace.technique,
            shadow: scene.trace.shadow,
            albedo: scene.material.albedo,
            shading: scene.material.model,
            with_truth: display.shows == Shows::Error,
        }
    }

    /// The stem of the part that holds the truth, or none of it.
    pub const fn truth_stem(self) -> &'static str {
        if self.with_truth { "truth_exact" } else { "truth_none" }
    }
}
