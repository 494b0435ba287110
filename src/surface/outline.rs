//! Outline: the part of the picture that shows the plane, as a convex polygon. Only what lies within is traced: a rasteriser leaves out the
//! rest, where a fragment shader that sees it beside the plane would still cost a software adapter all of its work.

use glam::{DVec2, DVec3};

use super::ray_map::ExactForms;

/// The most corners: the picture's, and one more for each line that it is cut along.
pub const CORNERS_MAX: usize = 9;

/// The vertices of their fan of triangles.
pub const VERTICES: u32 = 3 * (CORNERS_MAX as u32 - 2);

/// How far beyond the plane's border the outline runs, pixels: a pixel whose centre lies half of one outside still shows some of it, and
/// as much again is for rounding.
pub const MARGIN_PIXELS: f64 = 1.0;

/// How far beyond the picture's own border it may run, pixels.
const BEYOND_PIXELS: f64 = 8.0;

/// The outline's corners in clip space, x and y each, in order; the last repeats as often as is left. A plane that is not in the picture
/// has them all in one place, and so has one that is seen from below. The plane reaches so far from its middle, both in texels along u and v.
///
/// The picture is cut along the plane's borders, not the plane along the picture's: every corner is a pixel of the picture then, which an
/// f32 knows, and from close to the plane, where its borders all but lie in the horizon, nothing hangs on which of them meet.
pub fn corners(
    forms: &ExactForms,
    eye_height: f64,
    image_size: [u32; 2],
    half_extent: DVec2,
    middle: DVec2,
) -> [[f32; 2]; CORNERS_MAX] {
    if eye_height <= 0.0 {
        return [[0.0; 2]; CORNERS_MAX];
    }
    let ExactForms { lattice: [x, y], denominator, .. } = *forms;
    // Where the lattice position is at a border; on the plane's side of it above 0.
    let border =
        |form: DVec3, side: f64, half_extent: f64, middle: f64| denominator * (half_extent + side * middle) - form * side;
    let size = DVec2::from(image_size.map(f64::from));
    let (low, high) = (DVec2::splat(-BEYOND_PIXELS), size + BEYOND_PIXELS);
    let mut polygon = vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    for line in [
        // The horizon …
        denominator,
        // … and the plane's borders.
        border(x, -1.0, half_extent.x, middle.x),
        border(x, 1.0, half_extent.x, middle.x),
        border(y, -1.0, half_extent.y, middle.y),
        border(y, 1.0, half_extent.y, middle.y),
    ] {
        polygon = cut(&polygon, line + DVec3::Z * (line.truncate().length() * MARGIN_PIXELS));
    }
    let clip = |corner: &DVec2| {
        let share = *corner / size;
        [2.0 * share.x - 1.0, 1.0 - 2.0 * share.y].map(|x| x as f32)
    };
    let mut corners = [polygon.last().map_or([0.0; 2], clip); CORNERS_MAX];
    for (slot, corner) in corners.iter_mut().zip(&polygon) {
        *slot = clip(corner);
    }
    corners
}

/// What of a convex polygon lies on a line's positive side (Sutherland and Hodgman 1974).
fn cut(polygon: &[DVec2], line: DVec3) -> Vec<DVec2> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (index, &corner) in polygon.iter().enumerate() {
        let next = polygon[(index + 1) % polygon.len()];
        let (here, there) = (line.dot(corner.extend(1.0)), line.dot(next.extend(1.0)));
        if here >= 0.0 {
            kept.push(corner);
        }
        if (here >= 0.0) != (there >= 0.0) {
            kept.push(corner.lerp(next, here / (here - there)));
        }
    }
    kept
}
