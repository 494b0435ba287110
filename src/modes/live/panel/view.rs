//! The panel's group of what is shown: the picture or a view of its numbers, and another one beside it.

use egui::{RichText, Ui};

use super::Panel;
use super::widgets::{Control, choice, group, value};
use crate::surface::{Display, Shadow, Shows, Split, Technique};

impl Panel {
    pub(super) fn view_group(&mut self, ui: &mut Ui) {
        let changed = self.display != Display::default();
        let new = self.new_split();
        let display = &mut self.display;
        let mut toggles = false;
        let reset = group(ui, "View", true, Some(changed), |ui| {
            const VIEW: &str = "The picture, or one of the numbers behind it (V)";
            choice(ui, "Shows", VIEW, &mut display.shows, Shows::Picture, Shows::ALL, Shows::label);
            legend(ui, display.shows, display.gain);
            if display.shows == Shows::Error || display.split.is_some_and(|split| split.shows == Shows::Error) {
                let tip = "The brightest heat is an error of 1 / gain texels";
                let control = Control::new("Gain", " ×", 0.01, 1000.0).logarithmic().tip(tip);
                value(ui, &control, &mut display.gain, Display::GAIN);
            }
            if display.shows == Shows::LevelCap || display.split.is_some_and(|split| split.shows == Shows::LevelCap) {
                let control = Control::new("Level", "", 0.0, 12.0).integer().tip("Where the traversal of the pyramid ends");
                value(ui, &control, &mut display.level_cap, Display::LEVEL_CAP);
            }
            let mut splits = display.split.is_some();
            const SPLIT: &str = "The same field on both sides of a divider, traced in two ways (B)";
            toggles = ui.checkbox(&mut splits, "Split screen").on_hover_text(SPLIT).changed();
            if let Some(split) = &mut display.split {
                ui.label(RichText::new("On the right").weak());
                const TECHNIQUE: &str = "How the ray of a pixel finds the surface, on the right";
                choice(ui, "Its technique", TECHNIQUE, &mut split.technique, new.technique, Technique::ALL, Technique::label);
                choice(
                    ui,
                    "Its shadow",
                    "What blocks the light, on the right",
                    &mut split.shadow,
                    new.shadow,
                    Shadow::ALL,
                    Shadow::label,
                );
                choice(ui, "Its view", VIEW, &mut split.shows, new.shows, Shows::ALL, Shows::label);
                let control = Control::new("Divider", " %", 0.0, 100.0).scale(100.0).decimals(0);
                value(ui, &control.tip("Where it stands; drag it in the picture"), &mut split.fraction, Split::MIDDLE);
            }
        });
        if toggles {
            self.toggle_split();
        }
        if reset {
            self.display = Display::default();
        }
    }
}

/// What the colours of a view mean.
fn legend(ui: &mut Ui, shows: Shows, gain: f32) {
    let text = match (shows, shows.heat_top(gain)) {
        (_, Some(top)) => format!("Black is 0, the brightest {top} {}", shows.unit()),
        (Shows::Height | Shows::Visibility, _) => format!("Black is 0, white 1 {}", shows.unit()),
        (Shows::Normal, _) => "As in a normal map: red right, green up".to_owned(),
        (Shows::UvOffset, _) => "Grey is nowhere, red to the right, green up".to_owned(),
        _ => return,
    };
    ui.label(RichText::new(text).weak());
}
