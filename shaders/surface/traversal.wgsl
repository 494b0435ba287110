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

// Levels by which a search climbs and descends at once. Ones in between cost a visit each and seldom end one: two at once take a tenth
// less than one by one where a field of 2048² is seen, three no less than two.
const TRAVERSAL_STRIDE: i32 = 2;

// How far a ray toward a light is lifted off the surface that it starts from: five times what rounding can do to a height, so
// that its slope against the light decides the rest, and a tenth of what a shadow may miss.
const TRAVERSAL_LIFT: f32 = 9.6e-7;

// What does not change on the way.
struct TraversalWay {
    cells: vec2i,          // of the field, an axis
    wraps: bool,
    backward: vec2<bool>,  // axes on which the ray goes down
    toward: vec2i,         // −1 there, else 1
    top: i32,              // the coarsest level
}

// How coarse a surface the traversal looks for: the mip level of the mean heights at which it stops, 0 for the field itself ([PDM]
// §3.4). What sets it resets it.
var<private> traversal_detail: f32;

// Where the ray is.
struct TraversalPlace {
    cell: vec2i,  // of level 0, in the field's tile
    tile: vec2i,  // the texel at which that tile begins, counted from the ray's own cell
    level: i32,
}

// The node of the place's level that holds its cell: the last of a row takes the remainder.
fn traversal_node(way: TraversalWay, place: TraversalPlace, level: i32) -> vec2i {
    return min(place.cell >> vec2u(u32(level)), traversal_nodes(way, level) - 1);
}

fn traversal_nodes(way: TraversalWay, level: i32) -> vec2i {
    return max(way.cells >> vec2u(u32(level)), vec2i(1));
}

// The place on the other side of the node's border on the axis that is crossed; `within` is the cell before, at the border.
fn traversal_across(way: TraversalWay, place: TraversalPlace, within: vec2i, crosses: vec2<bool>) -> TraversalPlace {
    let cell = select(within, within + way.toward, crosses);
    // Climb where that leaves the node above behind, and never into a node that holds what was just left: rounding could lead back.
    let above = min(place.level + TRAVERSAL_STRIDE, way.top);
    let last_parent = traversal_nodes(way, above) - 1;
    let leaves = crosses & (min(within >> vec2u(u32(above)), last_parent) != min(cell >> vec2u(u32(above)), last_parent));
    // A tile's end leaves every node behind.
    let over = select(vec2i(0), way.cells * way.toward, vec2<bool>(way.wraps) & ((cell < vec2i(0)) | (cell >= way.cells)));
    return TraversalPlace(cell - over, place.tile + over, select(place.level, above, any(leaves) || any(over != vec2i(0))));
}

// Nothing is above this.
fn traversal_highest() -> f32 {
    return textureLoad(pyramid, vec2i(0), i32(textureNumLevels(pyramid)) - 1).r + TRAVERSAL_SLACK;
}

fn traversal_way(travel: vec2f) -> TraversalWay {
    let backward = travel < vec2f(0.0);
    let toward = select(vec2i(1), vec2i(-1), backward);
    return TraversalWay(vec2i(view.field_size), view.wrap != 0u, backward, toward, i32(textureNumLevels(pyramid)) - 1);
}

// The place at a lattice position, counted from the ray's cell, from which the ray goes on.
fn traversal_place(ray: Ray, way: TraversalWay, at: vec2f, level: i32) -> TraversalPlace {
    let cell = vec2i(select(floor(at), ceil(at) - 1.0, way.backward)) + ray.cell;
    if way.wraps {
        let within = field_wrapped(cell, way.cells);
        return TraversalPlace(within, cell - within - ray.cell, level);
    }
    return TraversalPlace(clamp(cell, vec2i(-1), way.cells - 1), -ray.cell, level);
}

// Where the ray meets the far borders of the place's node, an axis.
fn traversal_borders(ray: Ray, way: TraversalWay, place: TraversalPlace, node: vec2i, per_travel: vec2f) -> vec2f {
    let outermost = node == select(traversal_nodes(way, place.level) - 1, vec2i(-1), way.backward);
    let far = (node + select(vec2i(1), vec2i(0), way.backward)) << vec2u(u32(place.level));
    let border = select(far, way.cells, outermost);
    let crossed = (vec2f(border + place.tile) - ray.lattice) * per_travel;
    return select(crossed, vec2f(TRAVERSAL_NEVER), outermost & vec2<bool>(!way.wraps));
}

// The place after the node's: down into it where the ray enters it, at a lattice position counted from the ray's cell, else
// across the border. Rounding never carries it out of the node.
fn traversal_onward(
    way: TraversalWay, place: TraversalPlace, node: vec2i, at: vec2f, enters: bool, crosses: vec2<bool>, finest: i32,
) -> TraversalPlace {
    let scale = vec2u(u32(place.level));
    let first = max(node << scale, vec2i(-1));
    let last = select(((node + 1) << scale) - 1, way.cells - 1, node == traversal_nodes(way, place.level) - 1);
    let there = clamp(vec2i(floor(at)) - place.tile, first, last);
    if enters {
        return TraversalPlace(there, place.tile, max(place.level - TRAVERSAL_STRIDE, finest));
    }
    return traversal_across(way, place, select(there, select(last, first, way.backward), crosses), crosses);
}

// The search of a falling ray begins where it goes under the highest bound.
fn traversal_begin(ray: Ray) -> f32 {
    if ray.rise >= 0.0 {
        return 0.0;
    }
    return clamp((traversal_highest() - ray.height) / ray.rise, 0.0, ray.t_end);
}

// Whether nothing stands in the way from a height over the ray's start, with this travel for each height that is climbed.
fn traversal_escapes(ray: Ray, start: f32, travel: vec2f) -> bool {
    let highest = traversal_highest();
    if start >= highest {
        return true;
    }
    // A ray that gave up found no way out: it counts as blocked.
    return traversal(Ray(ray.lattice, travel, start, 1.0, ray.cell, highest - start, MISS), 0.0).status == MISS;
}

// How far a search has come.
struct TraversalSearch {
    place: TraversalPlace,
    t: f32,               // where it is
    t_under: f32,         // from where on the ray is under the bound of the place's node
    t_out: f32,           // where it leaves that
    crosses: vec2<bool>,  // by which border
    steps: u32,
    arrived: bool,        // at a node of the finest level under whose bound the ray goes
    ended: bool,          // where the ray does
}

// On from a place to the next node of the finest level whose bound the ray goes under, or to the ray's end. A loop of its own: neighbours
// in a SIMD register search together and then solve together, which takes 0.8 of the time of solving as soon as one of them can.
fn traversal_search(ray: Ray, way: TraversalWay, per_travel: vec2f, t_end: f32, finest: i32, begun: TraversalSearch) -> TraversalSearch {
    let falls = ray.rise < 0.0;
    let per_rise = 1.0 / select(ray.rise, 1.0, ray.rise == 0.0);
    let travel = select(ray.travel, vec2f(0.0), abs(ray.travel) < vec2f(TRAVERSAL_STILL));
    var found = begun;
    found.arrived = false;
    while !found.arrived && found.steps < view.step_cap {
        found.steps += 1u;

        // The node, its bound, and where the ray leaves it.
        let node = traversal_node(way, found.place, found.place.level);
        let bound = textureLoad(pyramid, max(node, vec2i(0)), found.place.level).r + TRAVERSAL_SLACK;
        let t_border = traversal_borders(ray, way, found.place, node, per_travel);
        found.t_out = max(found.t, min(min(t_border.x, t_border.y), t_end));

        // From where on it is under the bound, if it comes to that ([PDM] fig. 7: advance the ray to the bound).
        // A level ray is under it all the way or nowhere.
        let level_bound = select(-1.0, TRAVERSAL_NEVER, ray.height <= bound);
        let t_bound = select((bound - ray.height) * per_rise, level_bound, ray.rise == 0.0);
        found.t_under = select(select(2.0 * t_end + 1.0, found.t, found.t <= t_bound), max(found.t, t_bound), falls);
        let enters = found.t_under <= found.t_out;
        found.crosses = vec2<bool>(t_border.x <= t_border.y, t_border.x > t_border.y);
        found.arrived = enters && found.place.level == finest;
        if !found.arrived {
            if !enters && found.t_out >= t_end {
                found.ended = true;
                break;
            }
            // Down to where it goes under the bound, or across the border. Rounding never carries it out of the node.
            found.t = select(found.t_out, found.t_under, enters);
            found.place = traversal_onward(way, found.place, node, ray.lattice + found.t * travel, enters, found.crosses, finest);
        }
    }
    return found;
}

// The first meeting of the ray with the surface for t in [t_begin, t_end].
fn traversal(ray: Ray, t_begin: f32) -> Hit {
    let t_end = ray.t_end;
    let still = abs(ray.travel) < vec2f(TRAVERSAL_STILL);
    let travel = select(ray.travel, vec2f(0.0), still);
    let per_travel = 1.0 / select(ray.travel, vec2f(TRAVERSAL_STILL), still);
    let way = traversal_way(travel);

    // The place at the start. Coarser first nodes are rarely clear of the surface, finer ones are many: half the ray's extent
    // measured best.
    let start = ray.lattice + t_begin * travel;
    let extent = max(abs(travel.x), abs(travel.y)) * (t_end - t_begin);
    let finest = select(0, min(i32(traversal_detail), way.top), DETAIL);
    let level = clamp(i32(floor(log2(max(extent, 1.0)))) - 1, finest, way.top);
    let place = traversal_place(ray, way, start, level);

    var found = TraversalSearch(place, t_begin, t_begin, t_begin, vec2<bool>(false), 0u, false, false);
    while found.steps < view.step_cap {
        found = traversal_search(ray, way, per_travel, t_end, finest, found);
        if found.ended {
            return end_of(ray, found.steps);
        }
        if !found.arrived {
            break;
        }
        var hit: f32;
        if DETAIL && traversal_detail > 0.0 {
            hit = traversal_coarse_leaf(ray, found.t_under, found.t_out);
            hit_level = found.place.level;
        } else {
            hit = traversal_leaf(ray, travel, way, found.place, found.t_under, found.t_out);
        }
        if hit <= 1.0 {
            let t_hit = found.t_under + hit * (found.t_out - found.t_under);
            return Hit(ray_at(ray, t_hit), ray_height(ray, t_hit), t_hit, found.steps, HIT);
        }
        if found.t_out >= t_end {
            return end_of(ray, found.steps);
        }
        found.t = found.t_out;
        let within = traversal_leaving(ray, way, found.place, found.t * travel, found.crosses);
        found.place = traversal_across(way, found.place, within, found.crosses);
    }
    return Hit(ray_at(ray, found.t), ray_height(ray, found.t), found.t, found.steps, CAPPED);
}

// The cell in which a ray that has come so far leaves the place's node, which may be of any level.
fn traversal_leaving(ray: Ray, way: TraversalWay, place: TraversalPlace, gone: vec2f, crosses: vec2<bool>) -> vec2i {
    if place.level == 0 {
        return place.cell;
    }
    let scale = vec2u(u32(place.level));
    let node = traversal_node(way, place, place.level);
    let first = max(node << scale, vec2i(-1));
    let last = select(((node + 1) << scale) - 1, way.cells - 1, node == traversal_nodes(way, place.level) - 1);
    let there = clamp(vec2i(floor(ray.lattice + gone)) - place.tile, first, last);
    return select(there, select(last, first, way.backward), crosses);
}

// The same of a way through a node of any level, against the mean heights there: their surface is nearly straight over a node of
// its own level, and moves smoothly as the level does, so that nothing pops.
fn traversal_coarse_leaf(ray: Ray, t_in: f32, t_out: f32) -> f32 {
    let enter = ray_height(ray, t_in) - height_over(ray_at(ray, t_in), traversal_detail);
    let leave = ray_height(ray, t_out) - height_over(ray_at(ray, t_out), traversal_detail);
    if enter <= 0.0 {
        return 0.0;
    }
    return select(2.0, enter / (enter - leave), leave <= 0.0);
}

// The corners of the place's cell, which is one of the field's or the half cell before it: no remainder to take, as load_corners
// does.
fn traversal_corners(way: TraversalWay, place: TraversalPlace) -> vec4f {
    let low = max(place.cell, vec2i(0));
    let beyond = select(way.cells - 1, vec2i(0), vec2<bool>(way.wraps));
    let high = select(place.cell + 1, beyond, place.cell == way.cells - 1);
    return vec4f(
        textureLoad(height, low, 0).r,
        textureLoad(height, vec2i(high.x, low.y), 0).r,
        textureLoad(height, vec2i(low.x, high.y), 0).r,
        textureLoad(height, high, 0).r,
    );
}

// Where on its way through a cell, from 0 at t_in to 1 at t_out, the ray first meets the bilinear patch; 2 where it does not.
//
// On that way g = (ray − surface) is A s² + B s + C with C = g(0) and A + B + C = g(1), both evaluated where they are.
fn traversal_leaf(ray: Ray, travel: vec2f, way: TraversalWay, place: TraversalPlace, t_in: f32, t_out: f32) -> f32 {
    let z = traversal_corners(way, place);
    let along_u = z.y - z.x;
    let along_v = z.z - z.x;
    let twist = z.x - z.y - z.z + z.w;

    let origin = ray.lattice - vec2f(place.cell + place.tile);
    let enter = clamp(origin + t_in * travel, vec2f(0.0), vec2f(1.0));
    let leave = clamp(origin + t_out * travel, vec2f(0.0), vec2f(1.0));
    let c = ray_height(ray, t_in) - (z.x + along_u * enter.x + (along_v + twist * enter.x) * enter.y);
    let end = ray_height(ray, t_out) - (z.x + along_u * leave.x + (along_v + twist * leave.x) * leave.y);
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
