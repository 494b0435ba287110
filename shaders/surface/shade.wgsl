// What a point of the surface looks like: ambient, diffuse and specular light (Blinn–Phong, as [POM] §4 and [Zink] have it).
//
// Composed after a trace, a shadow, an albedo and the balls.

// What the picture shows.
const SHOW_PICTURE: u32 = 0u;
const SHOW_HEIGHT: u32 = 1u;
const SHOW_NORMAL: u32 = 2u;
const SHOW_VISIBILITY: u32 = 3u;
const SHOW_STEPS: u32 = 4u;

// A light lower above the reference surface than this, as a sine, is not up: its way would have no end.
const LIGHT_LEVEL: f32 = 1e-4;

// How far under the surface a ray must come into a shell to have come through its side: rounding is a thousandth of that.
const CUT_DEPTH: f32 = 1e-3;

struct Shaded {
    hit: Hit,
    height: f32,        // of the field at the hit's lattice position
    normal_world: vec3f,
    visibility: f32,    // share of the light that arrives; 0 where the surface faces away from it
    radiance: vec3f,
}

// The world normal at a lattice position, where the reference surface has the normal `reference`.
fn normal_at(lattice: vec2f, reference: vec3f) -> vec3f {
    return relief_normal(normalize(textureSampleLevel(normal_map, bilinear, uv_of(lattice), 0.0).xyz), reference);
}

// Share of the light that reaches a point of the surface at a place in the world.
fn visibility_at(lattice: vec2f, height: f32, world: vec3f, normal: vec3f, reference: vec3f) -> f32 {
    if dot(normal, view.light_world) <= 0.0 || dot(reference, view.light_world) <= LIGHT_LEVEL {
        return 0.0;
    }
    let passes = balls_visibility(world, view.light_world);
    if passes == 0.0 {
        return 0.0;
    }
    let direction = field_direction(view.light_world, reference);
    return passes * shadow(shadow_ray(lattice, direction.xy / direction.z, height));
}

// How open the sky is above a point, from the horizon in eight directions, four near and four far: what lies higher hides some of
// it.
fn sky_visibility(lattice: vec2f, height: f32) -> f32 {
    let per_texel = view.depth_metres / view.texel_metres;
    let near = 4.0;
    let far = 13.0;
    let diagonal = 0.70710678 * far;
    let climbs = max(vec4f(0.0), per_texel / near * (vec4f(
        sample_height(lattice + vec2f(near, 0.0)),
        sample_height(lattice + vec2f(0.0, near)),
        sample_height(lattice - vec2f(near, 0.0)),
        sample_height(lattice - vec2f(0.0, near)),
    ) - height));
    let rises = max(vec4f(0.0), per_texel / far * (vec4f(
        sample_height(lattice + vec2f(diagonal, diagonal)),
        sample_height(lattice + vec2f(-diagonal, diagonal)),
        sample_height(lattice - vec2f(diagonal, diagonal)),
        sample_height(lattice + vec2f(diagonal, -diagonal)),
    ) - height));
    // The sines of the horizon's elevations.
    let hidden = climbs * inverseSqrt(1.0 + climbs * climbs) + rises * inverseSqrt(1.0 + rises * rises);
    return 1.0 - dot(hidden, vec4f(0.125));
}

fn shade(ray: Ray) -> Shaded {
    return shade_hit(trace(ray));
}

fn shade_hit(hit: Hit) -> Shaded {
    let height = load_surface(hit.lattice);
    let position = world_of(hit.lattice, hit.height);
    // A ray that came into a shell through its side, under the surface, sees the side itself.
    let is_cut = hit.t == 0.0 && height - hit.height > CUT_DEPTH && any(frame.cut != vec3f(0.0));
    let reference = select(frame_normal(hit.lattice), frame.cut, is_cut);
    let normal = select(normal_at(hit.lattice, reference), frame.cut, is_cut);
    let lit = select(
        visibility_at(hit.lattice, height, position, normal, reference),
        select(0.0, 1.0, dot(normal, view.light_world) > 0.0) * balls_visibility(position, view.light_world),
        is_cut,
    );
    let toward_eye = normalize(view.eye_world - position);
    let matter = matter_at(SurfacePoint(hit.lattice, position, height, normal, dot(normal, reference), toward_eye, lit));
    let halfway = normalize(toward_eye + view.light_world);
    let diffuse = max(dot(normal, view.light_world), 0.0);
    // Normalised, so that a tighter highlight is a brighter one.
    let highlight = matter.specular * (matter.shininess + 8.0) / 25.0 * pow(max(dot(normal, halfway), 0.0), matter.shininess);
    let ambient = mix(view.ground, view.sky, 0.5 + 0.5 * normal.y) * sky_visibility(hit.lattice, height);
    let direct = view.light_radiance * lit * diffuse;
    let mirrored = balls_mirrored(position, normal, toward_eye, matter.specular);
    let radiance = matter.albedo * (ambient + direct) + direct * highlight + matter.glow + mirrored;
    return Shaded(hit, height, normal, lit, radiance);
}

// A colour for a number between 0 and 1: black, violet, orange, pale yellow, ever brighter.
fn heat(value: f32) -> vec3f {
    let x = clamp(value, 0.0, 1.0);
    return vec3f(
        smoothstep(0.05, 0.62, x),
        0.9 * smoothstep(0.38, 1.0, x),
        0.45 * smoothstep(0.0, 0.28, x) * (1.0 - smoothstep(0.34, 0.66, x)) + 0.62 * smoothstep(0.72, 1.0, x),
    );
}

// The radiance of the picture or of the view that was chosen instead.
fn shown(shaded: Shaded) -> vec3f {
    switch view.shows {
        case SHOW_HEIGHT: { return vec3f(shaded.height); }
        case SHOW_NORMAL: {
            // As a normal map has it: u to the right, v down.
            let along = vec3f(dot(shaded.normal_world, normalize(frame.along_u)), dot(shaded.normal_world, normalize(frame.along_v)), 0.0);
            return vec3f(along.x, -along.y, dot(shaded.normal_world, frame_normal(shaded.hit.lattice))) * 0.5 + 0.5;
        }
        case SHOW_VISIBILITY: { return vec3f(shaded.visibility); }
        case SHOW_STEPS: { return heat(f32(shaded.hit.steps) / 64.0); }
        default: {
            // A ray that gave up is never silently a hit.
            return select(shaded.radiance, vec3f(4.0, 0.0, 4.0), shaded.hit.status == CAPPED);
        }
    }
}
