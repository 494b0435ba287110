//! GGX microfacets over a matt base. Specification of `shaders/surface/light_ggx.wgsl`.

use std::f64::consts::PI;

use glam::DVec3;

use crate::surface::light_probe::{Lit, Matter};

/// The least roughness.
pub const SMOOTHEST: f64 = 0.045;

/// What keeps the matt part and the highlight together from exceeding 1.
pub const EXCESS: f64 = 1.0035;

/// Density of facets, a steradian, whose normals make this cosine with the surface's: GGX (Walter et al. 2007, eq. 33).
pub fn distribution(cosine: f64, alpha: f64) -> f64 {
    if cosine <= 0.0 {
        return 0.0;
    }
    let squared = alpha * alpha;
    squared / (PI * (cosine * cosine * (squared - 1.0) + 1.0).powi(2))
}

/// Share of the facets that a direction sees by their own shadows alone (Smith): λ in Heitz 2014, eq. 72.
fn lambda(cosine: f64, alpha: f64) -> f64 {
    let tangent_squared = (1.0 - cosine * cosine) / (cosine * cosine);
    0.5 * ((1.0 + alpha * alpha * tangent_squared).sqrt() - 1.0)
}

/// Share of the facets that both directions see, correlated by height (Heitz 2014, eq. 99).
pub fn masking(to_light: f64, to_eye: f64, alpha: f64) -> f64 {
    1.0 / (1.0 + lambda(to_light, alpha) + lambda(to_eye, alpha))
}

/// Schlick's Fresnel.
pub fn fresnel(head_on: f64, cosine: f64) -> f64 {
    head_on + (1.0 - head_on) * (1.0 - cosine).powi(5)
}

/// Radiance toward the eye, over what a white, matt surface that faces the light shows: π times the BRDF times the cosine.
pub fn light(lit: &Lit) -> DVec3 {
    reflected(&lit.matter, lit.directions())
}

/// The same of these directions: the normal, toward the eye, toward the light.
pub fn reflected(matter: &Matter, [normal, eye, light]: [DVec3; 3]) -> DVec3 {
    let to_light = normal.dot(light);
    if to_light <= 0.0 {
        return DVec3::ZERO;
    }
    let to_eye = normal.dot(eye).max(1e-3);
    let halfway = (eye + light).normalize();
    let alpha = f64::from(matter.roughness).max(SMOOTHEST).powi(2);
    let metallic = f64::from(matter.metallic);
    let dielectric = 0.08 * f64::from(matter.specular);
    let facets = distribution(normal.dot(halfway), alpha) * masking(to_light, to_eye, alpha) / (4.0 * to_light * to_eye);
    // The mean of (1 − cosine)⁵ over the cosine is 1/21.
    let mean = dielectric + (1.0 - dielectric) / 21.0;
    let passes = (1.0 - fresnel(dielectric, to_light)) * (1.0 - fresnel(dielectric, to_eye)) / (1.0 - mean) / EXCESS;
    DVec3::from(matter.albedo.map(|albedo| {
        let albedo = f64::from(albedo);
        let head_on = dielectric + (albedo - dielectric) * metallic;
        PI * to_light * (facets * fresnel(head_on, eye.dot(halfway)) + (1.0 - metallic) * albedo / PI * passes)
    }))
}
