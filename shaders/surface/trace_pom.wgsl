// Parallax occlusion mapping: a linear search down the ray, then the ray against the last linear segment of the profile
// ([POM] §3.1, fig. 6).
//
// Specification: src/reference/trace_pom.rs. Needs surface/march.

fn trace(ray: Ray) -> Hit {
    let found = march(ray, detail_samples(march_samples(ray)));
    if found.gap > 0.0 {
        return end_of(ray, found.steps);
    }
    if found.gap_above <= 0.0 {
        // It starts under the surface.
        return hit_at(ray, 0.0, found.steps);
    }
    return hit_at(ray, mix(found.t_above, found.t, found.gap_above / (found.gap_above - found.gap)), found.steps);
}
