// Traversal: a ray against the bilinear surface, exactly, through the pyramid of cell bounds ([PDM] with corner bounds).
//
//   height   r32float  read  the field; four texels a leaf                                   16 bytes
//   pyramid  r32float  read  level k: the largest corner under each node of 2^k cells a side  4 bytes a node
//
// The ray is where its parameter t says; the cell of level 0 that it is in is known as integers, and a node is that cell and a
// level: climbing and descending only change the level. A border's parameter is always (border − origin) / travel, from the
// ray's origin to an integer, so nothing accumulates over a long ray, and a ray along an axis never divides. Rounding can
// misplace the ray by some 2⁻²⁴ of its largest coordinate, never more: each cell is tested over the stretch of the ray that its
// own borders cut, and what counts is the sign of (ray − surface) where it enters and leaves, not whether a root seems to lie
// between. A test of the roots loses rays through borders, up to 0.78 of the height range deep.
//
// Specification: src/reference/traversal.rs. Needs common/view, surface/ray, a height part, and `pyramid`.

// How far a bound is raised: rounding of the bilinear and of the ray's height, eight steps of f32 below 1.
const TRAVERSAL_SLACK: f32 = 4.8e-7;
// A travel below this crosses no border: 1 / travel would overflow.
const TRAVERSAL_STILL: f32 = 1e-20;
// Where a ray meets the outer border of a clamped field's outermost cells: never.
const TRAVERSAL_NEVER: f32 = 3e38;

// The first meeting of the ray with the surface for t in [t_begin, t_end]. A falling ray (rise < 0) that is still above it at
// t_end has met the floor of the slab there; a climbing one has left.
fn traversal(ray: Ray, t_begin: f32, t_end: f32) -> Hit {
    let cells = vec2i(view.field_size);
    let top = i32(textureNumLevels(pyramid)) - 1;
    let wraps = view.wrap != 0u;
    let falls = ray.rise < 0.0;

    let still = abs(ray.travel) < vec2f(TRAVERSAL_STILL);
    let travel = select(ray.travel, vec2f(0.0), still);
    let per_travel = 1.0 / select(ray.travel, vec2f(TRAVERSAL_STILL), still);
    let backward = travel < vec2f(0.0);
    let forward = select(vec2i(1), vec2i(0), backward);
    let toward = select(vec2i(1), vec2i(-1), backward);
    // The cell at the start, and the texel at which its tile begins, counted from the ray's own cell.
    let start = ray.lattice + t_begin * travel;
    var cell = vec2i(select(floor(start), ceil(start) - 1.0, backward)) + ray.cell;
    var tile = vec2i(0);
    if wraps {
        tile = cell / cells;
        tile = (tile - select(vec2i(0), vec2i(1), cell < tile * cells)) * cells;
        cell -= tile;
    } else {
        cell = clamp(cell, vec2i(-1), cells - 1);
    }
    tile -= ray.cell;

    // Coarser first nodes are rarely clear of the surface, finer ones are many: half the ray's extent measured best.
    let extent = max(abs(travel.x), abs(travel.y)) * (t_end - t_begin);
    var level = clamp(i32(floor(log2(max(extent, 1.0)))) - 1, 0, top);

    var t = t_begin;
    var steps = 0u;
    while steps < view.step_cap {
        steps += 1u;

        // The node, its bound, and where the ray leaves it.
        let nodes = max(cells >> vec2u(u32(level)), vec2i(1));
        let node = min(cell >> vec2u(u32(level)), nodes - 1);
        let bound = textureLoad(pyramid, max(node, vec2i(0)), level).r + TRAVERSAL_SLACK;
        let outermost = node == select(nodes - 1, vec2i(-1), backward);
        let border = select((node + forward) << vec2u(u32(level)), cells, outermost);
        let crossed = (vec2f(border + tile) - ray.lattice) * per_travel;
        let t_border = select(crossed, vec2f(TRAVERSAL_NEVER), outermost & vec2<bool>(!wraps));
        let t_out = max(t, min(min(t_border.x, t_border.y), t_end));

        // From where on it is under the bound, if it comes to that ([PDM] fig. 7: advance the ray to the bound).
        let t_bound = (bound - ray.height) * ray.rise;
        let t_under = select(select(2.0 * t_end + 1.0, t, t <= t_bound), max(t, t_bound), falls);
        let enters = t_under <= t_out;
        if enters && level == 0 {
            let hit = traversal_leaf(ray, travel, cell, tile, t_under, t_out);
            if hit <= 1.0 {
                let t_hit = t_under + hit * (t_out - t_under);
                return Hit(ray_at(ray, t_hit), ray.height + ray.rise * t_hit, t_hit, steps, HIT);
            }
        }
        let descends = enters && level > 0;
        if !descends && t_out >= t_end {
            return Hit(ray_at(ray, t_end), ray.height + ray.rise * t_end, t_end, steps, select(MISS, HIT, falls));
        }

        // Go there. Rounding never carries the cell out of the node …
        t = select(t_out, t_under, descends);
        let first = max(node << vec2u(u32(level)), vec2i(-1));
        let last = select(((node + 1) << vec2u(u32(level))) - 1, cells - 1, node == nodes - 1);
        let there = clamp(vec2i(floor(ray.lattice + t * travel)) - tile, first, last);
        if descends {
            cell = there;
            level -= 1;
            continue;
        }
        // … and a crossed border puts it on the border's other side.
        let crosses = vec2<bool>(t_border.x <= t_border.y, t_border.x > t_border.y);
        cell = select(there, select(last + 1, first - 1, backward), crosses);
        // Climb where that leaves a parent behind: never into a node that holds what was just left, or rounding could lead back.
        let last_parent = max(nodes >> vec2u(1u), vec2i(1)) - 1;
        let leaves = outermost | (min(node >> vec2u(1u), last_parent) != min((node + toward) >> vec2u(1u), last_parent));
        level = min(level + select(0, 1, any(leaves & crosses)), top);
        if wraps {
            let over = select(vec2i(0), cells, cell >= cells) - select(vec2i(0), cells, cell < vec2i(0));
            cell -= over;
            tile += over;
        }
    }
    return Hit(ray_at(ray, t), ray.height + ray.rise * t, t, steps, CAPPED);
}

// Where on its way through a cell, from 0 at t_in to 1 at t_out, the ray first meets the bilinear patch; 2 where it does not.
//
// On that way g = (ray − surface) is A s² + B s + C with C = g(0) and A + B + C = g(1), both evaluated where they are.
fn traversal_leaf(ray: Ray, travel: vec2f, cell: vec2i, tile: vec2i, t_in: f32, t_out: f32) -> f32 {
    let z = load_corners(cell);
    let along_u = z.y - z.x;
    let along_v = z.z - z.x;
    let twist = z.x - z.y - z.z + z.w;

    let origin = ray.lattice - vec2f(cell + tile);
    let enter = clamp(origin + t_in * travel, vec2f(0.0), vec2f(1.0));
    let leave = clamp(origin + t_out * travel, vec2f(0.0), vec2f(1.0));
    let c = ray.height + ray.rise * t_in - (z.x + along_u * enter.x + (along_v + twist * enter.x) * enter.y);
    let end = ray.height + ray.rise * t_out - (z.x + along_u * leave.x + (along_v + twist * leave.x) * leave.y);
    let a = -twist * (leave.x - enter.x) * (leave.y - enter.y);
    let b = end - c - a;
    if c <= 0.0 {
        return 0.0;
    }
    // Under the surface at the end, or on the way there: a vertex inside with g no more than 0.
    let discriminant = b * b - 4.0 * a * c;
    let dips = a > 0.0 && b < 0.0 && -b < 2.0 * a && discriminant >= 0.0;
    if end > 0.0 && !dips {
        return 2.0;
    }
    // The smaller root that is not negative, without cancellation.
    let root = sqrt(max(discriminant, 0.0));
    let s = select((b + root) / (-2.0 * a), 2.0 * c / (root - b), b < 0.0);
    return clamp(s, 0.0, 1.0);
}
