//! Steep parallax mapping against its reference.

use rilievo::reference::{Ray, trace_steep};
use rilievo::surface::Technique;

use crate::support::techniques::{flat, hold};

#[test]
fn rays_end_where_the_reference_does() {
    hold(Technique::Steep, |_| {});
    hold(Technique::Steep, |view| view.steep_layers = 7.0);
}

#[test]
fn it_stops_at_the_first_layer_below_the_surface() {
    // Ten layers: 0.65 lies between the fourth, at 0.7, and the fifth, at 0.6.
    let hit = trace_steep::trace(&flat(0.65), &Ray::view([0.0, 0.0], [20.0, 0.0]), 10.0);
    assert!((hit.height - 0.6).abs() < 1e-12 && hit.steps == 5, "{hit:?}");
}
