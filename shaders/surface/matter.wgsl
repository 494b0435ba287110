// What an albedo is asked, and what it answers.

struct SurfacePoint {
    lattice: vec2f,
    world: vec3f,
    height: f32,          // of the field
    normal_world: vec3f,
    level: f32,           // cosine between the normal and the reference surface's: 1 where the relief is level
    toward_eye: vec3f,    // unit, world
    visibility: f32,      // share of the light that arrives
}

struct Matter {
    albedo: vec3f,    // linear
    specular: f32,    // strength of the highlight
    shininess: f32,   // its exponent
    glow: vec3f,      // radiance besides what the light model adds: reflection, what shows through
    roughness: f32,   // 0 a mirror, 1 matt: GGX's α is its square
    metallic: f32,    // 0 a dielectric, 1 a metal
    reflection: f32,  // how much of its surroundings it mirrors, of what Fresnel allows
}

// Whether there is anything on the material. Fixed when the pipeline is built: a large field's is as much to read as its heights.
override STAMPED: bool = true;

// What stamps left at a lattice position: soot, bare, post, gloss, each 0 to 1, bilinear.
fn stamped_matter(lattice: vec2f) -> vec4f {
    if !STAMPED {
        return vec4f(0.0);
    }
    let f = fract(lattice);
    let corners = stamped_corners(lattice);
    let north = mix(stamped_texel(corners.x), stamped_texel(corners.y), f.x);
    let south = mix(stamped_texel(corners.z), stamped_texel(corners.w), f.x);
    return mix(north, south, f.y);
}

fn stamped_corners(lattice: vec2f) -> vec4u {
    return textureGather(0, material_map, nearest, gather_uv(vec2i(floor(lattice)))).wzxy;
}

fn stamped_texel(bits: u32) -> vec4f {
    let levels = vec4f(material_soot(bits), material_bare(bits), material_post(bits), material_gloss(bits));
    return levels / vec4f(255.0, 255.0, 1.0, 31.0);
}

// How brightly what stamps left glows, of 1, bilinear.
fn stamped_glow(lattice: vec2f) -> f32 {
    let f = fract(lattice);
    let corners = stamped_corners(lattice);
    let north = mix(stamped_glow_texel(corners.x), stamped_glow_texel(corners.y), f.x);
    let south = mix(stamped_glow_texel(corners.z), stamped_glow_texel(corners.w), f.x);
    return mix(north, south, f.y);
}

fn stamped_glow_texel(bits: u32) -> f32 {
    return material_glow(material_heat(bits), view.moment);
}

// The material where stamps polished it, or left it hot.
fn marked(matter: Matter, lattice: vec2f) -> Matter {
    var after = matter;
    let gloss = stamped_matter(lattice).a;
    after.roughness = mix(matter.roughness, min(matter.roughness, 0.22), gloss);
    after.specular = mix(matter.specular, max(matter.specular, 0.7), gloss);
    after.shininess = mix(matter.shininess, max(matter.shininess, 60.0), gloss);
    // A crust forms as it cools, and what glows longest is between its flakes. The hotter the whiter: green and blue fall faster than
    // red.
    let hot = stamped_glow(lattice);
    let crust = smoothstep(0.62, 0.40, noise_over(plane_metres(lattice), 38.0, 97u));
    let glow = hot * mix(crust, 1.0, 0.75 * hot);
    after.glow += view.glow * glow * vec3f(1.0, 0.5 * glow * inverseSqrt(glow + 0.02), 0.22 * glow * glow);
    return after;
}

// Metres along u and v from the upper left corner of the plane.
fn plane_metres(lattice: vec2f) -> vec2f {
    return (lattice + 0.5) * view.texel_metres;
}

// Four octaves of value noise in [0, 1), the largest with so many features a metre: what is finer than the pixel becomes its mean.
fn noise_over(metres: vec2f, per_metre: f32, salt: u32) -> f32 {
    var sum = 0.0;
    var weights = 0.0;
    var weight = 0.5;
    var position = metres * per_metre;
    var size = footprint_metres() * per_metre;
    for (var octave = 0u; octave < 4u; octave++) {
        let left = detail_left(size);
        if left > 0.0 {
            sum += weight * left * (value_noise(position, salt + octave) - 0.5);
        }
        weights += weight;
        position = 2.0 * position + 17.3;
        size *= 2.0;
        weight *= 0.5;
    }
    return 0.5 + sum / weights;
}

// How much of the pixel's width, but at least of `softness`, lies beside a stripe of this width whose middle is so far away.
fn beside_stripe(from_middle: f32, stripe: f32, footprint_width: f32, softness: f32) -> f32 {
    let width = max(footprint_width, softness);
    let overlap = min(from_middle + 0.5 * width, 0.5 * stripe) - max(from_middle - 0.5 * width, -0.5 * stripe);
    return 1.0 - clamp(overlap / width, 0.0, 1.0);
}

// The scene's material with the given colour, blackened by soot.
fn sooty(colour: vec3f, soot: f32) -> Matter {
    let left = 1.0 - soot;
    let albedo = colour * view.tint * mix(0.08, 1.0, left * left);
    let roughness = mix(1.0, view.roughness, left);
    return Matter(
        albedo, view.specular * left, view.shininess, vec3f(0.0), roughness, view.metallic * left, view.reflection * left,
    );
}
