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
// Specification: src/reference/shallow_water.rs. Composed after common/shallow_water.wgsl.

// The half step takes one texel of it, the slopes of what it gives two.
const SHALLOW_WATER_HALO: u32 = 3u;

override SHALLOW_WATER_SPAN: u32;      // side of a tile with its halo
override SHALLOW_WATER_CELLS: u32;     // cells of it
override SHALLOW_WATER_FACES: u32;     // faces along the first direction, in the halo too

@group(1) @binding(0) var<storage, read> params: ShallowWaterParams;
@group(1) @binding(1) var<storage, read_write> control: ShallowWaterControl;
@group(1) @binding(2) var bed: texture_2d<f32>;
@group(1) @binding(3) var<storage, read> depths: array<vec2f>;
@group(1) @binding(4) var<storage, read> flows: array<vec2f>;
@group(1) @binding(5) var<storage, read_write> next_depths: array<vec2f>;
@group(1) @binding(6) var<storage, read_write> next_flows: array<vec2f>;

// In the frame of the substep: `along` its first direction, `across` its second.
var<workgroup> cells: array<vec4f, SHALLOW_WATER_CELLS>;       // depth, velocity along and across, foam
var<workgroup> beds: array<f32, SHALLOW_WATER_CELLS>;          // metres
var<workgroup> stocks: array<f32, SHALLOW_WATER_CELLS>;        // depth before the sweep: what faces may take from
var<workgroup> faces: array<vec4f, SHALLOW_WATER_FACES>;       // mass, pressed on the cell before and the one behind, across
var<workgroup> face_foams: array<f32, SHALLOW_WATER_FACES>;
var<workgroup> fastest: atomic<u32>;

// The texel of the field that a texel beyond its border means, an axis, and whether it is a mirror image.
fn border_of(axis: u32, texel: i32) -> u32 {
    let low = select(params.borders.x, params.borders.z, axis == 1u);
    let high = select(params.borders.y, params.borders.w, axis == 1u);
    return select(high, low, texel < 0);
}

fn home(axis: u32, texel: i32) -> i32 {
    let n = i32(params.size[axis]);
    if texel >= 0 && texel < n {
        return texel;
    }
    let border = border_of(axis, texel);
    if border == SHALLOW_WATER_PERIODIC {
        return (texel % n + n) % n;
    }
    let mirrored = select(2 * n - 1 - texel, -1 - texel, texel < 0);
    return clamp(select(texel, mirrored, border == SHALLOW_WATER_WALL), 0, n - 1);
}

// What of a velocity leaves by an open border: out, not in.
fn outward(velocity: f32, texel: i32) -> f32 {
    return select(max(velocity, 0.0), min(velocity, 0.0), texel < 0);
}

// A cell between the two directions. Beyond a border of the second one it is what that direction finds there: of an open border what
// the first has made of the texels inside, without what would come in; at sea what it was.
fn between(swept: vec4f, before: vec4f, across: i32, end: i32, axis: u32) -> vec4f {
    if across >= 0 && across < end {
        return swept;
    }
    let border = border_of(axis, across);
    let open = vec4f(swept.xy, outward(swept.z, across), swept.w);
    return select(select(swept, open, border == SHALLOW_WATER_OPEN), before, border == SHALLOW_WATER_SEA);
}

// Loads a cell; whether its state is all numbers is the answer.
fn load_cell(texel: vec2i, slot: u32, turned: bool) -> bool {
    let size = vec2i(params.size);
    let at = vec2i(home(0u, texel.x), home(1u, texel.y));
    let index = u32(at.y) * params.size.x + u32(at.x);
    let bed_metres = shallow_water_bed_metres(textureLoad(bed, at, 0).x, params.depth_metres);
    let state = depths[index];
    var depth = state.x;
    var foam = state.y;
    let flow = flows[index];
    var velocity = shallow_water_velocity(flow, depth, params.dry_metres, params.speed_cap);
    for (var axis = 0u; axis < 2u; axis++) {
        if texel[axis] < 0 || texel[axis] >= size[axis] {
            let border = border_of(axis, texel[axis]);
            if border == SHALLOW_WATER_WALL {
                velocity[axis] = -velocity[axis];
            } else if border == SHALLOW_WATER_OPEN && (axis == 1u) == turned {
                velocity[axis] = outward(velocity[axis], texel[axis]);
            } else if border == SHALLOW_WATER_SEA {
                // A wave that comes in carries its own velocity with it; one that goes out meets nothing.
                depth = max(params.sea_metres + control.rise - bed_metres, 0.0);
                let celerity = inverseSqrt(max(max(depth, abs(control.rise)), params.dry_metres) / params.gravity);
                velocity = vec2f(0.0);
                velocity[axis] = select(-1.0, 1.0, texel[axis] < 0) * control.rise * celerity;
                foam = 0.0;
            }
        }
    }
    cells[slot] = vec4f(depth, select(velocity, velocity.yx, turned), foam);
    beds[slot] = bed_metres;
    stocks[slot] = depth;
    return shallow_water_is_number(state.x + state.y) && shallow_water_is_number(flow.x + flow.y);
}

fn minmod(before: vec4f, after: vec4f) -> vec4f {
    return max(vec4f(0.0), min(before, after)) + min(vec4f(0.0), max(before, after));
}

// One side of a face: the state there, its surface, and half of the pull of the cell's own bed.
struct ShallowWaterSide {
    state: vec4f,
    surface: f32,
    pull: f32,
}

// The end of a cell with these slopes, before it (−½) or behind it (½).
fn end(cell: vec4f, bed_metres: f32, slope: vec4f, surface_slope: f32, side: f32) -> ShallowWaterSide {
    let depths = vec2f(cell.x - 0.5 * slope.x, cell.x + 0.5 * slope.x);
    let lacks = max(-depths, vec2f(0.0));
    let middle = cell.x + bed_metres;
    let surfaces = vec2f(middle - 0.5 * surface_slope, middle + 0.5 * surface_slope) + lacks;
    let pull = 0.25 * params.gravity * (depths.x + lacks.x + depths.y + lacks.y) * (surfaces.y - surfaces.x);
    var state = cell + side * slope;
    state.x = max(state.x, 0.0);
    return ShallowWaterSide(state, select(surfaces.y, surfaces.x, side < 0.0), pull);
}

// `turn` exchanges along and across: the second direction of the substep.
fn cell_at(slot: u32, turn: bool) -> vec4f {
    let cell = cells[slot];
    return select(cell, cell.xzyw, turn);
}

// What passes the face behind the cell at `slot`, whose neighbours are `stride` apart, in first order.
fn pass_first(face: u32, slot: u32, stride: u32, turn: bool, closed: bool, ratio: f32) {
    let c1 = cell_at(slot, turn);
    let c2 = cell_at(slot + stride, turn);
    let left = ShallowWaterSide(c1, c1.x + beds[slot], 0.0);
    let right = ShallowWaterSide(c2, c2.x + beds[slot + stride], 0.0);
    pass_between(face, left, right, vec2f(c1.x, c2.x), vec2f(c1.y, c2.y), closed, ratio);
}

// The same in second order; the fastest wave there is the answer.
fn pass_second(face: u32, slot: u32, stride: u32, turn: bool, closed: bool, ratio: f32) -> f32 {
    let c0 = cell_at(slot - stride, turn);
    let c1 = cell_at(slot, turn);
    let c2 = cell_at(slot + stride, turn);
    let c3 = cell_at(slot + 2u * stride, turn);
    let b1 = beds[slot];
    let b2 = beds[slot + stride];
    let s0 = c0.x + beds[slot - stride];
    let s1 = c1.x + b1;
    let s2 = c2.x + b2;
    let s3 = c3.x + beds[slot + 2u * stride];
    let rises = minmod(vec4f(s1 - s0, s2 - s1, 0.0, 0.0), vec4f(s2 - s1, s3 - s2, 0.0, 0.0)).xy;
    let left = end(c1, b1, minmod(c1 - c0, c2 - c1), rises.x, 0.5);
    let right = end(c2, b2, minmod(c2 - c1, c3 - c2), rises.y, -0.5);
    let stock = vec2f(stocks[slot], stocks[slot + stride]);
    return pass_between(face, left, right, stock, vec2f(c1.y, c2.y), closed, ratio);
}

fn pass_between(face: u32, before: ShallowWaterSide, behind: ShallowWaterSide, stock: vec2f, drift: vec2f, closed: bool,
    ratio: f32) -> f32 {
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
    var allowed = clamp(mass, -shares.y * stock.y / ratio, shares.x * stock.x / ratio);
    var scale = 1.0;
    if closed {
        allowed = 0.0;
    } else if mass != allowed {
        scale = allowed / mass;
    }
    let upwind = select(right, left, allowed >= 0.0);
    let pressed = scale * carried + (1.0 - scale) * select(0.0, -pressure, mass < 0.0);
    faces[face] = vec4f(allowed, pressed + before.pull, pressed + pressure - behind.pull, allowed * upwind.z);
    face_foams[face] = allowed * upwind.w;
    return speed;
}

// A cell after what passed its two faces; its foam keeps to the water that carries it.
struct ShallowWaterMoved {
    cell: vec4f,
    is_number: bool,
}

fn moved(cell: vec4f, before: u32, behind: u32, ratio: f32) -> ShallowWaterMoved {
    let f0 = faces[before];
    let f1 = faces[behind];
    let depth = cell.x - ratio * (f1.x - f0.x);
    let flow = cell.x * cell.yz - ratio * vec2f(f1.y - f0.z, f1.w - f0.w);
    let foam = cell.x * cell.w - ratio * (face_foams[behind] - face_foams[before]);
    let is_number = shallow_water_is_number(depth) && shallow_water_is_number(flow.x + flow.y) && shallow_water_is_number(foam);
    let kept = max(depth, 0.0);
    let velocity = shallow_water_velocity(flow, kept, params.dry_metres, params.speed_cap);
    let share = select(cell.w, saturate(foam / max(kept, params.dry_metres)), kept > params.dry_metres);
    return ShallowWaterMoved(vec4f(kept, velocity, share), is_number);
}

@compute @workgroup_size(SHALLOW_WATER_TILE, SHALLOW_WATER_TILE)
fn shallow_water_step(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) lane: u32) {
    let tile = SHALLOW_WATER_TILE;
    let span = SHALLOW_WATER_SPAN;
    let lanes = tile * tile;
    let turned = (control.substeps & 1u) == 1u;
    let ratio = control.dt / params.texel_metres;
    let origin = vec2i(workgroup.xy * tile) - i32(SHALLOW_WATER_HALO);
    // In the substep's frame: where the tile lies, how large the field is, and which borders are closed.
    let start = select(origin, origin.yx, turned);
    let size = vec2i(select(params.size, params.size.yx, turned));
    let walls = select(params.borders, params.borders.zwxy, turned) == vec4u(SHALLOW_WATER_WALL);

    // `max` and `clamp` may turn a NaN into a number: it must be seen before.
    var is_number = true;
    for (var i = lane; i < span * span; i += lanes) {
        let x = i % span;
        let y = i / span;
        let slot = select(y * span + x, x * span + y, turned);
        is_number = load_cell(origin + vec2i(i32(x), i32(y)), slot, turned) && is_number;
    }
    workgroupBarrier();

    // Cells with all their halo but its outermost ring, `inner` a row; one invocation keeps what two of them were before the sweep.
    let inner = span - 2u;
    var kept: array<vec4f, 2>;
    var speed = 0.0;

    // The first direction, over all rows.
    for (var i = lane; i < span * (span - 1u); i += lanes) {
        let row = i / (span - 1u);
        let column = i % (span - 1u);
        let at = start.x + i32(column) + 1;
        let closed = (at == 0 && walls.x) || (at == size.x && walls.y);
        pass_first(i, row * span + column, 1u, false, closed, 0.5 * ratio);
    }
    workgroupBarrier();
    for (var k = 0u; k < 2u; k++) {
        let i = lane + k * lanes;
        if i < span * inner {
            let row = i / inner;
            let column = i % inner + 1u;
            let slot = row * span + column;
            let face = row * (span - 1u) + column;
            kept[k] = cells[slot];
            let ahead = moved(kept[k], face - 1u, face, 0.5 * ratio);
            is_number = ahead.is_number && is_number;
            cells[slot] = ahead.cell;
        }
    }
    workgroupBarrier();
    for (var i = lane; i < span * (tile + 1u); i += lanes) {
        let row = i / (tile + 1u);
        let column = i % (tile + 1u);
        let at = start + vec2i(i32(column + SHALLOW_WATER_HALO), i32(row));
        let closed = (at.x == 0 && walls.x) || (at.x == size.x && walls.y);
        let here = pass_second(i, row * span + column + SHALLOW_WATER_HALO - 1u, 1u, false, closed, ratio);
        speed = max(speed, select(0.0, here, at.x <= size.x && at.y >= 0 && at.y < size.y));
    }
    workgroupBarrier();
    for (var k = 0u; k < 2u; k++) {
        let i = lane + k * lanes;
        let row = i / inner;
        let column = i % inner + 1u;
        if i < span * inner && column >= SHALLOW_WATER_HALO && column < tile + SHALLOW_WATER_HALO {
            let slot = row * span + column;
            let face = row * (tile + 1u) + column - SHALLOW_WATER_HALO;
            let after = moved(kept[k], face, face + 1u, ratio);
            is_number = after.is_number && is_number;
            let swept = between(after.cell, kept[k], start.y + i32(row), size.y, select(1u, 0u, turned));
            cells[slot] = swept;
            stocks[slot] = swept.x;
        }
    }
    workgroupBarrier();

    // The second, over the tile's own columns.
    for (var i = lane; i < tile * (span - 1u); i += lanes) {
        let row = i / tile;
        let column = i % tile + SHALLOW_WATER_HALO;
        let at = start.y + i32(row) + 1;
        let closed = (at == 0 && walls.z) || (at == size.y && walls.w);
        pass_first(i, row * span + column, span, true, closed, 0.5 * ratio);
    }
    workgroupBarrier();
    for (var k = 0u; k < 2u; k++) {
        let i = lane + k * lanes;
        if i < inner * tile {
            let slot = (i / tile + 1u) * span + i % tile + SHALLOW_WATER_HALO;
            kept[k] = cell_at(slot, true);
            let ahead = moved(kept[k], i, i + tile, 0.5 * ratio);
            is_number = ahead.is_number && is_number;
            cells[slot] = ahead.cell.xzyw;
        }
    }
    workgroupBarrier();
    for (var i = lane; i < tile * (tile + 1u); i += lanes) {
        let row = i / tile;
        let column = i % tile;
        let at = start + vec2i(i32(column), i32(row)) + i32(SHALLOW_WATER_HALO);
        let closed = (at.y == 0 && walls.z) || (at.y == size.y && walls.w);
        let here = pass_second(i, (row + SHALLOW_WATER_HALO - 1u) * span + column + SHALLOW_WATER_HALO, span, true, closed, ratio);
        speed = max(speed, select(0.0, here, at.y <= size.y && at.x < size.x));
    }
    workgroupBarrier();
    for (var k = 0u; k < 2u; k++) {
        let i = lane + k * lanes;
        // The first and the last rows of these cells are halo.
        let first = (SHALLOW_WATER_HALO - 1u) * tile;
        if i >= first && i < first + tile * tile {
            let face = i - first;
            let at = start + vec2i(i32(face % tile), i32(face / tile)) + i32(SHALLOW_WATER_HALO);
            if all(at < size) {
                let result = moved(kept[k], face, face + tile, ratio);
                is_number = result.is_number && is_number;
                // Back from (across, along) to the field's own directions.
                speed = max(speed, settle(select(at, at.yx, turned), result, !turned));
            }
        }
    }
    // The order of positive floats is that of their bits.
    atomicMax(&fastest, bitcast<u32>(speed));
    if !is_number {
        atomicOr(&control.fault, 1u);
    }
    workgroupBarrier();
    if lane == 0u {
        atomicMax(&control.speed, atomicLoad(&fastest));
    }
}

// Rain, seepage, friction and foam; then the texel is written, and the speed of its waves is the answer.
fn settle(texel: vec2i, result: ShallowWaterMoved, turned: bool) -> f32 {
    let dt = control.dt;
    let index = u32(texel.y) * params.size.x + u32(texel.x);
    let depth = max(result.cell.x + dt * (params.rain - params.seepage), 0.0);
    var velocity = result.cell.x * select(result.cell.yz, result.cell.zy, turned);
    velocity = shallow_water_velocity(velocity, depth, params.dry_metres, params.speed_cap);
    let drag = params.friction * pow(max(depth, params.dry_metres), -4.0 / 3.0);
    // u + dt·drag·|u|·u, solved for u a step ahead.
    velocity *= 2.0 / (1.0 + sqrt(1.0 + 4.0 * dt * drag * length(velocity)));
    let celerity = sqrt(params.gravity * depth);
    // It breaks where the surface rises faster than 0.15 to 0.5 times the speed of waves [Kennedy].
    let rate = (result.cell.x - depths[index].x) / dt;
    let breaking = saturate((rate / max(celerity, 1e-12) - 0.15) / 0.35);
    let foam = saturate((result.cell.w + dt * params.foam_gain * breaking) / (1.0 + dt * params.foam_loss));
    next_depths[index] = vec2f(depth, foam);
    next_flows[index] = depth * velocity;
    return max(abs(velocity.x), abs(velocity.y)) + celerity;
}
