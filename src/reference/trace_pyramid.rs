//! Pyramidal displacement mapping (\[PDM\]) without a pyramid: every column that the ray passes, one after the other, and half a
//! pixel's refinement. Specification of `shaders/surface/trace_pyramid.wgsl`.

use super::traversal::Line;
use super::{HeightField, Hit, Ray};

/// Where the ray first meets a column: a texel's height over the texel's square, for t from `begin` to `end`.
pub fn meets_column(field: &HeightField, line: &Line, begin: f64, end: f64) -> Option<f64> {
    // Columns part halfway between texel centres: moved by half a texel, their borders are the lattice lines.
    let moved = Line { lattice: line.lattice.map(|at| at + 0.5), ..*line };
    moved.stretches(field, begin, end).find_map(|stretch| {
        let middle = moved.lattice_at(stretch.t + 0.5 * stretch.length);
        let column = field.texel(middle[0].floor() as i64, middle[1].floor() as i64);
        let gap = line.height + line.rise * stretch.t - column;
        if gap <= 0.0 {
            return Some(stretch.t);
        }
        let fall = gap / -line.rise;
        (0.0..=stretch.length).contains(&fall).then_some(stretch.t + fall)
    })
}

/// Where the ray meets the columns (\[PDM\] fig. 14, top).
pub fn trace_nearest(field: &HeightField, ray: &Ray) -> Hit {
    let met = meets_column(field, &Line::from(ray), 0.0, ray.t_end.into());
    met.map_or(Hit::end(ray, 1), |t| Hit::on(ray, t, 1))
}

/// Where the ray meets the bilinear surface, as far as half a pixel before and after a column tells (\[PDM\] §3.3).
pub fn trace_refined(field: &HeightField, ray: &Ray) -> Hit {
    let line = Line::from(ray);
    let end = f64::from(ray.t_end);
    let half_pixel = 0.5 / line.travel[0].hypot(line.travel[1]);
    let mut begin = 0.0;
    while let Some(column) = meets_column(field, &line, begin, end) {
        let (back, forward) = ((column - half_pixel).max(0.0), (column + half_pixel).min(end));
        let gap_back = line.gap(field, back);
        let gap_forward = line.gap(field, forward);
        if gap_back <= 0.0 && gap_forward <= 0.0 {
            return Hit::on(ray, back, 3);
        }
        if gap_forward <= 0.0 {
            return Hit::on(ray, back + gap_back / (gap_back - gap_forward) * (forward - back), 3);
        }
        if forward == end {
            break;
        }
        begin = forward;
    }
    Hit::end(ray, 1)
}
