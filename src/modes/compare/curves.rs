//! The curves of a sweep: error against cost, and cost against the size of the field.

use super::plot::{Axis, Curve, Plot, Scale};
use super::table::{Row, Table};
use super::variant::has_samples;
use crate::surface::Technique;

/// Error against cost, a picture for each camera: one curve for each technique that counts samples, one point for each that does
/// not. Where nothing was timed the cost is the mean of the steps.
pub fn samples(table: &Table) -> Vec<Plot> {
    let timed = table.rows.iter().all(|row| row.surface_ms.is_some());
    let cost = |row: &Row| row.surface_ms.filter(|_| timed).unwrap_or(row.steps_per_pixel.mean);
    let label = if timed { "GPU time of the surface pass, milliseconds" } else { "steps a pixel, mean" };
    cameras(table)
        .map(|camera| Plot {
            title: format!("{}: error against cost", table.scene.name),
            subtitle: subtitle(table, camera, true),
            x: Axis { label, scale: Scale::Logarithmic, ticks_at_points: false },
            y: Axis { label: "RMS position error, texels", scale: Scale::Logarithmic, ticks_at_points: false },
            mark: Some((0.5, "half a texel")),
            curves: curves(table, camera, |row| {
                let count = if has_samples(row.technique) { row.samples } else { None };
                ([cost(row), row.position_error_texels.rms], count.map_or_else(String::new, |count| count.to_string()))
            }),
        })
        .collect()
}

/// Time of the whole frame against the size of the field, a picture for each camera.
pub fn fields(table: &Table) -> Vec<Plot> {
    let timed = table.rows.iter().all(|row| row.frame_ms.is_some());
    let cost = |row: &Row| row.frame_ms.filter(|_| timed).unwrap_or(row.steps_per_pixel.mean);
    let label = if timed { "GPU time of the frame, milliseconds" } else { "steps a pixel, mean" };
    cameras(table)
        .map(|camera| Plot {
            title: format!("{}: the same content at every size", table.scene.name),
            subtitle: subtitle(table, camera, false),
            x: Axis { label: "width of the field, texels", scale: Scale::Logarithmic, ticks_at_points: true },
            y: Axis { label, scale: Scale::Linear, ticks_at_points: false },
            mark: None,
            curves: curves(table, camera, |row| ([f64::from(row.field_size[0]), cost(row)], format!("{:.2}", cost(row)))),
        })
        .collect()
}

fn cameras(table: &Table) -> impl Iterator<Item = usize> {
    1..=table.cameras.len()
}

fn subtitle(table: &Table, camera: usize, with_field: bool) -> String {
    let [width, height] = table.image_size;
    let mut parts = vec![format!("picture {width}×{height}")];
    if let (true, Some(row)) = (with_field, table.rows.first()) {
        parts.push(format!("field {}×{}", row.field_size[0], row.field_size[1]));
    }
    let mut shadows: Vec<_> = table.rows.iter().map(|row| row.shadow).collect();
    shadows.dedup();
    if let [shadow] = shadows[..] {
        parts.push(format!("shadow {}", shadow.name()));
    }
    if table.cameras.len() > 1 {
        parts.push(format!("camera {camera}"));
    }
    parts.push(format!("truth {}", table.truth.name()));
    parts.push(table.adapter.name.clone());
    parts.join(", ")
}

/// A curve for each technique and shadow, in the order of the rows.
fn curves(table: &Table, camera: usize, point: impl Fn(&Row) -> ([f64; 2], String)) -> Vec<Curve> {
    let several_shadows = table.rows.iter().any(|row| row.shadow != table.rows[0].shadow);
    let mut curves: Vec<Curve> = Vec::new();
    for row in table.rows.iter().filter(|row| row.camera == camera) {
        let name = match several_shadows {
            true => format!("{}, {}", row.technique.name(), row.shadow.name()),
            false => row.technique.name().to_owned(),
        };
        match curves.iter_mut().find(|curve| curve.name == name) {
            Some(curve) => curve.points.push(point(row)),
            None => {
                // A technique keeps its colour whatever it is compared with; its shadows take the next ones.
                let technique = Technique::ALL.iter().position(|technique| *technique == row.technique).unwrap_or(0);
                let colour = if several_shadows { curves.len() } else { technique };
                curves.push(Curve { name, colour, points: vec![point(row)] });
            }
        }
    }
    curves
}
