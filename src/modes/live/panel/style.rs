//! The looks of the panel.

use egui::{Color32, vec2};

/// The looks of the panel: dark, quiet, with one warm accent, so that the surface is what catches the eye.
pub fn set_style(ctx: &egui::Context) {
    const ACCENT: Color32 = Color32::from_rgb(222, 143, 86);
    ctx.set_theme(egui::Theme::Dark);
    ctx.style_mut_of(egui::Theme::Dark, |style| {
        style.spacing.item_spacing = vec2(6.0, 5.0);
        style.spacing.slider_width = 88.0;
        // Widgets that jump or fade cost frames on a software adapter; half the default is still smooth.
        style.animation_time = 0.04;
        let visuals = &mut style.visuals;
        visuals.panel_fill = Color32::from_rgb(24, 25, 28);
        visuals.window_fill = Color32::from_rgb(30, 31, 35);
        visuals.slider_trailing_fill = true;
        visuals.selection.bg_fill = ACCENT.gamma_multiply(0.55);
        visuals.selection.stroke.color = Color32::WHITE;
        visuals.hyperlink_color = ACCENT;
        visuals.widgets.hovered.bg_stroke.color = ACCENT.gamma_multiply(0.6);
        visuals.override_text_color = Some(Color32::from_gray(208));
    });
}
