//! The panel's group of the scene itself: which one, and its seed.

use egui::{Align, Layout, RichText, Ui};

use super::Panel;
use super::widgets::group;
use crate::modes::live::input::Action;

impl Panel {
    pub(super) fn scene_group(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        group(ui, "Scene", true, None, |ui| {
            let label = ui.label("Scene");
            let chosen = self.scene.name.clone();
            let combo =
                egui::ComboBox::from_id_salt("scene").width(ui.available_width()).selected_text(&chosen).show_ui(ui, |ui| {
                    for (index, (name, description)) in self.scenes.iter().enumerate() {
                        if ui.selectable_label(*name == chosen, name).on_hover_text(description).clicked() {
                            actions.push(Action::Scene(index));
                        }
                    }
                });
            combo.response.labelled_by(label.id).on_hover_text("What is simulated and shown (1 … 9)");
            if !self.scene.description.is_empty() {
                ui.label(RichText::new(&self.scene.description).weak());
            }
            ui.horizontal(|ui| {
                ui.label("Seed").on_hover_text("All that is random in the scene follows from this number");
                ui.label(RichText::new(self.scene.seed.to_string()).monospace());
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    if ui.button("New seed").on_hover_text("Start the scene anew, with another seed (Shift+R)").clicked() {
                        actions.push(Action::NewSeed);
                    }
                });
            });
        });
    }
}
