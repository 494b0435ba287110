// What a point of the surface looks like: what each light, the sky and the surroundings add.
//
// Composed after a trace, a shadow, the sky, an albedo and a light model.

// A light lower above the reference surface than this, as a sine, is not up: its way would have no end.
const LIGHT_LEVEL: f32 = 1e-4;

struct Shaded {
    hit: Hit,
    height: f32,        // of the field at the hit's lattice position
    normal_world: vec3f,
    visibility: f32,    // share of the first light that arrives; 0 where the surface faces away from it
    radiance: vec3f,
}

// The world normal at a lattice position.
fn normal_at(lattice: vec2f) -> vec3f {
    return frame_normal_of(normalize(textureSampleLevel(normal_map, bilinear, uv_of(lattice), 0.0).xyz));
}

// Share of each light that reaches a point of the surface; 0 where the surface faces away from it.
fn visibilities_at(lattice: vec2f, height: f32, normal_world: vec3f) -> vec4f {
    var arrives = vec4f(0.0);
    for (var i = 0u; i < view.light_count; i++) {
        let source = view_buffer.lights[i];
        if dot(normal_world, source.toward) > 0.0 && dot(frame_normal(), source.toward) > LIGHT_LEVEL {
            let direction = field_direction(source.toward);
            var share = 1.0;
            if source.casts_shadow == 1u {
                share = shadow(shadow_ray(lattice, direction.xy / direction.z, height));
            }
            arrives[i] = share;
        }
    }
    return arrives;
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
    let hit = trace(ray);
    let height = load_surface(hit.lattice);
    let normal = normal_at(hit.lattice);
    let lit = visibilities_at(hit.lattice, height, normal);

    let position = world_of(hit.lattice, hit.height);
    let toward_eye = normalize(view.eye_world - position);
    let level = dot(normal, frame_normal());
    let matter = matter_at(SurfacePoint(hit.lattice, position, height, normal, level, toward_eye, lit.x));

    let open = sky_visibility(hit.lattice, height);
    let mirrored = sky_blurred(reflect(-toward_eye, normal), light_roughness(matter));
    var radiance = matter.glow + light_around(matter, dot(normal, toward_eye), open * sky_mean(normal), open * mirrored);
    for (var i = 0u; i < view.light_count; i++) {
        let source = view_buffer.lights[i];
        radiance += lit[i] * source.radiance * light(matter, normal, toward_eye, source.toward);
    }
    return Shaded(hit, height, normal, lit.x, radiance);
}
