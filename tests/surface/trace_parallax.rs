//! Parallax mapping against its reference.

use rilievo::reference::{Ray, trace_parallax};
use rilievo::surface::Technique;

use crate::support::techniques::{flat, hold};

#[test]
fn rays_end_where_the_reference_does() {
    hold(Technique::Parallax, |_| {});
}

#[test]
fn the_offset_is_what_kaneko_says() {
    // −(1 − h) · depth · V.xy / V.z: 45° over a depth of 100 texels, V toward the eye from the left.
    let hit = trace_parallax::trace(&flat(0.75), &Ray::view([7.0, 5.0], [100.0, 0.0]));
    assert_eq!((hit.lattice, hit.height), ([32.0, 5.0], 0.75));
}
