// Hard shadows: any hit of the exact traversal on the way to the light.
//
// The ray starts upon the surface below or above `ray.lattice`, not at `ray.height`: a technique that finds the surface only
// nearly would shadow itself. It is lifted by SHADOW_HARD_LIFT, so that it starts above the surface whatever rounding does, and
// its slope against the light decides the rest.
//
// Specification: src/reference/shadow_hard.rs. Needs surface/traversal.

// A millionth of the height range: five times what rounding can do to a height, a tenth of what a shadow may miss.
const SHADOW_HARD_LIFT: f32 = 9.6e-7;

fn shadow(ray: Ray) -> f32 {
    let start = load_surface(ray_at(ray, 0.0)) + SHADOW_HARD_LIFT;

    // Nothing is above the highest bound: there the ray is free.
    let highest = textureLoad(pyramid, vec2i(0), i32(textureNumLevels(pyramid)) - 1).r + TRAVERSAL_SLACK;
    if start >= highest {
        return 1.0;
    }
    let hit = traversal(Ray(ray.lattice, ray.travel, start, 1.0, ray.cell, highest - start, MISS), 0.0);
    // A ray that gave up found no way out: it counts as shadowed.
    return select(0.0, 1.0, hit.status == MISS);
}
