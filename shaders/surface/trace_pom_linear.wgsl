// The linear search of parallax occlusion mapping alone ([POM] fig. 4): where the first sample is that is not above the surface.
//
// The same samples as `pom`, so that side by side they show what the segment is worth: without it every step is a terrace.
//
// Specification: src/reference/trace_pom_linear.rs. Needs surface/march.

fn trace(ray: Ray) -> Hit {
    let found = march(ray, detail_samples(march_samples(ray)));
    if found.gap > 0.0 {
        return end_of(ray, found.steps);
    }
    return hit_at(ray, found.t, found.steps);
}
