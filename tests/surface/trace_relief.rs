//! Relief mapping against its reference, and what depth bias does.

use rilievo::reference::{Addressing, Ray, trace_relief};
use rilievo::surface::{Technique, View};

use crate::support::fields::Kind;
use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::techniques::{flat, hold, view_rays};

#[test]
fn rays_end_where_the_reference_does() {
    hold(Technique::Relief, |_| {});
    hold(Technique::Relief, |view| view.relief_depth_bias = 1);
}

#[test]
fn each_halving_finds_a_flat_surface_twice_as_well() {
    let ray = Ray::view([0.0, 0.0], [0.0, 30.0]);
    for halvings in 0..12 {
        let hit = trace_relief::trace(&flat(0.3), &ray, 3.0, halvings, 1.0);
        let width = 0.5_f64.powi(halvings as i32) / 3.0;
        // The nearest end that is not above the surface.
        assert!((0.0..=width).contains(&(f64::from(0.3_f32) - hit.height)), "{halvings}: {hit:?}");
        assert_eq!(hit.steps, 4 + halvings);
    }
}

#[test]
fn bias_leaves_head_on_rays_alone_and_limits_grazing_ones_to_eight_depths() {
    assert_eq!(trace_relief::bias(1.0), 1.0);
    let shares: Vec<_> = (1..=100).map(|percent| trace_relief::bias(f64::from(percent) / 100.0)).collect();
    assert!(shares.windows(2).all(|pair| pair[0] < pair[1]));
    for cosine in [1e-1, 1e-2, 1e-3, 1e-4_f64] {
        let tangent = (1.0 - cosine * cosine).sqrt() / cosine;
        assert!(trace_relief::bias(cosine) * tangent < 8.0);
    }
}

/// [POM] fig. 2b: what grazes is lifted toward the polygon.
#[test]
fn bias_flattens_toward_the_horizon() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Elevation.field([200, 150], Addressing::Wrap);
    // 100 texels deep: 5.7° above the surface.
    let rays: Vec<_> = view_rays(49, 5_000, field.size)
        .into_iter()
        .map(|ray| {
            let length = rays::distance(ray.travel.map(f64::from), [0.0, 0.0]) as f32;
            Ray { travel: ray.travel.map(|travel| travel / length * 1_000.0), ..ray }
        })
        .collect();
    let textures = rays::upload(gpu, &field);
    let depth = |relief_depth_bias: u32| {
        let view = View { relief_depth_bias, ..rays::view(&field) };
        let hits = rays::trace(gpu, Technique::Relief, &textures, &view, &rays);
        hits.iter().map(|hit| f64::from(hit.t)).sum::<f64>() / hits.len() as f64
    };
    let (without, with) = (depth(0), depth(1));
    println!("mean depth {without:.4} without bias, {with:.4} with it");
    assert!(with < 0.8 * without, "{with} of {without}");
}
