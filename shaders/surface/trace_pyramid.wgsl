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

// Where the ray meets a column of the place's cell between t_in and t_out; beyond t_out where it does not.
fn trace_pyramid_leaf(ray: Ray, way: TraversalWay, place: TraversalPlace, per_travel: vec2f, t_in: f32, t_out: f32) -> f32 {
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
    let way = traversal_way(travel);
    let falls = ray.rise < 0.0;
    let half_pixel = 0.5 / max(length(travel), 1e-20);

    let finest = min(i32(traversal_detail), way.top);
    var place = traversal_place(ray, way, ray.lattice, way.top);
    var t = 0.0;
    var steps = 0u;
    while steps < view.step_cap {
        steps += 1u;
        let node = traversal_node(way, place, place.level);
        let bound = textureLoad(pyramid, max(node, vec2i(0)), place.level).r + TRAVERSAL_SLACK;
        let t_border = traversal_borders(ray, way, place, node, per_travel);
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
                place = traversal_place(ray, way, ray.lattice + t * travel, 0);
                continue;
            }
        }
        let descends = enters && place.level > finest;
        if !descends && t_out >= ray.t_end {
            return end_of(ray, steps);
        }
        t = select(t_out, t_under, descends);
        place = traversal_onward(way, place, node, ray.lattice + t * travel, descends, crosses, finest);
    }
    return Hit(ray_at(ray, t), ray_height(ray, t), t, steps, CAPPED);
}

fn trace(ray: Ray) -> Hit {
    traversal_detail = footprint.trace_level;
    let hit = trace_pyramid(ray);
    traversal_detail = 0.0;
    return hit;
}
