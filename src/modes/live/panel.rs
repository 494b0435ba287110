//! The panel: shows a scene's values and what they cost, and changes them. A function of plain data, without a GPU or a window.
//!
//! [`Panel::show`] edits [`Panel::scene`] in place and returns what else was asked for as [`Action`]s, the same that keys give.

mod widgets;

use std::time::Duration;

use egui::{Align, Align2, Color32, Layout, RichText, Ui, vec2};

pub use self::widgets::PANEL_WIDTH;
use self::widgets::{Control, choice, colour, group, value};
use super::hand::{Brush, BrushKind};
use super::input::{Action, GESTURES, SHORTCUTS};
use super::readings::{self, Readings};
use crate::scene::{Boundary, Rain, Scene};
use crate::surface::{Albedo, Shadow, Shows, Technique};

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
    /// What the picture shows.
    pub shows: Shows,
    /// The left mouse button.
    pub brush: Brush,
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
            shows: Shows::Picture,
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
        let middle = ui.available_rect_before_wrap().center();
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
        self.surface_group(ui);
        self.light_group(ui);
        self.material_group(ui);
        self.simulation_group(ui);
        self.brush_group(ui);
        self.camera_group(ui, actions);
        group(ui, "Cost", true, None, |ui| readings::show(ui, readings));
        ui.add_space(12.0);
    }

    fn scene_group(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
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

    fn surface_group(&mut self, ui: &mut Ui) {
        let (plane, plane_was) = (&mut self.scene.plane, &self.original.plane);
        let (trace, was) = (&mut self.scene.trace, &self.original.trace);
        let shows = &mut self.shows;
        let changed = trace != was || plane != plane_was || *shows != Shows::Picture;
        let reset = group(ui, "Surface", true, Some(changed), |ui| {
            const VIEW: &str = "The picture, or one of the numbers behind it (V)";
            choice(ui, "View", VIEW, shows, Shows::Picture, Shows::ALL, Shows::label);
            const TECHNIQUE: &str = "How the ray of a pixel finds the surface (T)";
            choice(ui, "Technique", TECHNIQUE, &mut trace.technique, was.technique, Technique::ALL, Technique::label);
            choice(ui, "Shadow", "What blocks the light", &mut trace.shadow, was.shadow, Shadow::ALL, Shadow::label);
            let depth = Control::new("Depth", " mm", 1.0, 500.0).scale(1e3).decimals(1);
            value(ui, &depth.tip("How far height 0 lies below the plane"), &mut plane.depth_metres, plane_was.depth_metres);
            if trace.technique == Technique::Pom {
                let tip = "Samples along a ray that meets the surface head-on ([POM] eq. 1)";
                let control = Control::new("Samples, head-on", "", 1.0, 128.0).integer().tip(tip);
                value(ui, &control, &mut trace.pom_samples_min, was.pom_samples_min);
                let tip = "Samples along a ray that grazes the surface ([POM] eq. 1)";
                let control = Control::new("Samples, grazing", "", 1.0, 512.0).integer().logarithmic().tip(tip);
                value(ui, &control, &mut trace.pom_samples_max, was.pom_samples_max);
                trace.pom_samples_max = trace.pom_samples_max.max(trace.pom_samples_min);
            }
            if matches!(trace.shadow, Shadow::PomSoft | Shadow::Steep) {
                let tip = "Samples along the ray to the light; of steep shadows, layers of the whole depth";
                let control = Control::new("Shadow samples", "", 1.0, 128.0).integer().tip(tip);
                value(ui, &control, &mut trace.shadow_samples, was.shadow_samples);
            }
            if trace.shadow == Shadow::Area {
                let tip = "Points of the light's disc to which a ray goes";
                let control = Control::new("Light samples", "", 1.0, 512.0).integer().logarithmic().tip(tip);
                value(ui, &control, &mut trace.area_samples, was.area_samples);
            }
            if trace.shadow == Shadow::PomSoft {
                let tip = "How fast a blocker darkens";
                let control = Control::new("Shadow strength", " ×", 0.0, 20.0).decimals(1).tip(tip);
                value(ui, &control, &mut trace.shadow_strength, was.shadow_strength);
            }
            let traverses = matches!(trace.shadow, Shadow::Hard | Shadow::Cone | Shadow::Area);
            if trace.technique == Technique::Exact || traverses {
                let tip = "Nodes that one ray may visit before it gives up";
                let control = Control::new("Step cap", "", 16.0, 65536.0).integer().logarithmic().tip(tip);
                value(ui, &control, &mut trace.step_cap, was.step_cap);
            }
            let tip = "Rays along each side of a pixel: the cost is its square";
            let control = Control::new("Supersampling", " ×", 1.0, 4.0).integer().tip(tip);
            value(ui, &control, &mut trace.supersampling, was.supersampling);
        });
        if reset {
            *trace = was.clone();
            *plane = plane_was.clone();
            *shows = Shows::Picture;
        }
    }

    fn light_group(&mut self, ui: &mut Ui) {
        let (light, was) = (&mut self.scene.light, &self.original.light);
        let changed = light != was;
        let reset = group(ui, "Light", true, Some(changed), |ui| {
            let control = Control::new("Azimuth", "°", 0.0, 360.0).decimals(0).tip("Where the light stands, from +x toward +z");
            value(ui, &control, &mut light.azimuth_degrees, was.azimuth_degrees);
            let control = Control::new("Elevation", "°", 1.0, 90.0).decimals(0).tip("How high it stands above the plane");
            value(ui, &control, &mut light.elevation_degrees, was.elevation_degrees);
            let tip = "Half the angle that its disc spans: how soft cone and area shadows are";
            let control = Control::new("Half-angle", "°", 0.05, 15.0).logarithmic().tip(tip);
            value(ui, &control, &mut light.half_angle_degrees, was.half_angle_degrees);
            let control = Control::new("Turn", "°/s", -90.0, 90.0).decimals(0).tip("How fast it travels round the vertical");
            value(ui, &control, &mut light.turn_degrees_per_second, was.turn_degrees_per_second);
            let control = Control::new("Intensity", " ×", 0.0, 10.0).tip("Radiance of a white surface that faces it");
            value(ui, &control, &mut light.intensity, was.intensity);
            colour(ui, "Colour", "Colour of the light, linear", &mut light.colour, was.colour);
            colour(ui, "Sky", "Light from above, linear", &mut light.sky, was.sky);
            colour(ui, "Ground", "Light from below the horizon, linear", &mut light.ground, was.ground);
        });
        if reset {
            *light = was.clone();
        }
    }

    fn material_group(&mut self, ui: &mut Ui) {
        let (material, was) = (&mut self.scene.material, &self.original.material);
        let changed = material != was;
        let reset = group(ui, "Material", false, Some(changed), |ui| {
            choice(ui, "Albedo", "What the surface is made of", &mut material.albedo, was.albedo, Albedo::ALL, Albedo::label);
            colour(ui, "Tint", "Multiplies the albedo, linear", &mut material.tint, was.tint);
            let control = Control::new("Highlight", "", 0.0, 1.0).tip("Strength of the highlight");
            value(ui, &control, &mut material.specular, was.specular);
            let control = Control::new("Shininess", "", 1.0, 512.0).decimals(0).logarithmic().tip("How small the highlight is");
            value(ui, &control, &mut material.shininess, was.shininess);
        });
        if reset {
            *material = was.clone();
        }
    }

    fn simulation_group(&mut self, ui: &mut Ui) {
        let (scene, original) = (&mut self.scene, &self.original);
        // Two sponges and a texel of water between them.
        let widest_sponge = f64::from(scene.field.size[0].min(scene.field.size[1]).saturating_sub(1) / 2).clamp(1.0, 256.0);
        let changed = scene.wave != original.wave || scene.shots != original.shots;
        let reset = group(ui, "Simulation", true, Some(changed), |ui| {
            if let (Some(wave), Some(was)) = (&mut scene.wave, &original.wave) {
                let control = Control::new("Wave speed", " m/s", 0.01, 2.0).logarithmic().tip("How fast waves travel");
                value(ui, &control, &mut wave.speed_metres_per_second, was.speed_metres_per_second);
                let tip = "How fast waves die away: by e^(−rate/2) a second";
                let control = Control::new("Damping", " /s", 0.0, 10.0).tip(tip);
                value(ui, &control, &mut wave.damping_per_second, was.damping_per_second);
                let control = Control::new("Amplitude", "", 0.0, 1.0).tip("Height that a wave of amplitude 1 adds, of the depth");
                value(ui, &control, &mut wave.amplitude, was.amplitude);
                const BOUNDARY: &str = "What a wave meets at the border";
                choice(ui, "Border", BOUNDARY, &mut wave.boundary, was.boundary, BOUNDARIES, boundary_label);
                if wave.boundary == Boundary::Absorbing {
                    let control = Control::new("Sponge", " texels", 1.0, widest_sponge)
                        .integer()
                        .tip("Width of the layer that swallows waves");
                    value(ui, &control, &mut wave.sponge_texels, was.sponge_texels);
                }
                let rain_was = was.rain.clone().unwrap_or_default();
                let mut rains = wave.rain.is_some();
                if ui.checkbox(&mut rains, "Rain").on_hover_text("Seeded drops upon the water").changed() {
                    wave.rain = rains.then(|| rain_was.clone());
                }
                if let Some(rain) = &mut wave.rain {
                    rain_rows(ui, rain, &rain_was);
                }
            }
            if let (Some(shots), Some(was)) = (&mut scene.shots, &original.shots) {
                let control = Control::new("Shots", " /s", 0.0, 100.0).decimals(1).tip("Seeded shots at the wall");
                value(ui, &control, &mut shots.per_second, was.per_second);
                for (index, name) in ["Smallest crater", "Largest crater"].into_iter().enumerate() {
                    let control = Control::new(name, " mm", 1.0, 200.0).scale(1e3).decimals(1).tip("Radius of its rim");
                    value(ui, &control, &mut shots.radius_metres[index], was.radius_metres[index]);
                }
                shots.radius_metres[1] = shots.radius_metres[1].max(shots.radius_metres[0]);
                let tip = "How deep a crater of the largest radius is";
                let control = Control::new("Crater depth", " mm", 0.0, 100.0).scale(1e3).decimals(1).tip(tip);
                value(ui, &control, &mut shots.depth_metres, was.depth_metres);
                let control = Control::new("Scorch", "", 0.0, 1.0).tip("How black the soot around it is");
                value(ui, &control, &mut shots.scorch, was.scorch);
            }
            if scene.wave.is_none() && scene.shots.is_none() {
                ui.label(RichText::new("Nothing moves by itself in this scene.").weak());
            }
        });
        if reset {
            scene.wave = original.wave.clone();
            scene.shots = original.shots.clone();
        }
    }

    fn brush_group(&mut self, ui: &mut Ui) {
        let was = Brush::of(&self.original);
        let brush = &mut self.brush;
        let changed = *brush != was;
        let has_water = self.scene.wave.is_some();
        let reset = group(ui, "Brush", true, Some(changed), |ui| {
            let kinds = if has_water { BrushKind::ALL } else { &[BrushKind::Shot] };
            choice(ui, "Kind", "What the left mouse button does", &mut brush.kind, was.kind, kinds, BrushKind::label);
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

    fn camera_group(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
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

    fn keys(&mut self, ctx: &egui::Context, middle: egui::Pos2) {
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

fn rain_rows(ui: &mut Ui, rain: &mut Rain, was: &Rain) {
    let control = Control::new("Drops", " /s", 0.0, 200.0).decimals(0).tip("Mean number of drops a second");
    value(ui, &control, &mut rain.drops_per_second, was.drops_per_second);
    let control = Control::new("Drop radius", " mm", 2.0, 200.0).scale(1e3).decimals(1).tip("Radius of a drop's dent");
    value(ui, &control, &mut rain.radius_metres, was.radius_metres);
    let control = Control::new("Drop strength", " ×", 0.0, 4.0).tip("Depth of a drop's dent, in amplitudes");
    value(ui, &control, &mut rain.strength, was.strength);
}

const BOUNDARIES: &[Boundary] = &[Boundary::Periodic, Boundary::Reflecting, Boundary::Fixed, Boundary::Absorbing];

fn boundary_label(boundary: Boundary) -> &'static str {
    match boundary {
        Boundary::Periodic => "The opposite border",
        Boundary::Reflecting => "A wall",
        Boundary::Fixed => "A held border",
        Boundary::Absorbing => "A sponge",
    }
}

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
