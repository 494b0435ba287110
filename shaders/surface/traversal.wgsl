// Traversal: a ray against the bilinear surface, exactly, through the bounds of ever larger nodes ([PDM] with corner bounds).
//
//   height  r32float  read  the field; the four corners of a cell   16 bytes
//   bounds  r32float  read  the range of heights over a node         4 bytes a node
//
// What the traversal costs is the number of reads that wait for one another. So a step reads two things that do not: the cell in which
// the ray is, whose surface it meets or not, and the range over a node round it, which tells how far the ray may go on from there. And a
// step goes down at once to the level whose nodes are about as large as what is left of the way, which both ends of the range tell.
// Searching first and then walking from cell to cell took a fifth longer.
//
// The ray is where its parameter t says; the cell that it is in is known as integers, and a node is that cell and a level: climbing
// and descending only change the level. A border's parameter is always (border − origin) / travel, from the ray's origin to an
// integer, so nothing accumulates over a long ray, and a ray along an axis never divides. Rounding can misplace the ray by some 2⁻²⁴
// of its largest coordinate, never more: each cell is tested over the stretch of the ray that its own borders cut, and what counts is
// the sign of (ray − surface) where it enters and leaves, not whether a root seems to lie between. A test of the roots loses rays
// through borders, up to 0.78 of the height range deep.
//
// An axis on which the ray goes down is turned over: cell i there is called −1 − i, all its bits turned, and its positions change
// sign. So every ray goes up, and a node, its cell's bits shifted away, is the same either way.
//
// Specification: src/reference/traversal.rs. Needs common/view, common/range, surface/ray, a height part, and `bounds`.

// How far a bound is raised: rounding of the bilinear and of the ray's height, eight steps of f32 below 1.
const TRAVERSAL_SLACK: f32 = 4.8e-7;
// A travel below this crosses no border: 1 / travel would overflow.
const TRAVERSAL_STILL: f32 = 1e-20;
// Where a ray meets the outer border of a clamped field's outermost cells: never.
const TRAVERSAL_NEVER: f32 = 3e38;
// A cell that no field has.
const TRAVERSAL_NOWHERE: i32 = 0x7fffffff;

// Levels by which a search climbs at once: the one in between costs a visit and seldom ends one.
const TRAVERSAL_STRIDE: i32 = 2;
// By how many levels a node is larger than what is left of the way, and by how many less the first one.
const TRAVERSAL_FIT: i32 = 1;
const TRAVERSAL_START: i32 = 1;

// The coarsest level at which a falling ray looks at the cell beside the node: in coarser nodes it seldom meets it, and on a large field
// each look is a miss of the cache. 3 was 2 to 4 % faster than 2 at 512², and no slower at 2048². A ray toward a light starts on the
// surface, and looks at every cell that it stops in.
const TRAVERSAL_NEAR: i32 = 3;

// How far a ray toward a light is lifted off the surface that it starts from: five times what rounding can do to a height, so
// that its slope against the light decides the rest, and a tenth of what a shadow may miss.
const TRAVERSAL_LIFT: f32 = 9.6e-7;

// What does not change on the way; axes as the ray goes.
struct TraversalWay {
    origin: vec2f,      // lattice position at t = 0, counted from the ray's cell
    travel: vec2f,      // 0 or more
    per_travel: vec2f,
    speed: f32,         // the longer travel
    flip: vec2i,        // −1 where the axis is turned over, else 0
    cells: vec2i,       // of the field
    end: vec2i,         // the last cell of the tile
    endless: vec2i,     // the same where it goes on for ever
    top: i32,           // the coarsest level
    strip: vec2i,       // where level 2 would lie in `bounds`, but for its rows
    per_bounds: vec2f,  // of its texels
    per_cell: vec2f,    // of the field's
}

// How coarse a surface the traversal looks for: the mip level of the mean heights at which it stops, 0 for the field itself ([PDM]
// §3.4). What sets it resets it.
var<private> traversal_detail: f32;

// Where the ray is.
struct TraversalPlace {
    cell: vec2i,  // in the field's tile
    tile: vec2i,  // what a border's cell number lacks to be counted from the ray's own cell: of the cell after it
    level: i32,
}

// Nothing is above this.
fn traversal_highest(way: TraversalWay) -> f32 {
    return traversal_range(way, TraversalPlace(vec2i(0), vec2i(0), way.top)).high + TRAVERSAL_SLACK;
}

fn traversal_way(lattice: vec2f, travel: vec2f) -> TraversalWay {
    let still = abs(travel) < vec2f(TRAVERSAL_STILL);
    let backward = !still & (travel < vec2f(0.0));
    let along = select(abs(travel), vec2f(0.0), still);
    let origin = select(lattice, -lattice, backward);
    let per_travel = 1.0 / select(along, vec2f(TRAVERSAL_STILL), still);
    let cells = vec2i(view.field_size);
    let wraps = view_wraps();
    // Turned over, a tile's last cell is 0, called −1; a clamped field has half a cell before that.
    let end = select(cells - 1, select(vec2i(0), vec2i(-1), wraps), backward);
    let top = max(i32(firstLeadingBit(max(view.field_size.x, view.field_size.y) - 1u)) + 1, 1);
    return TraversalWay(
        origin, along, per_travel, max(along.x, along.y), select(vec2i(0), vec2i(-1), backward), cells, end,
        select(end, vec2i(TRAVERSAL_NOWHERE), wraps), top, vec2i((cells.x + 1) >> 1u, (cells.y >> 1u) - 2),
        1.0 / vec2f(textureDimensions(bounds)), 1.0 / vec2f(cells),
    );
}

// The place of a ray, counted from a cell, at t.
fn traversal_place(way: TraversalWay, ray_cell: vec2i, t: f32, level: i32) -> TraversalPlace {
    let at = vec2i(floor(way.origin + t * way.travel));
    let cell = (at ^ way.flip) + ray_cell;
    if view_wraps() {
        let within = field_wrapped(cell, way.cells) ^ way.flip;
        return TraversalPlace(within, at - within + 1, level);
    }
    let tile = select(-ray_cell, ray_cell, way.flip != vec2i(0));
    return TraversalPlace(clamp(cell, vec2i(-1), way.cells - 1) ^ way.flip, tile + 1, level);
}

// The level whose nodes are as large as so many cells, 0 or more of them, by the exponent.
fn traversal_level(extent: f32) -> i32 {
    return i32(bitcast<u32>(extent) >> 23u) - 127 + TRAVERSAL_FIT;
}

// Between which heights the surface lies over the place's node. Where its level's texels lie: src/field/bounds.rs.
fn traversal_range(way: TraversalWay, place: TraversalPlace) -> Range {
    let node = max(place.cell ^ way.flip, vec2i(0)) >> vec2u(u32(place.level));
    let beside = vec2i(way.strip.x, way.strip.y + place.level - (way.cells.y >> u32(place.level - 1)));
    let texel = node + select(beside, vec2i(0), place.level == 1);
    return range_unpacked(textureSampleLevel(bounds, nearest, (vec2f(texel) + 0.5) * way.per_bounds, 0.0).r);
}

// The last cell of the place's node.
fn traversal_last(way: TraversalWay, place: TraversalPlace) -> vec2i {
    return min(place.cell | vec2i((1i << u32(place.level)) - 1), way.end);
}

// Where the ray leaves a cell, an axis.
fn traversal_borders(way: TraversalWay, tile: vec2i, last: vec2i) -> vec2f {
    let crossed = (vec2f(last + tile) - way.origin) * way.per_travel;
    return select(crossed, vec2f(TRAVERSAL_NEVER), last == way.endless);
}

// The place on the other side of the node's border on the axis that is crossed; `there` is the cell before, at the border.
fn traversal_across(way: TraversalWay, place: TraversalPlace, there: vec2i, last: vec2i, crosses: vec2<bool>) -> TraversalPlace {
    // Climb where that leaves the node above behind, and never into a node that holds what was just left: rounding could lead back.
    let above = place.level + TRAVERSAL_STRIDE;
    let next = select(last.y, last.x, crosses.x) + 1;
    let leaves = (next & ((1i << u32(above)) - 1)) == 0;
    // A tile's end leaves every node behind; a field that clamps is all in one.
    let ends = crosses & (last == way.end) & vec2<bool>(view_wraps());
    let over = select(vec2i(0), way.cells, ends);
    return TraversalPlace(
        select(there, last + 1, crosses) - over,
        place.tile + over,
        select(place.level, min(above, way.top), leaves || any(ends)),
    );
}

// The cell at t, from `first` on and in a node.
fn traversal_cell(way: TraversalWay, tile: vec2i, t: f32, first: vec2i, last: vec2i) -> vec2i {
    return min(max(vec2i(floor(way.origin + t * way.travel)) - (tile - 1), first), last);
}

// Whether nothing stands in the way from a height over the ray's start, with this travel for each height that is climbed.
fn traversal_escapes(ray: Ray, start: f32, travel: vec2f) -> bool {
    let highest = traversal_highest(traversal_way(ray.lattice, travel));
    if start >= highest {
        return true;
    }
    // A ray that gave up found no way out: it counts as blocked.
    return traversal(Ray(ray.lattice, travel, start, 1.0, ray.cell, highest - start, MISS)).status == MISS;
}

// How far a ray has come.
struct TraversalAt {
    place: TraversalPlace,
    t: f32,       // where it is
    near: bool,   // so near the surface that the place's cell is looked at
    t_cell: f32,  // where it leaves that; where it is not looked at, t
    by_u: bool,   // over a border between columns
    ended: bool,  // where the ray does
}

// A falling ray is above everything until here. The nodes on the way would tell as much, and do in as many steps in a usual picture; but
// a ray that grazes a field that wraps may cross millions of cells before.
fn traversal_begin(way: TraversalWay, ray: Ray) -> f32 {
    return select(0.0, clamp((traversal_highest(way) - ray.height) / min(ray.rise, -TRAVERSAL_STILL), 0.0, ray.t_end), ray.rise < 0.0);
}

// A ray, counted from a cell, that is at t_begin.
fn traversal_start(way: TraversalWay, ray_cell: vec2i, t_begin: f32, t_end: f32) -> TraversalAt {
    // Coarser first nodes are rarely clear of the surface, finer ones are many.
    let level = clamp(traversal_level(way.speed * (t_end - t_begin)) - TRAVERSAL_START, 1, way.top);
    return TraversalAt(traversal_place(way, ray_cell, t_begin, level), t_begin, false, t_begin, false, false);
}

// Where it leaves its cell, if that is to be looked at.
fn traversal_cross(way: TraversalWay, rise: f32, t_end: f32, at: TraversalAt) -> TraversalAt {
    let t_border = traversal_borders(way, at.place.tile, at.place.cell);
    var found = at;
    found.near = rise >= 0.0 || at.place.level <= TRAVERSAL_NEAR;
    found.by_u = t_border.x <= t_border.y;
    found.t_cell = select(at.t, max(at.t, min(select(t_border.y, t_border.x, found.by_u), t_end)), found.near);
    return found;
}

// What a ray makes of its place's node.
struct TraversalVisit {
    last: vec2i,   // the node's last cell
    t_under: f32,  // where the ray is under its bound first, TRAVERSAL_NEVER where it is not
    t_below: f32,  // where it is under all of its surface at the latest, or leaves it
    t_out: f32,    // where it leaves it
    by_u: bool,    // over a border between columns
}

// For a ray that has a height at t = 0 and rises at a rate, from t on.
fn traversal_visit(way: TraversalWay, place: TraversalPlace, t: f32, height: f32, rise: f32, t_end: f32) -> TraversalVisit {
    let last = traversal_last(way, place);
    let range = traversal_range(way, place);
    let t_border = traversal_borders(way, place.tile, last);
    let by_u = t_border.x <= t_border.y;
    let t_out = max(t, min(select(t_border.y, t_border.x, by_u), t_end));
    // Advance the ray to the bound ([PDM] fig. 7).
    let falls = rise < 0.0;
    let per_fall = 1.0 / select(1.0, -rise, falls);
    let lowered = height - TRAVERSAL_SLACK;
    var t_under = select(TRAVERSAL_NEVER, t, fma(rise, t, lowered) <= range.high);
    var t_below = t_out;
    if falls {
        t_under = max(t, (lowered - range.high) * per_fall);
        t_below = min((height - range.low) * per_fall, t_out);
    }
    return TraversalVisit(last, t_under, t_below, t_out, by_u);
}

// On from a cell in which nothing is met: to where the ray goes under the bound of its node, or across the node's border.
fn traversal_onward(way: TraversalWay, height: f32, rise: f32, t_end: f32, at: TraversalAt) -> TraversalAt {
    let visit = traversal_visit(way, at.place, at.t_cell, height, rise, t_end);
    let enters = visit.t_under < visit.t_out;
    var found = at;
    found.ended = !enters && visit.t_out >= t_end;
    found.t = select(visit.t_out, visit.t_under, enters);
    // Rounding never carries it out of the node, nor back into the cell.
    let next = at.place.cell + select(vec2i(0), vec2i(1), vec2<bool>(at.near && at.by_u, at.near && !at.by_u));
    let there = traversal_cell(way, at.place.tile, found.t, next, visit.last);
    let across = traversal_across(way, at.place, there, visit.last, vec2<bool>(visit.by_u, !visit.by_u));
    let level = min(traversal_level(way.speed * max(visit.t_below - visit.t_under, 0.0)), at.place.level - 1);
    found.place.cell = select(across.cell, there, enters);
    found.place.tile = select(across.tile, at.place.tile, enters);
    found.place.level = select(across.level, max(level, 1), enters);
    return found;
}

// The first meeting of the ray with the surface.
fn traversal(ray: Ray) -> Hit {
    let way = traversal_way(ray.lattice, ray.travel);
    var at = traversal_start(way, ray.cell, traversal_begin(way, ray), ray.t_end);
    var steps = 0u;
    var hits = false;
    while !at.ended && steps < view.step_cap {
        steps += 1u;
        at = traversal_cross(way, ray.rise, ray.t_end, at);
        hits = traversal_leaf(ray, way, at).hits;
        if hits {
            break;
        }
        at = traversal_onward(way, ray.height, ray.rise, ray.t_end, at);
    }
    // Once, and not in every step, as a processor would that runs all branches: a root, two quotients and the hit were 37 of
    // 510 instructions of a step.
    if hits {
        let t = at.t + traversal_root(traversal_leaf(ray, way, at)) * (at.t_cell - at.t);
        return Hit(ray_at(ray, t), ray_height(ray, t), t, steps, HIT);
    }
    if at.ended {
        return end_of(ray, steps);
    }
    return Hit(ray_at(ray, at.t), ray_height(ray, at.t), at.t, steps, CAPPED);
}

// A ray's way through a cell: g = (ray − surface) is a s² + b s + c, with s from 0 where it comes in to 1 where it leaves.
struct TraversalLeaf {
    hits: bool,
    a: f32,
    b: f32,
    c: f32,
}

// The corners of a cell, which is one of the field's or the half cell before it: (x, y), (x+1, y), (x, y+1), (x+1, y+1). What the
// sampler does beyond the border is the field's addressing, and its footprint lies half a texel off every decision.
fn traversal_corners(way: TraversalWay, at: TraversalAt) -> vec4f {
    let cell = at.place.cell ^ way.flip;
    // Where nobody looks a processor reads all the same: what is in its cache.
    return textureGather(0, height, nearest, select(vec2f(0.0), vec2f(cell + 1) * way.per_cell, at.near)).wzxy;
}

// The way through the place's cell: c = g(0) and a + b + c = g(1) are both evaluated where they are.
fn traversal_leaf(ray: Ray, way: TraversalWay, at: TraversalAt) -> TraversalLeaf {
    let z = traversal_corners(way, at);
    let along_u = z.y - z.x;
    let along_v = z.z - z.x;
    let twist = z.x - z.y - z.z + z.w;

    let origin = ray.lattice - vec2f((at.place.cell + (at.place.tile - 1)) ^ way.flip);
    let enter = clamp(origin + at.t * ray.travel, vec2f(0.0), vec2f(1.0));
    let leave = clamp(origin + at.t_cell * ray.travel, vec2f(0.0), vec2f(1.0));
    let c = ray_height(ray, at.t) - (z.x + along_u * enter.x + (along_v + twist * enter.x) * enter.y);
    let end = ray_height(ray, at.t_cell) - (z.x + along_u * leave.x + (along_v + twist * leave.x) * leave.y);
    let a = -twist * (leave.x - enter.x) * (leave.y - enter.y);
    let b = end - c - a;
    // Under the surface where it comes in, at the end, or on the way there: a vertex inside with g no more than 0.
    let dips = a > 0.0 && b < 0.0 && -b < 2.0 * a && b * b - 4.0 * a * c >= 0.0;
    return TraversalLeaf(at.near && (c <= 0.0 || end <= 0.0 || dips), a, b, c);
}

// Where a way that hits first does.
fn traversal_root(leaf: TraversalLeaf) -> f32 {
    if leaf.c <= 0.0 {
        return 0.0;
    }
    // The smaller root that is not negative, without cancellation.
    let root = sqrt(max(leaf.b * leaf.b - 4.0 * leaf.a * leaf.c, 0.0));
    let s = select((leaf.b + root) / (-2.0 * leaf.a), 2.0 * leaf.c / (root - leaf.b), leaf.b < 0.0);
    return clamp(s, 0.0, 1.0);
}

// Where on its way through a node of any level, from 0 at t_in to 1 at t_out, the ray first meets the mean heights there; 2 where it
// does not. Their surface is nearly straight over a node of its own level, and moves smoothly as the level does, so that nothing pops.
fn traversal_coarse_leaf(ray: Ray, t_in: f32, t_out: f32) -> f32 {
    let enter = ray_height(ray, t_in) - height_over(ray_at(ray, t_in), traversal_detail);
    let leave = ray_height(ray, t_out) - height_over(ray_at(ray, t_out), traversal_detail);
    if enter <= 0.0 {
        return 0.0;
    }
    return select(2.0, enter / (enter - leave), leave <= 0.0);
}
