// Water: a clear pool over a tiled floor, which refracts the view, gathers the light into caustics, and mirrors the sky; posts
// that stand in it are stone.

const WATER_INDEX: f32 = 1.333;          // index of refraction of water
const WATER_TILE_METRES: f32 = 0.0625;   // edge of a floor tile
const WATER_FLOOR_METRES: f32 = 0.10;    // from the water line to the floor

// Light that arrives on the floor under a lattice position: under a post it is dark.
fn water_caustic(lattice: vec2f) -> f32 {
    if stamped_matter(lattice).b > 0.02 {
        return 0.35;
    }
    return transparent_caustic(lattice, WATER_FLOOR_METRES, WATER_INDEX);
}

fn water_floor(metres: vec2f) -> vec3f {
    let position = metres / WATER_TILE_METRES;
    let tile = vec2i(floor(position));
    let inside = 0.5 - abs(fract(position) - 0.5);
    let seen = footprint_metres() / WATER_TILE_METRES;
    let apart = detail_left(seen);
    let shade = mix(0.5, hash_cell(tile, 61u), apart);
    let accent = mix(0.07, step(0.93, hash_cell(tile, 62u)), apart);
    let glaze = mix(vec3f(0.16, 0.42, 0.47), vec3f(0.27, 0.55, 0.58), shade);
    let tile_colour = mix(glaze, vec3f(0.05, 0.20, 0.34), accent);
    let is_tile = mix(0.84, smoothstep(0.025 - 0.5 * seen, 0.06 + 0.5 * seen, min(inside.x, inside.y)), apart);
    return mix(vec3f(0.62, 0.66, 0.64), tile_colour, is_tile);
}

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    if stamped.b > 0.5 {
        let grain = noise_over(plane_metres(point.lattice), 150.0, 71u);
        let stone = vec3f(0.46, 0.43, 0.39) * mix(0.75, 1.1, grain) * mix(0.55, 1.0, smoothstep(0.0, 0.9, point.level));
        return sooty(stone, stamped.r);
    }
    let normal = point.normal_world;
    let seen = max(dot(normal, point.toward_eye), 0.02);
    let mirror = transparent_mirror(WATER_INDEX, seen);

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
    let glow = floor_radiance * (1.0 - mirror) + transparent_mirrored(point) * mirror;
    return Matter(vec3f(0.0), 0.0, view.shininess, glow, 1.0, 0.0, 0.0);
}
