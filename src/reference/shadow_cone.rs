//! A light that is a disc, in slices. Specification of `shaders/surface/shadow_cone.wgsl`, which says why.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

use super::light_disc::LightDisc;
use super::shadow_hard::way_to_light;
use super::traversal::Line;
use super::{HeightField, Ray};

/// The slices: where they begin and end, and where their horizon is looked for, in radii beside the disc's centre. The middle one
/// first, from its own middle outward: what is left of it mirrors what is right.
const SLICES: [[f64; 3]; 3] = [[0.0, 1.0 / 3.0, 0.0], [1.0 / 3.0, 1.0, 2.0 / 3.0], [1.0 / 3.0, 1.0, -2.0 / 3.0]];

/// Half the width of the wedge, in texels, from which on the sides have horizons of their own.
const NEAR_TEXELS: f64 = 0.5;

/// Tangent of the radius over that of the distance to the zenith beyond which the light is tilted.
const LEAN: f64 = 0.9;

/// The share of the light that arrives.
pub fn shadow(field: &HeightField, ray: &Ray, disc: &LightDisc) -> f64 {
    shadow_above(field, ray, disc, 0.0)
}

/// The share of the light that arrives at a height above the surface: the shader lifts its rays off it, so that rounding does not make
/// a surface shade itself.
pub fn shadow_above(field: &HeightField, ray: &Ray, disc: &LightDisc, lift: f64) -> f64 {
    let (start, _) = way_to_light(field, ray);
    let start = Line { height: start.height + lift, ..start };
    let [cosine, sine] = disc.elevation;
    let disc = if disc.radius * sine > LEAN * cosine { disc.tilted(disc.radius, LEAN) } else { *disc };
    // From its foot to its head, as the middle slice has them.
    let [foot, head] = [disc.horizon(), 1.0];
    let near = near(&start, &disc);
    let close = horizon(field, &start, lift, &disc, 0.0, [0.0, near]);
    // Where the sides of the wedge come nearer than that, they count only if its middle meets something there.
    let begin = if close > foot { 0.0 } else { near };
    let visible = |[inner, outer, b]: [f64; 3], begin: f64| {
        let horizon = horizon(field, &start, lift, &disc, b, [begin, f64::INFINITY]);
        share(inner, outer, horizon.clamp(foot, head))
    };
    let [middle, left, right] = SLICES;
    2.0 * visible(middle, 0.0) + visible(left, begin) + visible(right, begin)
}

/// The height climbed on the way to the disc's centre from which on the wedge reaches [`NEAR_TEXELS`] from its middle, along the
/// axis on which it is slower.
fn near(start: &Line, disc: &LightDisc) -> f64 {
    let travel = |b: f64| disc.line(start.lattice, start.height, disc.direction([0.0, b])).travel;
    let (centre, edge) = (travel(0.0), travel(1.0));
    let (major, minor) = if centre[1].abs() > centre[0].abs() { (1, 0) } else { (0, 1) };
    let across = [0, 1].map(|axis| edge[axis] - centre[axis]);
    NEAR_TEXELS / (across[minor] - across[major] * centre[minor] / centre[major]).abs()
}

/// How high above the disc's centre the horizon stands in the slice at b, in radii: over part of the way, by the height that the
/// ray to the middle of the slice climbs. The line starts `lift` above the surface.
fn horizon(field: &HeightField, start: &Line, lift: f64, disc: &LightDisc, b: f64, [begin, end]: [f64; 2]) -> f64 {
    let [x, y, up] = disc.direction([0.0, b]);
    let middle = disc.line(start.lattice, start.height, [x, y, up]);
    // The slowest ray that counts leaves the highest height behind here.
    let slowest = climb_at(disc, disc.horizon()).max(1e-4);
    let end = end.min((field.range[1] - start.height) / slowest);
    // Level, so that what a stretch says of the gap is how far the surface stands up.
    let level = Line { rise: 0.0, ..middle };
    let mut steepest = 0.0_f64;
    for stretch in level.stretches(field, begin, end) {
        // Height above the start over t, for t = stretch.t + s: at both ends, and at a crest between.
        let [c, b, a] = if stretch.t == 0.0 { [lift, stretch.gap[1], stretch.gap[2]] } else { stretch.gap };
        // At its very start a line upon the surface has to clear its slope, and one above it nothing.
        let at_start = if lift > 0.0 { f64::NEG_INFINITY } else { -b };
        let needed = |s: f64| if stretch.t + s > 0.0 { -(c + s * (b + s * a)) / (stretch.t + s) } else { at_start };
        let mut candidates = vec![0.0, stretch.length];
        // c + b s + a s² = −needed (t + s) has its derivative vanish where a s² + 2 a t s + b t − c does.
        let (t, root) = (stretch.t, stretch.t * stretch.t - (b * stretch.t - c) / a);
        if a != 0.0 && root >= 0.0 {
            candidates.extend([-t + root.sqrt(), -t - root.sqrt()].into_iter().filter(|s| *s > 0.0 && *s < stretch.length));
        }
        steepest = candidates.into_iter().map(needed).fold(steepest, f64::max);
    }
    // A direction straight up from the middle of the slice: (x, y, up · climb).
    let [cosine, sine] = disc.elevation;
    let up = up * steepest;
    (up * cosine - x * sine) / (x * cosine + up * sine) / disc.radius
}

/// How fast a ray climbs, in units of the centre's, that passes a above the centre.
fn climb_at(disc: &LightDisc, a: f64) -> f64 {
    let [cosine, sine] = disc.elevation;
    let elevation = sine.atan2(cosine) + (a * disc.radius).atan();
    if elevation >= FRAC_PI_2 { f64::INFINITY } else { elevation.tan() * cosine / sine }
}

/// The share of the unit disc that is in a slice and above a: numbers of an integral that is seldom needed in closed form, over
/// chords.
fn share(inner: f64, outer: f64, a: f64) -> f64 {
    // Simpson's rule in the angle whose sine is b, in which the chord's end is smooth.
    let (from, to) = (inner.asin(), outer.asin());
    // The kink lies where the chord ends at a.
    let kink = (1.0 - a * a).max(0.0).sqrt().asin().clamp(from, to);
    let chord = |angle: f64| {
        let half = angle.cos();
        (half - a).clamp(0.0, 2.0 * half) * half
    };
    let simpson = |from: f64, to: f64| {
        let steps = 32;
        let width = (to - from) / f64::from(2 * steps);
        let at = |i: i32| chord(from + f64::from(i) * width);
        (0..steps).map(|i| at(2 * i) + 4.0 * at(2 * i + 1) + at(2 * i + 2)).sum::<f64>() * width / 3.0
    };
    (simpson(from, kink) + simpson(kink, to)) * FRAC_1_PI
}
