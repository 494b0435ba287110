//! The micropolygon mesh: the field at the vertices of a regular grid, and flat triangles between them. Specification of
//! `shaders/surface/trace_mesh.wgsl` and of what `shaders/surface/micropolygon.wgsl` rasterises over a plane.

use super::HeightField;
use super::traversal::Line;

/// The field at a vertex of a grid of so many quads along either side of a tile.
fn vertex(field: &HeightField, quads: u32, [i, j]: [f64; 2]) -> f64 {
    let lattice = |axis: usize, place: f64| place * f64::from(field.size[axis]) / f64::from(quads) - 0.5;
    field.bilinear([lattice(0, i), lattice(1, j)])
}

/// The triangulated surface at a lattice position: each quad is cut from its right upper corner to its left lower one.
pub fn surface(field: &HeightField, quads: u32, lattice: [f64; 2]) -> f64 {
    let place = [0, 1].map(|axis| (lattice[axis] + 0.5) * f64::from(quads) / f64::from(field.size[axis]));
    let [i, j] = place.map(f64::floor);
    let [x, y] = [place[0] - i, place[1] - j];
    let at = |di: f64, dj: f64| vertex(field, quads, [i + di, j + dj]);
    // Barycentric weights of the triangle's three corners.
    if x + y <= 1.0 {
        (1.0 - x - y) * at(0.0, 0.0) + x * at(1.0, 0.0) + y * at(0.0, 1.0)
    } else {
        (x + y - 1.0) * at(1.0, 1.0) + (1.0 - y) * at(1.0, 0.0) + (1.0 - x) * at(0.0, 1.0)
    }
}

/// Every parameter between 0 and `end` at which a line crosses from one triangle into another, in order, and both ends.
fn crossings(field: &HeightField, quads: u32, line: &Line, end: f64) -> Vec<f64> {
    let place = |t: f64| {
        let at = line.lattice_at(t);
        let [i, j] = [0, 1].map(|axis| (at[axis] + 0.5) * f64::from(quads) / f64::from(field.size[axis]));
        [i, j, i + j]
    };
    let (from, to) = (place(0.0), place(end));
    let mut all = vec![0.0, end];
    for family in 0..3 {
        let (low, high) = (from[family].min(to[family]), from[family].max(to[family]));
        let mut whole = low.ceil();
        while whole <= high && high > low {
            all.push(end * (whole - from[family]) / (to[family] - from[family]));
            whole += 1.0;
        }
    }
    all.sort_by(f64::total_cmp);
    all
}

/// The first parameter between 0 and `end` at which a line is on the triangulated surface or below it.
pub fn meets(field: &HeightField, quads: u32, line: &Line, end: f64) -> Option<f64> {
    let gap = |t: f64| line.height + t * line.rise - surface(field, quads, line.lattice_at(t));
    let mut above = (0.0, gap(0.0));
    if above.1 <= 0.0 {
        return Some(0.0);
    }
    for t in crossings(field, quads, line, end) {
        let below = (t, gap(t));
        if below.1 <= 0.0 {
            return Some(above.0 + (below.0 - above.0) * above.1 / (above.1 - below.1));
        }
        above = below;
    }
    None
}
