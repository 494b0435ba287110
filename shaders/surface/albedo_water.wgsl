// Water: a clear pool over a tiled floor, which refracts the view, gathers the light into caustics, and mirrors the sky; posts
// that stand in it are stone.

const WATER_INDEX: f32 = 1.333;          // index of refraction of water
const WATER_TILE_METRES: f32 = 0.0625;   // edge of a floor tile
const WATER_FLOOR_METRES: f32 = 0.10;    // from the water line to the floor

// What lies overhead: a pale horizon, a deeper zenith, and the sun's own disc, wide enough to glitter.
fn water_sky(direction: vec3f) -> vec3f {
    let up = clamp(direction.y, 0.0, 1.0);
    let sun = pow(max(dot(direction, view.light_world), 0.0), 420.0);
    return mix(1.5 * view.sky + 0.06, 0.55 * view.sky, sqrt(up)) + 9.0 * sun * view.light_radiance;
}

// Light that arrives on the floor under a lattice position, over what would arrive under still water: a crest gathers it, a
// trough spreads it (paraxial: the floor's image of a small patch shrinks by 1 − distance · (1 − 1/n) · curvature).
fn water_caustic(lattice: vec2f) -> f32 {
    // Under a post it is dark.
    if stamped_matter(lattice).b > 0.02 {
        return 0.35;
    }
    let spread = 3.0;
    let here = load_surface(lattice);
    let around = sample_height(lattice + vec2f(spread, 0.0)) + sample_height(lattice - vec2f(spread, 0.0))
        + sample_height(lattice + vec2f(0.0, spread)) + sample_height(lattice - vec2f(0.0, spread));
    let texels = spread * view.texel_metres;
    let curvature = (around - 4.0 * here) * view.depth_metres / (texels * texels);
    return clamp(1.0 / max(1.0 + 0.25 * WATER_FLOOR_METRES * curvature, 0.22), 0.45, 2.6);
}

fn water_floor(metres: vec2f) -> vec3f {
    let position = metres / WATER_TILE_METRES;
    let tile = vec2i(floor(position));
    let inside = 0.5 - abs(fract(position) - 0.5);
    let shade = hash_cell(tile, 61u);
    let accent = step(0.93, hash_cell(tile, 62u));
    let glaze = mix(vec3f(0.16, 0.42, 0.47), vec3f(0.27, 0.55, 0.58), shade);
    let tile_colour = mix(glaze, vec3f(0.05, 0.20, 0.34), accent);
    return mix(vec3f(0.62, 0.66, 0.64), tile_colour, smoothstep(0.025, 0.06, min(inside.x, inside.y)));
}

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    if stamped.b > 0.5 {
        let grain = fractal_noise(plane_metres(point.lattice) * 150.0, 71u);
        let stone = vec3f(0.46, 0.43, 0.39) * mix(0.75, 1.1, grain) * mix(0.55, 1.0, smoothstep(0.0, 0.9, point.level));
        return sooty(stone, stamped.r);
    }
    let normal = point.normal_world;
    let seen = max(dot(normal, point.toward_eye), 0.02);
    // Schlick, with (n − 1)²/(n + 1)² = 0.02 for water.
    let mirror = 0.02 + 0.98 * pow(1.0 - seen, 5.0);
    var reflected = reflect(-point.toward_eye, normal);
    reflected.y = abs(reflected.y);

    let below = refract(-point.toward_eye, normal, 1.0 / WATER_INDEX);
    let depth = WATER_FLOOR_METRES + (point.height - view.rest_height) * view.depth_metres;
    let reach = depth / max(-below.y, 0.2);
    let floor_metres = plane_metres(point.lattice) + below.xz * reach;

    // Light falls in aslant: the caustic under a floor point stands where its light crossed the surface.
    let light_below = refract(-view.light_world, vec3f(0.0, 1.0, 0.0), 1.0 / WATER_INDEX);
    let crossed = floor_metres - light_below.xz * (WATER_FLOOR_METRES / max(-light_below.y, 0.2));
    let caustic = water_caustic(crossed / view.texel_metres - 0.5);
    let lit = view.light_radiance * max(view.light_world.y, 0.0) * mix(0.35, 1.0, point.visibility) * caustic;
    let absorbed = exp(-vec3f(5.2, 1.3, 0.9) * reach);
    let floor_radiance = water_floor(floor_metres) * view.tint * (0.62 * lit + 0.50 * view.sky) * absorbed;
    let glow = floor_radiance * (1.0 - mirror) + water_sky(reflected) * mirror;
    return Matter(vec3f(0.0), 0.0, view.shininess, glow);
}
