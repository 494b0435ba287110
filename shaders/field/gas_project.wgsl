// Gas, projection: a V-cycle of geometric multigrid takes most of its divergence from a velocity.
//
//   velocity  vec2f  read   m/s at the western and northern face
//   p         f32    write by the way down, read by the way up
//   b         f32    the divergence that a coarser level is to account for
//   q         f32    a coarser level's p when its way up is done
//
// On the finest level the way down reads 8 bytes a cell and writes 5, the way up reads 13 and writes 8; coarser ones read 4 and
// write 5, then read 9 and write 4, of a quarter of the cells each. A cycle moves 42 bytes a cell. The last cycle reads 16 more and
// writes 16, for the leading velocity. Specification: src/reference/gas_project.rs. Composed after field/gas_project_smooth.wgsl.

override GAS_TILE: u32;

struct GasLevel {
    size: vec2i,               // its cells
    periodic: vec2i,           // 1 where an axis repeats, 0 where it is closed
    coarse: vec2i,             // the next level's cells
    exchange: vec2f,           // what two neighbours along u, along v exchange for a unit of difference
    courant: f32,              // cells that 1 m/s crosses in a step
    tiles_across: i32,         // tiles along u
}

// Whether it is the last cycle of a step, and by how much the carried velocity leads.
override GAS_LAST: bool;
override GAS_LEAD: f32;
override GAS_HEADER: u32;

@group(1) @binding(0) var<storage, read> level: GasLevel;
@group(1) @binding(1) var<storage, read> tile_list: array<u32>;
@group(1) @binding(2) var<storage, read> velocity: array<vec2f>;
@group(1) @binding(3) var<storage, read_write> finest_p_out: array<f32>;
@group(1) @binding(4) var<storage, read_write> coarse_b_out: array<f32>;

@group(1) @binding(3) var<storage, read> finest_p: array<f32>;
@group(1) @binding(4) var<storage, read> coarse_q: array<f32>;
@group(1) @binding(5) var<storage, read_write> projected: array<vec2f>;
@group(1) @binding(6) var<storage, read_write> carried: array<vec4f>;
@group(1) @binding(7) var<storage, read_write> activity: array<u32>;

@group(1) @binding(1) var<storage, read> b: array<f32>;
@group(1) @binding(2) var<storage, read_write> p_out: array<f32>;
@group(1) @binding(3) var<storage, read_write> next_b_out: array<f32>;

@group(1) @binding(2) var<storage, read> p: array<f32>;
@group(1) @binding(3) var<storage, read> next_q: array<f32>;
@group(1) @binding(4) var<storage, read_write> q_out: array<f32>;

@group(1) @binding(2) var<storage, read> inverse: array<f32>;
@group(1) @binding(3) var<storage, read_write> solved: array<f32>;

var<workgroup> fastest: atomic<u32>;

fn project_address(cell: vec2i, size: vec2i) -> vec2i {
    let images = vec2i(floor((vec2f(cell) + 0.5) / vec2f(size)));
    return select(clamp(cell, vec2i(0), size - 1), cell - images * size, level.periodic == vec2i(1));
}

fn project_index(cell: vec2i) -> u32 {
    let inside = project_address(cell, level.size);
    return u32(inside.y * level.size.x + inside.x);
}

fn project_open(cell: vec2i) -> vec2f {
    return select(vec2f(0.0), vec2f(1.0), (level.periodic == vec2i(1)) | ((cell > vec2i(0)) & (cell < level.size)));
}

// a / b of whole numbers that are not negative, rounded down, without an integer division: the float's quotient is off by one at most.
fn quotient(a: vec2i, b: vec2i) -> vec2i {
    let near = vec2i(floor(vec2f(a) / vec2f(b)));
    let left = a - near * b;
    return near + select(vec2i(0), vec2i(1), left >= b) - select(vec2i(0), vec2i(1), left < vec2i(0));
}

fn divergence(cell: vec2i) -> f32 {
    let here = velocity[project_index(cell)] * project_open(cell);
    let east = velocity[project_index(cell + vec2i(1, 0))].x * project_open(cell + vec2i(1, 0)).x;
    let south = velocity[project_index(cell + vec2i(0, 1))].y * project_open(cell + vec2i(0, 1)).y;
    return (east - here.x) + (south - here.y);
}

// The coarse cell that an invocation sums: those that begin within the tile are the tile's own. An axis of one cell is not halved.
fn coarse_cell(first: vec2i, local: vec2u) -> vec2i {
    return quotient(first * level.coarse + level.size - 1, level.size) + vec2i(local);
}

// The part of a fine cell that lies in a coarse one, an axis.
fn part(coarse: vec2i, fine: vec2i) -> vec2f {
    let start = max(coarse * level.size, fine * level.coarse);
    let end = min((coarse + 1) * level.size, (fine + 1) * level.coarse);
    return vec2f(max(end - start, vec2i(0))) / vec2f(level.coarse);
}

// The sum of the residuals over a coarse cell, by area.
fn restricted(coarse: vec2i, origin: vec2i) -> f32 {
    let first = quotient(coarse * level.size, level.coarse);
    var sum = 0.0;
    for (var y = 0; y < 4; y++) {
        for (var x = 0; x < 4; x++) {
            let fine = first + vec2i(x, y);
            let at = vec2u(fine - origin);
            let parts = part(coarse, fine);
            sum += parts.x * parts.y * one[at.y * GAS_SIDE + at.x];
        }
    }
    return sum;
}

fn owns(coarse: vec2i, first: vec2i) -> bool {
    return all(coarse < level.coarse) && all(quotient(coarse * level.size, level.coarse) < first + i32(GAS_TILE));
}

@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_down_finest(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) local_index: u32,
) {
    let place = workgroup.y * workgroups.x + workgroup.x;
    if place >= tile_list[0] {
        return;
    }
    let packed = tile_list[1u + place];
    let first = vec2i(i32(packed & 0xffffu), i32(packed >> 16u)) * i32(GAS_TILE);
    let origin = first - GAS_DOWN;
    for (var k = local_index; k < GAS_AREA; k += GAS_TILE * GAS_TILE) {
        source[k] = divergence(project_cell(origin, k));
    }
    workgroupBarrier();
    descend(local_index, origin);
    let cell = first + vec2i(local.xy);
    if all(cell < level.size) {
        finest_p_out[cell.y * level.size.x + cell.x] = other[(local.y + u32(GAS_DOWN)) * GAS_SIDE + local.x + u32(GAS_DOWN)];
    }
    let coarse = coarse_cell(first, local.xy);
    if owns(coarse, first) {
        coarse_b_out[coarse.y * level.coarse.x + coarse.x] = restricted(coarse, origin);
    }
}

@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_down(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) local_index: u32,
) {
    let first = vec2i(workgroup.xy * GAS_TILE);
    let origin = first - GAS_DOWN;
    for (var k = local_index; k < GAS_AREA; k += GAS_TILE * GAS_TILE) {
        source[k] = b[project_index(project_cell(origin, k))];
    }
    workgroupBarrier();
    descend(local_index, origin);
    let cell = first + vec2i(local.xy);
    if all(cell < level.size) {
        p_out[cell.y * level.size.x + cell.x] = other[(local.y + u32(GAS_DOWN)) * GAS_SIDE + local.x + u32(GAS_DOWN)];
    }
    let coarse = coarse_cell(first, local.xy);
    if owns(coarse, first) {
        next_b_out[coarse.y * level.coarse.x + coarse.x] = restricted(coarse, origin);
    }
}

// The coarsest level, exactly: one invocation a cell. The inverse is symmetric: its columns are read, which lie together.
@compute @workgroup_size(GAS_TILE * GAS_TILE)
fn gas_solve(@builtin(local_invocation_index) local_index: u32) {
    let count = u32(level.size.x * level.size.y);
    if local_index >= count {
        return;
    }
    var sum = 0.0;
    for (var i = 0u; i < count; i++) {
        sum += inverse[i * count + local_index] * b[i];
    }
    solved[local_index] = sum;
}

// Where a fine cell's centre lies between those of the coarse ones: a whole number and a fraction, from the tile's first cell on.
fn prolong_place(cell: vec2i, first: vec2i, start: vec2f) -> vec2f {
    return start + vec2f(cell - first) * (vec2f(level.coarse) / vec2f(level.size));
}

// The same of the tile's surroundings' first cell, in integers: exact on the largest grids.
fn prolong_base(first: vec2i) -> vec2i {
    // Twice the grid more, that it is positive wherever the surroundings begin.
    let shifted = (2 * first + 1) * level.coarse - level.size + 2 * level.size * GAS_SHIFT * level.coarse;
    return quotient(shifted, 2 * level.size) - GAS_SHIFT * level.coarse;
}

fn prolong_start(first: vec2i, base: vec2i) -> vec2f {
    return vec2f((2 * first + 1) * level.coarse - level.size - 2 * level.size * base) / vec2f(2 * level.size);
}

// Grids that the surroundings of a tile may begin before the border: four cells of a grid of one.
const GAS_SHIFT: i32 = 5;

fn coarse_index(cell: vec2i) -> u32 {
    let inside = project_address(cell, level.coarse);
    return u32(inside.y * level.coarse.x + inside.x);
}

@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_up(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) local_index: u32,
) {
    let first = vec2i(workgroup.xy * GAS_TILE);
    let origin = first - GAS_UP;
    let base = prolong_base(origin);
    let start = prolong_start(origin, base);
    for (var k = local_index; k < GAS_AREA; k += GAS_TILE * GAS_TILE) {
        let cell = project_cell(origin, k);
        let at = prolong_place(cell, origin, start);
        let low = base + vec2i(floor(at));
        let weights = fract(at);
        let upper = mix(next_q[coarse_index(low)], next_q[coarse_index(low + vec2i(1, 0))], weights.x);
        let lower = mix(next_q[coarse_index(low + vec2i(0, 1))], next_q[coarse_index(low + 1)], weights.x);
        one[k] = p[project_index(cell)] + mix(upper, lower, weights.y);
        source[k] = b[project_index(cell)];
    }
    workgroupBarrier();
    ascend(local_index, origin);
    let cell = first + vec2i(local.xy);
    if all(cell < level.size) {
        q_out[cell.y * level.size.x + cell.x] = other[(local.y + u32(GAS_UP)) * GAS_SIDE + local.x + u32(GAS_UP)];
    }
}

@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_up_finest(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) local_index: u32,
) {
    let place = workgroup.y * workgroups.x + workgroup.x;
    if place >= tile_list[0] {
        return;
    }
    let packed = tile_list[1u + place];
    let tile = vec2i(i32(packed & 0xffffu), i32(packed >> 16u));
    let first = tile * i32(GAS_TILE);
    let origin = first - GAS_UP;
    let base = prolong_base(origin);
    let start = prolong_start(origin, base);
    for (var k = local_index; k < GAS_AREA; k += GAS_TILE * GAS_TILE) {
        let cell = project_cell(origin, k);
        let at = prolong_place(cell, origin, start);
        let low = base + vec2i(floor(at));
        let weights = fract(at);
        let upper = mix(coarse_q[coarse_index(low)], coarse_q[coarse_index(low + vec2i(1, 0))], weights.x);
        let lower = mix(coarse_q[coarse_index(low + vec2i(0, 1))], coarse_q[coarse_index(low + 1)], weights.x);
        one[k] = finest_p[project_index(cell)] + mix(upper, lower, weights.y);
        source[k] = divergence(cell);
    }
    workgroupBarrier();
    ascend(local_index, origin);
    let cell = first + vec2i(local.xy);
    if all(cell < level.size) {
        let index = u32(cell.y * level.size.x + cell.x);
        let k = (local.y + u32(GAS_UP)) * GAS_SIDE + local.x + u32(GAS_UP);
        let slope = vec2f(other[k] - other[k - 1u], other[k] - other[k - GAS_SIDE]);
        let now = (velocity[index] - slope) * project_open(cell);
        projected[index] = now;
        if GAS_LAST {
            let before = carried[index];
            carried[index] = vec4f(now + GAS_LEAD * (now - before.xy), before.zw);
            let speed = level.courant * abs(now);
            atomicMax(&fastest, bitcast<u32>(max(speed.x, speed.y)));
        }
    }
    if GAS_LAST {
        workgroupBarrier();
        if local_index == 0u {
            // As fast as the forces left it, or as the projection did.
            let motion = GAS_HEADER + u32(tile.y * level.tiles_across + tile.x);
            activity[motion] = max(activity[motion], atomicLoad(&fastest));
        }
    }
}
