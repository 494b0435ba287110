//! Signed distances to an outline, from its own geometry: as fine as the field is, without a raster between them.

use glam::DVec2;

/// A directed straight piece of an outline.
pub type Edge = [DVec2; 2];

/// Rows whose edges are looked through together where edges are searched for.
const BAND_ROWS: f64 = 8.0;

/// A piece shorter than this, in texels, is nothing; sides of a piece are told apart this far from it.
const NOTHING: f64 = 1e-4;

/// Distance of every texel's centre from the border of what closed contours fill (by a winding number that is not zero), in texels:
/// positive inside, and ±`reach` where it is farther. Texel (i, j) has its centre at (i + ½, j + ½).
pub fn signed_distance(contours: &[Edge], [width, height]: [u32; 2], reach: f64) -> Vec<f32> {
    let mut squared = vec![(reach * reach) as f32; width as usize * height as usize];
    for [from, to] in border(contours) {
        let texels = |low: f64, high: f64, size: u32| {
            let first = (low - reach - 0.5).floor().clamp(0.0, f64::from(size));
            let last = (high + reach + 0.5).ceil().clamp(0.0, f64::from(size));
            first as u32..last as u32
        };
        let (low, high) = (from.min(to), from.max(to));
        let along = to - from;
        let per_length = 1.0 / along.length_squared();
        for y in texels(low.y, high.y, height) {
            let row = &mut squared[y as usize * width as usize..][..width as usize];
            for x in texels(low.x, high.x, width) {
                let offset = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) - from;
                let share = (offset.dot(along) * per_length).clamp(0.0, 1.0);
                let distance = (offset - share * along).length_squared() as f32;
                row[x as usize] = row[x as usize].min(distance);
            }
        }
    }
    let mut distances: Vec<f32> = squared.into_iter().map(f32::sqrt).collect();
    for (row, crossings) in distances.chunks_exact_mut(width as usize).zip(crossings(contours, height)) {
        let mut crossings = crossings.into_iter().peekable();
        let mut winding = 0;
        for (x, distance) in row.iter_mut().enumerate() {
            while let Some((_, turn)) = crossings.next_if(|(at, _)| *at <= x as f64 + 0.5) {
                winding += turn;
            }
            if winding == 0 {
                *distance = -*distance;
            }
        }
    }
    distances
}

/// Where edges cross the middle of each row, from the left, and whether they run down (+1) or up (−1).
fn crossings(edges: &[Edge], height: u32) -> Vec<Vec<(f64, i32)>> {
    let mut rows = vec![Vec::new(); height as usize];
    for &[from, to] in edges {
        let (upper, lower, turn) = if from.y <= to.y { (from, to, 1) } else { (to, from, -1) };
        // Half-open, so that a vertex on the middle counts once.
        let row = |y: f64| (y - 0.5).ceil().clamp(0.0, f64::from(height)) as usize;
        for (y, crossings) in rows.iter_mut().enumerate().take(row(lower.y)).skip(row(upper.y)) {
            let share = (y as f64 + 0.5 - upper.y) / (lower.y - upper.y);
            crossings.push((upper.x + share * (lower.x - upper.x), turn));
        }
    }
    for crossings in &mut rows {
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    rows
}

/// What of the edges parts filled from empty. Contours may overlap, in a glyph of a variable font or where script letters join: edges
/// inside of what they fill together are no border of it, and a bevel must not follow them.
fn border(edges: &[Edge]) -> Vec<Edge> {
    let bands = Bands::new(edges);
    let pieces = bands.split(edges);
    let parts = |&[from, to]: &Edge| {
        let middle = 0.5 * (from + to);
        let side = (to - from).perp().normalize() * NOTHING;
        (bands.winding(edges, middle + side) != 0) != (bands.winding(edges, middle - side) != 0)
    };
    pieces.into_iter().filter(parts).collect()
}

/// Edges by the bands of rows that they pass through.
struct Bands {
    top: f64,
    bands: Vec<Vec<usize>>,
}

impl Bands {
    fn new(edges: &[Edge]) -> Self {
        let top = edges.iter().flatten().fold(f64::INFINITY, |top, point| top.min(point.y));
        let mut bands = Self { top, bands: Vec::new() };
        for (index, [from, to]) in edges.iter().enumerate() {
            let (first, last) = (bands.of(from.y.min(to.y)), bands.of(from.y.max(to.y)));
            bands.bands.resize_with(bands.bands.len().max(last + 1), Vec::new);
            bands.bands[first..=last].iter_mut().for_each(|band| band.push(index));
        }
        for band in &mut bands.bands {
            band.sort_by(|a, b| left(&edges[*a]).total_cmp(&left(&edges[*b])));
        }
        bands
    }

    fn of(&self, y: f64) -> usize {
        ((y - self.top) / BAND_ROWS).max(0.0) as usize
    }

    /// The edges, split where others meet them.
    fn split(&self, edges: &[Edge]) -> Vec<Edge> {
        let mut cuts: Vec<Vec<f64>> = vec![vec![0.0, 1.0]; edges.len()];
        for band in &self.bands {
            for (place, &a) in band.iter().enumerate() {
                // Sorted by their left ends: those that begin beyond this one's right end cannot meet it.
                let right = edges[a][0].x.max(edges[a][1].x);
                for &b in band[place + 1..].iter().take_while(|b| left(&edges[**b]) <= right) {
                    cut(edges, a, b, &mut cuts);
                    cut(edges, b, a, &mut cuts);
                }
            }
        }
        let mut pieces = Vec::with_capacity(edges.len());
        for ([from, to], cuts) in edges.iter().zip(&mut cuts) {
            cuts.sort_by(f64::total_cmp);
            pieces.extend(cuts.windows(2).map(|ends| [from.lerp(*to, ends[0]), from.lerp(*to, ends[1])]));
        }
        pieces.retain(|[from, to]| from.distance(*to) > NOTHING);
        pieces
    }

    /// How often the contours wind round a point.
    fn winding(&self, edges: &[Edge], point: DVec2) -> i32 {
        let Some(band) = self.bands.get(self.of(point.y)) else { return 0 };
        let crossed = |&index: &usize| {
            let [from, to] = edges[index];
            if (from.y <= point.y) == (to.y <= point.y) {
                return 0;
            }
            let x = from.x + (point.y - from.y) / (to.y - from.y) * (to.x - from.x);
            if x > point.x { 0 } else { 1 - 2 * i32::from(from.y > to.y) }
        };
        band.iter().take_while(|index| left(&edges[**index]) <= point.x).map(crossed).sum()
    }
}

fn left([from, to]: &Edge) -> f64 {
    from.x.min(to.x)
}

/// Notes where on edge `a` edge `b` meets it.
fn cut(edges: &[Edge], a: usize, b: usize, cuts: &mut [Vec<f64>]) {
    let ([from, to], [other_from, other_to]) = (edges[a], edges[b]);
    let (along, across) = (to - from, other_to - other_from);
    let sides = [other_from, other_to].map(|end| along.perp_dot(end - from));
    let near = NOTHING * along.length();
    let mut note = |share: f64| {
        if share > 0.0 && share < 1.0 {
            cuts[a].push(share);
        }
    };
    if sides.iter().all(|side| side.abs() <= near) {
        // They lie on one line: the other's ends are where it begins and ceases to be doubled.
        [other_from, other_to].iter().for_each(|end| note((*end - from).dot(along) / along.length_squared()));
    } else if sides[0].min(sides[1]) <= near && sides[0].max(sides[1]) >= -near {
        note((other_from - from).perp_dot(across) / along.perp_dot(across));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[[f64; 2]]) -> Vec<Edge> {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| [DVec2::from(*a), DVec2::from(*b)]).collect()
    }

    fn box_of(x: [f64; 2], y: [f64; 2]) -> Vec<Edge> {
        polygon(&[[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]])
    }

    /// Signed distance from the border of an axis-parallel box.
    fn from_box(point: [f64; 2], x: [f64; 2], y: [f64; 2]) -> f64 {
        let outside = DVec2::new((x[0] - point[0]).max(point[0] - x[1]), (y[0] - point[1]).max(point[1] - y[1]));
        -(outside.max(DVec2::ZERO).length() + outside.max_element().min(0.0))
    }

    #[track_caller]
    fn assert_near(distances: &[f32], width: usize, expected: impl Fn([f64; 2]) -> f64) {
        for (index, distance) in distances.iter().enumerate() {
            let centre = [(index % width) as f64 + 0.5, (index / width) as f64 + 0.5];
            let expected = expected(centre);
            assert!((f64::from(*distance) - expected).abs() < 1e-4, "{centre:?}: {distance} for {expected}");
        }
    }

    #[test]
    fn a_box_is_measured_within_reach() {
        let (x, y) = ([7.3, 21.9], [5.0, 14.5]);
        for turned in [false, true] {
            let mut edges = box_of(x, y);
            if turned {
                edges = edges.into_iter().map(|[a, b]| [b, a]).collect();
            }
            let distances = signed_distance(&edges, [30, 20], 6.0);
            assert_near(&distances, 30, |point| from_box(point, x, y).clamp(-6.0, 6.0));
        }
    }

    #[test]
    fn a_counter_is_empty_and_a_doubled_box_is_one() {
        let (outer, inner) = (([2.0, 28.0], [2.0, 18.0]), ([8.0, 22.0], [6.5, 12.0]));
        let hole: Vec<_> = box_of(inner.0, inner.1).into_iter().map(|[a, b]| [b, a]).collect();
        let ring = [box_of(outer.0, outer.1), hole.clone()].concat();
        let expected = |point| from_box(point, outer.0, outer.1).min(-from_box(point, inner.0, inner.1)).clamp(-20.0, 20.0);
        assert_near(&signed_distance(&ring, [30, 20], 20.0), 30, expected);
        let doubled = [ring, box_of(outer.0, outer.1), hole].concat();
        assert_near(&signed_distance(&doubled, [30, 20], 20.0), 30, expected);
    }

    #[test]
    fn what_overlaps_is_one() {
        // A cross of two bars, and two boxes that share a side in part: no seam shows inside.
        let cross = [box_of([4.0, 26.0], [8.0, 12.0]), box_of([13.0, 17.0], [1.0, 19.0])].concat();
        let distances = signed_distance(&cross, [30, 20], 20.0);
        let middle = distances[10 * 30 + 15];
        assert!((middle - 8f32.sqrt() + 0.12).abs() < 0.6, "{middle}: the nearest border is an inner corner of the cross");
        let apart = [box_of([4.0, 15.0], [4.0, 16.0]), box_of([15.0, 26.0], [4.0, 16.0])].concat();
        assert_near(&signed_distance(&apart, [30, 20], 20.0), 30, |point| from_box(point, [4.0, 26.0], [4.0, 16.0]).min(20.0));
    }

    #[test]
    fn what_lies_beyond_the_field_counts_too() {
        let edges = box_of([-50.0, 10.0], [-50.0, 50.0]);
        assert_near(&signed_distance(&edges, [16, 16], 8.0), 16, |point| (10.0 - point[0]).clamp(-8.0, 8.0));
    }
}
