//! The panel's rows of a gas.

use egui::Ui;

use super::widgets::{Control, value};
use crate::scene::{Gas, GasBands, GasEmitters};

/// The rows of a gas; `was` is the one that every reset leads to.
pub(super) fn gas_rows(ui: &mut Ui, gas: &mut Gas, was: &Gas) {
    let control = Control::new("Gas amplitude", "", 0.0, 1.0).tip("Height that a density of 1 adds, of the depth");
    value(ui, &control, &mut gas.amplitude, was.amplitude);
    let most = (0.5 / f64::from(gas.step_seconds)).min(10.0);
    let control = Control::new("Confinement", " /s", 0.0, most).tip("Holds vortices together against what the grid loses");
    value(ui, &control, &mut gas.confinement_per_second, was.confinement_per_second);
    let control = Control::new("Buoyancy", " m/s²", -2.0, 2.0).tip("How fast dense gas rises up the image");
    value(ui, &control, &mut gas.buoyancy, was.buoyancy);
    let control = Control::new("Beta", " /(m·s)", -20.0, 20.0).decimals(1).tip("How fast the planet's turning grows along v");
    value(ui, &control, &mut gas.beta, was.beta);
    if let Some(bands) = &mut gas.bands {
        band_rows(ui, bands, &was.bands.clone().unwrap_or_default());
    }
    let emitters_were = was.emitters.clone().unwrap_or_default();
    let mut emits = gas.emitters.is_some();
    if ui.checkbox(&mut emits, "Emitters").on_hover_text("Seeded particles that emit gas and velocity").changed() {
        gas.emitters = emits.then(|| emitters_were.clone());
    }
    if let Some(emitters) = &mut gas.emitters {
        emitter_rows(ui, emitters, &emitters_were);
    }
}

fn band_rows(ui: &mut Ui, bands: &mut GasBands, was: &GasBands) {
    let control = Control::new("Wind", " mm/s", 0.0, 1000.0).scale(1e3).decimals(0).tip("Speed of the fastest band");
    value(ui, &control, &mut bands.wind_metres_per_second, was.wind_metres_per_second);
    let control = Control::new("Wind pull", " /s", 0.0, 1.0).decimals(3).tip("How fast the gas returns to its row's wind");
    value(ui, &control, &mut bands.wind_pull_per_second, was.wind_pull_per_second);
    let control = Control::new("Gas pull", " /s", 0.0, 1.0).decimals(3).tip("How fast it returns to its row's colour");
    value(ui, &control, &mut bands.gas_pull_per_second, was.gas_pull_per_second);
}

fn emitter_rows(ui: &mut Ui, emitters: &mut GasEmitters, was: &GasEmitters) {
    let control = Control::new("Births", " /s", 0.0, 50.0).decimals(1).tip("Particles born a second");
    value(ui, &control, &mut emitters.per_second, was.per_second);
    let control = Control::new("Lifetime", " s", 0.1, 60.0).logarithmic().tip("How long one lives");
    value(ui, &control, &mut emitters.lifetime_seconds, was.lifetime_seconds);
    let control = Control::new("Emitter radius", " mm", 5.0, 300.0).scale(1e3).decimals(0).tip("Radius of the largest");
    value(ui, &control, &mut emitters.radius_metres, was.radius_metres);
    let control = Control::new("Emitted density", " /s", -5.0, 5.0).tip("What one adds at its middle");
    value(ui, &control, &mut emitters.density_per_second, was.density_per_second);
    let control = Control::new("Emitted velocity", " m/s²", 0.0, 2.0).tip("What one adds at its middle");
    value(ui, &control, &mut emitters.push, was.push);
    let control = Control::new("Emitted spin", " /s²", -20.0, 20.0).decimals(1).tip("Rotation that one adds");
    value(ui, &control, &mut emitters.spin, was.spin);
}
