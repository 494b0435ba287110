//! Pillars side by side. Specification of `shaders/field/noise_columns.wgsl`.

use super::noise::{Ground, Rows, edge_metres, pulse, smooth};
use crate::scene::{ColumnShape, Columns};

/// The height at a place in metres.
pub fn height(columns: &Columns, ground: &Ground, time_seconds: f64, at: [f64; 2]) -> f64 {
    let hexagons = columns.shape == ColumnShape::Hexagons;
    let rows = Rows::new(ground, columns.pitch_metres, if hexagons { 0.75_f64.sqrt() } else { 1.0 }, hexagons);
    let at = rows.from_origin(at);
    let axis_of = |column: [i64; 2]| {
        let along = rows.along(column, hexagons);
        [along[0] * rows.pitch[0], along[1] * rows.pitch[1]]
    };
    let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);

    // The column whose axis is nearest, of all that could be.
    let about = [(at[0] / rows.pitch[0]).floor() as i64, (at[1] / rows.pitch[1]).floor() as i64];
    let near = |about: [i64; 2]| (-2..=3).flat_map(move |dy| (-2..=3).map(move |dx| [about[0] + dx, about[1] + dy]));
    let mut column = about;
    for other in near(about) {
        if distance(at, axis_of(other)) < distance(at, axis_of(column)) {
            column = other;
        }
    }
    // As far inside as the nearest of the lines halfway to another axis. Squares have none to those across their corners that would
    // cut them.
    let own = axis_of(column);
    let mut inside = f64::MAX;
    for other in near(about).filter(|other| *other != column) {
        let axis = axis_of(other);
        let apart = distance(own, axis);
        let toward = ((at[0] - own[0]) * (axis[0] - own[0]) + (at[1] - own[1]) * (axis[1] - own[1])) / apart;
        inside = inside.min(0.5 * apart - toward);
    }

    let turns = rows.turns(ground, column, rows.along(column, hexagons), columns.waves, columns.disorder)
        + time_seconds / f64::from(columns.period_seconds);
    let [low, high, floor] = [columns.low, columns.high, columns.ground].map(f64::from);
    let top = low + (high - low) * pulse(turns);
    let edge = smooth((inside - 0.5 * f64::from(columns.gap_metres)) / edge_metres(ground, columns.edge_metres));
    floor + (top - floor) * edge
}
