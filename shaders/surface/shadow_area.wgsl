// Area shadows, the truth of a light that is a disc: the share of its points that no hit of the exact traversal hides.
//
// Every receiver takes the same points of the disc, so that nothing flickers and a blocker that grows never lets more light
// through.
//
// Specification: src/reference/shadow_area.rs. Needs surface/traversal and surface/light_disc.

fn shadow(ray: Ray) -> f32 {
    let start = load_surface(ray_at(ray, 0.0)) + TRAVERSAL_LIFT;
    let disc = light_disc(light_toward(ray), view.light_radius);
    var seen = 0u;
    for (var i = 0u; i < view.area_samples; i++) {
        let point = light_disc_point(i, view.area_samples);
        if light_disc_climb(disc, point) > disc.lowest && traversal_escapes(ray, start, light_disc_travel(disc, point)) {
            seen += 1u;
        }
    }
    return f32(seen) / f32(view.area_samples);
}
