// Light disc: the light as a receiver sees it, a disc of directions, and the ray of field space that each of them is.
//
// A direction of the disc is toward + radius (a · raised + b · across), a² + b² ≤ 1: `toward` the unit vector to the disc's centre,
// `across` level with the reference surface and `raised` at right angles to both, `radius` the tangent of the disc's half angle. In
// field space that is an affine map of (a, b), whatever the frame: the centre's travel and what a and b add to it. What lies below
// the reference surface's own horizon sends no light.
//
// Specification: src/reference/light_disc.rs. Needs common/view, surface/ray and surface/frame.

// A direction lower above the reference surface than this, as a sine, has no light: its way would have no end.
const LIGHT_DISC_LEVEL: f32 = 1e-4;
// A golden section of the whole turn, in units of 2⁻³²: u32 wraps as angles do.
const LIGHT_DISC_GOLDEN: u32 = 2654435769u;

struct LightDisc {
    travel: vec2f,  // of the centre: lattice displacement while it climbs by a height of 1
    raised: vec2f,  // what a = 1 adds to that displacement …
    climb: f32,     // … and to that climb
    lowest: f32,    // least climb that is above the horizon
    across: vec2f,  // what b = 1 adds to the displacement; it climbs no more
    steepen: f32,   // straight up from the centre, the climb is 1 + a steepen / (1 − a lean)
    lean: f32,      // radius over the distance from centre to zenith, as the tangent plane of the centre has it: 1 where they touch
}

// The unit vector from the ray's start toward the light, world.
fn light_toward(ray: Ray) -> vec3f {
    return normalize(frame.along_u * ray.travel.x + frame.along_v * ray.travel.y + frame.up * ray.rise);
}

// The disc round a unit vector above the reference surface, world.
fn light_disc(toward: vec3f, radius: f32) -> LightDisc {
    let normal = frame_up();
    // Where the light stands in the zenith any direction is level.
    let beside = cross(toward, normal);
    let any_level = normalize(cross(frame.along_u, normal));
    let across = select(normalize(beside), any_level, dot(beside, beside) < 1e-12);
    let raised = cross(across, toward);

    let centre = field_displacement(toward);
    let per_climb = radius / centre.z;
    let above = field_displacement(raised) * per_climb;
    let reach = max(dot(frame.up, raised), 1e-6 * length(frame.up));
    return LightDisc(
        centre.xy / centre.z,
        above.xy,
        above.z,
        LIGHT_DISC_LEVEL / dot(normal, toward),
        field_displacement(across).xy * per_climb,
        per_climb / reach,
        radius * dot(frame.up, toward) / reach,
    );
}

// The climb of a point of the disc, in units of the centre's.
fn light_disc_climb(disc: LightDisc, point: vec2f) -> f32 {
    return 1.0 + point.x * disc.climb;
}

// The lattice displacement of its ray while that climbs by a height of 1.
fn light_disc_travel(disc: LightDisc, point: vec2f) -> vec2f {
    return (disc.travel + point.x * disc.raised + point.y * disc.across) / light_disc_climb(disc, point);
}

// Point `index` of `count` that cover the disc evenly: a spiral whose turns are golden sections (Vogel 1979).
fn light_disc_point(index: u32, count: u32) -> vec2f {
    let radius = sqrt((f32(index) + 0.5) / f32(count));
    let angle = f32((index * LIGHT_DISC_GOLDEN) >> 8u) * (6.2831853 / 16777216.0);
    return radius * vec2f(cos(angle), sin(angle));
}
