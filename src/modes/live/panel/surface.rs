//! The panel's group of the surface: technique, shadow, and what belongs to them.

use egui::Ui;

use super::widgets::{Control, choice, group, value};
use super::{Panel, techniques};
use crate::scene::PomCounts;
use crate::surface::{Shadow, Technique};

impl Panel {
    pub(super) fn surface_group(&mut self, ui: &mut Ui) {
        let (plane, plane_was) = (&mut self.scene.plane, &self.original.plane);
        let (trace, was) = (&mut self.scene.trace, &self.original.trace);
        let changed = trace != was || plane != plane_was;
        let reset = group(ui, "Surface", true, Some(changed), |ui| {
            const TECHNIQUE: &str = "How the ray of a pixel finds the surface (T)";
            choice(ui, "Technique", TECHNIQUE, &mut trace.technique, was.technique, Technique::ALL, Technique::label);
            choice(ui, "Shadow", "What blocks the light", &mut trace.shadow, was.shadow, Shadow::ALL, Shadow::label);
            // A harbour is deeper than a wall: twice what the scene has must be there.
            let deepest = (2e3 * f64::from(plane_was.depth_metres)).max(500.0);
            let depth = Control::new("Depth", " mm", 1.0, deepest).scale(1e3).decimals(1);
            value(ui, &depth.tip("How far height 0 lies below the plane"), &mut plane.depth_metres, plane_was.depth_metres);
            techniques::rows(ui, trace, was);
            if trace.shadow == Shadow::Area {
                let tip = "Points of the light's disc, a ray each";
                let control = Control::new("Shadow rays", "", 1.0, 512.0).integer().logarithmic().tip(tip);
                value(ui, &control, &mut trace.area_samples, was.area_samples);
            }
            if matches!(trace.shadow, Shadow::PomSoft | Shadow::Steep) {
                let tip = "Samples along the ray to the light; of steep shadows, layers of the whole depth";
                let control = Control::new("Shadow samples", "", 1.0, 128.0).integer().tip(tip);
                value(ui, &control, &mut trace.shadow_samples, was.shadow_samples);
            }
            if trace.shadow == Shadow::PomSoft {
                let tip = "How fast a blocker darkens";
                let control = Control::new("Shadow strength", " ×", 0.0, 20.0).decimals(1).tip(tip);
                value(ui, &control, &mut trace.shadow_strength, was.shadow_strength);
            }
            let counts_by_texels =
                matches!(trace.technique, Technique::Pom | Technique::PomLinear) && trace.pom_counts == PomCounts::Texels;
            let traverses = matches!(trace.technique, Technique::Pyramid | Technique::Exact)
                || matches!(trace.shadow, Shadow::Hard | Shadow::Cone | Shadow::Area);
            if traverses || counts_by_texels {
                let tip = "Nodes that one ray may visit before it gives up, and the most samples by crossed texels";
                let control = Control::new("Step cap", "", 16.0, 65536.0).integer().logarithmic().tip(tip);
                value(ui, &control, &mut trace.step_cap, was.step_cap);
            }
            let tip = "Draw the relief as a solid with a silhouette of its own, which ends at its mesh's borders";
            ui.checkbox(&mut trace.shell, "Shell").on_hover_text(tip);
            let tip = "Write the relief's depth instead of the polygon's, so that surfaces intersect as they should";
            ui.checkbox(&mut trace.displaced_depth, "Displaced depth").on_hover_text(tip);
            let tip = "Rays along each side of a pixel: the cost is its square";
            let control = Control::new("Supersampling", " ×", 1.0, 4.0).integer().tip(tip);
            value(ui, &control, &mut trace.supersampling, was.supersampling);
        });
        if reset {
            *trace = was.clone();
            *plane = plane_was.clone();
        }
    }
}
