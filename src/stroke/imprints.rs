//! Imprints: a text or an image that a scene presses at its time, once or again and again.

use super::{Lattice, due, numbers_between};
use crate::field::stamp::{ImageForm, Stamp};
use crate::scene::Imprint;

/// An imprint is not pressed before there is time: the first frame is the untouched start.
const EARLIEST_SECONDS: f64 = 1e-6;

/// The stamps of an imprint, whose image has this number, after one time and until another, both seconds.
pub fn between(
    imprint: &Imprint,
    number: u32,
    lattice: &Lattice,
    after_seconds: f64,
    until_seconds: f64,
) -> impl Iterator<Item = Stamp> + use<> {
    let at = f64::from(imprint.at_seconds).max(EARLIEST_SECONDS);
    let every = f64::from(imprint.every_seconds);
    let once = !due(at, after_seconds) && due(at, until_seconds);
    let again =
        if every > 0.0 { numbers_between(1.0 / every, 0.0, after_seconds - at, until_seconds - at) } else { 0..u64::from(once) };
    let stamp = pressed(imprint, number, lattice, imprint.centre.map(f64::from));
    again.map(move |time| Stamp { at_seconds: at + time as f64 * every, ..stamp })
}

/// An imprint at a point of the plane.
pub fn pressed(imprint: &Imprint, number: u32, lattice: &Lattice, uv: [f64; 2]) -> Stamp {
    let half = 0.5 * lattice.texels(f64::from(imprint.width_metres));
    // Images are squares by the time they are pressed.
    let form = ImageForm { number, half_extent: [half, half * imprint.stretch], turn: imprint.turn_degrees.to_radians() };
    Stamp { height: -lattice.heights(f64::from(imprint.depth_metres)), bare: 0.6, ..Stamp::of_image(form, lattice.at(uv)) }
}
