// Exact: where the ray first meets the bilinear surface.
//
// Specification: src/reference/trace_exact.rs. Needs surface/traversal.

fn trace(ray: Ray) -> Hit {
    return traversal(ray, traversal_begin(ray));
}
