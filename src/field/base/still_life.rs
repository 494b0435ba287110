//! A still life as a depth camera takes it: the distance of every pixel, and its colour.
//!
//! A vase, fruit and books on a table before a curtain, cast by parallel rays that look a little down (\[PDM\] fig. 19 turns and lights
//! such a pair of images). Rays march along the distance to the nearest thing. The colours are those of the things, with what shade
//! their neighbours cast round contacts, but no light of their own: the scene brings that.

use glam::{DVec2, DVec3};

use super::noise::{fractal_noise, smoothstep};
use crate::surface::albedo_image::{ColourImage, encode};

/// How far down the camera looks, radians.
const PITCH: f64 = 0.42;

/// Half the width of what it sees, in the scene's own unit, some decimetres.
const HALF_WIDTH: f64 = 1.0;

/// What is in the middle of the picture.
const TARGET: DVec3 = DVec3::new(0.0, 0.33, 0.0);

/// Distances along a ray, from the plane through the target, that become heights 1 and 0.
const NEAREST: f64 = -0.92;
const FARTHEST: f64 = 1.02;

/// A ray is there when it is nearer than this.
const THERE: f64 = 4e-4;

/// Takes the picture: heights, row by row, and the colours over them.
pub fn photograph([width, height]: [u32; 2]) -> (Vec<f32>, ColourImage) {
    let pixel = 2.0 * HALF_WIDTH / f64::from(width);
    let ahead = DVec3::new(0.0, -PITCH.sin(), -PITCH.cos());
    let up = DVec3::new(0.0, PITCH.cos(), -PITCH.sin());
    let count = width as usize * height as usize;
    let mut heights = Vec::with_capacity(count);
    let mut rgba = Vec::with_capacity(4 * count);
    for y in 0..height {
        for x in 0..width {
            let right = (f64::from(x) + 0.5) * pixel - HALF_WIDTH;
            let above = (0.5 * f64::from(height) - f64::from(y) - 0.5) * pixel;
            let start = TARGET + DVec3::X * right + up * above;
            let mut distance = NEAREST;
            let mut thing = Thing::Curtain;
            for _ in 0..160 {
                let (to_surface, nearest) = nearest(start + ahead * distance);
                thing = nearest;
                distance += to_surface;
                if to_surface < THERE || distance > FARTHEST {
                    break;
                }
            }
            let distance = distance.min(FARTHEST);
            let at = start + ahead * distance;
            let colour = thing.colour(at) * openness(at);
            heights.push(((FARTHEST - distance) / (FARTHEST - NEAREST)).clamp(0.0, 1.0) as f32);
            rgba.extend(colour.to_array().map(|channel| encode(channel as f32)));
            rgba.push(255);
        }
    }
    (heights, ColourImage { size: [width, height], rgba })
}

/// What there is to see.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Thing {
    Table,
    Curtain,
    Vase,
    Orange,
    Lemon,
    Gourd,
    RedBook,
    BlueBook,
}

const VASE: DVec3 = DVec3::new(-0.40, 0.0, -0.22);
const VASE_TOP: f64 = 0.86;
/// Heights and radii of the vase's profile.
const PROFILE: [[f64; 2]; 9] = [
    [0.00, 0.125],
    [0.05, 0.135],
    [0.18, 0.215],
    [0.34, 0.245],
    [0.50, 0.195],
    [0.62, 0.105],
    [0.70, 0.082],
    [0.79, 0.095],
    [0.86, 0.140],
];
const ORANGES: [DVec3; 2] = [DVec3::new(0.03, 0.125, 0.14), DVec3::new(-0.30, 0.125, 0.36)];
const ORANGE_RADIUS: f64 = 0.125;
const LEMON: DVec3 = DVec3::new(0.02, 0.082, 0.56);
const GOURD: DVec3 = DVec3::new(0.50, 0.335, -0.12);
const GOURD_RADIUS: f64 = 0.118;
/// Thickness of the covers.
const COVER: f64 = 0.014;
/// Middle, half extents and cosine and sine of the turn of the two books.
const RED_BOOK: (DVec3, DVec3, [f64; 2]) = (DVec3::new(0.50, 0.065, -0.08), DVec3::new(0.34, 0.065, 0.24), [0.92, 0.39]);
const BLUE_BOOK: (DVec3, DVec3, [f64; 2]) = (DVec3::new(0.52, 0.178, -0.11), DVec3::new(0.28, 0.048, 0.20), [0.97, -0.24]);

/// Distance to the nearest thing, or to a ball round it while that is far away, and which it is.
fn nearest(at: DVec3) -> (f64, Thing) {
    let mut best = (at.y, Thing::Table);
    let mut offer = |distance: f64, thing: Thing| {
        if distance < best.0 {
            best = (distance, thing);
        }
    };
    offer(curtain(at), Thing::Curtain);
    offer(vase(at - VASE), Thing::Vase);
    for centre in ORANGES {
        offer(orange(at - centre), Thing::Orange);
    }
    offer(lemon(at - LEMON), Thing::Lemon);
    offer(gourd(at - GOURD), Thing::Gourd);
    offer(book(at, RED_BOOK), Thing::RedBook);
    offer(book(at, BLUE_BOOK), Thing::BlueBook);
    best
}

/// Folds that hang, deeper and wider toward the floor. The factor answers for the slope of the folds.
fn curtain(at: DVec3) -> f64 {
    let distance = at.z + 0.62;
    if distance > 0.3 {
        return distance - 0.15;
    }
    let sway = 0.35 * fractal_noise(at.x * 1.3 + 4.0, at.y * 0.9, 31, 2);
    let phase = 11.0 * at.x + 9.0 * sway;
    let fold = phase.sin() + 0.35 * (2.0 * phase + 1.0).sin();
    0.55 * (distance - (0.035 + 0.020 * (1.0 - at.y).clamp(0.0, 1.0)) * fold)
}

fn vase(at: DVec3) -> f64 {
    let radius = DVec2::new(at.x, at.z).length();
    let far = DVec2::new(radius - 0.26, (at.y - 0.43).abs() - 0.44).max(DVec2::ZERO).length();
    if far > 0.1 {
        return far - 0.02;
    }
    let wall = radius - profile(at.y.clamp(0.0, VASE_TOP));
    // Open above: the mouth goes down into the neck.
    let mouth = (profile(at.y.clamp(0.0, VASE_TOP)) - 0.018 - radius).min(at.y - 0.72);
    0.72 * wall.max(at.y - VASE_TOP).max(-at.y).max(mouth.min(at.y - 0.72).min(0.5))
}

/// Radius of the vase at a height: a smooth curve through the profile.
fn profile(height: f64) -> f64 {
    let last = PROFILE.len() - 1;
    let piece = PROFILE.iter().rposition(|point| point[0] <= height).unwrap_or(0).min(last - 1);
    let point = |index: usize| PROFILE[index.min(last)];
    let [before, low, high, after] = [point(piece.saturating_sub(1)), point(piece), point(piece + 1), point(piece + 2)];
    let span = high[0] - low[0];
    let t = (height - low[0]) / span;
    let tangent = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]) / (b[0] - a[0]) * span;
    let (m0, m1) = (tangent(before, high), tangent(low, after));
    let (t2, t3) = (t * t, t * t * t);
    (2.0 * t3 - 3.0 * t2 + 1.0) * low[1] + (t3 - 2.0 * t2 + t) * m0 + (3.0 * t2 - 2.0 * t3) * high[1] + (t3 - t2) * m1
}

fn orange(at: DVec3) -> f64 {
    let distance = at.length() - ORANGE_RADIUS;
    if distance > 0.02 {
        return distance;
    }
    // Pores, and the dimple of the stalk.
    let pores = fractal_noise(at.x * 90.0 + 17.0 * at.z, at.y * 90.0 - 23.0 * at.z, 33, 2);
    let stalk = DVec2::new(at.x + 0.03, at.z - 0.04).length();
    0.9 * (distance + 0.0022 * pores + 0.012 * (1.0 - smoothstep(0.0, 0.035, stalk)) * f64::from(u8::from(at.y > 0.0)))
}

fn lemon(at: DVec3) -> f64 {
    let along = 0.86 * at.x + 0.50 * at.z;
    let across = DVec2::new(-0.50 * at.x + 0.86 * at.z, at.y).length();
    // A spindle with a nipple at either end.
    let share = (along.abs() / 0.15).min(1.0);
    let radius = 0.082 * (1.0 - share.powi(3)).max(0.0).sqrt() + 0.016 * smoothstep(0.155, 0.11, along.abs());
    let beyond = (along.abs() - 0.148).max(0.0);
    0.6 * (DVec2::new(across - radius, beyond).max(DVec2::ZERO).length() + (across - radius).min(0.0))
}

fn gourd(at: DVec3) -> f64 {
    let across = DVec2::new(at.x, at.z).length();
    let stalk = (DVec2::new(at.x - 0.10 * (at.y - 0.08), at.z).length() - 0.009).max((at.y - 0.105).abs() - 0.045);
    // A torus so fat that its hole is a dimple, with ribs.
    let ribs = 0.006 * (9.0 * at.z.atan2(at.x)).cos().abs() * smoothstep(0.0, 0.06, across);
    let body = DVec2::new(across - 0.050, at.y * 1.12).length() - (GOURD_RADIUS - 0.052 + ribs);
    (0.75 * body).min(stalk)
}

/// Two covers and a spine, and the pages that stand back from the covers on three sides.
fn book(at: DVec3, (middle, half, turn): (DVec3, DVec3, [f64; 2])) -> f64 {
    let at = in_book(at, middle, turn);
    let cover = COVER;
    let covers = from_box(DVec3::new(at.x, at.y.abs() - half.y + 0.5 * cover, at.z), DVec3::new(half.x, 0.5 * cover, half.z));
    let spine = from_box(at + DVec3::X * (half.x - 0.5 * cover), DVec3::new(0.5 * cover, half.y, half.z));
    let pages = from_box(at, DVec3::new(half.x - 0.016, half.y - 0.5 * cover, half.z - 0.016));
    covers.min(spine).min(pages)
}

/// Signed distance from a box about the origin.
fn from_box(at: DVec3, half: DVec3) -> f64 {
    let corner = at.abs() - half;
    corner.max(DVec3::ZERO).length() + corner.max_element().min(0.0)
}

fn in_book(at: DVec3, middle: DVec3, [cosine, sine]: [f64; 2]) -> DVec3 {
    let at = at - middle;
    DVec3::new(cosine * at.x + sine * at.z, at.y, cosine * at.z - sine * at.x)
}

/// Share of the surroundings that a point sees along its normal: less in corners and where things touch.
fn openness(at: DVec3) -> f64 {
    let distance = |offset: DVec3| nearest(at + offset).0;
    let e = 1.5e-3;
    // Four corners of a tetrahedron give the gradient.
    let corners = [DVec3::new(1.0, -1.0, -1.0), DVec3::new(-1.0, -1.0, 1.0), DVec3::new(-1.0, 1.0, -1.0), DVec3::ONE];
    let normal = corners.iter().map(|corner| *corner * distance(*corner * e)).sum::<DVec3>().normalize_or(DVec3::Y);
    let hidden: f64 = [(0.03, 0.5), (0.08, 0.3), (0.18, 0.2)]
        .iter()
        .map(|(reach, weight)| weight * (1.0 - (distance(normal * *reach) / (0.75 * reach)).clamp(0.0, 1.0)))
        .sum();
    1.0 - 0.62 * hidden
}

impl Thing {
    /// Linear colour at a point of it.
    fn colour(self, at: DVec3) -> DVec3 {
        let noise = |scale: f64, salt: u32| fractal_noise(at.x * scale + 3.1 * at.z, at.y * scale + 1.7 * at.z * scale, salt, 4);
        let mix = |a: DVec3, b: DVec3, share: f64| a + (b - a) * share.clamp(0.0, 1.0);
        match self {
            Self::Table => {
                // Planks along x, each of its own shade, with grain.
                let plank = (at.z / 0.26).floor();
                let seam = smoothstep(0.0, 0.02, 0.5 - ((at.z / 0.26).rem_euclid(1.0) - 0.5).abs());
                let grain = fractal_noise(at.x * 3.0 + 17.0 * plank, at.z * 46.0, 34, 4);
                let shade = 0.75 + 0.4 * fractal_noise(plank * 7.3, 0.5, 35, 1);
                mix(DVec3::new(0.075, 0.035, 0.017), DVec3::new(0.36, 0.19, 0.092), grain) * shade * (0.35 + 0.65 * seam)
            }
            Self::Curtain => {
                let weave = noise(150.0, 36);
                mix(DVec3::new(0.055, 0.115, 0.095), DVec3::new(0.105, 0.20, 0.155), weave)
            }
            Self::Vase => {
                let local = at - VASE;
                let turn = local.z.atan2(local.x);
                let glaze = DVec3::new(0.70, 0.72, 0.70) * (0.92 + 0.12 * noise(14.0, 37));
                let blue = DVec3::new(0.030, 0.075, 0.30);
                // Bands, and between them a row of leaves.
                let line = |middle: f64, half: f64| 1.0 - smoothstep(half, half + 0.006, (local.y - middle).abs());
                let band = line(0.055, 0.012)
                    .max(line(0.115, 0.005))
                    .max(line(0.535, 0.006))
                    .max(line(0.58, 0.014))
                    .max(line(0.82, 0.018));
                let leaf_at = (turn * 7.0 / std::f64::consts::TAU).rem_euclid(1.0) - 0.5;
                let (px, py) = (leaf_at * 2.2, (local.y - 0.33) / 0.17);
                let leaf = 1.0 - px.abs() / (0.75 * (1.0 - py * py).max(0.0));
                let vein = smoothstep(0.02, 0.07, (px - 0.12 * (py * 14.0).sin() * px.signum()).abs());
                let drawn = band.max(smoothstep(0.0, 0.12, leaf) * (0.55 + 0.45 * vein) * f64::from(u8::from(py.abs() < 1.0)));
                let inside = f64::from(u8::from(
                    local.y < VASE_TOP - 0.004 && DVec2::new(local.x, local.z).length() < profile(local.y) - 0.009,
                ));
                mix(mix(glaze, blue, 0.9 * drawn), DVec3::splat(0.05), inside)
            }
            Self::Orange => mix(DVec3::new(0.80, 0.24, 0.018), DVec3::new(0.92, 0.36, 0.030), noise(16.0, 38)),
            Self::Lemon => mix(DVec3::new(0.80, 0.58, 0.045), DVec3::new(0.88, 0.70, 0.10), noise(20.0, 39)),
            Self::Gourd => {
                let local = at - GOURD;
                if DVec2::new(local.x, local.z).length() < 0.02 && local.y > 0.062 {
                    return DVec3::new(0.06, 0.035, 0.015);
                }
                let rib = (9.0 * local.z.atan2(local.x)).cos().abs();
                let speckle = fractal_noise(local.x * 40.0 + 9.0 * local.z, local.y * 40.0, 40, 3);
                mix(DVec3::new(0.60, 0.17, 0.018), DVec3::new(0.78, 0.36, 0.050), 0.75 * rib + 0.7 * (speckle - 0.5))
            }
            Self::RedBook => Self::bound(at, RED_BOOK, DVec3::new(0.30, 0.030, 0.028)),
            Self::BlueBook => Self::bound(at, BLUE_BOOK, DVec3::new(0.032, 0.060, 0.15)),
        }
    }

    /// A book's cloth with a gilt line near its edges, and the edges of its pages.
    fn bound(at: DVec3, (middle, half, turn): (DVec3, DVec3, [f64; 2]), cloth: DVec3) -> DVec3 {
        let local = in_book(at, middle, turn);
        if local.y.abs() < half.y - COVER && local.x > -half.x + COVER {
            let leaves = fractal_noise(local.x * 6.0 + local.z * 6.0, local.y * 420.0, 41, 2);
            return DVec3::new(0.62, 0.55, 0.42) * (0.70 + 0.35 * leaves);
        }
        let border = (half.x - local.x.abs()).min(half.z - local.z.abs());
        let gilt = 1.0 - smoothstep(0.004, 0.007, (border - 0.035).abs());
        let weave = fractal_noise(local.x * 160.0, local.z * 160.0, 42, 2);
        let gold = DVec3::new(0.62, 0.42, 0.12);
        cloth * (0.8 + 0.4 * weave) + (gold - cloth) * 0.8 * gilt
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_shows_what_is_there() {
        let (heights, colours) = photograph([96, 72]);
        assert_eq!((heights.len(), colours.rgba.len()), (96 * 72, 4 * 96 * 72));
        // Nothing is cut off before or behind.
        let (low, high) = heights.iter().fold((1.0_f32, 0.0_f32), |(low, high), height| (low.min(*height), high.max(*height)));
        assert!(low > 0.005 && low < 0.25 && high < 0.995 && high > 0.8, "from {low} to {high}");
        let at = |x: usize, y: usize| (heights[y * 96 + x], colours.rgba[4 * (y * 96 + x)]);
        // The table comes nearer downward; the vase stands before the curtain, white against green.
        assert!(at(90, 71).0 > at(90, 60).0 + 0.05);
        let (vase, curtain) = (at(28, 30), at(3, 10));
        assert!(vase.0 > curtain.0 + 0.1, "{vase:?} before {curtain:?}");
        assert!(vase.1 > curtain.1 + 60, "{vase:?} {curtain:?}");
        // Silhouettes are cliffs: that is what such an image cannot know better.
        let cliffs = heights.windows(2).filter(|pair| (pair[0] - pair[1]).abs() > 0.1).count();
        assert!(cliffs > 20, "{cliffs}");
    }
}
