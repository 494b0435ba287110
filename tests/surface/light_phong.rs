//! Blinn–Phong: the shader against its reference, and where it is dark.

use glam::DVec3;
use rilievo::reference::light_phong;
use rilievo::surface::Shading;

use crate::support::fields::Random;
use crate::support::gpu::gpu;
use crate::support::lit;
use crate::support::tolerances::LIGHT;

#[test]
fn the_shader_lights_as_the_reference_does() {
    let Some(gpu) = gpu() else { return };
    let mut random = Random::new(81);
    let list: Vec<_> = (0..50_000).map(|_| lit::random(&mut random)).collect();
    let largest = lit::largest_difference(gpu, Shading::Phong, &list, light_phong::light);
    println!("largest difference {largest:.2e}");
    assert!(largest < LIGHT, "{largest}");
}

#[test]
fn a_light_behind_the_surface_lights_nothing() {
    let Some(gpu) = gpu() else { return };
    let mut random = Random::new(82);
    let list: Vec<_> = (0..1_000)
        .map(|_| {
            let mut item = lit::random(&mut random);
            item.toward_light[1] = -item.toward_light[1];
            item
        })
        .collect();
    for shading in [Shading::Phong, Shading::Ggx] {
        assert!(lit::light(gpu, shading, &list).iter().all(|radiance| *radiance == DVec3::ZERO), "{shading:?}");
    }
}

#[test]
fn the_highlight_is_brightest_where_the_view_is_mirrored() {
    let mut random = Random::new(83);
    for _ in 0..1_000 {
        let mut item = lit::random(&mut random);
        item.matter.albedo = [0.0; 3];
        let toward = |item: &mut rilievo::surface::light_probe::Lit| light_phong::light(item).x;
        let [x, y, z] = item.toward_eye;
        let cosine = f64::from(item.toward_light[1]);
        let elsewhere = toward(&mut item) / cosine.max(1e-9);
        item.toward_light = [-x, y, -z];
        assert!(toward(&mut item) / f64::from(y).max(1e-9) >= elsewhere);
    }
}
