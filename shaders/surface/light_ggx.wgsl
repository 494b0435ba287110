// A physically based light model: a microfacet highlight and a matt part beneath it, which gets what the highlight leaves.
//
//   f = D V F + (1 − metallic) · albedo / π · (1 − F(n·l)) (1 − F(n·v)) / (1 − F̄)
//
// D is GGX, V the height-correlated Smith visibility over 4 (n·l) (n·v) (Heitz 2014), F Schlick's Fresnel, F̄ its mean over the
// cosine. The matt part's factor is reciprocal, and over a smooth surface it makes the sum exactly 1 (Kelemen and
// Szirmay-Kalos 2001, with Fresnel in place of the highlight's albedo); rough ones exceed that by up to 0.0030, which a
// constant takes off. The usual Lambert times 1 − F(v·h) would shine twice as bright as what falls in, where it is grazed.
//
// Light that bounces between the facets is not followed: a white metal reflects 0.995 of it at roughness ¼, 0.916 at ½ and
// 0.307 at 1, seen head-on. The test prints the table.
//
// Specification: src/reference/light_ggx.rs. Needs surface/matter.

// A smoother surface would be a mirror, in which a light without extent is a point that no pixel meets.
const LIGHT_GGX_SMOOTHEST: f32 = 0.045;
// By what the matt part and the highlight together would exceed 1, and a little.
const LIGHT_GGX_EXCESS: f32 = 1.0035;

fn light_ggx_fresnel(head_on: vec3f, cosine: f32) -> vec3f {
    let grazing = pow(1.0 - saturate(cosine), 5.0);
    return head_on + (1.0 - head_on) * grazing;
}

// Reflectance head-on: up to 8 % for a dielectric (glass has 4 %), the albedo for a metal.
fn light_ggx_head_on(matter: Matter) -> vec3f {
    return mix(vec3f(0.08 * matter.specular), matter.albedo, matter.metallic);
}

// 1 − F for the dielectric that covers the matt part.
fn light_ggx_passes(matter: Matter, cosine: f32) -> f32 {
    return (1.0 - 0.08 * matter.specular) * (1.0 - pow(1.0 - saturate(cosine), 5.0));
}

// Radiance toward the eye under light from one direction, over what a white, matt surface that faces the light shows: π times
// the BRDF times the cosine.
fn light(matter: Matter, normal: vec3f, toward_eye: vec3f, toward_light: vec3f) -> vec3f {
    let to_light = dot(normal, toward_light);
    if to_light <= 0.0 {
        return vec3f(0.0);
    }
    // A relief's normal may face away from the eye that sees it: as if grazed.
    let to_eye = max(dot(normal, toward_eye), 1e-3);
    let halfway = normalize(toward_eye + toward_light);
    let roughness = max(matter.roughness, LIGHT_GGX_SMOOTHEST);
    let alpha = roughness * roughness;
    // D = α² / (π ((n·h)² (α² − 1) + 1)²), where (n·h)² near 1 would round its difference from 1 away.
    let across = cross(normal, halfway);
    let along = max(dot(normal, halfway), 0.0) * alpha;
    let peak = alpha / (dot(across, across) + along * along);
    let squared = alpha * alpha;
    let masked = to_light * sqrt(to_eye * to_eye * (1.0 - squared) + squared)
        + to_eye * sqrt(to_light * to_light * (1.0 - squared) + squared);
    let fresnel = light_ggx_fresnel(light_ggx_head_on(matter), dot(toward_eye, halfway));
    // π D V; D's own π cancels.
    let highlight = peak * peak * 0.5 / masked * fresnel;
    let mean_passes = (1.0 - 0.08 * matter.specular) * (20.0 / 21.0);
    let passes = light_ggx_passes(matter, to_light) * light_ggx_passes(matter, to_eye) / (mean_passes * LIGHT_GGX_EXCESS);
    return to_light * (highlight + (1.0 - matter.metallic) * matter.albedo * passes);
}

// Radiance toward the eye under the surroundings: `ambient` is the mean radiance that falls upon the surface, `mirrored` what
// lies where the view is reflected, `cosine` that of the normal and the direction toward the eye.
//
// The highlight's albedo is F₀ a + b of Karis' fit (2014, "Physically Based Shading on Mobile"). What does not mirror its
// surroundings reflects their mean: a metal is never black.
fn light_around(matter: Matter, cosine: f32, ambient: vec3f, mirrored: vec3f) -> vec3f {
    let r = matter.roughness * vec4f(-1.0, -0.0275, -0.572, 0.022) + vec4f(1.0, 0.0425, 1.04, -0.04);
    let a004 = min(r.x * r.x, exp2(-9.28 * saturate(cosine))) * r.x + r.y;
    let fit = vec2f(-1.04, 1.04) * a004 + r.zw;
    let highlight = light_ggx_head_on(matter) * fit.x + saturate(50.0 * max(matter.specular, matter.metallic)) * fit.y;
    let diffuse = (1.0 - matter.metallic) * matter.albedo * light_ggx_passes(matter, cosine);
    return diffuse * ambient + highlight * mix(ambient, mirrored, matter.reflection);
}

// How blurred it mirrors.
fn light_roughness(matter: Matter) -> f32 {
    return matter.roughness;
}
