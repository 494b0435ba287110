//! The panel's group of what moves by itself: waves and rain, shots, charges.

use egui::{RichText, Ui};

use super::Panel;
use super::gas::gas_rows;
use super::widgets::{Control, choice, group, value};
use crate::scene::shallow_water::SUBSTEPS_MAX;
use crate::scene::{Boundary, Rain, ShallowWater};

impl Panel {
    pub(super) fn simulation_group(&mut self, ui: &mut Ui) {
        let (scene, original) = (&mut self.scene, &self.original);
        // Two sponges and a texel of water between them.
        let widest_sponge = f64::from(scene.field.size[0].min(scene.field.size[1]).saturating_sub(1) / 2).clamp(1.0, 256.0);
        let changed = scene.wave != original.wave
            || scene.shallow_water != original.shallow_water
            || scene.shots != original.shots
            || scene.explosions != original.explosions
            || scene.gas != original.gas;
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
            if let (Some(water), Some(was)) = (&mut scene.shallow_water, &original.shallow_water) {
                water_rows(ui, water, was);
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
            if let (Some(explosions), Some(was)) = (&mut scene.explosions, &original.explosions) {
                let control =
                    Control::new("Charges", " /s", 0.0, 20.0).decimals(1).tip("Seeded charges that go off in the ground");
                value(ui, &control, &mut explosions.per_second, was.per_second);
                for (index, name) in ["Smallest charge", "Largest charge"].into_iter().enumerate() {
                    let control =
                        Control::new(name, " mm", 10.0, 1000.0).scale(1e3).decimals(0).tip("Radius of its crater's rim");
                    value(ui, &control, &mut explosions.radius_metres[index], was.radius_metres[index]);
                }
                explosions.radius_metres[1] = explosions.radius_metres[1].max(explosions.radius_metres[0]);
                let control = Control::new("Growth", " s", 0.0, 5.0).decimals(2).tip("From the flash to the crater's full size");
                value(ui, &control, &mut explosions.growth_seconds, was.growth_seconds);
                let control = Control::new("Reach", " radii", 0.0, 12.0).decimals(1).tip("How far the farthest clod flies");
                value(ui, &control, &mut explosions.reach, was.reach);
                let control = Control::new("Glow", " ×", 0.0, 50.0).decimals(1).tip("Radiance of what is hottest");
                value(ui, &control, &mut explosions.glow, was.glow);
            }
            if let (Some(gas), Some(was)) = (&mut scene.gas, &original.gas) {
                gas_rows(ui, gas, was);
            }
            let stamps = scene.shots.is_some() || scene.explosions.is_some() || !scene.tracks.is_empty();
            let still = scene.wave.is_none() && scene.shallow_water.is_none() && scene.gas.is_none() && !stamps;
            if still {
                ui.label(RichText::new("Nothing moves by itself in this scene.").weak());
            }
        });
        if reset {
            scene.wave = original.wave.clone();
            scene.shallow_water = original.shallow_water.clone();
            scene.shots = original.shots.clone();
            scene.explosions = original.explosions.clone();
            scene.gas = original.gas.clone();
        }
    }
}

fn water_rows(ui: &mut Ui, water: &mut ShallowWater, was: &ShallowWater) {
    let control = Control::new("Gravity", " m/s²", 0.1, 30.0).tip("What pulls the water down");
    value(ui, &control, &mut water.gravity_metres_per_second_squared, was.gravity_metres_per_second_squared);
    let tip = "Manning's n of the ground, s/m^⅓: 0.01 is glass, 0.03 gravel, 0.1 undergrowth";
    let control = Control::new("Roughness of the bed", "", 0.0, 0.2).decimals(3).tip(tip);
    value(ui, &control, &mut water.manning, was.manning);
    let control = Control::new("Water's rain", " mm/s", 0.0, 50.0).scale(1e3).decimals(2).tip("Water that falls everywhere");
    value(ui, &control, &mut water.rain_metres_per_second, was.rain_metres_per_second);
    let control =
        Control::new("Seepage", " mm/s", 0.0, 50.0).scale(1e3).decimals(2).tip("Water that the ground takes everywhere");
    value(ui, &control, &mut water.seepage_metres_per_second, was.seepage_metres_per_second);
    let control = Control::new("Foam", " /s", 0.0, 30.0).tip("Foam that breaking makes");
    value(ui, &control, &mut water.foam_per_second, was.foam_per_second);
    let control = Control::new("Life of foam", " s", 0.1, 20.0).tip("Until a third of it is left");
    value(ui, &control, &mut water.foam_seconds, was.foam_seconds);
    let control = Control::new("Sea level", "", 0.0, 1.0).tip("Height of the sea beyond its borders");
    value(ui, &control, &mut water.sea_level, was.sea_level);
    if let (Some(swell), Some(was)) = (&mut water.swell, &was.swell) {
        let control = Control::new("Swell", " m", 0.0, 2.0).decimals(3).tip("Height of its crests");
        value(ui, &control, &mut swell.amplitude_metres, was.amplitude_metres);
        let control = Control::new("Swell's period", " s", 0.2, 20.0).tip("From crest to crest");
        value(ui, &control, &mut swell.period_seconds, was.period_seconds);
    }
    if let (Some(drops), Some(was)) = (&mut water.drops, &was.drops) {
        let control = Control::new("Drops on water", " /s", 0.0, 500.0).decimals(0).tip("Mean number of rings a second");
        value(ui, &control, &mut drops.per_second, was.per_second);
    }
    let control = Control::new("Substeps at most", "", 1.0, f64::from(SUBSTEPS_MAX)).integer();
    let tip = "Of a step: beyond, the water falls behind the clock and says so";
    value(ui, &control.tip(tip), &mut water.substep_cap, was.substep_cap);
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
