//! The panel: shows a scene's values and what they cost, and changes them. A function of plain data, without a GPU or a window.
//!
//! [`Panel::show`] edits [`Panel::scene`] in place and returns what else was asked for as [`Action`]s, the same that keys give.

mod brush;
mod camera;
mod detail;
mod gas;
mod keys;
mod light;
mod material;
mod noise;
mod reliefs;
mod scene;
mod simulation;
mod split;
mod style;
mod surface;
mod techniques;
mod view;
mod widgets;

use std::time::Duration;

use egui::{Align, Align2, Layout, RichText, Ui, vec2};

pub use self::style::set_style;
pub use self::widgets::PANEL_WIDTH;
use self::widgets::group;
use super::hand::Brush;
use super::input::Action;
use super::readings::{self, Readings};
use crate::scene::Scene;
use crate::surface::{Display, Shows, Split, Technique};

/// What the scroll bar takes of the panel, points.
const SCROLL_BAR_WIDTH: f32 = 8.0;

/// How wide a message may be, points.
const MESSAGE_WIDTH: f32 = 520.0;

/// What the panel shows and changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The scene, as it is now.
    pub scene: Scene,
    /// The scene as it was chosen: where every reset leads.
    pub original: Scene,
    /// The scenes that can be chosen: name and description.
    pub scenes: Vec<(String, String)>,
    /// What is shown of it, and what is beside it.
    pub display: Display,
    /// Which of the lights the panel shows, the scene's own is 0.
    pub light: usize,
    /// Which of the reliefs beside the scene's own it shows.
    pub relief: usize,
    /// The left mouse button.
    pub brush: Brush,
    /// How many strokes of the brush can be taken back.
    pub undoable: usize,
    /// Whether the simulation stands.
    pub paused: bool,
    /// Whether the camera flies.
    pub flies: bool,
    /// Whether the panel is there at all.
    pub shown: bool,
    /// Whether the keys are explained.
    pub keys_shown: bool,
    /// A line for the user, and how many seconds it stays.
    pub message: Option<(String, f64)>,
}

impl Panel {
    /// Shows a scene, and these others to choose from.
    pub fn new(scene: Scene, scenes: Vec<(String, String)>) -> Self {
        Self {
            brush: Brush::of(&scene),
            original: scene.clone(),
            scene,
            scenes,
            display: Display::default(),
            light: 0,
            undoable: 0,
            relief: 0,
            paused: false,
            flies: false,
            shown: true,
            keys_shown: false,
            message: Some(("F1 shows the keys, H hides and shows the panel".to_owned(), 6.0)),
        }
    }

    /// Takes over another scene.
    pub fn choose(&mut self, scene: Scene) {
        self.brush = Brush::of(&scene);
        self.original = scene.clone();
        self.scene = scene;
        self.light = 0;
        self.relief = 0;
    }

    /// Shows another view, on both sides of a divider.
    pub fn show_view(&mut self, shows: Shows) {
        self.display.shows = shows;
        if let Some(split) = &mut self.display.split {
            split.shows = shows;
        }
    }

    /// Splits the screen, or joins it again.
    pub fn toggle_split(&mut self) {
        self.display.split = if self.display.split.is_some() { None } else { Some(self.new_split()) };
    }

    /// What a new divider has on its right.
    fn new_split(&self) -> Split {
        let trace = &self.scene.trace;
        // A technique beside itself would show nothing.
        let technique = if trace.technique == Technique::Normal { Technique::Exact } else { Technique::Normal };
        Split { technique, shadow: trace.shadow, shows: self.display.shows, fraction: Split::MIDDLE }
    }

    /// Says something for a while.
    pub fn say(&mut self, message: impl Into<String>) {
        self.message = Some((message.into(), 4.0));
    }

    /// Says what went wrong, long enough to be read; all of it on stderr, where it stays, and its first line here.
    pub fn say_error(&mut self, error: &str) {
        log::error!("{error}");
        self.message = Some((error.lines().next().unwrap_or_default().to_owned(), 15.0));
    }

    /// When to draw it anew without an event, if egui itself would wait for `delay`.
    pub fn stir(&self, delay: Duration) -> Duration {
        self.message.as_ref().map_or(delay, |&(_, left)| delay.min(Duration::from_secs_f64(left.max(0.0))))
    }

    /// Lets `seconds` pass for the message.
    pub fn pass_time(&mut self, seconds: f64) {
        if let Some((_, left)) = &mut self.message {
            *left -= seconds;
            if *left <= 0.0 {
                self.message = None;
            }
        }
    }

    /// Lays it out, applies what the user changes, and returns what the user asks for.
    pub fn show(&mut self, ui: &mut Ui, readings: &Readings) -> Vec<Action> {
        let mut actions = Vec::new();
        if self.shown {
            let frame = egui::Frame::side_top_panel(ui.style()).fill(ui.visuals().panel_fill.gamma_multiply(0.94));
            egui::Panel::left("panel").frame(frame).resizable(false).exact_size(PANEL_WIDTH).show(ui, |ui| {
                self.head(ui, readings, &mut actions);
                ui.separator();
                egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    // Beside the controls, not upon them.
                    ui.set_max_width(ui.available_width() - SCROLL_BAR_WIDTH);
                    self.groups(ui, readings, &mut actions);
                });
            });
        }
        let uncovered = ui.available_rect_before_wrap();
        self.divider(ui.ctx(), uncovered, readings);
        let middle = uncovered.center();
        self.keys(ui.ctx(), middle);
        self.messages(ui.ctx());
        actions
    }

    fn head(&self, ui: &mut Ui, readings: &Readings, actions: &mut Vec<Action>) {
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            ui.heading("Rilievo");
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.label(RichText::new(format!("{:.0} fps", readings.frames_per_second())).monospace())
                    .on_hover_text("Frames shown a second, by the wall clock");
                ui.label(RichText::new(format!("{:.2} s", readings.time_seconds)).monospace().weak())
                    .on_hover_text("Time that passed in the scene; in slow motion below 20 frames a second");
            });
        });
        ui.horizontal(|ui| {
            let mut button = |text: &str, tip: &str, action: Action| {
                if ui.button(text).on_hover_text(tip).clicked() {
                    actions.push(action);
                }
            };
            if self.paused {
                button("▶ Go on", "Let the simulation go on (Space)", Action::TogglePause);
            } else {
                button("⏸ Pause", "Stop the simulation; the brush still works (Space)", Action::TogglePause);
            }
            button("⏭ Step", "One frame of 1/60 s, then pause (.)", Action::Step);
            button("⟲ Reset", "Back to the start of the scene (R)", Action::Reset);
            button("❓ Keys", "What keys and mouse do (F1 or ?)", Action::ToggleKeys);
        });
    }

    fn groups(&mut self, ui: &mut Ui, readings: &Readings, actions: &mut Vec<Action>) {
        self.scene_group(ui, actions);
        self.view_group(ui);
        self.surface_group(ui);
        self.detail_group(ui);
        self.light_group(ui);
        self.material_group(ui);
        self.reliefs_group(ui);
        self.noise_group(ui);
        self.sequence_group(ui);
        self.simulation_group(ui);
        self.brush_group(ui, actions);
        self.camera_group(ui, actions);
        group(ui, "Cost", true, None, |ui| readings::show(ui, readings));
        ui.add_space(12.0);
    }

    fn messages(&self, ctx: &egui::Context) {
        let Some((message, _)) = &self.message else { return };
        let area = egui::Area::new(egui::Id::unique(("message", message)))
            .anchor(Align2::RIGHT_BOTTOM, vec2(-12.0, -12.0))
            .interactable(false);
        area.show(ctx, |ui| {
            ui.set_max_width(MESSAGE_WIDTH);
            egui::Frame::popup(ui.style()).show(ui, |ui| ui.label(message));
        });
    }
}
