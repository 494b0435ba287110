// Level cap: the trace of a view, in which the traversal ends at a chosen level of the pyramid and takes its bounds for the surface
// ([PDM] fig. 18, minification by a limit of the traversal's level): the relief as boxes.
//
//   pyramid  r32float  read  level view.level_cap: a node a step   4 bytes
//
// Needs surface/traversal.

// Cells away: further than any field is long.
const LEVEL_CAP_FAR: i32 = 0x1000000;

fn trace(ray: Ray) -> Hit {
    let levels = i32(textureNumLevels(pyramid));
    let level = clamp(i32(view.level_cap), 0, levels - 1);
    hit_level = level;
    let size = vec2i(view.field_size);
    let last = max(size >> vec2u(u32(level)), vec2i(1)) - 1;
    let wraps = view_wraps();
    let forward = ray.travel > vec2f(0.0);
    let per_travel = 1.0 / select(ray.travel, vec2f(TRAVERSAL_STILL), abs(ray.travel) < vec2f(TRAVERSAL_STILL));

    var t = 0.0;
    var cell = vec2i(floor(ray.lattice)); // counted from ray.cell, like the ray
    var steps = 0u;
    while steps < view.step_cap {
        steps += 1u;
        let absolute = cell + ray.cell;
        let within = select(clamp(absolute, vec2i(0), size - 1), address(absolute), vec2<bool>(wraps));
        let node = min(within >> vec2u(u32(level)), last);
        let bound = textureLoad(pyramid, node, level).r;

        // The node's borders, counted as the ray is; a clamped field's outermost nodes go on for ever.
        let shift = select(vec2i(0), absolute - within, vec2<bool>(wraps)) - ray.cell;
        let endless = vec2<bool>(!wraps);
        let low = select((node << vec2u(u32(level))) + shift, vec2i(-LEVEL_CAP_FAR), endless & (node == vec2i(0)));
        let end = select((node + 1) << vec2u(u32(level)), size, node == last) + shift;
        let high = select(end, vec2i(LEVEL_CAP_FAR), endless & (node == last));
        let crossed = (vec2f(select(low, high, forward)) - ray.lattice) * per_travel;
        let t_out = clamp(min(crossed.x, crossed.y), t, ray.t_end);

        // Under its bound where it comes in: it meets the box's side; or it comes down upon its top.
        var t_hit = t;
        if ray_height(ray, t) > bound {
            t_hit = select(TRAVERSAL_NEVER, (bound - ray.height) / ray.rise, ray.rise < 0.0);
        }
        if t_hit <= t_out {
            return Hit(ray_at(ray, t_hit), ray_height(ray, t_hit), t_hit, steps, HIT);
        }
        if t_out >= ray.t_end {
            return end_of(ray, steps);
        }
        t = t_out;
        // Across the border on one axis, along the node on the other.
        let along = clamp(vec2i(floor(ray.lattice + t * ray.travel)), low, high - 1);
        let across = select(low - 1, high, forward);
        cell = select(along, across, vec2<bool>(crossed.x <= crossed.y, crossed.x > crossed.y));
    }
    return Hit(ray_at(ray, t), ray_height(ray, t), t, steps, CAPPED);
}
