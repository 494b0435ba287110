// Shallow water: one substep of the nonlinear equations, both directions in one dispatch.
//
//   depths   vec2f   read        depth of the water, metres; share of its surface that is foam
//   flows    vec2f   read        depth times velocity, m²/s
//   bed      r32float  read      height of what it flows over, heights, unclamped
//   next     2 vec2f write       the two a substep ahead
//
// 36 bytes a texel: 16 and the bed's 4 in, 16 out, the halo apart. Each direction by turns, x first in even substeps and y first in odd
// ones (Strang), each along lines of cells by the midpoint rule (field/shallow_water_flux).
//
// A workgroup makes a tile of SPAN texels along the substep's first direction and SPAN − 2·HALO across it. Each invocation walks one
// line of it, with the few cells that a stencil needs in registers: first a row, from and to the halo, then a column of what the rows
// left in workgroup memory, where alone the invocations meet. A version whose every face was an invocation's, with cells and faces in
// workgroup memory, took five times as long on lavapipe, where each access to it is lane by lane.
//
// Specification: src/reference/shallow_water.rs. Composed after common/shallow_water.wgsl and field/shallow_water_flux.wgsl.

override SHALLOW_WATER_CELLS: u32;     // SPAN²

@group(1) @binding(0) var<storage, read> stored_params: ShallowWaterParams;
@group(1) @binding(1) var<storage, read_write> control: ShallowWaterControl;
@group(1) @binding(2) var bed: texture_2d<f32>;
@group(1) @binding(3) var<storage, read> depths: array<vec2f>;
@group(1) @binding(4) var<storage, read> flows: array<vec2f>;
@group(1) @binding(5) var<storage, read_write> next_depths: array<vec2f>;
@group(1) @binding(6) var<storage, read_write> next_flows: array<vec2f>;

// Copies of an invocation: lavapipe reads a buffer anew, lane by lane, each time that it is named.
var<private> params: ShallowWaterParams;
var<private> dt: f32;          // seconds
var<private> rise: f32;        // of the sea by its swell, metres

// What the rows made: depth, velocity along and across, foam; along is the substep's first direction.
var<workgroup> rows: array<vec4f, SHALLOW_WATER_CELLS>;

// The field along one axis: its texels, how far apart they lie in the buffers, and its borders.
struct ShallowWaterAxis {
    size: i32,
    stride: u32,
    low: u32,
    high: u32,
}

fn axis_of(y: bool) -> ShallowWaterAxis {
    if y {
        return ShallowWaterAxis(i32(params.size.y), params.size.x, params.borders.z, params.borders.w);
    }
    return ShallowWaterAxis(i32(params.size.x), 1u, params.borders.x, params.borders.y);
}

fn border_of(axis: ShallowWaterAxis, texel: i32) -> u32 {
    return select(axis.high, axis.low, texel < 0);
}

// The texel of the field that a texel means which may lie beyond its border. Loops in place of a remainder: they seldom run, and an
// integer division costs lavapipe a division a lane.
fn home(axis: ShallowWaterAxis, texel: i32) -> i32 {
    let n = axis.size;
    var at = texel;
    let border = border_of(axis, texel);
    if border == SHALLOW_WATER_PERIODIC {
        while at < 0 {
            at += n;
        }
        while at >= n {
            at -= n;
        }
    } else if border == SHALLOW_WATER_WALL {
        at = select(select(at, 2 * n - 1 - at, at >= n), -1 - at, at < 0);
    }
    return clamp(at, 0, n - 1);
}

// What of a velocity leaves by an open border: out, not in.
fn outward(velocity: f32, texel: i32) -> f32 {
    return select(max(velocity, 0.0), min(velocity, 0.0), texel < 0);
}

// Whether the face before a texel is one through which nothing passes.
fn is_closed(axis: ShallowWaterAxis, texel: i32) -> bool {
    return (texel == 0 && axis.low == SHALLOW_WATER_WALL) || (texel == axis.size && axis.high == SHALLOW_WATER_WALL);
}

// A cell between the two directions. Beyond a border of the second one it is what that direction finds there: of an open border what
// the first has made of the texels inside, without what would come in; at sea what it was.
fn between(swept: vec4f, before: vec4f, axis: ShallowWaterAxis, texel: i32) -> vec4f {
    if texel >= 0 && texel < axis.size {
        return swept;
    }
    let border = border_of(axis, texel);
    let open = vec4f(swept.xy, outward(swept.z, texel), swept.w);
    return select(select(swept, open, border == SHALLOW_WATER_OPEN), before, border == SHALLOW_WATER_SEA);
}

// A cell beyond a border, whose velocity across that border is along the line or across it.
fn beyond(cell: ShallowWaterCell, texel: i32, border: u32, along: bool) -> vec4f {
    let state = cell.state;
    if border == SHALLOW_WATER_WALL {
        return vec4f(state.x, select(state.yz, -state.yz, vec2(along, !along)), state.w);
    }
    if border == SHALLOW_WATER_OPEN && along {
        return vec4f(state.x, outward(state.y, texel), state.zw);
    }
    if border == SHALLOW_WATER_SEA {
        // A wave that comes in carries its own velocity with it; one that goes out meets nothing.
        let depth = max(params.sea_metres + rise - cell.bed_metres, 0.0);
        let celerity = inverseSqrt(max(max(depth, abs(rise)), params.dry_metres) / params.gravity);
        let inward = select(-1.0, 1.0, texel < 0) * rise * celerity;
        return vec4f(depth, select(vec2f(0.0), vec2f(inward), vec2(along, !along)), 0.0);
    }
    return state;
}

// Of a row, and of a column, no two cells lie in the same bank of workgroup memory.
fn slot_of(row: u32, column: u32) -> u32 {
    return row * SHALLOW_WATER_SPAN + (row ^ column);
}

fn bed_at(along: i32, across: i32, turned: bool) -> f32 {
    let texel = select(vec2i(along, across), vec2i(across, along), turned);
    return shallow_water_bed_metres(textureLoad(bed, texel, 0).x, params.depth_metres);
}

@compute @workgroup_size(SHALLOW_WATER_SPAN)
fn shallow_water_step(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) lane: u32) {
    params = stored_params;
    dt = control.dt;
    rise = control.rise;
    let span = SHALLOW_WATER_SPAN;
    let halo = i32(SHALLOW_WATER_HALO);
    let turned = (control.substeps & 1u) == 1u;
    let ratio = dt / params.texel_metres;
    let along = axis_of(turned);
    let across = axis_of(!turned);
    let tile = select(workgroup.xy, workgroup.yx, turned);
    // The first texel of the tile, along, and of its halo, across.
    let first = vec2i(tile * vec2u(span, span - 2u * SHALLOW_WATER_HALO)) - vec2i(0, halo);
    var is_number = true;
    var speed = 0.0;

    // The first direction: a row.
    let row = first.y + i32(lane);
    let home_row = home(across, row);
    let row_inside = row >= 0 && row < across.size;
    let row_border = border_of(across, row);
    var walk = ShallowWaterWalk();
    for (var i = 0; i < i32(span) + 2 * halo; i++) {
        let texel = first.x + i - halo;
        let home_texel = home(along, texel);
        let index = u32(home_texel) * along.stride + u32(home_row) * across.stride;
        let state = depths[index];
        let flow = flows[index];
        // `max` and `clamp` may turn a NaN into a number: it must be seen before.
        is_number = is_number && shallow_water_is_number(state.x + state.y) && shallow_water_is_number(flow.x + flow.y);
        let velocity = shallow_water_velocity(select(flow, flow.yx, turned), state.x, params.dry_metres, params.speed_cap);
        var cell = ShallowWaterCell(vec4f(state.x, velocity, state.y), bed_at(home_texel, home_row, turned));
        if !row_inside {
            cell.state = beyond(cell, row, row_border, false);
        }
        if texel < 0 || texel >= along.size {
            cell.state = beyond(cell, texel, border_of(along, texel), true);
        }
        let result = walk_on(&walk, cell, vec2(is_closed(along, texel), is_closed(along, texel - 2)), ratio);
        is_number = is_number && result.is_number;
        if i >= 2 * halo - 1 && row_inside && texel - 2 <= along.size {
            speed = max(speed, result.speed);
        }
        if i >= 2 * halo {
            rows[slot_of(lane, u32(i - 2 * halo))] = between(result.after, result.before, across, row);
        }
    }
    workgroupBarrier();

    // The second: a column. Here `along` is across.
    let column = first.x + i32(lane);
    let home_column = home(along, column);
    walk = ShallowWaterWalk();
    for (var i = 0; i < i32(span); i++) {
        let texel = first.y + i;
        let cell = ShallowWaterCell(rows[slot_of(u32(i), lane)].xzyw, bed_at(home_column, home(across, texel), turned));
        let result = walk_on(&walk, cell, vec2(is_closed(across, texel), is_closed(across, texel - 2)), ratio);
        is_number = is_number && result.is_number;
        if i >= 2 * halo - 1 && column < along.size && texel - 2 <= across.size {
            speed = max(speed, result.speed);
        }
        if i >= 2 * halo && column < along.size && texel - 3 < across.size {
            let index = u32(column) * along.stride + u32(texel - 3) * across.stride;
            // Back to the field's own directions.
            let velocity = select(result.after.zy, result.after.yz, turned);
            speed = max(speed, settle(index, vec4f(result.after.x, velocity, result.after.w)));
        }
    }

    // The order of positive floats is that of their bits.
    workgroupBarrier();
    rows[lane].x = speed;
    workgroupBarrier();
    if lane == 0u {
        for (var i = 1u; i < span; i++) {
            speed = max(speed, rows[i].x);
        }
        atomicMax(&control.speed, bitcast<u32>(speed));
    }
    if !is_number {
        atomicOr(&control.fault, 1u);
    }
}

// Rain, seepage, friction and foam; then the texel is written, and the speed of its waves is the answer.
fn settle(index: u32, swept: vec4f) -> f32 {
    let depth = max(swept.x + dt * (params.rain - params.seepage), 0.0);
    var velocity = shallow_water_velocity(swept.x * swept.yz, depth, params.dry_metres, params.speed_cap);
    let drag = params.friction * pow(max(depth, params.dry_metres), -4.0 / 3.0);
    // u + dt·drag·|u|·u, solved for u a step ahead.
    velocity *= 2.0 / (1.0 + sqrt(1.0 + 4.0 * dt * drag * length(velocity)));
    let celerity = sqrt(params.gravity * depth);
    // It breaks where the surface rises faster than 0.15 to 0.5 times the speed of waves [Kennedy].
    let rate = (swept.x - depths[index].x) / dt;
    let breaking = saturate((rate / max(celerity, 1e-12) - 0.15) / 0.35);
    let foam = saturate((swept.w + dt * params.foam_gain * breaking) / (1.0 + dt * params.foam_loss));
    next_depths[index] = vec2f(depth, foam);
    next_flows[index] = depth * velocity;
    return max(abs(velocity.x), abs(velocity.y)) + celerity;
}
