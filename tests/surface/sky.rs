//! The sky: the shader against its reference, and the reference against the two colours that it is made of.

use glam::DVec3;
use rilievo::reference::sky::Sky;
use rilievo::surface::light_probe::Lit;
use rilievo::surface::{Choice, LightProbe, View};

use crate::support::fields::Random;
use crate::support::gpu::{gpu, wait_for};
use crate::support::lit;
use crate::support::tolerances::{SKY, SKY_MEAN};

const SKIES: [Sky; 3] = [
    Sky { above: DVec3::new(0.30, 0.37, 0.47), below: DVec3::new(0.13, 0.10, 0.08) },
    Sky { above: DVec3::new(0.0, 0.0, 1.0), below: DVec3::ZERO },
    Sky { above: DVec3::new(0.9, 0.35, 0.1), below: DVec3::new(0.3, 0.3, 0.3) },
];

#[test]
fn the_shader_shows_the_sky_of_the_reference() {
    let Some(gpu) = gpu() else { return };
    let probe = LightProbe::new(gpu, Choice::PLAIN).expect("the shader compiles");
    let mut random = Random::new(101);
    let list: Vec<Lit> = (0..10_000)
        .map(|i| {
            let mut item = lit::random(&mut random);
            // Both hemispheres, and the horizon's edge.
            item.toward_light[1] *= [1.0, -1.0, 0.01, -0.01][i % 4];
            item.toward_light = lit_direction(&item).as_vec3().to_array();
            item
        })
        .collect();
    for sky in SKIES {
        let [above, below] = [sky.above, sky.below].map(|colour| colour.as_vec3().to_array());
        let view = View { sky: above, ground: below, ..View::default() };
        let values: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&wait_for(gpu, &probe.sky(gpu, &view, &list)));
        for (item, value) in list.iter().zip(values) {
            let direction = DVec3::from(item.toward_light.map(f64::from));
            let roughness = f64::from(item.matter.roughness);
            let expected = sky.radiance(direction).lerp(sky.mean(direction), roughness);
            let shader = DVec3::new(value[0].into(), value[1].into(), value[2].into());
            // A square root near the horizon, and the soft edge, magnify the rounding of the direction.
            let slack = SKY * (1.0 + 1.0 / direction.y.abs().max(1e-4).sqrt()) * 8.0;
            assert!((shader - expected).abs().max_element() < slack, "{direction}: {shader} {expected}");
        }
    }
}

fn lit_direction(item: &Lit) -> DVec3 {
    item.directions()[2]
}

/// What a level surface receives is the sky's colour, what one that faces down receives the ground's; and no direction is darker
/// than nothing.
#[test]
fn its_mean_is_the_colour_that_the_scene_calls_it() {
    for sky in SKIES {
        let count = 200_000;
        let mut sums = [DVec3::ZERO; 2];
        for i in 0..count {
            // Over the cosine: y² is even.
            let y = ((f64::from(i) + 0.5) / f64::from(count)).sqrt();
            let across = (1.0 - y * y).sqrt();
            for (sum, up) in sums.iter_mut().zip([1.0, -1.0]) {
                let radiance = sky.radiance(DVec3::new(across, up * y, 0.0));
                assert!(radiance.min_element() >= 0.0, "{radiance}");
                *sum += radiance / f64::from(count);
            }
        }
        for (mean, colour) in sums.into_iter().zip([sky.above, sky.below]) {
            assert!((mean - colour).abs().max_element() < SKY_MEAN, "{mean} {colour}");
        }
        assert!((sky.mean(DVec3::Y) - sky.above).abs().max_element() < 1e-12);
        assert!((sky.mean(DVec3::X) - 0.5 * (sky.above + sky.below)).abs().max_element() < 1e-12);
    }
}
