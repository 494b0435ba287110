// Level of detail: how much of the surface a pixel sees, and how closely it is therefore looked at ([POM] §3.3).
//
//   normal_map  rgba16float, mips  read  means of normals and heights
//
// The level is explicit and computed before any loop, where derivatives are those of the polygon. It is that of hardware mip
// mapping without anisotropy (OpenGL 4.6 §8.14.1): log₂ of the longer of the two texel distances that one pixel to the right and
// one pixel down make. So nothing aliases, and what a grazing pixel's short side could still show is lost with the long one.
//
// Specification: src/reference/level_of_detail.rs. Needs common/view, common/field, surface/ray,
// surface/frame, surface/matter, surface/traversal and a height part.

struct Footprint {
    texels: vec2f,    // its extent along u and along v
    level: f32,       // the mip level whose texels are as large as its longer side: 0 or more
    trace_level: f32, // that of the mean heights at which a traversal stops: 0 the field itself
    flattened: f32,   // 0 the full effect, 1 normal mapping alone
}

// What the pixel sees, set by whatever knows; a point where nobody does.
var<private> footprint: Footprint;

// By how many levels a traversal stops at cells smaller than the pixel ([PDM] §3.4). A grazing ray meets the tops of what it sees,
// which means lower: with half a pixel pictures of `sidewalk` differed from those without by 42 of 255 in their 99th percentile,
// with an eighth by 12, and a few steps more are all that it costs.
const DETAIL_FINER: f32 = 3.0;
// Whether anything looks less closely at all. Fixed when the pipeline is built: a software adapter runs both sides of a branch, and would
// read the mips beside the field for every sample (2.5 times the cost of a picture on lavapipe).
override DETAIL: bool = true;
// The fewest samples that a count is lowered to.
const DETAIL_SAMPLES: f32 = 4.0;
// Where between the mean and the greatest height the plane lies on which normal mapping is left: where grazing rays meet the
// surface. On the polygon itself the picture would slide by a stone or so before it settles: 22 of 255 instead of 14.
const DETAIL_PLANE: f32 = 0.4;

// The footprint of a pixel whose uv changes by so much from it to the next on the right, and to the next below.
fn footprint_of(du_dx: vec2f, du_dy: vec2f) -> Footprint {
    let right = du_dx * vec2f(view.field_size);
    let down = du_dy * vec2f(view.field_size);
    let level = max(0.5 * log2(max(max(dot(right, right), dot(down, down)), 1e-20)), 0.0);
    // The threshold's own level is the first without the effect: over the one before it fades, by the fractional part.
    let flattened = saturate(level + 1.0 - view.detail.threshold);
    let trace_level = select(0.0, max(level - DETAIL_FINER, 0.0), view.detail.traces == 1u);
    return Footprint(abs(right) + abs(down), level, trace_level, flattened);
}

// The longer side of the footprint, metres.
fn footprint_metres() -> f32 {
    return max(footprint.texels.x, footprint.texels.y) * view.texel_metres;
}

// How much is left of something whose mean is known, at a footprint of so many of its own sizes: all of it at a quarter, where
// a pixel shows it, nothing at one and a half.
fn detail_left(footprint_over_size: f32) -> f32 {
    return 1.0 - smoothstep(0.25, 1.5, footprint_over_size);
}

// The mean height round a lattice position, at a mip level.
fn height_over(lattice: vec2f, level: f32) -> f32 {
    if !DETAIL || level <= 0.0 {
        return sample_height(lattice);
    }
    return textureSampleLevel(normal_map, bilinear, uv_of(lattice), level).w;
}

// What is left of a count of samples: [POM slides] has them grow toward the viewer. By the root of what the footprint is larger
// than a texel, since counts are chosen for what is near and are few there already. They go on sampling the field itself: its
// means are lower than what a grazing ray meets, and it would search the longer for that.
fn detail_samples(samples: f32) -> f32 {
    if !DETAIL || view.detail.traces == 0u {
        return samples;
    }
    return max(samples * exp2(-0.5 * footprint.level), min(samples, DETAIL_SAMPLES));
}

// Where a ray meets the plane on which normal mapping is left.
fn detail_plane(ray: Ray) -> f32 {
    let mean = textureLoad(normal_map, vec2i(0), i32(textureNumLevels(normal_map)) - 1).w;
    let top = traversal_highest(traversal_way(ray.lattice, ray.travel));
    return clamp((mix(mean, top, DETAIL_PLANE) - ray.height) / ray.rise, 0.0, ray.t_end);
}

// The technique's hit, as far as the pixel's level of detail goes: over the last level before the threshold the surface
// flattens to a plane, and beyond it nothing is traced. A piece of a shell has no such plane.
fn trace_detail(ray: Ray) -> Hit {
    if !DETAIL {
        return trace(ray);
    }
    let flattened = select(0.0, footprint.flattened, ray.ends == HIT);
    var hit = Hit(vec2f(0.0), 0.0, 0.0, 1u, HIT);
    if flattened < 1.0 {
        hit = trace(ray);
    }
    if flattened == 0.0 || hit.status != HIT {
        return hit;
    }
    let t = mix(hit.t, detail_plane(ray), flattened);
    return Hit(ray_at(ray, t), ray_height(ray, t), t, hit.steps, HIT);
}

// The level at which the surface is lit.
fn light_level() -> f32 {
    return select(0.0, footprint.level, DETAIL && view.detail.filters == 1u);
}

// The normal of what the pixel sees round a lattice position where the reference surface has the normal `reference`: unit, in the
// world; and how long the mean of the unit normals there
// is, 1 where they are all the same.
fn normal_over(lattice: vec2f, reference: vec3f) -> vec4f {
    let level = light_level();
    let mean = textureSampleLevel(normal_map, bilinear, uv_of(lattice), level).xyz;
    let length = length(mean);
    // Seen closer than the texels, what the bilinear filter takes off a unit normal is no roughness.
    return vec4f(relief_normal(mean / length, reference), mix(1.0, min(length, 1.0), saturate(level)));
}

// The exponent of a highlight on normals whose mean has this length (Toksvig 2005, "Mipmapping Normal Maps").
fn detail_shininess(shininess: f32, mean_length: f32) -> f32 {
    return shininess * mean_length / (mean_length + shininess * (1.0 - mean_length));
}

// Half the mean square of the slopes that a mean of this length averages away, as it widens a microfacet distribution's α²
// (Toksvig's exponent as Beckmann's: α² = 2 / s).
fn detail_variance(mean_length: f32) -> f32 {
    return 2.0 * (1.0 - mean_length) / mean_length;
}

// The matter of what the pixel sees, where the mean of its normals has this length. Normals that differ face the light, and the sky
// out of the valleys between them, as much less as their mean is shorter; and they widen the highlight.
fn detail_matter(matter: Matter, mean_length: f32) -> Matter {
    var seen = matter;
    seen.albedo *= mix(mean_length, 1.0, matter.metallic);
    seen.shininess = detail_shininess(matter.shininess, mean_length);
    let alpha = matter.roughness * matter.roughness;
    seen.roughness = min(sqrt(sqrt(alpha * alpha + detail_variance(mean_length))), 1.0);
    return seen;
}

// How much is left of shadows toward a light to which a ray travels so far, in texels, while it climbs by a height of 1: no shadow
// is longer. Where none is seen the mean normal says all: what faces the light more than the mean makes up for what it shades, since
// together they hide as much of the light as the flat polygon does.
fn detail_shadows(light_in_field: vec2f) -> f32 {
    if !DETAIL || view.detail.filters == 0u {
        return 1.0;
    }
    return detail_left(exp2(footprint.level) / max(length(light_in_field), 1e-6));
}
