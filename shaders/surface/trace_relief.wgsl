// Relief mapping (Policarpo): a linear search down the ray, then a binary search between its last two samples.
//
// Depth bias shortens the offset of rays that graze, as Policarpo and Oliveira's shader does: by 1 − (1 − cos)⁸, so that it
// stays under 8 depths. The linear search then steps over less, and the surface flattens toward the horizon ([POM] fig. 2b):
// what the shortened ray finds is shown where the true ray passes the same lattice position.
//
// Specification: src/reference/trace_relief.rs. Needs surface/march.

fn trace_relief_share(ray: Ray) -> f32 {
    if view.relief_depth_bias == 0u {
        return 1.0;
    }
    // 1 − s⁸ with s = 1 − cos, without cancellation where cos is small.
    let cosine = march_cosine(ray);
    let s = 1.0 - cosine;
    let s2 = s * s;
    return cosine * (1.0 + s) * (1.0 + s2) * (1.0 + s2 * s2);
}

fn trace(ray: Ray) -> Hit {
    let share = trace_relief_share(ray);
    let biased = Ray(ray.lattice, share * ray.travel, ray.height, ray.rise, ray.cell, ray.t_end, ray.ends);
    let found = march(biased, detail_samples(view.relief_linear_steps));
    if found.gap > 0.0 {
        return end_of(ray, found.steps);
    }
    var above = found.t_above;
    var t = found.t;
    var steps = found.steps;
    // A ray that starts under the surface has nothing to search.
    let halvings = select(view.relief_binary_steps, 0u, found.gap_above <= 0.0);
    for (var i = 0u; i < halvings; i++) {
        let middle = 0.5 * (above + t);
        let is_above = march_gap(biased, middle) > 0.0;
        above = select(above, middle, is_above);
        t = select(middle, t, is_above);
    }
    return hit_at(ray, share * t, steps + halvings);
}
