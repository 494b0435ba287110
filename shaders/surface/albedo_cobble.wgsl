// Cobble: rounded stones of several greys in dark sand. The layout is that of the base `cobbles` (src/field/base/masonry.rs).

override COBBLE_SIZE: f32; // metres from stone to stone

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let metres = plane_metres(point.lattice);
    let position = metres / COBBLE_SIZE;
    let home = vec2i(floor(position));
    var nearest = 1e9;
    var second = 1e9;
    var stone = vec2i(0);
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let cell = home + vec2i(x, y);
            let centre = vec2f(cell) + 0.5 + 0.55 * (vec2f(hash_cell(cell, 41u), hash_cell(cell, 42u)) - 0.5);
            let distance = length(position - centre);
            if distance < nearest {
                second = nearest;
                nearest = distance;
                stone = cell;
            } else {
                second = min(second, distance);
            }
        }
    }
    let grain = fractal_noise(metres * 140.0, 7u);
    let hue = hash_cell(stone, 43u);
    let granite = mix(vec3f(0.17, 0.165, 0.16), vec3f(0.42, 0.39, 0.36), hue) * mix(0.75, 1.15, grain);
    let sand = vec3f(0.105, 0.088, 0.070) * mix(0.7, 1.2, grain);
    let colour = mix(sand, granite, smoothstep(0.06, 0.16, second - nearest));
    return sooty(mix(colour, vec3f(0.52, 0.50, 0.48), 0.6 * stamped.g), stamped.r);
}
