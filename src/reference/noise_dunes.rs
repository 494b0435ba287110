//! Dunes that travel. Specification of `shaders/field/noise_dunes.wgsl`.

use super::noise::{Ground, cells_across, gradient_noise};
use crate::field::noise::hash;
use crate::scene::Dunes;

/// How much the two sides of a dune differ where its rounded crest begins.
const BRINK: f64 = 0.12;

/// The height at a place in metres.
pub fn height(dunes: &Dunes, ground: &Ground, time_seconds: f64, at: [f64; 2]) -> f64 {
    let wind = f64::from(dunes.wind_degrees).to_radians();
    let wind = [wind.cos(), wind.sin()];
    // What travels is the place that one looks at, the other way.
    let behind = |speed: f32| [0, 1].map(|axis| at[axis] - time_seconds * f64::from(speed) * wind[axis]);
    let (ridden, rippled) = (behind(dunes.speed_metres_per_second), behind(dunes.ripple_speed_metres_per_second));
    let wavelength = f64::from(dunes.wavelength_metres);
    let wander = |at: [f64; 2], metres: f64, which: u32| {
        let cells = cells_across(ground, metres);
        let [x, y] = [0, 1].map(|axis| at[axis] * cells[axis] / ground.metres()[axis]);
        let period = ground.wraps().then(|| cells.map(|count| count as i64));
        gradient_noise([x, y, 0.0], period, hash(ground.salt.wrapping_add(which)))
    };

    let waves = waves(ground, wavelength, wind);
    let turns = waves[0] * ridden[0]
        + waves[1] * ridden[1]
        + f64::from(dunes.meander) * (wander(ridden, 2.2 * wavelength, 0) + 0.3 * wander(ridden, 0.8 * wavelength, 1));
    let along = turns - turns.floor();
    let crest = f64::from(dunes.crest);
    let (up, down) = (along / crest, (1.0 - along) / (1.0 - crest));
    let side = |q: f64| q * q * (2.0 - q);
    let height = 1.0 - f64::from(dunes.variety) * (0.5 + wander(ridden, 1.6 * wavelength, 2)).clamp(0.0, 1.0);
    // The lower of the two sides, rounded where they differ by less than the brink.
    let apart = (down - up).abs().min(BRINK);
    let dune = height * side(up.min(down) - (BRINK - apart).powi(2) / (4.0 * BRINK));

    let ripple = f64::from(dunes.ripple_metres);
    let waves = self::waves(ground, ripple, wind);
    let turns = waves[0] * rippled[0] + waves[1] * rippled[1] + 0.9 * wander(rippled, 7.0 * ripple, 3);
    let along = turns - turns.floor();
    let grown = (3.0 * up).clamp(0.0, 1.0) * (6.0 * (1.0 - up)).clamp(0.0, 1.0);
    let share = f64::from(dunes.ripple_height);
    dune * (1.0 - share) + share * grown * side((along / 0.65).min((1.0 - along) / 0.35))
}

/// Waves a metre along u and v: across the wind, at most four a texel; where the field wraps as many as it takes whole, and one at
/// the least.
fn waves(ground: &Ground, wavelength: f64, wind: [f64; 2]) -> [f64; 2] {
    let wavelength = wavelength.max(ground.texel_metres / 4.0);
    let across = [0, 1].map(|axis| ground.metres()[axis] * wind[axis] / wavelength);
    if !ground.wraps() {
        return wind.map(|share| share / wavelength);
    }
    let mut whole = across.map(f64::round);
    if whole == [0.0, 0.0] {
        let axis = if across[0].abs() >= across[1].abs() { 0 } else { 1 };
        whole[axis] = 1_f64.copysign(across[axis]);
    }
    [0, 1].map(|axis| whole[axis] / ground.metres()[axis])
}
