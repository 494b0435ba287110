// Exact: where the ray first meets the bilinear surface; with a level of detail, unless exact is to stay so, the one that is averaged
// over the pixel.
//
// Specification: src/reference/trace_exact.rs. Needs surface/traversal.

fn trace(ray: Ray) -> Hit {
    traversal_detail = footprint.trace_level;
    hit_level = i32(traversal_detail);
    let hit = traversal(ray, traversal_begin(ray));
    traversal_detail = 0.0;
    return hit;
}
