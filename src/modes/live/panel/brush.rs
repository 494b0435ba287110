//! The panel's group of the left mouse button.

use egui::Ui;

use super::Panel;
use super::widgets::{Control, choice, group, value};
use crate::modes::live::hand::{Brush, BrushKind};

impl Panel {
    pub(super) fn brush_group(&mut self, ui: &mut Ui) {
        let was = Brush::of(&self.original);
        let brush = &mut self.brush;
        let changed = *brush != was;
        let kinds = BrushKind::of(&self.scene);
        let reset = group(ui, "Brush", true, Some(changed), |ui| {
            choice(ui, "Kind", "What the left mouse button does", &mut brush.kind, was.kind, &kinds, BrushKind::label);
            let [least, most] = Brush::RADIUS_METRES.map(|metres| f64::from(metres) * 1e3);
            let control = Control::new("Radius", " mm", least, most).scale(1e3).decimals(1).logarithmic();
            value(ui, &control.tip("How large it is (Ctrl+wheel)"), &mut brush.radius_metres, was.radius_metres);
            let control =
                Control::new("Rate", " /s", 1.0, 60.0).decimals(0).tip("How often while it is held; once a frame at most");
            value(ui, &control, &mut brush.per_second, was.per_second);
        });
        if reset {
            *brush = was;
        }
    }
}
