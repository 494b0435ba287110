// What a point of the surface looks like: what each light, the sky and the surroundings add.
//
// Composed after a trace, a shadow, the sky, the balls, an albedo and a light model.

// A light lower above the reference surface than this, as a sine, is not up: its way would have no end.
const LIGHT_LEVEL: f32 = 1e-4;

// How far under the surface a ray must come into a shell to have come through its side: rounding is a thousandth of that.
const CUT_DEPTH: f32 = 1e-3;

// Whether the material mirrors its surroundings. Fixed when the pipeline is built, as DETAIL is.
override REFLECTS: bool = true;
// Whether stamps may have left gloss and heat. Fixed when the pipeline is built, too.
override MARKS: bool = false;

struct Shaded {
    ray: Ray,
    hit: Hit,
    height: f32,        // of the field at the hit's lattice position
    normal_world: vec3f,
    visibility: f32,    // share of the first light that arrives; 0 where the surface faces away from it
    radiance: vec3f,
}

// Share of each light that reaches a point of the surface at a place in the world; 0 where the surface faces away from it. On a
// cut through the relief nothing but balls and other reliefs casts shadows.
fn visibilities_at(lattice: vec2f, height: f32, world: vec3f, normal: vec3f, reference: vec3f, is_cut: bool) -> vec4f {
    var arrives = vec4f(0.0);
    for (var i = 0u; i < LIGHTS; i++) {
        let source = view_light(i);
        if dot(normal, source.toward) > 0.0 && (is_cut || dot(reference, source.toward) > LIGHT_LEVEL) {
            var share = balls_visibility(world, source.toward);
            if source.casts_shadow == 1u {
                share *= reliefs_visibility(world, source.toward);
            }
            if share > 0.0 && source.casts_shadow == 1u && !is_cut {
                let direction = field_direction(source.toward, reference);
                let way = direction.xy / direction.z;
                let left = detail_shadows(way);
                if left > 0.0 {
                    share *= mix(1.0, shadow(shadow_ray(lattice, way, height)), left);
                }
            }
            arrives[i] = share;
        }
    }
    return arrives;
}

// How open the sky is above a point, from the horizon in eight directions, four near and four far: what lies higher hides some of
// it.
fn sky_visibility(lattice: vec2f, field_height: f32) -> f32 {
    let level = light_level();
    let height = select(height_over(lattice, level), field_height, level == 0.0);
    let per_texel = view.depth_metres / view.texel_metres;
    let near = 4.0;
    let far = 13.0;
    let diagonal = 0.70710678 * far;
    let climbs = max(vec4f(0.0), per_texel / near * (vec4f(
        height_over(lattice + vec2f(near, 0.0), level),
        height_over(lattice + vec2f(0.0, near), level),
        height_over(lattice - vec2f(near, 0.0), level),
        height_over(lattice - vec2f(0.0, near), level),
    ) - height));
    let rises = max(vec4f(0.0), per_texel / far * (vec4f(
        height_over(lattice + vec2f(diagonal, diagonal), level),
        height_over(lattice + vec2f(-diagonal, diagonal), level),
        height_over(lattice - vec2f(diagonal, diagonal), level),
        height_over(lattice + vec2f(diagonal, -diagonal), level),
    ) - height));
    // The sines of the horizon's elevations.
    let hidden = climbs * inverseSqrt(1.0 + climbs * climbs) + rises * inverseSqrt(1.0 + rises * rises);
    return 1.0 - dot(hidden, vec4f(0.125));
}

fn shade(ray: Ray) -> Shaded {
    return shade_hit(ray, trace_detail(ray));
}

fn shade_hit(ray: Ray, hit: Hit) -> Shaded {
    let height = load_surface(hit.lattice);
    let position = world_of(hit.lattice, hit.height);
    // A ray that came into a shell through its side, under the surface, sees the side itself.
    let is_cut = hit.t == 0.0 && height - hit.height > CUT_DEPTH && any(frame.cut != vec3f(0.0));
    let reference = select(frame_normal(hit.lattice), frame.cut, is_cut);
    let over = select(normal_over(hit.lattice, reference), vec4f(frame.cut, 1.0), is_cut);
    let normal = over.xyz;
    let lit = visibilities_at(hit.lattice, height, position, normal, reference, is_cut);
    let toward_eye = normalize(view.eye_world - position);
    let point = SurfacePoint(hit.lattice, position, height, normal, dot(normal, reference), toward_eye, lit.x);
    var matter = detail_matter(covered_matter(point), over.w);
    if MARKS {
        matter = marked(matter, hit.lattice);
    }

    let open = sky_visibility(hit.lattice, height);
    var mirrored = vec3f(0.0);
    if REFLECTS {
        let reflected = reflect(-toward_eye, normal);
        mirrored = sky_blurred(reflected, light_roughness(matter)) * balls_visibility(position, reflected);
    }
    var radiance = matter.glow + light_around(matter, dot(normal, toward_eye), open * sky_mean(normal), open * mirrored)
        + balls_mirrored(position, normal, toward_eye, max(matter.specular, matter.reflection));
    for (var i = 0u; i < LIGHTS; i++) {
        let source = view_light(i);
        radiance += lit[i] * source.radiance * light(matter, normal, toward_eye, source.toward);
    }
    return Shaded(ray, hit, height, normal, lit.x, radiance);
}
