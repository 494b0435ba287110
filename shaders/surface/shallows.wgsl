// Shallows: whatever the ground is made of, under water: wet and dark at the shore, seen through the water and lost in its depth,
// under foam where it broke.
//
//   cover_map  rgba16float  read   depth in heights, share of foam, velocity x and y in m/s
//
// Composed after an albedo and surface/transparent.

// Whether there is any. Fixed when the pipeline is built, as DETAIL is.
override COVERED: bool = false;

const SHALLOWS_INDEX: f32 = 1.33;

// What it mirrors, the suns only where their light arrives. What would be reflected into the relief is seen as if by its next slope.
fn shallows_mirrored(point: SurfacePoint) -> vec3f {
    let reflected = transparent_reflected(point);
    return sky(reflected) + point.visibility * sky_suns(reflected);
}

fn shallows_at(lattice: vec2f) -> vec4f {
    let cell = vec2i(floor(lattice));
    let f = fract(lattice);
    let low = address(cell);
    let high = address(cell + 1);
    let north = mix(textureLoad(cover_map, low, 0), textureLoad(cover_map, vec2i(high.x, low.y), 0), f.x);
    let south = mix(textureLoad(cover_map, vec2i(low.x, high.y), 0), textureLoad(cover_map, high, 0), f.x);
    return mix(north, south, f.y);
}

// The matter of a point, dry or under water.
fn covered_matter(point: SurfacePoint) -> Matter {
    if !COVERED {
        return matter_at(point);
    }
    let cover = shallows_at(point.lattice);
    let depth = max(cover.x, 0.0) * view.depth_metres;
    // A film darkens what it wets; what is a tenth of a texel deep is water to look at.
    let wet = smoothstep(0.0, 0.02 * view.texel_metres, depth);
    let pool = smoothstep(0.04 * view.texel_metres, 0.35 * view.texel_metres, depth);

    let below = refract(-point.toward_eye, point.normal_world, 1.0 / SHALLOWS_INDEX);
    let downward = max(-dot(below, frame_normal(point.lattice)), 0.25);
    var ground = point;
    ground.lattice += pool * below.xz * depth / (downward * view.texel_metres);
    ground.height = point.height - cover.x;
    let matter = matter_at(ground);

    // Down with the light and up to the eye.
    let way = depth * (1.0 / downward + 1.0 / max(view.light_world.y, 0.35));
    let left = exp(-view.water_absorption * way);
    let soaked = matter.albedo * mix(1.0, 0.52, wet);
    let seen = max(dot(point.normal_world, point.toward_eye), 0.02);
    let mirror = pool * transparent_mirror(SHALLOWS_INDEX, seen);
    let water = mix(soaked, soaked * left + view.water_scatter * (1.0 - left), pool) * (1.0 - mirror);

    // Bubbles of some texels, that thin out to lace before they are gone.
    let bubbles = noise_over(plane_metres(point.lattice), 0.22 / view.texel_metres, 71u);
    let foam = smoothstep(0.95, 1.25, 1.15 * cover.y + bubbles) * wet;
    // A film shines as what it wets would; a pool is a mirror, in which the suns stand already: no highlight, or they would count twice.
    let shine = max(wet * 0.55, pool);
    return Matter(
        mix(water, vec3f(0.80, 0.84, 0.85), foam),
        mix(matter.specular, 0.4, wet) * (1.0 - max(pool, foam)),
        mix(matter.shininess, 220.0, shine),
        mix(matter.glow, shallows_mirrored(point) * mirror, pool) * (1.0 - foam),
        mix(mix(matter.roughness, 0.25, wet), 1.0, pool),
        matter.metallic * (1.0 - wet),
        mix(matter.reflection, 0.0, shine),
    );
}
