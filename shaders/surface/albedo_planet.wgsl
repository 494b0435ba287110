// Planet: dust on the plains, pale rock where craters broke it, dark lava in the basins, frost on the poles. Every colour is a
// function of the point on the sphere, so that there is no seam. Made for the base `planet`.

// A number in [0, 1) for a lattice point in space.
fn planet_hash(cell: vec3i, salt: u32) -> f32 {
    return hash_cell(cell.xy, hash_u32(bitcast<u32>(cell.z) ^ salt));
}

// Value noise in space, in [0, 1).
fn planet_noise(position: vec3f, salt: u32) -> f32 {
    let cell = floor(position);
    let i = vec3i(cell);
    let f = position - cell;
    let s = f * f * (3.0 - 2.0 * f);
    var layers = vec2f(0.0);
    for (var z = 0; z < 2; z++) {
        let low = mix(planet_hash(i + vec3i(0, 0, z), salt), planet_hash(i + vec3i(1, 0, z), salt), s.x);
        let high = mix(planet_hash(i + vec3i(0, 1, z), salt), planet_hash(i + vec3i(1, 1, z), salt), s.x);
        layers[z] = mix(low, high, s.y);
    }
    return mix(layers.x, layers.y, s.z);
}

fn planet_octaves(position: vec3f, salt: u32) -> f32 {
    return (8.0 * planet_noise(position, salt) + 4.0 * planet_noise(2.03 * position, salt + 1u)
        + 2.0 * planet_noise(4.11 * position, salt + 2u) + planet_noise(8.23 * position, salt + 3u)) / 15.0;
}

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let uv = uv_of(point.lattice);
    let longitude = 6.2831853 * uv.x;
    let from_north = 3.1415927 * uv.y;
    let place = vec3f(sin(from_north) * cos(longitude), cos(from_north), sin(from_north) * sin(longitude));

    let broad = planet_octaves(place * 2.3, 111u);
    let fine = planet_octaves(place * 36.0, 121u);
    let dust = mix(vec3f(0.30, 0.145, 0.070), vec3f(0.46, 0.265, 0.140), broad) * mix(0.80, 1.12, fine);
    let lava = vec3f(0.105, 0.080, 0.072) * mix(0.75, 1.2, fine);
    let rock = mix(vec3f(0.36, 0.29, 0.235), vec3f(0.52, 0.45, 0.38), fine);
    let low = 1.0 - smoothstep(0.36, 0.47, point.height + 0.18 * (broad - 0.5));
    let high = smoothstep(0.53, 0.66, point.height + 0.10 * (fine - 0.5));
    let steep = 1.0 - smoothstep(0.70, 0.93, point.level);
    var ground = mix(mix(dust, lava, 0.75 * low), rock, max(0.8 * high, 0.6 * steep));
    let frost = smoothstep(0.86, 0.93, abs(place.y) + 0.09 * (broad - 0.5) + 0.05 * (fine - 0.5));
    ground = mix(ground, vec3f(0.80, 0.82, 0.84), frost * smoothstep(0.45, 0.75, point.level));
    return sooty(mix(ground, rock, 0.6 * stamped.g), stamped.r);
}
