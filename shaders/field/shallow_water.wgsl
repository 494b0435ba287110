// Shallow water: one substep of the nonlinear equations, both directions in one dispatch.
//
//   depths   vec2f   read        depth of the water, metres; share of its surface that is foam
//   flows    vec2f   read        depth times velocity, m²/s
//   bed      r32float  read      height of what it flows over, heights, unclamped
//   next     2 vec2f write       the two a substep ahead
//
// 36 bytes a texel: 16 and the bed's 4 in, 16 out, the halo apart. Each direction by turns, x first in even substeps and y first in odd
// ones (Strang), each by the midpoint rule: a first-order half step, then minmod slopes of what it gives. HLLC fluxes [Toro] of
// hydrostatically reconstructed states [Audusse]: a lake at rest stays so to the bit. The half step of MUSCL-Hancock, from limited
// slopes alone, costs half as much, and lost: over a bed of white noise the slopes are 0, what remains is Euler's rule, and ripples
// of 1e-7 grew to a tenth of the depth in 500 substeps. So did steeper limiters. These stay as small as they were.
//
// A workgroup makes a tile of SPAN texels along the substep's first direction and SPAN − 2·HALO across it. Each invocation walks one
// line of it, with the few cells that a stencil needs in registers: first a row, from and to the halo, then a column of what the rows
// left in workgroup memory, where alone the invocations meet. A version whose every face was an invocation's, with cells and faces in
// workgroup memory, took five times as long on lavapipe, where each access to it is lane by lane.
//
// Specification: src/reference/shallow_water.rs. Composed after common/shallow_water.wgsl.

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

// One side of a face: the state there, its surface, and half of the pull of the cell's own bed.
struct ShallowWaterSide {
    state: vec4f,              // depth, velocity along and across the line, foam
    surface: f32,
    pull: f32,
}

// What passes a face, and what presses on the cells before and behind it.
struct ShallowWaterFace {
    mass: f32,
    pressed: vec2f,
    across: f32,
    foam: f32,
}

fn minmod(before: vec4f, after: vec4f) -> vec4f {
    return max(vec4f(0.0), min(before, after)) + min(vec4f(0.0), max(before, after));
}

// How fast the fastest wave of a face is, and what passes it.
struct ShallowWaterPassed {
    face: ShallowWaterFace,
    speed: f32,
}

fn pass_between(before: ShallowWaterSide, behind: ShallowWaterSide, stock: vec2f, drift: vec2f, closed: bool,
    ratio: f32) -> ShallowWaterPassed {
    let left = before.state;
    let right = behind.state;
    let g = params.gravity;
    let sill = max(before.surface - left.x, behind.surface - right.x);
    let hl = max(before.surface - sill, 0.0);
    let hr = max(behind.surface - sill, 0.0);
    let ul = left.y;
    let ur = right.y;
    let cl = sqrt(g * hl);
    let cr = sqrt(g * hr);
    // Two rarefactions bound the waves, and the exact speeds of a front where a side is dry ([Toro] §10.5.1, 10.8); waves beside a sill
    // are those of the water beside it, not those of the little that is above.
    let middle = 0.5 * (ul + ur) + cl - cr;
    let celerity = max(0.5 * (cl + cr) + 0.25 * (ul - ur), 0.0);
    var lowest = min(ul - sqrt(g * left.x), middle - celerity);
    var highest = max(ur + sqrt(g * right.x), middle + celerity);
    if hl <= 0.0 {
        lowest = ur - 2.0 * cr;
        highest = ur + cr;
    } else if hr <= 0.0 {
        lowest = ul - cl;
        highest = ul + 2.0 * cl;
    }
    let speed = select(0.0, max(abs(lowest), abs(highest)), hl + hr > 0.0);
    lowest = min(lowest, 0.0);
    highest = max(highest, 0.0);
    // Written from the left state on: what presses on a side is then exactly 0 in a lake at rest.
    let share = select(0.0, lowest / max(highest - lowest, 1e-30), highest > lowest);
    let ml = hl * ul;
    let mr = hr * ur;
    let mass = ml + share * ((ml - mr) + highest * (hr - hl));
    let pressure = 0.5 * g * (hl - hr) * (hl + hr);
    let carried = ml * ul + share * ((ml * ul - mr * ur + pressure) + highest * (mr - ml));
    // No face takes more than its share of what there is: the shares of a cell's two faces are 1 together.
    let shares = 0.5 + 0.5 * clamp(vec2f(drift.x, -drift.y) * ratio, vec2f(-1.0), vec2f(1.0));
    let most = shares * stock / ratio;
    let allowed = select(clamp(mass, -most.y, most.x), 0.0, closed);
    let scale = select(allowed / mass, 1.0, closed || mass == allowed);
    let upwind = select(right.zw, left.zw, allowed >= 0.0);
    let pressed = scale * carried + (1.0 - scale) * select(0.0, -pressure, mass < 0.0);
    let pressed_on = vec2f(pressed + before.pull, pressed + pressure - behind.pull);
    return ShallowWaterPassed(ShallowWaterFace(allowed, pressed_on, allowed * upwind.x, allowed * upwind.y), speed);
}

// A cell after what passed its two faces; its foam keeps to the water that carries it.
struct ShallowWaterMoved {
    cell: vec4f,
    is_number: bool,
}

fn moved(cell: vec4f, before: ShallowWaterFace, behind: ShallowWaterFace, ratio: f32) -> ShallowWaterMoved {
    let depth = cell.x - ratio * (behind.mass - before.mass);
    let flow = cell.x * cell.yz - ratio * vec2f(behind.pressed.x - before.pressed.y, behind.across - before.across);
    let foam = cell.x * cell.w - ratio * (behind.foam - before.foam);
    let is_number = shallow_water_is_number(depth) && shallow_water_is_number(flow.x + flow.y) && shallow_water_is_number(foam);
    let kept = max(depth, 0.0);
    let velocity = shallow_water_velocity(flow, kept, params.dry_metres, params.speed_cap);
    let share = select(cell.w, saturate(foam / max(kept, params.dry_metres)), kept > params.dry_metres);
    return ShallowWaterMoved(vec4f(kept, velocity, share), is_number);
}

// A cell of a line before its sweep.
struct ShallowWaterCell {
    state: vec4f,              // depth, velocity along and across the line, foam
    bed_metres: f32,
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

// What a walk along a line remembers: of the cells one, two and three before the one that comes next. A line begins beside dry ground
// at height 0: a state like any other, whose traces do not reach the texels behind the halo.
struct ShallowWaterWalk {
    one: ShallowWaterCell,
    two: ShallowWaterCell,
    three: ShallowWaterCell,
    passed_first: ShallowWaterFace,    // before cell one, in first order
    ahead_two: vec4f,                  // half a step on
    ahead_three: vec4f,
    behind_three: ShallowWaterSide,    // that end of cell three
    passed: ShallowWaterFace,          // before cell three
}

// What became of the cell three before the one that came.
struct ShallowWaterSwept {
    before: vec4f,
    after: vec4f,
    is_number: bool,
    speed: f32,                // of the fastest wave at its farther face
}

// Goes on to the next cell: the midpoint rule of three cells at once, each as far as what lies before it allows. `closed` says of the
// faces before that cell, and before the second before it, whether nothing passes.
fn walk_on(walk: ptr<function, ShallowWaterWalk>, cell: ShallowWaterCell, closed: vec2<bool>, ratio: f32) -> ShallowWaterSwept {
    let one = (*walk).one;
    let two = (*walk).two;
    let three = (*walk).three;
    // Half a step of cell one, in first order.
    let near = ShallowWaterSide(one.state, one.state.x + one.bed_metres, 0.0);
    let far = ShallowWaterSide(cell.state, cell.state.x + cell.bed_metres, 0.0);
    let first = pass_between(near, far, vec2f(one.state.x, cell.state.x), vec2f(one.state.y, cell.state.y), closed.x, 0.5 * ratio);
    let ahead = moved(one.state, (*walk).passed_first, first.face, 0.5 * ratio);
    // The ends of cell two, from the slopes of what that gave.
    let ahead_two = (*walk).ahead_two;
    let ahead_three = (*walk).ahead_three;
    let slope = minmod(ahead_two - ahead_three, ahead.cell - ahead_two);
    let surface = ahead_two.x + two.bed_metres;
    let rises = vec2f(surface - (ahead_three.x + three.bed_metres), (ahead.cell.x + one.bed_metres) - surface);
    let half_rise = 0.5 * (max(0.0, min(rises.x, rises.y)) + min(0.0, max(rises.x, rises.y)));
    let depth_ends = vec2f(ahead_two.x - 0.5 * slope.x, ahead_two.x + 0.5 * slope.x);
    let lacks = max(-depth_ends, vec2f(0.0));
    let surfaces = vec2f(surface - half_rise, surface + half_rise) + lacks;
    let pull = 0.25 * params.gravity * (depth_ends.x + lacks.x + depth_ends.y + lacks.y) * (surfaces.y - surfaces.x);
    let low = vec4f(max(depth_ends.x, 0.0), ahead_two.yzw - 0.5 * slope.yzw);
    let high = vec4f(max(depth_ends.y, 0.0), ahead_two.yzw + 0.5 * slope.yzw);
    // What passes between cells three and two, in second order, and with it cell three's whole step.
    let stock = vec2f(three.state.x, two.state.x);
    let drift = vec2f(ahead_three.y, ahead_two.y);
    let second = pass_between((*walk).behind_three, ShallowWaterSide(low, surfaces.x, pull), stock, drift, closed.y, ratio);
    let result = moved(three.state, (*walk).passed, second.face, ratio);
    *walk = ShallowWaterWalk(cell, one, two, first.face, ahead.cell, ahead_two, ShallowWaterSide(high, surfaces.y, pull), second.face);
    return ShallowWaterSwept(three.state, result.cell, ahead.is_number && result.is_number, second.speed);
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
