// Hard shadows: any hit of the exact traversal on the way to the light.
//
// The ray starts upon the surface below or above `ray.lattice`, not at `ray.height`: a technique that finds the surface only
// nearly would shadow itself.
//
// Specification: src/reference/shadow_hard.rs. Needs surface/traversal.

fn shadow(ray: Ray) -> f32 {
    let start = load_surface(ray_at(ray, 0.0)) + TRAVERSAL_LIFT;
    return select(0.0, 1.0, traversal_escapes(ray, start, ray.travel));
}
