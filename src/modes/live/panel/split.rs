//! The divider of a split screen: what takes hold of it, and what stands on either side.

use egui::{Align2, Color32, Context, CursorIcon, Id, Order, Rect, RichText, Role, Sense, WidgetInfo, pos2, vec2};

use super::Panel;
use crate::frame::SIDES;
use crate::modes::live::readings::Readings;
use crate::scene::Scene;
use crate::surface::Shows;

/// How near to the divider the pointer takes hold of it, points.
const REACH: f32 = 8.0;

impl Panel {
    /// Lets the user drag the divider, and says beside it what each side is and what it costs. The divider itself is part of the
    /// picture, which lies under the panel too; `uncovered` is what the panel leaves free.
    pub(super) fn divider(&mut self, ctx: &Context, uncovered: Rect, readings: &Readings) {
        let Some(split) = &mut self.display.split else { return };
        let picture = ctx.content_rect();
        let x = picture.left() + split.fraction * picture.width();
        if uncovered.x_range().contains(x) {
            let area = egui::Area::new(Id::unique("divider")).order(Order::Middle).fixed_pos(pos2(x - REACH, uncovered.top()));
            area.constrain(false).show(ctx, |ui| {
                let (_, response) = ui.allocate_exact_size(vec2(2.0 * REACH, uncovered.height()), Sense::drag());
                response.widget_info(|| WidgetInfo::labeled(Role::Splitter, true, "Drag the divider"));
                if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
                    split.fraction = ((pointer.x - picture.left()) / picture.width()).clamp(0.0, 1.0);
                }
                response.on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
            });
        }
        let right = split.scene(&self.scene);
        let sides = [
            (&self.scene, self.display.shows, Align2::RIGHT_TOP, -1.0, SIDES[0]),
            (&right, split.shows, Align2::LEFT_TOP, 1.0, SIDES[1]),
        ];
        for (scene, shows, pivot, direction, pass) in sides {
            let at = pos2(x.clamp(uncovered.left(), uncovered.right()) + direction * 2.0 * REACH, uncovered.top() + REACH);
            let area = egui::Area::new(Id::unique(pass)).order(Order::Background).pivot(pivot).fixed_pos(at).interactable(false);
            area.constrain(false).show(ctx, |ui| {
                let text = side(scene, shows, readings.milliseconds(pass));
                let frame = egui::Frame::new().fill(Color32::from_black_alpha(150)).corner_radius(4.0).inner_margin(6.0);
                frame.show(ui, |ui| ui.add(egui::Label::new(RichText::new(text)).extend()));
            });
        }
    }
}

/// What stands on one side, in three lines at most.
fn side(scene: &Scene, shows: Shows, milliseconds: Option<f64>) -> String {
    let mut lines = vec![scene.trace.technique.label().to_owned(), format!("Shadow: {}", scene.trace.shadow.label())];
    if shows != Shows::Picture {
        lines.push(shows.label().to_owned());
    }
    if let Some(milliseconds) = milliseconds {
        lines.push(format!("{milliseconds:.2} ms"));
    }
    lines.join("\n")
}
