// Cone shadows: a light that is a disc, near the cost of a hard shadow.
//
//   height  r32float  read  the field; the four corners of a cell   16 bytes
//   bounds  r32float  read  the range of heights over a node         4 bytes a node
//
// Over a height field a direction is free if and only if it is above the horizon of its azimuth. So the disc is cut into upright
// slices, and each is as visible as it stands above its own horizon: one number a slice, where `area` needs many rays. A
// horizon is found by one traversal whose ray only ever climbs faster: it begins at the foot of the slice, rises to the top of
// whatever stands in its way, and is done when it reaches the head of the slice (dark) or leaves the highest bound behind.
//
// Three slices; but most receivers need none. Nearer than where the wedge between disc and receiver reaches half a texel from its
// middle, the middle's horizon tells; from there on a search through coarser nodes, as wide as the wedge. Where nothing stands up
// into it the light is free, and otherwise the slices begin where the first thing does.
//
// One slice alone has 2.5 times the error where walls stand askew or posts are thinner than the wedge.
//
// Specification: src/reference/shadow_cone.rs. Needs surface/traversal and surface/light_disc.

const SHADOW_CONE_SLICES: i32 = 3;
// Half the width of the wedge, in texels, from which on its sides are looked at.
const SHADOW_CONE_NEAR: f32 = 0.5;
// Largest `lean` of a disc: nearer to the zenith azimuths turn within it, and no slice is upright. There the light is tilted.
const SHADOW_CONE_LEAN: f32 = 0.9;

// The way of the wedge between the disc and the receiver.
struct ShadowConeWedge {
    side: vec2i,   // 1 on the axis on which its middle is slower
    spread: f32,   // lattice distance along that axis from its middle to its edge, while t grows by 1
    ahead: f32,    // share of t by which its edge may be ahead of its middle
}

// The disc, tilted if it holds the zenith or nearly so.
fn shadow_cone_disc(ray: Ray) -> LightDisc {
    let toward = light_toward(ray);
    let disc = light_disc(toward, view.light_radius);
    if disc.lean <= SHADOW_CONE_LEAN {
        return disc;
    }
    let normal = frame_up();
    let beside = toward - normal * dot(normal, toward);
    let level = select(normalize(beside), normalize(frame.along_u), dot(beside, beside) < 1e-12);
    return light_disc(normalize(normal * SHADOW_CONE_LEAN + level * view.light_radius), view.light_radius);
}

// How fast a ray climbs through the point a above the middle of its slice, in units of the centre's; and the reverse.
fn shadow_cone_climb(disc: LightDisc, a: f32) -> f32 {
    return max(1.0 + a * disc.steepen / (1.0 - a * disc.lean), 1e-6);
}

fn shadow_cone_point(disc: LightDisc, climb: f32) -> f32 {
    return (climb - 1.0) / (disc.steepen + (climb - 1.0) * disc.lean);
}

// The area of half a unit disc's piece between b = 0 and b.
fn shadow_cone_area(b: f32) -> f32 {
    return 0.5 * (b * sqrt(max(1.0 - b * b, 0.0)) + asin(b));
}

// The share of the disc that is in a slice between two distances from the upright through the centre, and above a.
fn shadow_cone_share(inner: f32, outer: f32, a: f32) -> f32 {
    let level = min(abs(a), 1.0);
    let reach = sqrt(1.0 - level * level);
    let near = min(inner, reach);
    let far = min(outer, reach);
    let beyond = shadow_cone_area(far) - shadow_cone_area(near) - level * (far - near);
    let whole = shadow_cone_area(outer) - shadow_cone_area(inner);
    return select(beyond, 2.0 * whole - beyond, a < 0.0) * 0.318309886;
}

fn shadow(ray: Ray) -> f32 {
    let start = load_surface(ray_at(ray, 0.0)) + TRAVERSAL_LIFT;
    let disc = shadow_cone_disc(ray);
    // Nothing is above this.
    let room = traversal_highest(traversal_way(ray.lattice, disc.travel)) - start;
    // Where the disc dips under the reference surface's horizon, only what is above it shines.
    let dips = 1.0 - disc.climb < disc.lowest;
    let horizon = select(-1.0, min((disc.lowest - 1.0) / disc.climb, 1.0), dips);

    // Near the receiver the wedge is narrow, and its middle stands for all of it.
    let wedge = shadow_cone_wedge(disc);
    let t_near = SHADOW_CONE_NEAR / max(wedge.spread, 1e-20);
    let lowest = shadow_cone_climb(disc, horizon);
    let close = shadow_cone_horizon(ray, start, room, disc.travel, 0.0, t_near, lowest, shadow_cone_climb(disc, 1.0));
    var begin = 0.0;
    if close <= lowest {
        begin = shadow_cone_search(ray, start, room, disc.travel, wedge, t_near, lowest);
        if begin == TRAVERSAL_NEVER && !dips {
            return 1.0;
        }
    }

    var seen = 0.0;
    for (var slice = 0; slice < SHADOW_CONE_SLICES; slice++) {
        let inner = select(1.0 / 3.0, 0.0, slice == 0);
        let outer = select(1.0, 1.0 / 3.0, slice == 0);
        let b = select(select(-2.0, 2.0, slice == 1) / 3.0, 0.0, slice == 0);
        let head = sqrt(1.0 - inner * inner);
        let foot = clamp(horizon, -head, head);
        // What is near is known of the middle already.
        let is_middle = slice == 0;
        let from_t = select(begin, max(begin, t_near), is_middle);
        let lowest_climb = max(shadow_cone_climb(disc, foot), select(0.0, close, is_middle));
        let climb = shadow_cone_horizon(
            ray, start, room, disc.travel + b * disc.across, from_t, TRAVERSAL_NEVER, lowest_climb, shadow_cone_climb(disc, head),
        );
        let share = shadow_cone_share(inner, outer, clamp(shadow_cone_point(disc, climb), max(horizon, -1.0), 1.0));
        seen += select(1.0, 2.0, slice == 0) * share;
    }
    return clamp(seen, 0.0, 1.0);
}

fn shadow_cone_wedge(disc: LightDisc) -> ShadowConeWedge {
    let major = select(vec2f(1.0, 0.0), vec2f(0.0, 1.0), abs(disc.travel.y) > abs(disc.travel.x));
    let ahead = dot(disc.across, major) / dot(disc.travel, major);
    let skewed = disc.across - ahead * disc.travel;
    return ShadowConeWedge(vec2i(1.0 - major), abs(dot(skewed, 1.0 - major)), abs(ahead));
}

// The horizon of a slice between two t: `foot` raised by all that stands in the way, to no more than `top`. All three are climbs in
// units of the centre's.
fn shadow_cone_horizon(ray: Ray, start: f32, room: f32, travel: vec2f, t_begin: f32, t_stop: f32, foot: f32, top: f32) -> f32 {
    var climb = foot;
    var t_end = min(room / climb, t_stop);
    if t_begin >= t_end || climb >= top {
        return climb;
    }
    let way = traversal_way(ray.lattice, travel);
    var at = traversal_start(way, ray.cell, t_begin, t_end);
    var steps = 0u;
    while !at.ended && steps < view.step_cap {
        steps += 1u;
        at = traversal_cross(way, climb, t_end, at);
        climb = select(climb, max(climb, shadow_cone_leaf(ray, travel, way, at, start)), at.near);
        if climb >= top {
            return top;
        }
        t_end = min(room / climb, t_stop);
        at = traversal_onward(way, start, climb, t_end, at);
    }
    // One that gave up counts as dark.
    return select(top, climb, at.ended);
}

// From which t on something may stand up into the wedge, looking from t_begin on; TRAVERSAL_NEVER where nothing does.
//
// Its nodes are as wide as half the wedge or wider, and seen with their neighbours. Beside its middle a ray of the wedge may be over
// the same place at a smaller t, and so lower.
fn shadow_cone_search(ray: Ray, start: f32, room: f32, travel: vec2f, wedge: ShadowConeWedge, t_begin: f32, climb: f32) -> f32 {
    let way = traversal_way(ray.lattice, travel);
    let behind = max(1.0 - wedge.ahead, 0.1);
    let t_end = room / (climb * behind);
    var place = traversal_start(way, ray.cell, t_begin, t_end).place;
    var t = t_begin;
    var steps = 0u;
    while t < t_end {
        steps += 1u;
        if steps > view.step_cap {
            return t;
        }
        let last = traversal_last(way, place);
        let t_border = traversal_borders(way, place.tile, last);
        let t_out = max(t, min(min(t_border.x, t_border.y), t_end));

        // A side ray is over the same place along the major axis at up to t / behind.
        let width = wedge.spread * t_out / behind;
        let size = f32(1u << u32(place.level));
        if size < width && place.level < way.top {
            place.level += 1;
            continue;
        }
        // The nodes that the wedge reaches into from this one.
        let first = (last >> vec2u(u32(place.level))) << vec2u(u32(place.level));
        let axis = vec2f(wedge.side);
        let origin = dot(axis, way.origin - vec2f(place.tile - 1));
        let least = origin + t * dot(axis, way.travel) - width;
        let most = origin + t_out * dot(axis, way.travel) + width;
        let below = select(place.cell, first - 1, wedge.side * vec2i(i32(least < dot(axis, vec2f(first)))) != vec2i(0));
        let above = select(place.cell, last + 1, wedge.side * vec2i(i32(most > dot(axis, vec2f(last + 1)))) != vec2i(0));
        let bound = max(
            traversal_range(way, place).high,
            max(shadow_cone_beside(way, place, below), shadow_cone_beside(way, place, above)),
        ) + TRAVERSAL_SLACK;
        let rises = start + climb * behind * t <= bound;
        if rises && (place.level == 1 || size <= 2.0 * width) {
            return max(behind * t, t_begin);
        }
        t = select(t_out, t, rises);
        let there = traversal_cell(way, place.tile, t, place.cell, last);
        let by_u = t_border.x <= t_border.y;
        if rises {
            place = TraversalPlace(there, place.tile, max(place.level - TRAVERSAL_STRIDE, 1));
        } else {
            place = traversal_across(way, place, there, last, vec2<bool>(by_u, !by_u));
        }
    }
    return TRAVERSAL_NEVER;
}

// The bound of a node beside the place's, or of what lies there where the field ends.
fn shadow_cone_beside(way: TraversalWay, place: TraversalPlace, cell: vec2i) -> f32 {
    let wraps = view_wraps();
    let begin = way.end - way.cells + select(vec2i(0), vec2i(1), wraps);
    let over = select(select(vec2i(0), -way.cells, cell > way.end), way.cells, cell < begin);
    let inside = select(clamp(cell, begin, way.end), cell + over, wraps);
    return traversal_range(way, TraversalPlace(inside, place.tile, place.level)).high;
}

// How fast a ray must climb from the start to clear the surface in a cell, from t_in to t_out.
fn shadow_cone_leaf(ray: Ray, travel: vec2f, way: TraversalWay, at: TraversalAt, start: f32) -> f32 {
    let t_in = at.t;
    let t_out = at.t_cell;
    let z = traversal_corners(way, at);
    let along_u = z.y - z.x;
    let along_v = z.z - z.x;
    let twist = z.x - z.y - z.z + z.w;
    let origin = ray.lattice - vec2f((at.place.cell + (at.place.tile - 1)) ^ way.flip);
    let enter = clamp(origin + t_in * travel, vec2f(0.0), vec2f(1.0));
    let leave = clamp(origin + t_out * travel, vec2f(0.0), vec2f(1.0));
    // The surface is start + c + b s + a s² for s from 0 to 1, and what is needed (c + b s + a s²) / (t_in + length s).
    let c = z.x + along_u * enter.x + (along_v + twist * enter.x) * enter.y - start;
    let end = z.x + along_u * leave.x + (along_v + twist * leave.x) * leave.y - start;
    let a = twist * (leave.x - enter.x) * (leave.y - enter.y);
    let b = end - c - a;
    let length = t_out - t_in;
    // At its own start a ray is above the surface, by the lift.
    var needed = max(end / max(t_out, 1e-20), select(-1.0, c / t_in, t_in > 0.0));
    // A crest within: the derivative a length s² + 2 a t_in s + (b t_in − c length) vanishes. Without cancellation.
    let slope = b * t_in - c * length;
    if a < 0.0 && slope > 0.0 {
        let s = slope / (sqrt(a * a * t_in * t_in - a * length * slope) - a * t_in);
        if s < 1.0 {
            needed = max(needed, (c + s * (b + s * a)) / (t_in + length * s));
        }
    }
    return needed;
}
