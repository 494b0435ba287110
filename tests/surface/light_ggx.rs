//! GGX: the shader against its reference; that the reference is a light model at all: its facets cover the surface, light may go
//! either way, nothing shines more than falls in, and what single scattering loses is what the shader's header says.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use rilievo::reference::light_ggx::{self, distribution};
use rilievo::surface::Shading;
use rilievo::surface::light_probe::{Lit, Matter};

use crate::support::fields::Random;
use crate::support::gpu::gpu;
use crate::support::lit;
use crate::support::tolerances::{DISTRIBUTION_INTEGRAL, FURNACE, FURNACE_STATED, LIGHT, RECIPROCITY};

#[test]
fn the_shader_lights_as_the_reference_does() {
    let Some(gpu) = gpu() else { return };
    let mut random = Random::new(91);
    let mut list: Vec<_> = (0..50_000).map(|_| lit::random(&mut random)).collect();
    // About the mirrored view, where smooth surfaces are bright and rounding has the longest lever.
    for item in list.iter_mut().skip(25_000) {
        let mirrored = DVec3::from(item.toward_eye.map(f64::from)) * DVec3::new(-1.0, 1.0, -1.0);
        let near = (mirrored + 0.02 * lit::direction(&mut random)).normalize();
        item.toward_light = near.as_vec3().to_array();
        item.matter.roughness = item.matter.roughness.max(0.1);
    }
    let largest = lit::largest_difference(gpu, Shading::Ggx, &list, light_ggx::light);
    println!("largest difference {largest:.2e}");
    assert!(largest < LIGHT, "{largest}");
}

#[test]
fn the_facets_cover_the_surface_once() {
    for alpha in [0.002, 0.01, 0.1, 0.3, 0.7, 1.0] {
        // tan θ = α √(u / (1 − u)) follows the lobe: what is left to integrate is smooth, here even constant.
        let count = 4_000;
        let sum: f64 = (0..count)
            .map(|i| {
                let share = (f64::from(i) + 0.5) / f64::from(count);
                let tangent_squared = alpha * alpha * share / (1.0 - share);
                let cosine_squared = 1.0 / (1.0 + tangent_squared);
                // d(sin²θ) = d(tan²θ) cos⁴θ; the projected solid angle is π d(sin²θ).
                let slope = alpha * alpha / (1.0 - share).powi(2);
                distribution(cosine_squared.sqrt(), alpha) * PI * slope * cosine_squared * cosine_squared
            })
            .sum();
        let integral = sum / f64::from(count);
        assert!((integral - 1.0).abs() < DISTRIBUTION_INTEGRAL, "α = {alpha}: {integral}");
    }
}

#[test]
fn light_may_go_either_way() {
    let mut random = Random::new(92);
    for _ in 0..10_000 {
        let there = lit::random(&mut random);
        let back = Lit { toward_eye: there.toward_light, toward_light: there.toward_eye, ..there };
        // The BRDF is what the light model says over the light's cosine; a grazing eye is treated as if less so.
        let cosine = |lit: &Lit| f64::from(lit.toward_light[1]);
        if cosine(&there).min(cosine(&back)) < 2e-3 {
            continue;
        }
        let [one, other] = [there, back].map(|lit| light_ggx::light(&lit) / lit.directions()[2].y);
        assert!((one - other).abs().max_element() <= RECIPROCITY * one.max_element().max(1.0), "{one} {other}");
    }
}

/// Share of the light from everywhere that a white surface reflects toward an eye of this cosine.
fn furnace(matter: Matter, cosine: f64) -> f64 {
    let alpha = f64::from(matter.roughness).max(light_ggx::SMOOTHEST).powi(2);
    let eye = DVec3::new((1.0 - cosine * cosine).sqrt(), cosine, 0.0);
    let (rings, spokes) = (256, 256);
    let mut sum = 0.0;
    for ring in 0..rings {
        for spoke in 0..spokes {
            // Half of the lights are those that facets drawn from D reflect toward the eye, half are drawn over the cosine;
            // each is weighted by the density of both, and is finite wherever either is.
            let (u, v) = ((f64::from(ring) + 0.5) / f64::from(rings), (f64::from(spoke) + 0.5) / f64::from(spokes));
            let tangent = alpha * (u / (1.0 - u)).sqrt();
            let up = 1.0 / (1.0 + tangent * tangent).sqrt();
            let facet = DVec3::new(tangent * up * (TAU * v).cos(), up, tangent * up * (TAU * v).sin());
            let across = u.sqrt();
            let even = DVec3::new(across * (TAU * v).cos(), (1.0 - u).sqrt(), across * (TAU * v).sin());
            for light in [2.0 * eye.dot(facet) * facet - eye, even] {
                if light.y <= 0.0 {
                    continue;
                }
                let halfway = (eye + light).normalize();
                let by_facets = distribution(halfway.y, alpha) * halfway.y / (4.0 * eye.dot(halfway));
                let density = 0.5 * (by_facets + light.y / PI);
                sum += reflected(matter, eye, light) / density / 2.0;
            }
        }
    }
    sum / f64::from(rings * spokes)
}

/// The BRDF times the cosine, in f64 directions: those of a list are f32, too coarse for a mirror.
fn reflected(matter: Matter, eye: DVec3, light: DVec3) -> f64 {
    light_ggx::reflected(&matter, [DVec3::Y, eye, light]).x / PI
}

#[test]
fn nothing_shines_more_than_falls_in() {
    let mut most: f64 = 0.0;
    for specular in [0.0, 0.2, 0.5, 1.0] {
        for roughness in [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.85, 1.0] {
            for metallic in [0.0, 0.5, 1.0] {
                for cosine in [0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1.0] {
                    let matter = Matter { albedo: [1.0; 3], specular, roughness, metallic, ..Matter::default() };
                    most = most.max(furnace(matter, cosine));
                }
            }
        }
    }
    println!("most of the light from everywhere that comes back: {most:.5}");
    assert!(most <= 1.0 + FURNACE, "{most}");
    // A bound that nothing comes near would hold nothing.
    assert!(most > 0.99, "{most}");
}

/// What the header of the shader says.
#[test]
fn single_scattering_loses_what_is_stated() {
    println!("white metal, share of the light from everywhere that comes back, by roughness and cosine of the eye");
    for roughness in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let matter = Matter { albedo: [1.0; 3], roughness, metallic: 1.0, ..Matter::default() };
        let row: Vec<_> = [0.05, 0.1, 0.2, 0.5, 0.8, 1.0].map(|cosine| format!("{:.3}", furnace(matter, cosine))).to_vec();
        println!("{roughness:4} {}", row.join(" "));
    }
    for (roughness, stated) in [(0.25, 0.995), (0.5, 0.916), (1.0, 0.307)] {
        let metal = Matter { albedo: [1.0; 3], roughness, metallic: 1.0, ..Matter::default() };
        let found = furnace(metal, 1.0);
        assert!((found - stated).abs() < FURNACE_STATED, "{roughness}: {found}");
    }
}
