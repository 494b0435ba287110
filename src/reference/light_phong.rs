//! Blinn–Phong. Specification of `shaders/surface/light_phong.wgsl`.

use glam::DVec3;

use crate::surface::light_probe::{Lit, Matter};

/// Radiance toward the eye, over what a white, matt surface that faces the light shows.
pub fn light(lit: &Lit) -> DVec3 {
    let [normal, eye, light] = lit.directions();
    let Matter { albedo, specular, shininess, .. } = lit.matter;
    let (specular, shininess) = (f64::from(specular), f64::from(shininess));
    let cosine = normal.dot(light).max(0.0);
    let lobe = normal.dot((eye + light).normalize()).max(0.0).powf(shininess);
    let highlight = specular * (shininess + 8.0) / 25.0 * lobe;
    DVec3::from(albedo.map(f64::from)) * cosine + DVec3::splat(highlight * cosine)
}
