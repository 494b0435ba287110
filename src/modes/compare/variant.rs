//! What a row compares: a technique, a shadow, a number of samples.

use crate::scene::{PomCounts, Scene};
use crate::surface::{Shadow, Technique};

/// What a row compares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variant {
    /// How the surface is found.
    pub technique: Technique,
    /// The shadow upon it.
    pub shadow: Shadow,
    /// Samples of every view ray; none are the scene's.
    pub samples: Option<u32>,
}

impl Variant {
    /// Every technique with every shadow; where counts are swept, each technique that has one with each count.
    pub fn all(techniques: &[Technique], shadows: &[Shadow], sweep: &[u32]) -> Vec<Self> {
        let mut variants = Vec::new();
        for &technique in techniques {
            for &shadow in shadows {
                let variant = |samples| Self { technique, shadow, samples };
                if sweep.is_empty() || !has_samples(technique) {
                    variants.push(variant(None));
                } else {
                    variants.extend(sweep.iter().map(|count| variant(Some(*count))));
                }
            }
        }
        variants
    }

    /// The scene, shown this way.
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.trace.technique = self.technique;
        scene.trace.shadow = self.shadow;
        match self.samples {
            Some(count) => with_samples(scene, count),
            None => scene,
        }
    }
}

/// Whether the technique takes a number of samples that can be chosen.
pub fn has_samples(technique: Technique) -> bool {
    match technique {
        Technique::Steep | Technique::Relief | Technique::PomLinear | Technique::Pom => true,
        Technique::Normal
        | Technique::Parallax
        | Technique::ParallaxLimited
        | Technique::Pyramid
        | Technique::Exact
        | Technique::Mesh => false,
    }
}

/// The scene with so many samples for every view ray, whatever its angle.
pub fn with_samples(mut scene: Scene, count: u32) -> Scene {
    let trace = &mut scene.trace;
    trace.pom_counts = PomCounts::Angle;
    (trace.pom_samples_min, trace.pom_samples_max) = (count, count);
    // The binary search of `relief` comes on top of its linear one.
    (trace.steep_layers, trace.relief_linear_steps) = (count, count);
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_swept_for_techniques_that_have_one() {
        let variants = Variant::all(&[Technique::Normal, Technique::Pom], &[Shadow::None, Shadow::Hard], &[4, 8]);
        let count = |technique| variants.iter().filter(|variant| variant.technique == technique).count();
        assert_eq!((count(Technique::Normal), count(Technique::Pom)), (2, 4));
        let scene = variants[3].scene(&Scene::default());
        assert_eq!((scene.trace.technique, scene.trace.shadow), (Technique::Pom, Shadow::None));
        assert_eq!((scene.trace.pom_samples_min, scene.trace.pom_samples_max), (8, 8));
        assert_eq!(Variant::all(Technique::ALL, &[Shadow::Hard], &[]).len(), Technique::ALL.len());
    }
}
