//! Procedural heights: fractal noise and objects that move by a closed form of time.

use serde::{Deserialize, Serialize};

use super::validate::{Range, number, numbers, refuse};
use super::{LayerBlend, SceneError, exactly};

/// Procedural heights over what lies beneath.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Noise {
    /// How its heights, 0 to 1, meet what lies beneath.
    pub blend: LayerBlend,
    /// What its heights are multiplied by, or how much they count.
    pub amplitude: f32,
    /// What it is made of.
    pub pattern: NoisePattern,
}

/// What procedural heights are made of. Each is a function of place, seed and time: no frame needs the one before it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, tag = "kind", rename_all = "kebab-case")]
pub enum NoisePattern {
    /// Octaves of gradient noise that drift and change.
    Fractal(FractalNoise),
    /// Pillars that rise and sink.
    Columns(Columns),
    /// Overlapping scales that ripple.
    Scales(Scales),
    /// Wheels with teeth that mesh.
    Gears(Gears),
    /// Dunes that travel before the wind.
    Dunes(Dunes),
}

impl NoisePattern {
    /// Its name in scenes and in the panel.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Fractal(_) => "fractal",
            Self::Columns(_) => "columns",
            Self::Scales(_) => "scales",
            Self::Gears(_) => "gears",
            Self::Dunes(_) => "dunes",
        }
    }
}

/// Octaves of gradient noise, each finer and lower than the one before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FractalNoise {
    /// What an octave is folded into.
    pub fold: Fold,
    /// Distance from cell to cell of the first octave's lattice, metres. Where the field wraps, the nearest that fits it a whole
    /// number of times.
    pub feature_metres: f32,
    /// How many octaves.
    pub octaves: u32,
    /// How much finer each octave is than the one before.
    pub lacunarity: f32,
    /// How much lower each octave is than the one before.
    pub gain: f32,
    /// What the sum is multiplied by about its middle (`plain`) or from zero; beyond 0 and 1 it is cut off.
    pub contrast: f32,
    /// Lattice cells of time a second that the first octave passes through; finer ones pass through more, by their fineness to
    /// the power of ⅔, as eddies do.
    pub evolution_per_second: f32,
    /// How fast it travels along u and v, metres a second.
    #[serde(deserialize_with = "exactly")]
    pub drift_metres_per_second: [f32; 2],
}

/// What an octave of noise n, −1 to 1, is folded into.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum Fold {
    /// n: rolling hills (fBm).
    Plain = 0,
    /// |n|: round lumps between sharp creases.
    Billow = 1,
    /// (1 − |n|)², each octave the rougher the higher the one before it: sharp ridges (Musgrave).
    Ridged = 2,
}

impl Fold {
    /// Every fold.
    pub const ALL: &[Self] = &[Self::Plain, Self::Billow, Self::Ridged];
}

/// Pillars side by side, each with a phase of its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Columns {
    /// Their outline.
    pub shape: ColumnShape,
    /// From axis to axis along u, metres. Where the field wraps, the nearest that fits it.
    pub pitch_metres: f32,
    /// Width of the gap between them, metres.
    pub gap_metres: f32,
    /// Width of their rounded edges, metres.
    pub edge_metres: f32,
    /// Heights between which their tops move, and the height of the ground in the gaps.
    pub low: f32,
    /// See [`Columns::low`].
    pub high: f32,
    /// Height of the ground in the gaps.
    pub ground: f32,
    /// Time from one rise to the next, seconds.
    pub period_seconds: f32,
    /// Waves across the field along u and v, in step with which they rise.
    #[serde(deserialize_with = "exactly")]
    pub waves: [i32; 2],
    /// How much of its phase each has by chance: 0 in step with the waves, 1 quite its own.
    pub disorder: f32,
}

/// The outline of a pillar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum ColumnShape {
    /// Four sides.
    Squares = 0,
    /// Six sides, as basalt has them.
    Hexagons = 1,
}

impl ColumnShape {
    /// Every shape.
    pub const ALL: &[Self] = &[Self::Squares, Self::Hexagons];
}

/// Scales in rows, each lying over the roots of the row below it (toward larger v).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Scales {
    /// From scale to scale along u, metres; rows are half as far apart. Where the field wraps, the nearest that fits it.
    pub pitch_metres: f32,
    /// Width of their rounded edges, metres.
    pub edge_metres: f32,
    /// How much of their height they lose and regain as they ripple, 0 to 1.
    pub lift: f32,
    /// How much the ridge along their middle stands out, 0 to 1.
    pub keel: f32,
    /// Time from one lift to the next, seconds.
    pub period_seconds: f32,
    /// Waves across the field along u and v, in step with which they lift.
    #[serde(deserialize_with = "exactly")]
    pub waves: [i32; 2],
    /// How much of its phase each has by chance.
    pub disorder: f32,
}

/// A train of spoked wheels: the first turns, and drives the second, which drives the third.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Gears {
    /// Centre of the first wheel, uv.
    #[serde(deserialize_with = "exactly")]
    pub centre: [f32; 2],
    /// Diameter of a wheel's pitch circle for each of its teeth (the module of mechanics), metres.
    pub module_metres: f32,
    /// Turns of the first wheel a second, from u toward v.
    pub turns_per_second: f32,
    /// Height of their teeth.
    pub top: f32,
    /// Width of their rounded edges, metres.
    pub edge_metres: f32,
    /// The wheels.
    pub train: Vec<Gear>,
}

/// One wheel of a train.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gear {
    /// How many teeth it has.
    pub teeth: u32,
    /// How many spokes it has.
    #[serde(default = "five")]
    pub spokes: u32,
    /// Where it stands, seen from the wheel that drives it, degrees from u toward v. Of no account to the first.
    #[serde(default)]
    pub toward_degrees: f32,
}

/// Dunes across the wind, and ripples upon their backs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Dunes {
    /// From crest to crest, metres. Where the field wraps, crests turn and move so as to fit it.
    pub wavelength_metres: f32,
    /// Where the wind blows to, degrees from u toward v.
    pub wind_degrees: f32,
    /// How fast they travel, metres a second.
    pub speed_metres_per_second: f32,
    /// How much of a dune lies before its crest, where the wind drives the sand up; the rest is the steep side behind it.
    pub crest: f32,
    /// How far crests wander, wavelengths.
    pub meander: f32,
    /// How much lower than the highest the lowest are, 0 to 1.
    pub variety: f32,
    /// From ripple to ripple, metres.
    pub ripple_metres: f32,
    /// How fast ripples travel, metres a second.
    pub ripple_speed_metres_per_second: f32,
    /// Height of the ripples, of the whole.
    pub ripple_height: f32,
}

/// The most octaves: the twelfth is 2,048 times as fine as the first.
pub const OCTAVES_MAX: u32 = 12;

/// The most wheels of a train.
pub const GEARS_MAX: usize = 12;

fn five() -> u32 {
    5
}

impl Default for Noise {
    fn default() -> Self {
        Self { blend: LayerBlend::Add, amplitude: 1.0, pattern: NoisePattern::Fractal(FractalNoise::default()) }
    }
}

impl Default for FractalNoise {
    fn default() -> Self {
        Self {
            fold: Fold::Plain,
            feature_metres: 0.25,
            octaves: 5,
            lacunarity: 2.0,
            gain: 0.5,
            contrast: 1.5,
            evolution_per_second: 0.25,
            drift_metres_per_second: [0.0, 0.0],
        }
    }
}

impl Default for Columns {
    fn default() -> Self {
        Self {
            shape: ColumnShape::Hexagons,
            pitch_metres: 0.08,
            gap_metres: 0.003,
            edge_metres: 0.008,
            low: 0.25,
            high: 1.0,
            ground: 0.0,
            period_seconds: 4.0,
            waves: [1, 1],
            disorder: 0.5,
        }
    }
}

impl Default for Scales {
    fn default() -> Self {
        Self { pitch_metres: 0.1, edge_metres: 0.01, lift: 0.5, keel: 0.5, period_seconds: 3.0, waves: [0, 2], disorder: 0.1 }
    }
}

impl Default for Gears {
    fn default() -> Self {
        Self {
            centre: [0.36, 0.42],
            module_metres: 0.02,
            turns_per_second: 0.125,
            top: 1.0,
            edge_metres: 0.006,
            train: vec![Gear { teeth: 24, spokes: 5, toward_degrees: 0.0 }, Gear { teeth: 16, spokes: 4, toward_degrees: 20.0 }],
        }
    }
}

impl Default for Dunes {
    fn default() -> Self {
        Self {
            wavelength_metres: 0.5,
            wind_degrees: 0.0,
            speed_metres_per_second: 0.02,
            crest: 0.7,
            meander: 0.35,
            variety: 0.5,
            ripple_metres: 0.025,
            ripple_speed_metres_per_second: 0.01,
            ripple_height: 0.03,
        }
    }
}

const METRES: Range = Range::above(0.0, 1e6, "metres");
const EDGE_METRES: Range = Range::from_to(0.0, 1e6, "metres");
const SHARE: Range = Range::from_to(0.0, 1.0, "");
const METRES_PER_SECOND: Range = Range::from_to(-1e4, 1e4, "metres per second");
const PERIOD: Range = Range::above(0.0, 1e6, "seconds");
const WAVES: Range = Range::from_to(-256.0, 256.0, "waves");

pub(super) fn validate(noise: &Noise) -> Result<(), SceneError> {
    number("noise.amplitude", noise.amplitude, Range::from_to(-100.0, 100.0, ""))?;
    let key = |name: &str| format!("noise.pattern.{name}");
    match &noise.pattern {
        NoisePattern::Fractal(fractal) => {
            number(key("feature_metres"), fractal.feature_metres, METRES)?;
            number(key("octaves"), fractal.octaves, Range::from_to(1.0, OCTAVES_MAX.into(), "octaves"))?;
            number(key("lacunarity"), fractal.lacunarity, Range::from_to(1.0, 4.0, ""))?;
            number(key("gain"), fractal.gain, SHARE)?;
            number(key("contrast"), fractal.contrast, Range::from_to(0.0, 100.0, ""))?;
            number(key("evolution_per_second"), fractal.evolution_per_second, Range::from_to(-100.0, 100.0, "per second"))?;
            numbers(&key("drift_metres_per_second"), &fractal.drift_metres_per_second, METRES_PER_SECOND)
        }
        NoisePattern::Columns(columns) => {
            number(key("pitch_metres"), columns.pitch_metres, METRES)?;
            number(key("gap_metres"), columns.gap_metres, EDGE_METRES)?;
            number(key("edge_metres"), columns.edge_metres, EDGE_METRES)?;
            number(key("low"), columns.low, SHARE)?;
            number(key("high"), columns.high, SHARE)?;
            number(key("ground"), columns.ground, SHARE)?;
            number(key("period_seconds"), columns.period_seconds, PERIOD)?;
            numbers(&key("waves"), &columns.waves, WAVES)?;
            number(key("disorder"), columns.disorder, SHARE)
        }
        NoisePattern::Scales(scales) => {
            number(key("pitch_metres"), scales.pitch_metres, METRES)?;
            number(key("edge_metres"), scales.edge_metres, EDGE_METRES)?;
            number(key("lift"), scales.lift, SHARE)?;
            number(key("keel"), scales.keel, SHARE)?;
            number(key("period_seconds"), scales.period_seconds, PERIOD)?;
            numbers(&key("waves"), &scales.waves, WAVES)?;
            number(key("disorder"), scales.disorder, SHARE)
        }
        NoisePattern::Gears(gears) => {
            numbers(&key("centre"), &gears.centre, Range::from_to(-1.0, 2.0, ""))?;
            number(key("module_metres"), gears.module_metres, METRES)?;
            number(key("turns_per_second"), gears.turns_per_second, Range::from_to(-100.0, 100.0, "per second"))?;
            number(key("top"), gears.top, SHARE)?;
            number(key("edge_metres"), gears.edge_metres, EDGE_METRES)?;
            if !(1..=GEARS_MAX).contains(&gears.train.len()) {
                let count = format!("a list of {}", gears.train.len());
                return refuse(key("train"), count, format!("a list of 1 to {GEARS_MAX} wheels"));
            }
            for (i, gear) in gears.train.iter().enumerate() {
                let key = |name: &str| key(&format!("train[{i}].{name}"));
                // With fewer teeth their roots cut into the hub.
                number(key("teeth"), gear.teeth, Range::from_to(8.0, 512.0, "teeth"))?;
                number(key("spokes"), gear.spokes, Range::from_to(1.0, 32.0, "spokes"))?;
                number(key("toward_degrees"), gear.toward_degrees, Range::from_to(-3600.0, 3600.0, "degrees"))?;
            }
            Ok(())
        }
        NoisePattern::Dunes(dunes) => {
            number(key("wavelength_metres"), dunes.wavelength_metres, METRES)?;
            number(key("wind_degrees"), dunes.wind_degrees, Range::from_to(-3600.0, 3600.0, "degrees"))?;
            number(key("speed_metres_per_second"), dunes.speed_metres_per_second, METRES_PER_SECOND)?;
            number(key("crest"), dunes.crest, Range::from_to(0.05, 0.95, ""))?;
            number(key("meander"), dunes.meander, Range::from_to(0.0, 4.0, "wavelengths"))?;
            number(key("variety"), dunes.variety, SHARE)?;
            number(key("ripple_metres"), dunes.ripple_metres, METRES)?;
            number(key("ripple_speed_metres_per_second"), dunes.ripple_speed_metres_per_second, METRES_PER_SECOND)?;
            number(key("ripple_height"), dunes.ripple_height, SHARE)
        }
    }
}
