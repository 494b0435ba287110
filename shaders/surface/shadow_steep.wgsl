// Steep shadows ([Steep], Self-Shadowing): the march of steep parallax mapping, toward the light.
//
//   height  r32float  read  through sample_height, level 0: up to shadow_samples + 1 bilinear samples  16 bytes each
//
// Layer after layer of 1 / shadow_samples of the height range, without interpolation; the first sample above the ray blocks it.
// The poster prints the step as −L.xy / L.z, which marches away from the light: climbing moves the lattice position toward it.
//
// Specification: src/reference/shadow_steep.rs. Needs common/view, surface/ray and a height part.

fn shadow(ray: Ray) -> f32 {
    let surface = sample_height(ray_at(ray, 0.0));
    let step = 1.0 / view.shadow_samples;
    for (var i = 1u; surface + f32(i) * step < 1.0; i++) {
        let t = f32(i) * step;
        if sample_height(ray_at(ray, t)) > surface + t {
            return 0.0;
        }
    }
    return 1.0;
}
