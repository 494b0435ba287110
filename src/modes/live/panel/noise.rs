//! The panel's group of procedural heights and of series of images.

use egui::Ui;

use super::Panel;
use super::widgets::{Control, choice, group, value};
use crate::scene::{
    ColumnShape, Columns, Dunes, Fold, FractalNoise, Gears, LayerBlend, NoisePattern, OCTAVES_MAX, Playback, Scales,
};

impl Panel {
    pub(super) fn noise_group(&mut self, ui: &mut Ui) {
        let (scene, original) = (&mut self.scene, &self.original);
        let changed = scene.noise != original.noise;
        if let (Some(noise), Some(was)) = (&mut scene.noise, &original.noise) {
            let reset = group(ui, "Noise", true, Some(changed), |ui| {
                layer_rows(ui, (&mut noise.blend, was.blend), (&mut noise.amplitude, was.amplitude));
                match (&mut noise.pattern, &was.pattern) {
                    (NoisePattern::Fractal(fractal), NoisePattern::Fractal(was)) => fractal_rows(ui, fractal, was),
                    (NoisePattern::Columns(columns), NoisePattern::Columns(was)) => columns_rows(ui, columns, was),
                    (NoisePattern::Scales(scales), NoisePattern::Scales(was)) => scales_rows(ui, scales, was),
                    (NoisePattern::Gears(gears), NoisePattern::Gears(was)) => gears_rows(ui, gears, was),
                    (NoisePattern::Dunes(dunes), NoisePattern::Dunes(was)) => dunes_rows(ui, dunes, was),
                    // The pattern itself is the scene's: no control changes it.
                    _ => {}
                }
            });
            if reset {
                scene.noise = original.noise.clone();
            }
        }
    }

    pub(super) fn sequence_group(&mut self, ui: &mut Ui) {
        let (scene, original) = (&mut self.scene, &self.original);
        let changed = scene.sequence != original.sequence;
        if let (Some(sequence), Some(was)) = (&mut scene.sequence, &original.sequence) {
            let reset =
                group(ui, "Images", true, Some(changed), |ui| {
                    layer_rows(ui, (&mut sequence.blend, was.blend), (&mut sequence.amplitude, was.amplitude));
                    let control = Control::new("Images", " /s", 0.1, 120.0).logarithmic().tip("Images of the series a second");
                    value(ui, &control, &mut sequence.images_per_second, was.images_per_second);
                    const AFTER: &str = "What comes after the last image";
                    choice(ui, "After the last", AFTER, &mut sequence.playback, was.playback, Playback::ALL, |playback| {
                        match playback {
                            Playback::Loop => "The first again",
                            Playback::PingPong => "Backward",
                            Playback::Hold => "It stays",
                        }
                    });
                    ui.checkbox(&mut sequence.interpolate, "Fade").on_hover_text("Let images fade into one another");
                });
            if reset {
                scene.sequence = original.sequence.clone();
            }
        }
    }
}

fn layer_rows(ui: &mut Ui, (blend, blend_was): (&mut LayerBlend, LayerBlend), (amplitude, amplitude_was): (&mut f32, f32)) {
    const BLEND: &str = "How the layer's heights meet what lies beneath it";
    choice(ui, "Blend", BLEND, blend, blend_was, &LayerBlend::ALL, LayerBlend::label);
    let control =
        Control::new("Amplitude", " ×", -1.0, 1.0).tip("What the layer's heights are multiplied by, or how much they count");
    value(ui, &control, amplitude, amplitude_was);
}

fn fractal_rows(ui: &mut Ui, fractal: &mut FractalNoise, was: &FractalNoise) {
    const FOLD: &str = "What each octave is folded into";
    choice(ui, "Fold", FOLD, &mut fractal.fold, was.fold, Fold::ALL, |fold| match fold {
        Fold::Plain => "Hills",
        Fold::Billow => "Billows",
        Fold::Ridged => "Ridges",
    });
    let control =
        Control::new("Feature", " mm", 5.0, 2000.0).scale(1e3).decimals(0).logarithmic().tip("Size of the largest features");
    value(ui, &control, &mut fractal.feature_metres, was.feature_metres);
    let control = Control::new("Octaves", "", 1.0, OCTAVES_MAX.into()).integer().tip("How many sizes of features there are");
    value(ui, &control, &mut fractal.octaves, was.octaves);
    let control = Control::new("Lacunarity", " ×", 1.0, 4.0).tip("How much finer each octave is than the one before");
    value(ui, &control, &mut fractal.lacunarity, was.lacunarity);
    let control = Control::new("Gain", " ×", 0.0, 1.0).tip("How much lower each octave is than the one before");
    value(ui, &control, &mut fractal.gain, was.gain);
    let control = Control::new("Contrast", " ×", 0.0, 4.0).tip("How far heights spread; beyond 0 and 1 they are cut off");
    value(ui, &control, &mut fractal.contrast, was.contrast);
    let control = Control::new("Evolution", " /s", 0.0, 4.0).tip("How fast the features change");
    value(ui, &control, &mut fractal.evolution_per_second, was.evolution_per_second);
    for (index, name) in ["Drift along u", "Drift along v"].into_iter().enumerate() {
        let control = Control::new(name, " mm/s", -500.0, 500.0).scale(1e3).decimals(0).tip("How fast the whole travels");
        value(ui, &control, &mut fractal.drift_metres_per_second[index], was.drift_metres_per_second[index]);
    }
}

fn columns_rows(ui: &mut Ui, columns: &mut Columns, was: &Columns) {
    const SHAPE: &str = "The outline of a column";
    choice(ui, "Outline", SHAPE, &mut columns.shape, was.shape, ColumnShape::ALL, |shape| match shape {
        ColumnShape::Squares => "Four sides",
        ColumnShape::Hexagons => "Six sides",
    });
    let control = Control::new("Pitch", " mm", 10.0, 500.0).scale(1e3).decimals(1).logarithmic().tip("From axis to axis");
    value(ui, &control, &mut columns.pitch_metres, was.pitch_metres);
    let control = Control::new("Gap", " mm", 0.0, 50.0).scale(1e3).decimals(1).tip("Width of the gap between columns");
    value(ui, &control, &mut columns.gap_metres, was.gap_metres);
    let control = Control::new("Edge", " mm", 0.0, 50.0).scale(1e3).decimals(1).tip("Width of their rounded edges");
    value(ui, &control, &mut columns.edge_metres, was.edge_metres);
    let control = Control::new("Lowest top", "", 0.0, 1.0).tip("Height to which a column sinks");
    value(ui, &control, &mut columns.low, was.low);
    let control = Control::new("Highest top", "", 0.0, 1.0).tip("Height to which a column rises");
    value(ui, &control, &mut columns.high, was.high);
    pulse_rows(
        ui,
        (&mut columns.period_seconds, was.period_seconds),
        (&mut columns.waves, was.waves),
        (&mut columns.disorder, was.disorder),
    );
}

fn scales_rows(ui: &mut Ui, scales: &mut Scales, was: &Scales) {
    let control = Control::new("Pitch", " mm", 10.0, 500.0).scale(1e3).decimals(1).logarithmic().tip("From scale to scale");
    value(ui, &control, &mut scales.pitch_metres, was.pitch_metres);
    let control = Control::new("Edge", " mm", 0.0, 50.0).scale(1e3).decimals(1).tip("Width of their rounded edges");
    value(ui, &control, &mut scales.edge_metres, was.edge_metres);
    let control = Control::new("Lift", "", 0.0, 1.0).tip("How much of their height they lose and regain");
    value(ui, &control, &mut scales.lift, was.lift);
    let control = Control::new("Keel", "", 0.0, 1.0).tip("How much the ridge along their middle stands out");
    value(ui, &control, &mut scales.keel, was.keel);
    pulse_rows(
        ui,
        (&mut scales.period_seconds, was.period_seconds),
        (&mut scales.waves, was.waves),
        (&mut scales.disorder, was.disorder),
    );
}

/// Rows of what rises and sinks in waves.
fn pulse_rows(
    ui: &mut Ui,
    (period, period_was): (&mut f32, f32),
    (waves, waves_was): (&mut [i32; 2], [i32; 2]),
    (disorder, disorder_was): (&mut f32, f32),
) {
    let control = Control::new("Period", " s", 0.2, 60.0).logarithmic().tip("Time from one rise to the next");
    value(ui, &control, period, period_was);
    for (index, name) in ["Waves along u", "Waves along v"].into_iter().enumerate() {
        let control = Control::new(name, "", -8.0, 8.0).integer().tip("Waves across the field, in step with which they rise");
        value(ui, &control, &mut waves[index], waves_was[index]);
    }
    let control = Control::new("Disorder", "", 0.0, 1.0).tip("0: in step with the waves; 1: each quite its own");
    value(ui, &control, disorder, disorder_was);
}

fn gears_rows(ui: &mut Ui, gears: &mut Gears, was: &Gears) {
    let control = Control::new("Speed", " turns/s", -2.0, 2.0).tip("Turns of the first wheel");
    value(ui, &control, &mut gears.turns_per_second, was.turns_per_second);
    let control =
        Control::new("Module", " mm", 5.0, 100.0).scale(1e3).decimals(1).tip("Diameter of a wheel for each of its teeth");
    value(ui, &control, &mut gears.module_metres, was.module_metres);
    let control = Control::new("Height", "", 0.0, 1.0).tip("Height of the teeth");
    value(ui, &control, &mut gears.top, was.top);
    let control = Control::new("Edge", " mm", 0.0, 50.0).scale(1e3).decimals(1).tip("Width of the rounded edges");
    value(ui, &control, &mut gears.edge_metres, was.edge_metres);
}

fn dunes_rows(ui: &mut Ui, dunes: &mut Dunes, was: &Dunes) {
    let control = Control::new("Wavelength", " mm", 50.0, 5000.0).scale(1e3).decimals(0).logarithmic().tip("From crest to crest");
    value(ui, &control, &mut dunes.wavelength_metres, was.wavelength_metres);
    let control = Control::new("Wind", "°", -180.0, 180.0).decimals(0).tip("Where it blows to, from u toward v");
    value(ui, &control, &mut dunes.wind_degrees, was.wind_degrees);
    let control = Control::new("Dune speed", " mm/s", -200.0, 200.0).scale(1e3).decimals(1).tip("How fast dunes travel");
    value(ui, &control, &mut dunes.speed_metres_per_second, was.speed_metres_per_second);
    let control = Control::new("Crest", "", 0.05, 0.95).tip("How much of a dune lies before its crest");
    value(ui, &control, &mut dunes.crest, was.crest);
    let control = Control::new("Meander", " ×", 0.0, 2.0).tip("How far crests wander, in wavelengths");
    value(ui, &control, &mut dunes.meander, was.meander);
    let control = Control::new("Variety", "", 0.0, 1.0).tip("How much lower than the highest the lowest are");
    value(ui, &control, &mut dunes.variety, was.variety);
    let control = Control::new("Ripples", " mm", 5.0, 500.0).scale(1e3).decimals(1).logarithmic().tip("From ripple to ripple");
    value(ui, &control, &mut dunes.ripple_metres, was.ripple_metres);
    let control = Control::new("Ripple speed", " mm/s", -200.0, 200.0).scale(1e3).decimals(1).tip("How fast ripples travel");
    value(ui, &control, &mut dunes.ripple_speed_metres_per_second, was.ripple_speed_metres_per_second);
    let control = Control::new("Ripple height", "", 0.0, 0.5).decimals(3).tip("Height of the ripples, of the whole");
    value(ui, &control, &mut dunes.ripple_height, was.ripple_height);
}
