// March: height samples at equal distances down a ray, up to the first that is not under it ([Steep]; Policarpo; [POM] §3.1).
//
//   height  r32float  read  through sample_height, level 0: one bilinear sample a step  16 bytes
//
// What the techniques that search this way share. They differ in how many samples they take, and in what they make of the two
// between which the ray goes under the surface. What the surface does between samples is theirs to miss.
//
// Specification: src/reference/march.rs. Needs common/view, surface/ray, surface/frame and a height part.

// How `pom` and `pom-linear` choose their counts; the other choice is by the angle.
const MARCH_BY_TEXELS: u32 = 1u;

// Where a ray goes under the surface: the last sample above it, and the first that is not. They are the same where the ray
// starts under it. `gap` is the ray's height less the surface's, above 0 where the ray reached its end without meeting it.
struct March {
    t_above: f32,
    gap_above: f32,
    t: f32,
    gap: f32,
    steps: u32,
}

fn march_gap(ray: Ray, t: f32) -> f32 {
    return ray_height(ray, t) - sample_height(ray_at(ray, t));
}

// Samples lie 1/n of the way apart and the last is at its end, over a flat polygon the floor. n is a real number: one more
// sample begins as one of no width, and rounded counts would show as bands.
fn march(ray: Ray, samples: f32) -> March {
    let step = ray.t_end / samples;
    let gap = march_gap(ray, 0.0);
    var found = March(0.0, gap, 0.0, gap, 1u);
    while found.gap > 0.0 && found.t < ray.t_end {
        let t = min(f32(found.steps) * step, ray.t_end);
        found = March(found.t, found.gap, t, march_gap(ray, t), found.steps + 1u);
    }
    return found;
}

// Cosine between the ray and the reference surface's normal, in the world: 1 seen head-on, 0 edge-on.
fn march_cosine(ray: Ray) -> f32 {
    let along = frame.along_u * ray.travel.x + frame.along_v * ray.travel.y + frame.up * ray.rise;
    return saturate(abs(dot(along, frame_normal(ray_at(ray, 0.0)))) / max(length(along), 1e-20));
}

// Samples of `pom` and `pom-linear`.
//
// By the angle they grow from n_min, seen head-on, to n_max, seen edge-on. [POM] eq. 1 prints it the other way round; its text
// and [Zink]'s lerp (with E from the eye, so that its printed dot product is negative) mean this.
//
// By texels there is one for each texel that the parallax offset crosses ([Zink], "Algorithm Metrics"), n_min at the least. A
// ray that grazes crosses thousands: the cap on steps, not n_max, is the most.
fn march_samples(ray: Ray) -> f32 {
    if view.pom_counts == MARCH_BY_TEXELS {
        return max(min(max(length(ray.travel) * ray.t_end, view.pom_samples_min), f32(view.step_cap)), 1.0);
    }
    return max(mix(view.pom_samples_max, view.pom_samples_min, march_cosine(ray)), 1.0);
}
