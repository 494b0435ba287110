//! The linear search alone against its reference, and against `pom`, whose samples it takes.

use rilievo::scene::PomCounts;
use rilievo::surface::Technique;

use crate::support::fields::Kind;
use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::techniques::{hold, view_rays};

#[test]
fn rays_end_where_the_reference_does() {
    hold(Technique::PomLinear, |_| {});
    hold(Technique::PomLinear, |view| view.pom_counts = PomCounts::Texels as u32);
}

#[test]
fn it_ends_at_the_sample_below_the_segment_that_pom_cuts() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Elevation.field([200, 150], rilievo::reference::Addressing::Wrap);
    let (view, rays) = (rays::view(&field), view_rays(48, 5_000, field.size));
    let textures = rays::upload(gpu, &field);
    let linear = rays::trace(gpu, Technique::PomLinear, &textures, &view, &rays);
    let pom = rays::trace(gpu, Technique::Pom, &textures, &view, &rays);
    for (linear, pom) in linear.iter().zip(&pom) {
        let apart = linear.t - pom.t;
        assert!(linear.steps == pom.steps && (0.0..=1.0 / view.pom_samples_min).contains(&apart), "{linear:?} {pom:?}");
    }
}
