//! Parallax mapping with offset limiting against its reference.

use rilievo::reference::{Ray, trace_parallax_limited};
use rilievo::surface::Technique;

use crate::support::rays;
use crate::support::techniques::{cosine, flat, hold, view_rays};

#[test]
fn rays_end_where_the_reference_does() {
    hold(Technique::ParallaxLimited, |_| {});
}

#[test]
fn the_offset_is_never_longer_than_the_surface_is_deep() {
    let field = flat(0.25);
    let view = rays::view(&field);
    // 0.75 of a depth of 100 texels.
    let deep = 75.0;
    let mut longest = 0.0_f64;
    for ray in view_rays(47, 1_000, field.size).into_iter().chain([Ray::view([0.0, 0.0], [1e5, 0.0])]) {
        let hit = trace_parallax_limited::trace(&field, &ray, cosine(&view, &ray));
        longest = longest.max(rays::distance(hit.lattice, ray.lattice_at(0.0)));
    }
    assert!(longest <= deep && longest > 0.999 * deep, "{longest}");
}
