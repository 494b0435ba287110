//! The panel's group of the camera.

use egui::Ui;

use super::Panel;
use super::widgets::{Control, group, value};
use crate::modes::live::input::Action;

impl Panel {
    pub(super) fn camera_group(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        let (camera, was) = (&mut self.scene.camera, &self.original.camera);
        group(ui, "Camera", false, None, |ui| {
            let control = Control::new("Field of view", "°", 5.0, 120.0).decimals(0).tip("Vertical");
            value(ui, &control, &mut camera.vertical_fov_degrees, was.vertical_fov_degrees);
            ui.horizontal(|ui| {
                let mut flies = self.flies;
                if ui.checkbox(&mut flies, "Fly").on_hover_text("Fly with W A S D Q E instead of orbiting (F)").changed() {
                    actions.push(Action::ToggleFly);
                }
                if ui.button("Reset camera").on_hover_text("Back to the scene's own camera (C)").clicked() {
                    actions.push(Action::ResetCamera);
                }
            });
        });
    }
}
