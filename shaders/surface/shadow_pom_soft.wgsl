// Soft shadows ([POM] §3.2): samples of the profile along the way to the light, the strongest blocker counts.
//
//   height  r32float  read  through sample_height, level 0: shadow_samples + 1 bilinear samples        16 bytes each
//
// h₀ is the height where the ray starts, the paper's reference height, t the height that the ray has climbed. A sample h blocks
// by what it rises above the ray, (h − h₀) − t, times a weight that is a function of the place alone:
//
//   visibility = 1 − clamp(strength · max ((h − h₀) − t) / max(t, t½), 0, 1)
//
// The weight 1 / t is the paper's penumbra, w_p = w_s (d_r − d_b) / d_b: seen from the receiver the blocker hides as much of
// the light as the tangent of its elevation exceeds the light's, so the same rise hides less from further away, and a shadow
// starts sharp where it meets its blocker. `strength` is the light's tangent over the height of the light. t½ is half a texel
// away: nearer ones say no more than the slope, and rounding over nothing is much. The paper's weights belong to the tap's
// index and darken as taps are added.
//
// Five eighths of the samples look for the blocker, denser near the start, where contact shadows are. Fixed places see a
// blocker's edge jump from one to the next, which shows as bands, so the rest look for the edge: they bisect between the best
// sample and the one before, and then take the two borders of cells around it, where the bilinear profile has its ridges. A
// wall's penumbra is then as smooth as with any number of samples.
//
// Specification: src/reference/shadow_pom_soft.rs. Needs common/view, surface/ray and a height part.

// How much steeper than the light the receiver sees the surface at t.
fn shadow_pom_soft_excess(ray: Ray, surface: f32, near: f32, t: f32) -> f32 {
    return (sample_height(ray_at(ray, t)) - surface - t) / max(t, near);
}

fn shadow(ray: Ray) -> f32 {
    let surface = sample_height(ray_at(ray, 0.0));
    // Beyond the slab nothing can block.
    let span = 1.0 - surface;
    if span <= 0.0 {
        return 1.0;
    }
    let near = 0.5 / max(length(ray.travel), 1e-6);
    let count = u32(view.shadow_samples);
    let edge = count * 3u / 8u;
    let borders = select(0u, 2u, edge >= 2u);
    let coarse = count - edge;
    var most = -1.0;
    var at = 0.0;
    var before = 0.0;
    var previous = 0.0;
    for (var i = 0u; i < coarse; i++) {
        let share = (f32(i) + 0.5) / f32(coarse);
        let t = span * share * sqrt(share);
        let excess = shadow_pom_soft_excess(ray, surface, near, t);
        if excess > most {
            most = excess;
            at = t;
            before = previous;
        }
        previous = t;
    }
    for (var i = borders; i < edge; i++) {
        let middle = 0.5 * (before + at);
        let excess = shadow_pom_soft_excess(ray, surface, near, middle);
        if excess > most {
            most = excess;
            at = middle;
        } else {
            before = middle;
        }
    }
    // On the axis on which the ray is faster.
    let along = select(vec2f(1.0, 0.0), vec2f(0.0, 1.0), abs(ray.travel.y) > abs(ray.travel.x));
    let origin = dot(along, ray.lattice);
    let travel = dot(along, ray.travel);
    if abs(travel) >= 1e-6 {
        let border = floor(origin + at * travel);
        for (var i = 0u; i < borders; i++) {
            let t = max((border + f32(i) - origin) / travel, 0.0);
            most = max(most, shadow_pom_soft_excess(ray, surface, near, t));
        }
    }
    return 1.0 - clamp(view.shadow_strength * most, 0.0, 1.0);
}
