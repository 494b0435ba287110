//! Overlapping scales. Specification of `shaders/field/noise_scales.wgsl`.

use super::noise::{Ground, Rows, edge_metres, pulse, smooth};
use crate::scene::Scales;

/// Radius of a scale, pitches.
pub const RADIUS: f64 = 0.62;

/// The height at a place in metres: that of the highest scale.
pub fn height(scales: &Scales, ground: &Ground, time_seconds: f64, at: [f64; 2]) -> f64 {
    let rows = Rows::new(ground, scales.pitch_metres, 0.5, true);
    let at = rows.from_origin(at);
    let radius = RADIUS * rows.pitch[0].min(2.0 * rows.pitch[1]);
    let about = [(at[0] / rows.pitch[0]).floor() as i64, (at[1] / rows.pitch[1]).floor() as i64];
    let mut highest = 0.0_f64;
    for dy in -3..=3 {
        for dx in -3..=3 {
            let scale = [about[0] + dx, about[1] + dy];
            let along = rows.along(scale, true);
            let [x, y] = [0, 1].map(|axis| (at[axis] - along[axis] * rows.pitch[axis]) / radius);
            let turns =
                rows.turns(ground, scale, along, scales.waves, scales.disorder) + time_seconds / f64::from(scales.period_seconds);
            // It rises to its free edge, less as it sinks; it is domed, and has a ridge.
            let rise = 0.5 * (y + 1.0) * (1.0 - f64::from(scales.lift) * pulse(turns));
            let beside_ridge = smooth(x.abs() / 0.22);
            let domed = (1.0 - 0.35 * x * x) * (1.0 - 0.25 * f64::from(scales.keel) * beside_ridge);
            let edge = smooth((1.0 - x.hypot(y)) * radius / edge_metres(ground, scales.edge_metres));
            highest = highest.max(rise * domed * edge);
        }
    }
    highest
}
