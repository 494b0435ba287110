// No shadow: the light reaches everything.
//
// Specification: src/reference/shadow_none.rs.

fn shadow(ray: Ray) -> f32 {
    return 1.0;
}
