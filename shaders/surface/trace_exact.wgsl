// Exact: where the ray first meets the bilinear surface.
//
// Specification: src/reference/trace_exact.rs. Needs surface/traversal.

fn trace(ray: Ray) -> Hit {
    // Nothing is above the highest bound: the search begins where the ray goes under it.
    let highest = textureLoad(pyramid, vec2i(0), i32(textureNumLevels(pyramid)) - 1).r;
    let t_begin = max(ray.height - highest - TRAVERSAL_SLACK, 0.0);
    return traversal(ray, t_begin, ray.height);
}
