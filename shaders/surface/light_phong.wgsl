// Blinn–Phong, the light model of the papers ([POM] §4, [Zink]): a matt part, and a highlight about the halfway vector.
//
// The highlight is normalised, so that a tighter one is a brighter one: (n + 8) / 25 stands for (n + 8) / 8π of a light whose
// white, matt surface shows π / 3. It is multiplied by the cosine like the matt part, so that it dies where the light sets.
//
// Specification: src/reference/light_phong.rs. Needs surface/matter.

// Radiance toward the eye under light from one direction, over what a white, matt surface that faces the light shows: π times
// the BRDF times the cosine.
fn light(matter: Matter, normal: vec3f, toward_eye: vec3f, toward_light: vec3f) -> vec3f {
    let halfway = normalize(toward_eye + toward_light);
    let diffuse = max(dot(normal, toward_light), 0.0);
    let highlight = matter.specular * (matter.shininess + 8.0) / 25.0 * pow(max(dot(normal, halfway), 0.0), matter.shininess);
    return diffuse * (matter.albedo + highlight);
}

// Radiance toward the eye under the surroundings: `ambient` is the mean radiance that falls upon the surface, `mirrored` what
// lies where the view is reflected, `cosine` that of the normal and the direction toward the eye. Schlick's Fresnel, of 4 %
// head-on as most dielectrics.
fn light_around(matter: Matter, cosine: f32, ambient: vec3f, mirrored: vec3f) -> vec3f {
    let fresnel = 0.04 + 0.96 * pow(1.0 - saturate(cosine), 5.0);
    return matter.albedo * ambient + matter.reflection * fresnel * mirrored;
}

// How blurred it mirrors: the roughness whose GGX lobe is as wide as the highlight (Walter et al. 2007: n = 2 / α² − 2).
fn light_roughness(matter: Matter) -> f32 {
    return sqrt(sqrt(2.0 / (matter.shininess + 2.0)));
}
