// Cobble: rounded stones of several greys in dark sand. The layout is that of the base `cobbles` (src/field/base/masonry.rs).

override COBBLE_SIZE: f32; // metres from stone to stone

// The share of stone in the picture of many.
const COBBLE_STONE: f32 = 0.77;

// The cell of a stone in the tile of a field that wraps: what its height and its colour are told by.
fn cobble_home(cell: vec2i, cells: vec2i) -> vec2i {
    let remainder = cell % cells;
    return select(cell, select(remainder, remainder + cells, remainder < vec2i(0)), view_wraps());
}

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let metres = plane_metres(point.lattice);
    // Where the field wraps, a whole number of stones fits it.
    let cells = max(round(view.plane_size_metres / COBBLE_SIZE), vec2f(1.0));
    let size = select(vec2f(COBBLE_SIZE), view.plane_size_metres / cells, view_wraps());
    let seen = footprint_metres() / COBBLE_SIZE;
    let apart = detail_left(seen);
    let grain = noise_over(metres, 140.0, 7u);
    let sand = vec3f(0.105, 0.088, 0.070) * mix(0.7, 1.2, grain);
    if apart == 0.0 {
        return cobble_matter(sand, COBBLE_STONE, 0.5, grain, stamped);
    }

    let position = metres / size;
    let home = vec2i(floor(position));
    var nearest = 1e9;
    var second = 1e9;
    var stone = vec2i(0);
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let at = home + vec2i(x, y);
            let cell = cobble_home(at, vec2i(cells));
            let centre = vec2f(at) + 0.5 + 0.55 * (vec2f(hash_cell(cell, 41u), hash_cell(cell, 42u)) - 0.5);
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
    // From one stone to the next the difference of the distances grows twice as fast as either.
    let is_stone = mix(COBBLE_STONE, smoothstep(0.06 - seen, 0.16 + seen, second - nearest), apart);
    return cobble_matter(sand, is_stone, mix(0.5, hash_cell(stone, 43u), apart), grain, stamped);
}

fn cobble_matter(sand: vec3f, is_stone: f32, hue: f32, grain: f32, stamped: vec4f) -> Matter {
    let granite = mix(vec3f(0.17, 0.165, 0.16), vec3f(0.42, 0.39, 0.36), hue) * mix(0.75, 1.15, grain);
    let colour = mix(sand, granite, is_stone);
    return sooty(mix(colour, vec3f(0.52, 0.50, 0.48), 0.6 * stamped.g), stamped.r);
}
