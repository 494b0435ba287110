//! The panel's group of the lights and the sky.

use egui::{RichText, Ui};

use super::Panel;
use super::widgets::{Control, choice, colour, group, value};
use crate::scene::{Background, DirectionalLight, LIGHTS_MAX, Scene};

/// What the lights are called.
const NAMES: [&str; LIGHTS_MAX] = ["The scene's own", "Second", "Third", "Fourth"];

impl Panel {
    pub(super) fn light_group(&mut self, ui: &mut Ui) {
        let (scene, original, chosen) = (&mut self.scene, &self.original, &mut self.light);
        let changed = scene.light != original.light || scene.lights != original.lights;
        let reset = group(ui, "Light", true, Some(changed), |ui| {
            let count = 1 + scene.lights.len();
            *chosen = (*chosen).min(count - 1);
            if count > 1 {
                let all: Vec<usize> = (0..count).collect();
                choice(ui, "Which", "Which of the lights these rows move", chosen, *chosen, &all, |light| NAMES[light]);
            }
            directional_rows(ui, scene, original, *chosen);
            ui.horizontal(|ui| {
                if ui.add_enabled(count < LIGHTS_MAX, egui::Button::new("Add a light")).clicked() {
                    scene.lights.push(DirectionalLight::default());
                    *chosen = count;
                }
                if *chosen > 0 && ui.button("Remove this one").clicked() {
                    scene.lights.remove(*chosen - 1);
                    *chosen -= 1;
                }
            });
            ui.label(RichText::new("Surroundings").weak());
            let (light, was) = (&mut scene.light, &original.light);
            const BACKGROUND: &str = "What is behind everything";
            choice(ui, "Background", BACKGROUND, &mut light.background, was.background, Background::ALL, Background::label);
            colour(ui, "Sky", "Light from above, linear", &mut light.sky, was.sky);
            colour(ui, "Ground", "Light from below the horizon, linear", &mut light.ground, was.ground);
        });
        if reset {
            scene.light = original.light.clone();
            scene.lights = original.lights.clone();
        }
    }
}

/// The rows of one light, the scene's own or one of the others.
fn directional_rows(ui: &mut Ui, scene: &mut Scene, original: &Scene, chosen: usize) {
    let mut light = scene.all_lights().swap_remove(chosen);
    // A light that was added begins as the default one.
    let was = original.all_lights().get(chosen).cloned().unwrap_or_default();
    let control = Control::new("Azimuth", "°", 0.0, 360.0).decimals(0).tip("Where the light stands, from +x toward +z");
    value(ui, &control, &mut light.azimuth_degrees, was.azimuth_degrees);
    let control = Control::new("Elevation", "°", 1.0, 90.0).decimals(0).tip("How high it stands above the plane");
    value(ui, &control, &mut light.elevation_degrees, was.elevation_degrees);
    if chosen == 0 {
        let tip = "Half the angle that its disc spans: how soft cone and area shadows are";
        let control = Control::new("Half-angle", "°", 0.05, 15.0).logarithmic().tip(tip);
        value(ui, &control, &mut scene.light.half_angle_degrees, original.light.half_angle_degrees);
    }
    let control = Control::new("Turn", "°/s", -90.0, 90.0).decimals(0).tip("How fast it travels round the vertical");
    value(ui, &control, &mut light.turn_degrees_per_second, was.turn_degrees_per_second);
    let control = Control::new("Intensity", " ×", 0.0, 10.0).tip("Radiance of a white surface that faces it");
    value(ui, &control, &mut light.intensity, was.intensity);
    colour(ui, "Colour", "Colour of the light, linear", &mut light.colour, was.colour);
    ui.checkbox(&mut light.casts_shadow, "Casts shadows").on_hover_text("Each light that does costs a shadow ray a pixel");
    if chosen > 0 {
        scene.lights[chosen - 1] = light;
        return;
    }
    let DirectionalLight { azimuth_degrees, elevation_degrees, colour, intensity, turn_degrees_per_second, casts_shadow } = light;
    let own = &mut scene.light;
    (own.azimuth_degrees, own.elevation_degrees, own.colour) = (azimuth_degrees, elevation_degrees, colour);
    (own.intensity, own.turn_degrees_per_second, own.casts_shadow) = (intensity, turn_degrees_per_second, casts_shadow);
}
