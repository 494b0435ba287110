//! Parallax occlusion mapping against its reference, and that it moves smoothly with its count.

use rilievo::reference::{Addressing, Ray};
use rilievo::scene::PomCounts;
use rilievo::surface::probe::Hit;
use rilievo::surface::{Technique, View};

use crate::support::fields::Kind;
use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::techniques::{hold, view_rays};
use crate::support::tolerances;

#[test]
fn rays_end_where_the_reference_does() {
    hold(Technique::Pom, |_| {});
    hold(Technique::Pom, |view| view.pom_counts = PomCounts::Texels as u32);
}

/// Rounded counts show as bands: the hit on a smooth field has to move smoothly with the count, through whole numbers too.
#[test]
fn a_fraction_of_a_sample_moves_the_hit_by_little() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Waves.field([1024, 1024], Addressing::Wrap);
    // Steep enough that no ray grazes.
    let rays: Vec<_> = view_rays(46, 500, field.size)
        .into_iter()
        .map(|ray| {
            let length = rays::distance(ray.travel.map(f64::from), [0.0, 0.0]) as f32;
            Ray { travel: ray.travel.map(|travel| travel / length * 60.0), ..ray }
        })
        .collect();
    let textures = rays::upload(gpu, &field);
    let mut before: Option<Vec<Hit>> = None;
    for hundredth in 780..=1_220 {
        let count = hundredth as f32 * 0.01;
        let view = View { pom_samples_min: count, pom_samples_max: count, ..rays::view(&field) };
        let hits = rays::trace(gpu, Technique::Pom, &textures, &view, &rays);
        if let Some(before) = before {
            let jumps = hits.iter().zip(&before).map(|(a, b)| (a.t - b.t).abs());
            let largest = jumps.fold(0.0, f32::max);
            assert!(f64::from(largest) <= tolerances::POM_JUMP, "{largest} at {count}");
        }
        before = Some(hits);
    }
}
