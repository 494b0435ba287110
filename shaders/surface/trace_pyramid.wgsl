// Pyramidal displacement mapping ([PDM] §3.2 and 3.3): from the root of the pyramid down, to where the ray meets the texels as
// columns, and from there to the bilinear surface by one interpolation over half a pixel either way.
//
//   height   r32float  read  the column under the ray, three a leaf at the most              4 bytes each
//                            and through sample_height: two bilinear samples a refinement  16 bytes each
//   pyramid  r32float  read  level k: the largest corner under each node of 2^k cells a side  4 bytes a node
//
// [PDM]'s pyramid takes its bounds over the texels of a block. Ours, which `exact` needs, takes them over the corners of cells;
// the column that stands at a position is one of its cell's corners, so that they bound the columns as well, and no less safely.
// A leaf is then a cell with the quarters of four columns in it, where the paper's is one column: the surface that a ray meets
// is the paper's (fig. 14, top), steps count a little differently.
//
// Of fig. 13 it mends what its text means: it samples at the ray's end, not at its start; a node is left by its own border,
// integer ids keep it from being met again, and no offset is added; after a crossing that leaves the node above the search goes
// on there, where the paper's stays at the finest it came to; and it climbs and descends by the traversal's stride, two levels at once.
//
// The refinement is §3.3's, and an approximation by design: it believes that the bilinear surface is met within half a texel of
// the column's. It steps over what rises less than that, and over a ridge between columns that the ray passes without touching
// one. Where the ray is already under the surface half a pixel before the column, that is the answer: fig. 16's absolute values
// would lead further in.
//
// Specification: src/reference/trace_pyramid.rs. Needs surface/traversal, surface/march.

const TRACE_PYRAMID_REFINED: u32 = 1u;

// A node is a cell of level 0, known as integers, and a level: climbing and descending only change the level. Levels are the mips of
// `pyramid`, of floor sizes, and the last node of a row takes the remainder.

// What does not change on the way.
struct TracePyramidWay {
    cells: vec2i,          // of the field, an axis
    wraps: bool,
    backward: vec2<bool>,  // axes on which the ray goes down
    toward: vec2i,         // −1 there, else 1
    top: i32,              // the coarsest level
}

// Where the ray is.
struct TracePyramidPlace {
    cell: vec2i,  // of level 0, in the field's tile
    tile: vec2i,  // the texel at which that tile begins, counted from the ray's own cell
    level: i32,
}

// The node of the place's level that holds its cell: the last of a row takes the remainder.
fn trace_pyramid_node(way: TracePyramidWay, place: TracePyramidPlace, level: i32) -> vec2i {
    return min(place.cell >> vec2u(u32(level)), trace_pyramid_nodes(way, level) - 1);
}

fn trace_pyramid_nodes(way: TracePyramidWay, level: i32) -> vec2i {
    return max(way.cells >> vec2u(u32(level)), vec2i(1));
}

// The place on the other side of the node's border on the axis that is crossed; `within` is the cell before, at the border.
fn trace_pyramid_across(way: TracePyramidWay, place: TracePyramidPlace, within: vec2i, crosses: vec2<bool>) -> TracePyramidPlace {
    let cell = select(within, within + way.toward, crosses);
    // Climb where that leaves the node above behind, and never into a node that holds what was just left: rounding could lead back.
    let above = min(place.level + TRAVERSAL_STRIDE, way.top);
    let last_parent = trace_pyramid_nodes(way, above) - 1;
    let leaves = crosses & (min(within >> vec2u(u32(above)), last_parent) != min(cell >> vec2u(u32(above)), last_parent));
    // A tile's end leaves every node behind.
    let over = select(vec2i(0), way.cells * way.toward, vec2<bool>(way.wraps) & ((cell < vec2i(0)) | (cell >= way.cells)));
    return TracePyramidPlace(cell - over, place.tile + over, select(place.level, above, any(leaves) || any(over != vec2i(0))));
}

fn trace_pyramid_way(travel: vec2f) -> TracePyramidWay {
    let backward = travel < vec2f(0.0);
    let toward = select(vec2i(1), vec2i(-1), backward);
    return TracePyramidWay(vec2i(view.field_size), view_wraps(), backward, toward, i32(textureNumLevels(pyramid)) - 1);
}

// The place at a lattice position, counted from the ray's cell, from which the ray goes on.
fn trace_pyramid_place(ray: Ray, way: TracePyramidWay, at: vec2f, level: i32) -> TracePyramidPlace {
    let cell = vec2i(select(floor(at), ceil(at) - 1.0, way.backward)) + ray.cell;
    if way.wraps {
        let within = field_wrapped(cell, way.cells);
        return TracePyramidPlace(within, cell - within - ray.cell, level);
    }
    return TracePyramidPlace(clamp(cell, vec2i(-1), way.cells - 1), -ray.cell, level);
}

// Where the ray meets the far borders of the place's node, an axis.
fn trace_pyramid_borders(ray: Ray, way: TracePyramidWay, place: TracePyramidPlace, node: vec2i, per_travel: vec2f) -> vec2f {
    let outermost = node == select(trace_pyramid_nodes(way, place.level) - 1, vec2i(-1), way.backward);
    let far = (node + select(vec2i(1), vec2i(0), way.backward)) << vec2u(u32(place.level));
    let border = select(far, way.cells, outermost);
    let crossed = (vec2f(border + place.tile) - ray.lattice) * per_travel;
    return select(crossed, vec2f(TRAVERSAL_NEVER), outermost & vec2<bool>(!way.wraps));
}

// The place after the node's: down into it where the ray enters it, at a lattice position counted from the ray's cell, else
// across the border. Rounding never carries it out of the node.
fn trace_pyramid_onward(
    way: TracePyramidWay, place: TracePyramidPlace, node: vec2i, at: vec2f, enters: bool, crosses: vec2<bool>, finest: i32,
) -> TracePyramidPlace {
    let scale = vec2u(u32(place.level));
    let first = max(node << scale, vec2i(-1));
    let last = select(((node + 1) << scale) - 1, way.cells - 1, node == trace_pyramid_nodes(way, place.level) - 1);
    let there = clamp(vec2i(floor(at)) - place.tile, first, last);
    if enters {
        return TracePyramidPlace(there, place.tile, max(place.level - TRAVERSAL_STRIDE, finest));
    }
    return trace_pyramid_across(way, place, select(there, select(last, first, way.backward), crosses), crosses);
}

// Where the ray meets a column of the place's cell between t_in and t_out; beyond t_out where it does not.
fn trace_pyramid_leaf(ray: Ray, way: TracePyramidWay, place: TracePyramidPlace, per_travel: vec2f, t_in: f32, t_out: f32) -> f32 {
    // Columns part halfway between texel centres.
    let middle = vec2f(place.cell + place.tile) + 0.5;
    let parts = clamp((middle - ray.lattice) * per_travel, vec2f(t_in), vec2f(t_out));
    let moves = abs(ray.travel) >= vec2f(TRAVERSAL_STILL);
    let stands = ray.lattice >= middle;
    let begins = vec3f(t_in, min(parts.x, parts.y), max(parts.x, parts.y));
    let ends = vec3f(begins.yz, t_out);
    for (var i = 0; i < 3; i++) {
        if begins[i] >= ends[i] {
            continue;
        }
        let passed = vec2f(begins[i]) >= parts;
        let high = select(stands, passed != way.backward, moves);
        let column = load_height(place.cell + select(vec2i(0), vec2i(1), high));
        // Into its side, or onto its top.
        if ray_height(ray, begins[i]) <= column {
            return begins[i];
        }
        let t = (column - ray.height) / min(ray.rise, -TRAVERSAL_STILL);
        if ray.rise < 0.0 && t <= ends[i] {
            return max(t, begins[i]);
        }
    }
    return 2.0 * t_out + 1.0;
}

fn trace_pyramid(ray: Ray) -> Hit {
    let still = abs(ray.travel) < vec2f(TRAVERSAL_STILL);
    let travel = select(ray.travel, vec2f(0.0), still);
    let per_travel = 1.0 / select(ray.travel, vec2f(TRAVERSAL_STILL), still);
    let way = trace_pyramid_way(travel);
    let falls = ray.rise < 0.0;
    let half_pixel = 0.5 / max(length(travel), 1e-20);

    let finest = min(i32(traversal_detail), way.top);
    var place = trace_pyramid_place(ray, way, ray.lattice, way.top);
    var t = 0.0;
    var steps = 0u;
    while steps < view.step_cap {
        steps += 1u;
        let node = trace_pyramid_node(way, place, place.level);
        let bound = textureLoad(pyramid, max(node, vec2i(0)), place.level).r + TRAVERSAL_SLACK;
        let t_border = trace_pyramid_borders(ray, way, place, node, per_travel);
        let t_out = max(t, min(min(t_border.x, t_border.y), ray.t_end));
        let crosses = vec2<bool>(t_border.x <= t_border.y, t_border.x > t_border.y);

        // Advance the ray to the bound, but not over the node's border ([PDM] fig. 7 and 10).
        let t_bound = (bound - ray.height) / select(-1.0, ray.rise, falls);
        let t_under = select(t, max(t, t_bound), falls);
        let enters = select(ray_height(ray, t) <= bound, t_under <= t_out, falls);
        if DETAIL && enters && traversal_detail > 0.0 && place.level == finest {
            // [PDM] §3.4: the traversal ends at the pixel's own level.
            let share = traversal_coarse_leaf(ray, t_under, t_out);
            hit_level = place.level;
            if share <= 1.0 {
                return hit_at(ray, mix(t_under, t_out, share), steps);
            }
        } else if enters && place.level == 0 {
            let t_column = trace_pyramid_leaf(ray, way, place, per_travel, t_under, t_out);
            if t_column <= t_out {
                if view.pyramid_leaf != TRACE_PYRAMID_REFINED {
                    return hit_at(ray, t_column, steps);
                }
                // Half a pixel back and half a pixel on ([PDM] fig. 16).
                let back = max(t_column - half_pixel, 0.0);
                let forward = min(t_column + half_pixel, ray.t_end);
                let gap_back = max(march_gap(ray, back), 0.0);
                let gap_forward = march_gap(ray, forward);
                steps += 2u;
                if gap_forward <= 0.0 {
                    let share = gap_back / max(gap_back - gap_forward, 1e-20);
                    return hit_at(ray, mix(back, forward, share), steps);
                }
                if forward >= ray.t_end {
                    return end_of(ray, steps);
                }
                // It does not meet the bilinear surface there: on from the forward position, at this level ([PDM] fig. 17).
                t = forward;
                place = trace_pyramid_place(ray, way, ray.lattice + t * travel, 0);
                continue;
            }
        }
        let descends = enters && place.level > finest;
        if !descends && t_out >= ray.t_end {
            return end_of(ray, steps);
        }
        t = select(t_out, t_under, descends);
        place = trace_pyramid_onward(way, place, node, ray.lattice + t * travel, descends, crosses, finest);
    }
    return Hit(ray_at(ray, t), ray_height(ray, t), t, steps, CAPPED);
}

fn trace(ray: Ray) -> Hit {
    traversal_detail = footprint.trace_level;
    let hit = trace_pyramid(ray);
    traversal_detail = 0.0;
    return hit;
}
