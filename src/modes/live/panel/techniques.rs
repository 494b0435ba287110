//! The controls that belong to the chosen technique.

use egui::Ui;

use super::widgets::{Control, choice, value};
use crate::scene::{PomCounts, PyramidLeaf, Trace};
use crate::surface::Technique;

/// Shows what the technique lets one choose, and changes it; `was` is where each reset leads.
pub fn rows(ui: &mut Ui, trace: &mut Trace, was: &Trace) {
    match trace.technique {
        Technique::Steep => {
            let control = count("Layers").tip("Layers between the polygon and the floor, one sample each ([Steep])");
            value(ui, &control, &mut trace.steep_layers, was.steep_layers);
        }
        Technique::Relief => {
            let control = count("Linear steps").tip("Samples of the linear search");
            value(ui, &control, &mut trace.relief_linear_steps, was.relief_linear_steps);
            let tip = "Samples of the binary search between its last two";
            let control = Control::new("Binary steps", "", 1.0, 24.0).integer().tip(tip);
            value(ui, &control, &mut trace.relief_binary_steps, was.relief_binary_steps);
            const BIAS: &str = "Shortens the offset of rays that graze: fewer artefacts, and flatter ([POM] fig. 2)";
            let label = |on| if on { "On" } else { "Off" };
            choice(ui, "Depth bias", BIAS, &mut trace.relief_depth_bias, was.relief_depth_bias, &[false, true], label);
        }
        Technique::PomLinear | Technique::Pom => pom_rows(ui, trace, was),
        Technique::Pyramid => {
            const LEAF: &str = "What the ray meets at the finest level ([PDM] fig. 14)";
            choice(ui, "Leaf", LEAF, &mut trace.pyramid_leaf, was.pyramid_leaf, PyramidLeaf::ALL, PyramidLeaf::label);
        }
        Technique::Mesh => {
            let tip = "About how many micropolygons there are";
            let control = Control::new("Triangles", "", 2048.0, 8_388_608.0).integer().logarithmic().tip(tip);
            value(ui, &control, &mut trace.mesh_triangles, was.mesh_triangles);
        }
        Technique::Normal | Technique::Parallax | Technique::ParallaxLimited | Technique::Exact => {}
    }
}

fn pom_rows(ui: &mut Ui, trace: &mut Trace, was: &Trace) {
    const COUNTS: &str = "How the number of samples along a ray is chosen";
    choice(ui, "Sample counts", COUNTS, &mut trace.pom_counts, was.pom_counts, PomCounts::ALL, PomCounts::label);
    let by_angle = trace.pom_counts == PomCounts::Angle;
    let (name, tip) = if by_angle {
        ("Samples, head-on", "Samples along a ray that meets the surface head-on ([POM] eq. 1)")
    } else {
        ("Fewest samples", "Samples along a ray that crosses no more texels than this")
    };
    let control = Control::new(name, "", 1.0, 128.0).integer().tip(tip);
    value(ui, &control, &mut trace.pom_samples_min, was.pom_samples_min);
    if by_angle {
        let tip = "Samples along a ray that grazes the surface ([POM] eq. 1)";
        let control = count("Samples, grazing").tip(tip);
        value(ui, &control, &mut trace.pom_samples_max, was.pom_samples_max);
    }
    trace.pom_samples_max = trace.pom_samples_max.max(trace.pom_samples_min);
}

fn count(name: &str) -> Control<'_> {
    Control::new(name, "", 1.0, 512.0).integer().logarithmic()
}
