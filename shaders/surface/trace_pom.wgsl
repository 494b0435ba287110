// Parallax occlusion mapping: a linear search down the ray, then the ray against the last linear segment of the profile
// ([POM] §3.1, fig. 6).
//
//   height  r32float  read  through sample_height, level 0: one bilinear sample a step                16 bytes
//
// The number of samples n grows from n_min, seen head-on, to n_max, seen edge-on. [POM] eq. 1 prints it the other way round;
// its text and [Zink]'s lerp (with E from the eye, so that its printed dot product is negative) mean this. n is a real number:
// samples lie 1/n of the way apart and the last is at its end, over a flat polygon the floor, so that one more sample begins as one of no width. Rounded counts
// show as bands.
//
// Specification: src/reference/trace_pom.rs. Needs common/view, surface/ray and a height part.

fn trace_pom_samples(ray: Ray) -> f32 {
    let travel_metres = ray.travel * view.plane_size_metres / vec2f(view.field_size);
    let fall_metres = abs(ray.rise) * view.depth_metres;
    let cosine = fall_metres / max(length(vec3f(travel_metres, fall_metres)), 1e-20);
    return max(mix(view.pom_samples_max, view.pom_samples_min, saturate(cosine)), 1.0);
}

fn trace(ray: Ray) -> Hit {
    let step = ray.t_end / detail_samples(trace_pom_samples(ray));
    var t = 0.0;
    var gap = ray_height(ray, 0.0) - sample_height(ray_at(ray, 0.0));
    var steps = 1u;
    while gap > 0.0 && t < ray.t_end {
        let t_above = t;
        let gap_above = gap;
        t = min(f32(steps) * step, ray.t_end);
        gap = ray_height(ray, t) - sample_height(ray_at(ray, t));
        steps += 1u;
        if gap <= 0.0 {
            t = mix(t_above, t, gap_above / (gap_above - gap));
            return Hit(ray_at(ray, t), ray_height(ray, t), t, steps, HIT);
        }
    }
    if gap > 0.0 {
        return end_of(ray, steps);
    }
    return Hit(ray_at(ray, 0.0), ray.height, 0.0, steps, HIT);
}
