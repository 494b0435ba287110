// The truth: the exact traversal of the ray that a technique has traced, and how far apart the two end.
//
// Needs surface/frame and surface/traversal.

// Texels between the point that the technique found and the point where the surface is.
fn truth_error(ray: Ray, hit: Hit) -> f32 {
    let exact = traversal(ray);
    return length(world_of(hit.lattice, hit.height) - world_of(exact.lattice, exact.height)) / view.texel_metres;
}
