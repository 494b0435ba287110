//! Normal mapping moves nothing.

use rilievo::reference::{Addressing, Ray, trace_normal};
use rilievo::surface::Technique;
use rilievo::surface::probe::Hit;

use crate::support::fields::{Kind, Random};
use crate::support::gpu::gpu;
use crate::support::rays;

#[test]
fn every_ray_ends_where_it_starts() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Noise.field([37, 41], Addressing::Wrap);
    let mut random = Random::new(21);
    let list: Vec<_> = (0..1_000)
        .map(|_| {
            let (lattice, travel) = rays::random_ray(&mut random, field.size);
            Ray::view(lattice, travel)
        })
        .collect();
    let hits = rays::trace(gpu, Technique::Normal, &rays::upload(gpu, &field), &rays::view(&field), &list);
    for (ray, hit) in list.iter().zip(hits) {
        let expected = trace_normal::trace(ray);
        assert_eq!(hit.lattice.map(f64::from), expected.lattice);
        assert_eq!((f64::from(hit.t), f64::from(hit.height), hit.steps), (expected.t, expected.height, expected.steps));
        assert_eq!(hit.status, Hit::HIT);
    }
}
