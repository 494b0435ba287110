// Steep parallax mapping ([Steep]): equal layers from the polygon down, and the first of them that is not above the surface.
//
// The count is one for all angles, and nothing is interpolated. [Steep]'s listing adds E.xy / E.z with E from the eye to the
// texture coordinate, which for a ray that falls has the wrong sign: the ray travels along E.xy.
//
// Specification: src/reference/trace_steep.rs. Needs surface/march.

fn trace(ray: Ray) -> Hit {
    let found = march(ray, detail_samples(view.steep_layers));
    if found.gap > 0.0 {
        return end_of(ray, found.steps);
    }
    return hit_at(ray, found.t, found.steps);
}
