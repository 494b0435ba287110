// Normal mapping (Blinn, *Simulation of Wrinkled Surfaces*, 1978): the surface stays at the polygon, no offset.
//
// Specification: src/reference/trace_normal.rs.

fn trace(ray: Ray) -> Hit {
    return Hit(ray_at(ray, 0.0), ray.height, 0.0, 1u, HIT);
}
