//! The panel's group of the reliefs beside the scene's own: where each lies and how deep it is.

use egui::Ui;

use super::Panel;
use super::widgets::{Control, choice, colour, group, value};
use crate::scene::{RELIEFS_MAX, Relief};
use crate::surface::Albedo;

/// What reliefs without a name are called.
const NAMES: [&str; RELIEFS_MAX] = ["First", "Second", "Third", "Fourth", "Fifth", "Sixth", "Seventh"];

impl Panel {
    pub(super) fn reliefs_group(&mut self, ui: &mut Ui) {
        let (reliefs, original, chosen) = (&mut self.scene.reliefs, &self.original.reliefs, &mut self.relief);
        if reliefs.is_empty() {
            return;
        }
        let changed = reliefs != original;
        let reset = group(ui, "Reliefs beside it", false, Some(changed), |ui| {
            *chosen = (*chosen).min(reliefs.len() - 1);
            if reliefs.len() > 1 {
                let all: Vec<usize> = (0..reliefs.len()).collect();
                choice(ui, "Which one", "Which of the reliefs these rows move", chosen, *chosen, &all, |relief| NAMES[relief]);
            }
            // What the scene has at its start is there as long as the scene is.
            if let (Some(relief), Some(was)) = (reliefs.get_mut(*chosen), original.get(*chosen)) {
                if !relief.name.is_empty() {
                    ui.label(&relief.name);
                }
                rows(ui, relief, was);
            }
        });
        if reset {
            reliefs.clone_from(original);
        }
    }
}

fn rows(ui: &mut Ui, relief: &mut Relief, was: &Relief) {
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let control = Control::new(name, " m", -10.0, 10.0).tip("Where its middle lies");
        value(ui, &control, &mut relief.position_metres[axis], was.position_metres[axis]);
    }
    let control = Control::new("Yaw", "°", -180.0, 180.0).decimals(1).tip("Turn about the vertical");
    value(ui, &control, &mut relief.yaw_degrees, was.yaw_degrees);
    let control = Control::new("Pitch", "°", -180.0, 180.0).decimals(1).tip("0 lies, 90 stands as a wall, 180 hangs");
    value(ui, &control, &mut relief.pitch_degrees, was.pitch_degrees);
    let control = Control::new("Roll", "°", -180.0, 180.0).decimals(1).tip("Turn in its own plane");
    value(ui, &control, &mut relief.roll_degrees, was.roll_degrees);
    let control = Control::new("Relief depth", " mm", 1.0, 1000.0).scale(1e3).decimals(1).logarithmic();
    value(ui, &control.tip("How far its deepest valley lies below"), &mut relief.plane.depth_metres, was.plane.depth_metres);
    let material = &mut relief.material;
    choice(ui, "Made of", "What it is made of", &mut material.albedo, was.material.albedo, Albedo::ALL, Albedo::label);
    colour(ui, "Relief tint", "Multiplies its albedo, linear", &mut material.tint, was.material.tint);
}
