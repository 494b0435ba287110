// Gas, activity: which tiles there is work in, and how many workgroups each kernel of a step needs.
//
//   activity    u32  a header (GAS_*), then for each tile how fast it is (the bits of a float, cells a step), whether it was
//                    touched, and whether it is and was active
//   tile_list   u32  the active tiles: how many, then column and row, 16 bits each
//   settling    u32  those that were active until now
//   dispatches  u32  three numbers a dispatch: active tiles, settling ones, what is shown, then each coarser level
//
// A tile is active if it, or one that it touches, is faster than stillness or was touched. The others are at rest in every buffer,
// so that whatever reads beyond an active tile reads what is true. Moves 20 bytes a tile, and 80 a cell of tiles that settle.
// Specification: src/reference/gas_activity.rs. Composed after common/gas.wgsl.

@group(1) @binding(2) var<storage, read_write> activity: array<u32>;
@group(1) @binding(3) var<storage, read_write> active_out: array<u32>;
@group(1) @binding(4) var<storage, read_write> settling_out: array<u32>;
@group(1) @binding(5) var<storage, read_write> dispatches: array<u32>;
@group(1) @binding(6) var<storage, read> levels: array<vec2u>;   // workgroups of each coarser level

override GAS_HEADER: u32;
override GAS_POISON: u32;
override GAS_STOPPED: u32;
override GAS_STEPS: u32;
override GAS_ACTIVE: u32;
override GAS_LONGEST: u32;
override GAS_COARSENING: u32;

const GAS_NOW: u32 = 1u;
const GAS_BEFORE: u32 = 2u;

fn tile_count() -> u32 {
    return u32(gas.tiles.x * gas.tiles.y);
}

// One invocation a tile.
@compute @workgroup_size(64)
fn gas_mark(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let index = id.y * workgroups.x * 64u + id.x;
    let count = tile_count();
    if index >= count {
        return;
    }
    let tile = vec2i(i32(index) % gas.tiles.x, i32(index) / gas.tiles.x);
    var moves = false;
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            var at = tile + vec2i(x, y);
            at += select(vec2i(0), gas.tiles, (gas.periodic == vec2i(1)) & (at < vec2i(0)));
            at -= select(vec2i(0), gas.tiles, (gas.periodic == vec2i(1)) & (at >= gas.tiles));
            at = clamp(at, vec2i(0), gas.tiles - 1);
            let neighbour = GAS_HEADER + u32(at.y * gas.tiles.x + at.x);
            moves = moves || bitcast<f32>(activity[neighbour]) > gas.stillness || activity[neighbour + count] != 0u;
        }
    }
    let state = GAS_HEADER + 2u * count + index;
    activity[state] = select(0u, GAS_NOW, moves) | select(0u, GAS_BEFORE, (activity[state] & GAS_NOW) != 0u);
}

var<workgroup> sums: array<vec2u, 256>;

fn dispatch(at: u32, count: vec3u) {
    dispatches[3u * at] = count.x;
    dispatches[3u * at + 1u] = count.y;
    dispatches[3u * at + 2u] = count.z;
}

// So many workgroups in two dimensions, none of them longer than may be.
fn folded(count: u32, depth: u32) -> vec3u {
    return vec3u(min(count, GAS_LONGEST), (count + GAS_LONGEST - 1u) / GAS_LONGEST, depth);
}

// Nothing is left to do from the given dispatch on.
fn idle(start: u32) {
    for (var i = start; i < 3u + arrayLength(&levels); i++) {
        dispatch(i, vec3u(0u));
    }
}

// Lists the tiles in their order: each invocation counts a run of them, then they know where each run begins.
@compute @workgroup_size(256)
fn gas_list(@builtin(local_invocation_index) local_index: u32) {
    let count = tile_count();
    let states = GAS_HEADER + 2u * count;
    let run = (count + 255u) / 256u;
    let first = min(local_index * run, count);
    let last = min(first + run, count);
    let stopped = activity[GAS_STOPPED] != 0u;
    var mine = vec2u(0u);
    for (var i = first; i < last; i++) {
        let state = activity[states + i];
        mine += vec2u(select(0u, 1u, (state & GAS_NOW) != 0u), select(0u, 1u, state == GAS_BEFORE));
        activity[GAS_HEADER + count + i] = 0u;
    }
    sums[local_index] = mine;
    workgroupBarrier();
    var before = vec2u(0u);
    for (var i = 0u; i < local_index; i++) {
        before += sums[i];
    }
    let all_of_them = before + mine;
    for (var i = first; i < last; i++) {
        let state = activity[states + i];
        let packed = (i % u32(gas.tiles.x)) | ((i / u32(gas.tiles.x)) << 16u);
        if (state & GAS_NOW) != 0u {
            active_out[1u + before.x] = packed;
            before.x++;
        } else if state == GAS_BEFORE {
            settling_out[1u + before.y] = packed;
            before.y++;
        }
    }
    if local_index < 255u {
        return;
    }
    if stopped {
        active_out[0] = 0u;
        settling_out[0] = 0u;
        idle(0u);
        return;
    }
    activity[GAS_STEPS] += 1u;
    activity[GAS_ACTIVE] = all_of_them.x;
    active_out[0] = all_of_them.x;
    settling_out[0] = all_of_them.y;
    if all_of_them.x == 0u {
        idle(0u);
    } else {
        let blocks = GAS_COARSENING * GAS_COARSENING;
        dispatch(0u, folded(all_of_them.x, 1u));
        dispatch(2u, folded(all_of_them.x, blocks));
        for (var i = 0u; i < arrayLength(&levels); i++) {
            dispatch(3u + i, vec3u(levels[i], 1u));
        }
    }
    dispatch(1u, folded(all_of_them.y, 1u));
}

// Where the forces left something that is no number the step ends here, and no other begins: its start is the last good state.
@compute @workgroup_size(1)
fn gas_judge() {
    if activity[GAS_POISON] != 0u && activity[GAS_STOPPED] == 0u {
        activity[GAS_STOPPED] = activity[GAS_STEPS];
        active_out[0] = 0u;
        idle(0u);
    }
}

@group(1) @binding(2) var<storage, read_write> carried_a: array<vec4f>;
@group(1) @binding(3) var<storage, read_write> carried_b: array<vec4f>;
@group(1) @binding(4) var<storage, read_write> carried_c: array<vec4f>;

// Puts the gas of a tile to rest in every buffer.
@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_settle_carried(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let cell = gas_cell(workgroup, workgroups, local);
    if any(cell >= gas.size) {
        return;
    }
    let index = u32(cell.y * gas.size.x + cell.x);
    let at_rest = vec4f(0.0, 0.0, carried_a[index].zw);
    carried_a[index] = at_rest;
    carried_b[index] = at_rest;
    carried_c[index] = at_rest;
}

@group(1) @binding(2) var<storage, read_write> velocity_a: array<vec2f>;
@group(1) @binding(3) var<storage, read_write> velocity_b: array<vec2f>;
@group(1) @binding(4) var<storage, read_write> velocity_c: array<vec2f>;
@group(1) @binding(5) var<storage, read_write> p: array<f32>;
@group(1) @binding(6) var<storage, read_write> coarse_b: array<f32>;

@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_settle_flow(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let place = gas_place(workgroup, workgroups);
    if place >= tile_list[0] {
        return;
    }
    let first = gas_tile(place) * i32(GAS_TILE);
    // The tile's own cells of the second level, as the projection deals them out.
    let coarse = (first * gas.coarse + gas.size - 1) / gas.size + vec2i(local.xy);
    if all(coarse < gas.coarse) && all(coarse * gas.size / gas.coarse < first + i32(GAS_TILE)) {
        coarse_b[coarse.y * gas.coarse.x + coarse.x] = 0.0;
    }
    let cell = first + vec2i(local.xy);
    if any(cell >= gas.size) {
        return;
    }
    let index = u32(cell.y * gas.size.x + cell.x);
    velocity_a[index] = vec2f(0.0);
    velocity_b[index] = vec2f(0.0);
    velocity_c[index] = vec2f(0.0);
    p[index] = 0.0;
}
