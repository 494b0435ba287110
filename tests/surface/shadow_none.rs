//! Without shadows the light reaches everything.

use rilievo::reference::{Addressing, Ray, shadow_none};
use rilievo::surface::Shadow;

use crate::support::fields::{Kind, Random};
use crate::support::gpu::gpu;
use crate::support::rays;

#[test]
fn nothing_is_in_the_way() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Noise.field([16, 16], Addressing::Clamp);
    let mut random = Random::new(31);
    let list: Vec<_> = (0..100)
        .map(|_| {
            let (lattice, travel) = rays::random_ray(&mut random, field.size);
            Ray::shadow(lattice, travel, 0.0)
        })
        .collect();
    let seen = rays::shadow(gpu, Shadow::None, &rays::upload(gpu, &field), &rays::view(&field), &list);
    assert!(list.iter().zip(seen).all(|(ray, seen)| f64::from(seen) == shadow_none::shadow(ray)));
}
