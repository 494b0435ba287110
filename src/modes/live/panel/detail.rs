//! The panel's group of the level of detail.

use egui::Ui;

use super::Panel;
use super::widgets::{Control, group, value};
use crate::scene::Lod;

impl Panel {
    pub(super) fn detail_group(&mut self, ui: &mut Ui) {
        let (lod, was) = (&mut self.scene.lod, &self.original.lod);
        let changed = lod != was;
        let reset = group(ui, "Level of detail", true, Some(changed), |ui| {
            let usual = was.threshold.unwrap_or(Lod::USUAL_THRESHOLD);
            let mut on = lod.threshold.is_some();
            let tip = "Look less closely where a pixel sees much of the surface ([POM] §3.3)";
            if ui.checkbox(&mut on, "Level of detail on").on_hover_text(tip).changed() {
                lod.threshold = on.then_some(usual);
            }
            if let Some(threshold) = &mut lod.threshold {
                let tip = "Mip level beyond which normal mapping alone is left, and nothing is marched";
                value(ui, &Control::new("Threshold", "", 0.0, 10.0).decimals(1).tip(tip), threshold, usual);
                let tip = "Else the exact trace, too, stops at cells a fraction of a pixel ([PDM] §3.4)";
                ui.checkbox(&mut lod.keep_exact, "Keep exact exact").on_hover_text(tip);
            } else {
                let tip = "Light what a pixel sees, not one point: means of normals, and roughness for what they average away";
                ui.checkbox(&mut lod.filter, "Filter the light").on_hover_text(tip);
            }
        });
        if reset {
            *lod = was.clone();
        }
    }
}
