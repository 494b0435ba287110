//! Surfaces under lights, for the proofs of light models.

use glam::DVec3;
use rilievo::gpu::Gpu;
use rilievo::surface::light_probe::{Lit, Matter};
use rilievo::surface::{Choice, LightProbe, Shading};

use super::fields::Random;
use super::gpu::wait_for;

/// A direction of the upper hemisphere, all alike.
pub fn direction(random: &mut Random) -> DVec3 {
    let (height, turn) = (f64::from(random.uniform(0.0, 1.0)), std::f64::consts::TAU * f64::from(random.uniform(0.0, 1.0)));
    let across = (1.0 - height * height).sqrt();
    DVec3::new(across * turn.cos(), height, across * turn.sin())
}

/// Any surface under any light.
pub fn random(random: &mut Random) -> Lit {
    let mut share = || random.uniform(0.0, 1.0);
    let matter = Matter {
        albedo: [share(), share(), share()],
        specular: share(),
        shininess: 512_f32.powf(share()),
        roughness: share(),
        metallic: share(),
        reflection: share(),
        ..Matter::default()
    };
    let [normal, toward_eye, toward_light] =
        [DVec3::Y, direction(random), direction(random)].map(|direction| direction.as_vec3().to_array());
    Lit { matter, normal, toward_eye, toward_light, ..Lit::default() }
}

/// What the shader makes of them.
pub fn light(gpu: &Gpu, shading: Shading, lit: &[Lit]) -> Vec<DVec3> {
    let choice = Choice { shading, ..Choice::PLAIN };
    let probe = LightProbe::new(gpu, choice).expect("the shader compiles");
    let values: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&wait_for(gpu, &probe.light(gpu, lit)));
    values.into_iter().map(|[x, y, z, _]| DVec3::new(x.into(), y.into(), z.into())).collect()
}

/// The largest difference between the shader and a reference, over the larger of the value and 1.
pub fn largest_difference(gpu: &Gpu, shading: Shading, lit: &[Lit], reference: impl Fn(&Lit) -> DVec3) -> f64 {
    let pairs = lit.iter().zip(light(gpu, shading, lit));
    pairs
        .map(|(lit, shader)| {
            let expected = reference(lit);
            (shader - expected).abs().max_element() / expected.max_element().max(1.0)
        })
        .fold(0.0, f64::max)
}
