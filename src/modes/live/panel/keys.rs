//! The window that explains keys and mouse.

use egui::{Align2, RichText, Ui, vec2};

use super::Panel;
use crate::modes::live::input::{GESTURES, SHORTCUTS};

impl Panel {
    pub(super) fn keys(&mut self, ctx: &egui::Context, middle: egui::Pos2) {
        let window = egui::Window::new("Keys").open(&mut self.keys_shown).collapsible(false).resizable(false);
        window.pivot(Align2::CENTER_CENTER).default_pos(middle).show(ctx, |ui| {
            let row = |ui: &mut Ui, keys: &str, does: &str| {
                ui.label(RichText::new(keys).monospace().color(ui.visuals().strong_text_color()));
                ui.label(does);
                ui.end_row();
            };
            ui.horizontal_top(|ui| {
                egui::Grid::new("shortcuts").spacing(vec2(16.0, 4.0)).show(ui, |ui| {
                    SHORTCUTS.iter().for_each(|shortcut| row(ui, shortcut.keys, shortcut.does));
                });
                ui.add_space(16.0);
                egui::Grid::new("gestures").spacing(vec2(16.0, 4.0)).show(ui, |ui| {
                    GESTURES.iter().for_each(|(keys, does)| row(ui, keys, does));
                });
            });
        });
    }
}
