// Shallow water: how it begins, and what is done to it.
//
//   bed      r32float  read         height of what it stands on, heights, unclamped
//   depths   2 vec2f   read-write   of either state; the control says which is the present one
//   flows    2 vec2f   read-write
//
// A fill reads 4 bytes a texel and writes 16. What falls in a step is done by one workgroup, one after the other: no two meet in a
// texel, and the order is that of the list.
//
// Composed after common/shallow_water.wgsl.

// A pour adds water over a disc, or takes it.
const SHALLOW_WATER_POUR: u32 = 0u;
// A dent takes water within half its radius and heaps as much up around.
const SHALLOW_WATER_DENT: u32 = 1u;

struct ShallowWaterEvent {
    centre: vec2f,             // lattice
    radius: f32,               // texels
    kind: u32,
    metres: f32,               // depth at the centre
    foam: f32,                 // share of foam at the centre
}

struct ShallowWaterBatch {
    first: u32,                // in `events`
    count: u32,
}

// Water that stands in a part of the plane up to a level.
struct ShallowWaterBody {
    low: vec2f,                // uv
    high: vec2f,               // uv
    level: f32,                // height
}

override SHALLOW_WATER_LANES: u32;

@group(1) @binding(0) var<storage, read> params: ShallowWaterParams;
@group(1) @binding(1) var<storage, read_write> control: ShallowWaterControl;
@group(1) @binding(2) var bed: texture_2d<f32>;
@group(1) @binding(3) var<storage, read_write> depths_0: array<vec2f>;
@group(1) @binding(4) var<storage, read_write> flows_0: array<vec2f>;
@group(1) @binding(5) var<storage, read> bodies: array<ShallowWaterBody>;

@group(1) @binding(5) var<storage, read_write> depths_1: array<vec2f>;
@group(1) @binding(6) var<storage, read_write> flows_1: array<vec2f>;
@group(1) @binding(7) var<storage, read> events: array<ShallowWaterEvent>;
@group(1) @binding(8) var<storage, read> batch: ShallowWaterBatch;

var<workgroup> sums: array<vec2f, SHALLOW_WATER_LANES>;

@compute @workgroup_size(SHALLOW_WATER_TILE, SHALLOW_WATER_TILE)
fn shallow_water_fill(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= params.size) {
        return;
    }
    let uv = (vec2f(id.xy) + 0.5) / vec2f(params.size);
    let ground = shallow_water_bed_metres(textureLoad(bed, id.xy, 0).x, params.depth_metres);
    var depth = 0.0;
    for (var i = 0u; i < arrayLength(&bodies); i++) {
        let body = bodies[i];
        if all(uv >= body.low) && all(uv <= body.high) {
            depth = max(depth, body.level * params.depth_metres - ground);
        }
    }
    let index = id.y * params.size.x + id.x;
    depths_0[index] = vec2f(depth, 0.0);
    flows_0[index] = vec2f(0.0);
    atomicMax(&control.speed, bitcast<u32>(2.0 * sqrt(params.gravity * depth)));
}

// A place in an event's disc: its texel, the square of its distance from the centre in radii, and whether it counts.
struct Place {
    index: u32,
    squared: f32,
    counts: bool,
}

fn place(event: ShallowWaterEvent, low: vec2i, width: u32, i: u32) -> Place {
    let size = vec2i(params.size);
    var texel = low + vec2i(i32(i % width), i32(i / width));
    let away = (vec2f(texel) - event.centre) / event.radius;
    let squared = dot(away, away);
    var inside = squared < 1.0;
    for (var axis = 0u; axis < 2u; axis++) {
        if params.borders[2u * axis] == SHALLOW_WATER_PERIODIC {
            texel[axis] = (texel[axis] % size[axis] + size[axis]) % size[axis];
        } else {
            inside = inside && texel[axis] >= 0 && texel[axis] < size[axis];
        }
    }
    texel = clamp(texel, vec2i(0), size - 1);
    let height = textureLoad(bed, texel, 0).x;
    inside = inside && shallow_water_is_number(height) && abs(height) <= SHALLOW_WATER_BED_MAX;
    return Place(u32(texel.y) * params.size.x + u32(texel.x), squared, inside);
}

fn depth_at(index: u32) -> vec2f {
    if control.current == 0u {
        return depths_0[index];
    }
    return depths_1[index];
}

// Changes a texel's depth; what is taken takes its velocity with it, what is added has none.
fn add(index: u32, metres: f32, foam: f32) {
    let first = control.current == 0u;
    let before = depth_at(index);
    let depth = max(before.x + metres, 0.0);
    let after = vec2f(depth, saturate(max(before.y, foam)));
    let kept = select(1.0, depth / max(before.x, 1e-30), metres < 0.0);
    var flow = vec2f(0.0);
    if first {
        flow = flows_0[index] * kept;
        depths_0[index] = after;
        flows_0[index] = flow;
    } else {
        flow = flows_1[index] * kept;
        depths_1[index] = after;
        flows_1[index] = flow;
    }
    let velocity = shallow_water_velocity(flow, depth, params.dry_metres, params.speed_cap);
    let speed = max(abs(velocity.x), abs(velocity.y)) + 2.0 * sqrt(params.gravity * depth);
    atomicMax(&control.speed, bitcast<u32>(speed));
}

// Smooth, 1 at 0 and 0 from 1 on.
fn bump(squared: f32) -> f32 {
    let w = max(1.0 - squared, 0.0);
    return w * w;
}

// The depth that a dent takes, and how much of what was taken a texel of the ring receives, both before scaling.
fn dented(event: ShallowWaterEvent, at: Place) -> vec2f {
    let depth = depth_at(at.index).x;
    if !at.counts || depth <= params.dry_metres {
        return vec2f(0.0);
    }
    let taken = min(event.metres * bump(4.0 * at.squared), depth - params.dry_metres);
    let ring = select(0.0, bump(1.0 - (4.0 * at.squared - 1.0) / 3.0) * bump(at.squared), at.squared > 0.25);
    return vec2f(taken, ring);
}

@compute @workgroup_size(SHALLOW_WATER_LANES)
fn shallow_water_disturb(@builtin(local_invocation_index) lane: u32) {
    if control.halted == 1u {
        return;
    }
    for (var i = batch.first; i < batch.first + batch.count; i++) {
        let event = events[i];
        let low = vec2i(ceil(event.centre - event.radius));
        let high = min(vec2i(floor(event.centre + event.radius)), low + vec2i(params.size) - 1);
        let extent = vec2u(max(high - low + 1, vec2i(0)));
        let count = extent.x * extent.y;
        let is_dent = event.kind == SHALLOW_WATER_DENT;
        var sum = vec2f(0.0);
        for (var k = lane; is_dent && k < count; k += SHALLOW_WATER_LANES) {
            sum += dented(event, place(event, low, extent.x, k));
        }
        sums[lane] = sum;
        for (var half = SHALLOW_WATER_LANES / 2u; half > 0u; half /= 2u) {
            workgroupBarrier();
            if lane < half {
                sums[lane] += sums[lane + half];
            }
        }
        workgroupBarrier();
        let total = sums[0];
        let share = select(0.0, total.x / max(total.y, 1e-30), total.y > 0.0);
        for (var k = lane; k < count; k += SHALLOW_WATER_LANES) {
            let at = place(event, low, extent.x, k);
            var metres = select(0.0, event.metres * bump(at.squared), at.counts);
            if is_dent {
                let parts = dented(event, at);
                // Without a ring to heap it on nothing is taken.
                metres = select(0.0, share * parts.y - parts.x, total.y > 0.0);
            }
            if metres != 0.0 {
                add(at.index, metres, event.foam * bump(at.squared));
            }
        }
        storageBarrier();
        workgroupBarrier();
    }
}
