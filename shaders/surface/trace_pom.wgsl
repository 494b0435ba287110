// Parallax occlusion mapping: a linear search down the ray, then the ray against the last linear segment of the profile
// ([POM] §3.1, fig. 6).
//
//   height  r32float  read  through sample_height, level 0: one bilinear sample a step                16 bytes
//
// The number of samples n grows from n_min, seen head-on, to n_max, seen edge-on. [POM] eq. 1 prints it the other way round;
// its text and [Zink]'s lerp (with E from the eye, so that its printed dot product is negative) mean this. n is a real number:
// samples lie 1/n apart and the last is at the floor, t = 1, so that one more sample begins as one of no width. Rounded counts
// show as bands.
//
// Specification: src/reference/trace_pom.rs. Needs common/view, surface/ray and a height part.

fn trace_pom_samples(travel: vec2f) -> f32 {
    let travel_metres = travel * view.plane_size_metres / vec2f(view.field_size);
    let cosine = view.depth_metres / max(length(vec3f(travel_metres, view.depth_metres)), 1e-20);
    return max(mix(view.pom_samples_max, view.pom_samples_min, saturate(cosine)), 1.0);
}

fn trace(ray: Ray) -> Hit {
    let step = 1.0 / trace_pom_samples(ray.travel);
    var t = 0.0;
    var gap = ray.height - sample_height(ray_at(ray, 0.0));
    var steps = 1u;
    // The ray is at the floor, under everything, where t = ray.height: this ends there.
    while gap > 0.0 && t < ray.height {
        let t_above = t;
        let gap_above = gap;
        t = min(f32(steps) * step, ray.height);
        gap = ray.height - t - sample_height(ray_at(ray, t));
        steps += 1u;
        if gap <= 0.0 {
            t = mix(t_above, t, gap_above / (gap_above - gap));
        }
    }
    return Hit(ray_at(ray, t), ray.height - t, t, steps, HIT);
}
