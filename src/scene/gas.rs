//! A gas over the base: its settings, and what they may be.

use serde::{Deserialize, Serialize};

use super::validate::{Range, cell_metres, number, refuse};
use super::{Addressing, LayerBlend, Scene, SceneError};

/// An incompressible fluid in two dimensions, whose density is its height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Gas {
    /// How it meets what lies beneath it.
    pub blend: LayerBlend,
    /// Height that a density of 1 adds.
    pub amplitude: f32,
    /// Texels of the field that a cell of the gas covers along each axis: 2 makes a step four times cheaper.
    pub coarsening: u32,
    /// Its time step, seconds.
    pub step_seconds: f32,
    /// What it meets at the borders along u.
    pub border_u: GasBorder,
    /// What it meets at the borders along v.
    pub border_v: GasBorder,
    /// Kinematic viscosity ν, m²/s.
    pub viscosity: f32,
    /// How strongly vortices are held together against what the grid loses, 1/s.
    pub confinement_per_second: f32,
    /// Acceleration against v, up the image, of gas whose density is 1 above what is at rest in its row, m/s².
    pub buoyancy: f32,
    /// How fast the planet's turning, 0 in the middle row, grows along v, 1/(m·s).
    pub beta: f32,
    /// Bands of wind and colour along u, if any: what the gas starts from, and slowly returns to.
    pub bands: Option<GasBands>,
    /// Particles that emit gas, if any.
    pub emitters: Option<GasEmitters>,
}

/// What a gas meets at a border.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GasBorder {
    /// The opposite border.
    Periodic,
    /// A wall that it slides along.
    Closed,
}

/// Winds that blow along u, east and west by turns, and the gas between them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GasBands {
    /// Pairs of a bright and a dark band.
    pub pairs: u32,
    /// Speed of the fastest wind, m/s.
    pub wind_metres_per_second: f32,
    /// How fast the gas returns to its row's wind, 1/s.
    pub wind_pull_per_second: f32,
    /// How fast it returns to its row's density and dye, 1/s.
    pub gas_pull_per_second: f32,
    /// How far the start strays from straight bands, in widths of a band.
    pub waviness: f32,
    /// Speed of the eddies that it starts with, m/s.
    pub eddies_metres_per_second: f32,
    /// Vortices that it starts with.
    pub storms: u32,
    /// Radius of the largest of them along u, metres.
    pub storm_radius_metres: f32,
    /// Part of the height of the field, at either border along v, over which the wind dies away.
    pub calm_border: f32,
}

/// Seeded particles that drift with the wind and emit density, dye and velocity while they live (\[POM slides\], gas planet).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GasEmitters {
    /// Particles that are born a second.
    pub per_second: f32,
    /// How long one lives, seconds.
    pub lifetime_seconds: f32,
    /// Radius of the largest, metres.
    pub radius_metres: f32,
    /// Density that one adds at its middle, 1/s.
    pub density_per_second: f32,
    /// Velocity that one adds at its middle, m/s².
    pub push: f32,
    /// Rotation that one adds, 1/s².
    pub spin: f32,
}

impl Default for Gas {
    fn default() -> Self {
        Self {
            blend: LayerBlend::Add,
            amplitude: 0.25,
            coarsening: 1,
            step_seconds: 1.0 / 30.0,
            border_u: GasBorder::Periodic,
            border_v: GasBorder::Closed,
            viscosity: 0.0,
            confinement_per_second: 0.3,
            buoyancy: 0.0,
            beta: 0.0,
            bands: None,
            emitters: None,
        }
    }
}

impl Default for GasBands {
    fn default() -> Self {
        Self {
            pairs: 6,
            wind_metres_per_second: 0.1,
            wind_pull_per_second: 0.015,
            gas_pull_per_second: 0.02,
            waviness: 0.5,
            eddies_metres_per_second: 0.05,
            storms: 12,
            storm_radius_metres: 0.16,
            calm_border: 0.08,
        }
    }
}

impl Default for GasEmitters {
    fn default() -> Self {
        Self { per_second: 3.0, lifetime_seconds: 6.0, radius_metres: 0.05, density_per_second: 0.5, push: 0.1, spin: 1.0 }
    }
}

/// Cells that a gas needs along each axis: less has no room to flow.
pub const GAS_CELLS_MIN: u32 = 4;

/// ν·dt/dx² up to which viscosity is stable; explicit diffusion in two dimensions grows beyond ¼.
pub const GAS_VISCOSITY_MAX: f64 = 0.2;

/// Particles that may live at a time: each is dealt out to its tiles in every step, on the CPU.
pub const GAS_PARTICLES_MAX: f64 = 4096.0;

impl Gas {
    /// Cells along each axis of a field of this size.
    pub fn cells(&self, field: [u32; 2]) -> [u32; 2] {
        field.map(|side| side / self.coarsening.max(1))
    }

    /// Side of a cell, metres, where a texel has this one.
    pub fn cell_metres(&self, texel_metres: f64) -> f64 {
        texel_metres * f64::from(self.coarsening)
    }
}

/// Checks the gas of a scene.
pub(super) fn validate(gas: &Gas, scene: &Scene) -> Result<(), SceneError> {
    number("gas.amplitude", gas.amplitude, Range::from_to(0.0, 1.0, ""))?;
    number("gas.coarsening", gas.coarsening, Range::from_to(1.0, 8.0, "texels"))?;
    number("gas.step_seconds", gas.step_seconds, Range::from_to(1e-4, 0.1, "seconds"))?;
    let [width, height] = scene.field.size;
    if [width, height].iter().any(|side| !side.is_multiple_of(gas.coarsening)) {
        let allowed = format!("a divisor of both sides of the field, {width}×{height}: choose another, or another --field");
        return refuse("gas.coarsening", gas.coarsening, allowed);
    }
    let cells = gas.cells(scene.field.size);
    if cells.iter().any(|&side| side < GAS_CELLS_MIN) {
        let allowed =
            format!("at least {} texels along each side, {GAS_CELLS_MIN} cells of `gas`", GAS_CELLS_MIN * gas.coarsening);
        return refuse("field.size", format!("[{width}, {height}]"), allowed);
    }
    for (key, border) in [("gas.border_u", gas.border_u), ("gas.border_v", gas.border_v)] {
        if border == GasBorder::Periodic && scene.field.addressing == Addressing::Clamp {
            return refuse(key, "periodic", "`closed` where `field.addressing` is `clamp`: the field does not repeat");
        }
    }
    let (step, cell) = (f64::from(gas.step_seconds), gas.cell_metres(scene.texel_metres()));
    cell_metres("gas", cell, scene.plane.width_metres)?;
    number("gas.viscosity", gas.viscosity, Range::from_to(0.0, 1e6, "m²/s"))?;
    let share = f64::from(gas.viscosity) * step / (cell * cell);
    if share > GAS_VISCOSITY_MAX {
        let most = GAS_VISCOSITY_MAX * cell * cell / step;
        let allowed =
            format!("at most {most:.3e} m²/s with steps of {step:.4} s and cells of {cell:.3e} m, beyond which it is unstable");
        return refuse("gas.viscosity", gas.viscosity, allowed);
    }
    // A push of half of the vorticity a step.
    number("gas.confinement_per_second", gas.confinement_per_second, Range::from_to(0.0, 0.5 / step, "per second"))?;
    number("gas.buoyancy", gas.buoyancy, Range::from_to(-1000.0, 1000.0, "m/s²"))?;
    number("gas.beta", gas.beta, Range::from_to(-1e4, 1e4, "per metre and second"))?;
    gas.bands.as_ref().map_or(Ok(()), |bands| validate_bands(bands, gas))?;
    gas.emitters.as_ref().map_or(Ok(()), validate_emitters)
}

fn validate_bands(bands: &GasBands, gas: &Gas) -> Result<(), SceneError> {
    if gas.border_v == GasBorder::Periodic {
        return refuse("gas.border_v", "periodic", "`closed` with `gas.bands`: the last band does not meet the first");
    }
    number("gas.bands.pairs", bands.pairs, Range::from_to(1.0, 64.0, "pairs"))?;
    number("gas.bands.wind_metres_per_second", bands.wind_metres_per_second, Range::from_to(0.0, 1e4, "m/s"))?;
    // A step may not go farther than all the way.
    let rate = Range::from_to(0.0, 10.0, "per second");
    number("gas.bands.wind_pull_per_second", bands.wind_pull_per_second, rate)?;
    number("gas.bands.gas_pull_per_second", bands.gas_pull_per_second, rate)?;
    number("gas.bands.waviness", bands.waviness, Range::from_to(0.0, 4.0, "widths of a band"))?;
    number("gas.bands.eddies_metres_per_second", bands.eddies_metres_per_second, Range::from_to(0.0, 1e4, "m/s"))?;
    number("gas.bands.storms", bands.storms, Range::from_to(1.0, 256.0, "storms"))?;
    number("gas.bands.storm_radius_metres", bands.storm_radius_metres, Range::above(0.0, 1e6, "metres"))?;
    number("gas.bands.calm_border", bands.calm_border, Range::from_to(0.0, 0.5, "of the height"))
}

fn validate_emitters(emitters: &GasEmitters) -> Result<(), SceneError> {
    number("gas.emitters.per_second", emitters.per_second, Range::from_to(0.0, 1000.0, "per second"))?;
    number("gas.emitters.lifetime_seconds", emitters.lifetime_seconds, Range::above(0.0, 1000.0, "seconds"))?;
    let alive = f64::from(emitters.per_second) * f64::from(emitters.lifetime_seconds);
    if alive > GAS_PARTICLES_MAX {
        let allowed = format!(
            "shorter: {} particles a second would be {alive:.0} at a time, and {GAS_PARTICLES_MAX} are the most",
            emitters.per_second
        );
        return refuse("gas.emitters.lifetime_seconds", emitters.lifetime_seconds, allowed);
    }
    number("gas.emitters.radius_metres", emitters.radius_metres, Range::above(0.0, 1e6, "metres"))?;
    number("gas.emitters.density_per_second", emitters.density_per_second, Range::from_to(-1000.0, 1000.0, "per second"))?;
    number("gas.emitters.push", emitters.push, Range::from_to(0.0, 1e4, "m/s²"))?;
    number("gas.emitters.spin", emitters.spin, Range::from_to(-1e4, 1e4, "per second squared"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(change: impl FnOnce(&mut Scene, &mut Gas)) -> Result<(), String> {
        let mut scene = Scene::default();
        scene.field.addressing = Addressing::Wrap;
        let mut gas = Gas { bands: Some(GasBands::default()), ..Gas::default() };
        change(&mut scene, &mut gas);
        scene.gas = Some(gas);
        scene.validate().map_err(|error| error.to_string())
    }

    #[test]
    fn what_contradicts_itself_is_refused_in_a_sentence() {
        assert_eq!(scene(|_, _| ()), Ok(()));
        let refused = |change: fn(&mut Scene, &mut Gas), says: &str| {
            let error = scene(change).expect_err(says);
            assert!(error.contains(says), "{error}");
        };
        refused(|scene, _| scene.field.addressing = Addressing::Clamp, "`gas.border_u` is periodic: it must be `closed` where");
        refused(|_, gas| gas.border_v = GasBorder::Periodic, "`gas.border_v` is periodic: it must be `closed` with `gas.bands`");
        refused(|scene, gas| (scene.field.size, gas.coarsening) = ([510, 512], 4), "a divisor of both sides of the field");
        refused(|scene, _| scene.field.size = [512, 3], "at least 4 texels along each side");
        refused(|_, gas| gas.viscosity = 1.0, "beyond which it is unstable");
        refused(|_, gas| gas.confinement_per_second = 20.0, "gas.confinement_per_second");
        refused(|scene, _| scene.plane.width_metres = 1e-6, "with `gas` a cell, here 1.953e-9 metres wide, must be");
        refused(
            |_, gas| gas.emitters = Some(GasEmitters { per_second: 1000.0, lifetime_seconds: 5.0, ..GasEmitters::default() }),
            "1000 particles a second would be 5000 at a time, and 4096 are the most",
        );
    }
}
