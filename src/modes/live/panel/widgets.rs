//! The panel's rows: a name with a tip, a control with its unit, and a reset that is there when there is something to reset.

use egui::emath::Numeric;
use egui::{Align, Button, Color32, Layout, Response, RichText, Slider, Ui, UiBuilder, vec2};

/// Width of the panel, points.
pub const PANEL_WIDTH: f32 = 320.0;

/// Width of the names, points.
const NAME_WIDTH: f32 = 112.0;

/// How high a list may be before it scrolls, points: room for a dozen and a half choices.
const LIST_HEIGHT: f32 = 420.0;

/// What a numeric control shows.
#[derive(Clone, Copy, Debug)]
pub struct Control<'a> {
    name: &'a str,
    unit: &'a str,
    tip: &'a str,
    range: [f64; 2],
    scale: f64,
    decimals: usize,
    logarithmic: bool,
}

impl<'a> Control<'a> {
    /// A control of this name and unit, from `least` to `most` in that unit, with two decimals.
    pub const fn new(name: &'a str, unit: &'a str, least: f64, most: f64) -> Self {
        Self { name, unit, tip: "", range: [least, most], scale: 1.0, decimals: 2, logarithmic: false }
    }

    /// What it is for.
    pub const fn tip(self, tip: &'a str) -> Self {
        Self { tip, ..self }
    }

    /// The shown number is the value times this.
    pub const fn scale(self, scale: f64) -> Self {
        Self { scale, ..self }
    }

    /// How many decimals it shows.
    pub const fn decimals(self, decimals: usize) -> Self {
        Self { decimals, ..self }
    }

    /// It takes whole numbers only.
    pub const fn integer(self) -> Self {
        Self { decimals: 0, ..self }
    }

    /// Each part of its way multiplies by the same.
    pub const fn logarithmic(self) -> Self {
        Self { logarithmic: true, ..self }
    }
}

/// One row: the name, then `control`, then a reset. Returns whether the reset was clicked.
fn row(ui: &mut Ui, name: &str, tip: &str, changed: bool, control: impl FnOnce(&mut Ui) -> Response) -> bool {
    ui.horizontal(|ui| {
        let size = vec2(NAME_WIDTH, ui.spacing().interact_size.y);
        let label = ui
            .allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
                ui.set_min_width(NAME_WIDTH);
                ui.add(egui::Label::new(name).truncate()).on_hover_text(tip)
            })
            .inner;
        control(ui).labelled_by(label.id).on_hover_text(tip);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| reset_button(ui, name, changed)).inner
    })
    .inner
}

/// The small arrow that leads back.
fn reset_button(ui: &mut Ui, name: &str, changed: bool) -> bool {
    let colour = if changed { ui.visuals().hyperlink_color } else { Color32::TRANSPARENT };
    let button = Button::new(RichText::new("⟲").color(colour)).frame(false).small();
    let response = ui.add_enabled(changed, button).on_hover_text(format!("Reset {name}"));
    response.clone().accessible_name(format!("Reset {name}"));
    response.clicked()
}

/// A number, as a slider that can also be typed into.
pub fn value<N: Numeric>(ui: &mut Ui, control: &Control<'_>, value: &mut N, original: N) {
    let Control { name, unit, tip, range: [least, most], scale, decimals, logarithmic } = *control;
    let reset = row(ui, name, tip, *value != original, |ui| {
        let slider = Slider::from_get_set(least..=most, |new| {
            if let Some(new) = new {
                // A slider that was not touched must not rewrite what scale and back would round.
                let new = N::from_f64(new / scale);
                if new != *value {
                    *value = new;
                }
            }
            value.to_f64() * scale
        });
        let slider = slider.suffix(unit).fixed_decimals(decimals).logarithmic(logarithmic).clamping(egui::SliderClamping::Edits);
        ui.add(if N::INTEGRAL { slider.integer() } else { slider })
    });
    if reset {
        *value = original;
    }
}

/// One of a list.
pub fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    value: &mut T,
    original: T,
    all: &[T],
    label: impl Fn(T) -> &'static str,
) {
    let reset = row(ui, name, tip, *value != original, |ui| {
        let width = ui.available_width() - 24.0;
        let combo = egui::ComboBox::from_id_salt(name).width(width).height(LIST_HEIGHT).truncate().selected_text(label(*value));
        combo.show_ui(ui, |ui| all.iter().for_each(|&other| drop(ui.selectable_value(value, other, label(other))))).response
    });
    if reset {
        *value = original;
    }
}

/// A linear colour.
pub fn colour(ui: &mut Ui, name: &str, tip: &str, value: &mut [f32; 3], original: [f32; 3]) {
    // The picker rounds what it is given to its own cylinder and back: only what the user changed may be taken from it.
    let mut edited = *value;
    let mut changed = false;
    let reset = row(ui, name, tip, *value != original, |ui| {
        let response = ui.color_edit_button_rgb(&mut edited);
        changed = response.changed();
        response
    });
    if changed {
        *value = edited;
    }
    if reset {
        *value = original;
    }
}

/// A group under a heading. `changed`, where the group can be reset, says whether there is something to reset; returns whether
/// that was asked for.
pub fn group(ui: &mut Ui, name: &str, open: bool, changed: Option<bool>, body: impl FnOnce(&mut Ui)) -> bool {
    let heading = egui::CollapsingHeader::new(RichText::new(name).strong()).default_open(open);
    let header = heading.show_unindented(ui, body).header_response.rect;
    let Some(changed) = changed else { return false };
    // Laid over the right end of the heading, which is one wide button itself.
    let rect = header.with_max_x(ui.max_rect().right());
    let layout = Layout::right_to_left(Align::Center);
    reset_button(
        &mut ui.new_child(UiBuilder::new().id_salt(("reset", name)).max_rect(rect).layout(layout)),
        &format!("all of {name}"),
        changed,
    )
}
