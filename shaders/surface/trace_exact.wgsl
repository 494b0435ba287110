// Exact: where the ray first meets the bilinear surface; with a level of detail, unless exact is to stay so, the one that is averaged
// over the pixel.
//
// Specification: src/reference/trace_exact.rs. Needs surface/traversal.

// The first meeting with the mean heights of the level of detail, through nodes no finer than that.
fn trace_exact_coarse(ray: Ray) -> Hit {
    let way = traversal_way(ray.lattice, ray.travel);
    let finest = clamp(i32(traversal_detail), 1, way.top);
    var at = traversal_start(way, ray.cell, traversal_begin(way, ray), ray.t_end);
    at.place.level = max(at.place.level, finest);
    var steps = 0u;
    while steps < view.step_cap {
        steps += 1u;
        let visit = traversal_visit(way, at.place, at.t, ray.height, ray.rise, ray.t_end);
        let enters = visit.t_under <= visit.t_out;
        let arrives = enters && at.place.level == finest;
        let share = traversal_coarse_leaf(ray, visit.t_under, visit.t_out);
        if arrives && share <= 1.0 {
            hit_level = finest;
            return hit_at(ray, mix(visit.t_under, visit.t_out, share), steps);
        }
        let descends = enters && !arrives;
        if !descends && visit.t_out >= ray.t_end {
            return end_of(ray, steps);
        }
        at.t = select(visit.t_out, visit.t_under, descends);
        let there = traversal_cell(way, at.place.tile, at.t, at.place.cell, visit.last);
        if descends {
            at.place.cell = there;
            at.place.level = max(at.place.level - TRAVERSAL_STRIDE, finest);
        } else {
            at.place = traversal_across(way, at.place, there, visit.last, vec2<bool>(visit.by_u, !visit.by_u));
        }
    }
    return Hit(ray_at(ray, at.t), ray_height(ray, at.t), at.t, steps, CAPPED);
}

fn trace(ray: Ray) -> Hit {
    hit_level = 0;
    if DETAIL && footprint.trace_level > 0.0 {
        traversal_detail = footprint.trace_level;
        let hit = trace_exact_coarse(ray);
        traversal_detail = 0.0;
        return hit;
    }
    return traversal(ray);
}
