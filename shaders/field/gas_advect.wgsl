// Gas, advection: MacCormack's scheme with the limiter of [Selle], along paths traced by the midpoint rule.
//
//   velocity  vec2f  read   m/s at the western and northern face, free of divergence
//   carried   vec4f  read   leading velocity (m/s, at the faces), density, dye (at the centre)
//   ahead     vec4f  write, then read   the same after a semi-Lagrangian step
//   limited   vec4f  write  the same corrected and limited
//   activity  u32    write  whether anything is no number: the limiter would swallow it
//
// The first kernel reads 24 bytes a cell and writes 16, the second reads 40 and writes 16. Specification:
// src/reference/gas_advect.rs. Composed after common/gas.wgsl.

@group(1) @binding(2) var<storage, read> velocity: array<vec2f>;
@group(1) @binding(3) var<storage, read> carried: array<vec4f>;
@group(1) @binding(4) var<storage, read_write> ahead_out: array<vec4f>;
@group(1) @binding(4) var<storage, read> ahead: array<vec4f>;
@group(1) @binding(5) var<storage, read_write> limited: array<vec4f>;
@group(1) @binding(5) var<storage, read_write> activity: array<atomic<u32>>;

override GAS_POISON: u32;

// Where what a cell holds stands, from the cell's north-western corner.
const GAS_WEST = vec2f(0.0, 0.5);
const GAS_NORTH = vec2f(0.5, 0.0);
const GAS_CENTRE = vec2f(0.5, 0.5);

// The four indices around a lattice position, and how far it is beyond the first.
struct GasStencil {
    cells: array<vec2i, 4>,
    weights: vec2f,
}

// Positions are offsets from a cell: small numbers keep their precision on large grids.
fn gas_stencil(cell: vec2i, offset: vec2f) -> GasStencil {
    let whole = floor(offset);
    let first = cell + vec2i(whole);
    let cells = array(first, first + vec2i(1, 0), first + vec2i(0, 1), first + vec2i(1, 1));
    return GasStencil(cells, offset - whole);
}

fn gas_mix(corners: vec4f, weights: vec2f) -> f32 {
    return mix(mix(corners.x, corners.y, weights.x), mix(corners.z, corners.w, weights.x), weights.y);
}

fn velocity_west(cell: vec2i) -> f32 {
    return velocity[gas_index(cell)].x * gas_open(cell).x;
}

fn velocity_north(cell: vec2i) -> f32 {
    return velocity[gas_index(cell)].y * gas_open(cell).y;
}

// The velocity at an offset from a cell's corner, m/s.
fn gas_flow(cell: vec2i, offset: vec2f) -> vec2f {
    let u = gas_stencil(cell, offset - GAS_WEST);
    let v = gas_stencil(cell, offset - GAS_NORTH);
    let us = vec4f(velocity_west(u.cells[0]), velocity_west(u.cells[1]), velocity_west(u.cells[2]), velocity_west(u.cells[3]));
    let vs = vec4f(velocity_north(v.cells[0]), velocity_north(v.cells[1]), velocity_north(v.cells[2]), velocity_north(v.cells[3]));
    return vec2f(gas_mix(us, u.weights), gas_mix(vs, v.weights));
}

// The velocity at the three places of a cell where something is carried: both faces, and the centre.
struct GasPlaces {
    west: vec2f,
    north: vec2f,
    centre: vec2f,
}

fn gas_flows(cell: vec2i) -> GasPlaces {
    let u = vec4f(velocity_west(cell), velocity_west(cell + vec2i(1, 0)), velocity_west(cell - vec2i(0, 1)), velocity_west(cell + vec2i(1, -1)));
    let v = vec4f(velocity_north(cell), velocity_north(cell + vec2i(0, 1)), velocity_north(cell - vec2i(1, 0)), velocity_north(cell + vec2i(-1, 1)));
    return GasPlaces(
        vec2f(u.x, 0.25 * (v.x + v.y + v.z + v.w)),
        vec2f(0.25 * (u.x + u.y + u.z + u.w), v.x),
        0.5 * vec2f(u.x + u.y, v.x + v.y),
    );
}

// Where the flow leads from an offset in a step of `courant` cells per m/s; `here` is the velocity there.
fn gas_follow(cell: vec2i, offset: vec2f, here: vec2f, courant: f32) -> vec2f {
    return offset + courant * gas_flow(cell, offset + 0.5 * courant * here);
}

fn carried_west(cell: vec2i) -> f32 {
    return carried[gas_index(cell)].x * gas_open(cell).x;
}

fn carried_north(cell: vec2i) -> f32 {
    return carried[gas_index(cell)].y * gas_open(cell).y;
}

fn west_corners(at: GasStencil) -> vec4f {
    return vec4f(carried_west(at.cells[0]), carried_west(at.cells[1]), carried_west(at.cells[2]), carried_west(at.cells[3]));
}

fn north_corners(at: GasStencil) -> vec4f {
    return vec4f(carried_north(at.cells[0]), carried_north(at.cells[1]), carried_north(at.cells[2]), carried_north(at.cells[3]));
}

fn ahead_west(cell: vec2i) -> f32 {
    return ahead[gas_index(cell)].x * gas_open(cell).x;
}

fn ahead_north(cell: vec2i) -> f32 {
    return ahead[gas_index(cell)].y * gas_open(cell).y;
}

// A step back along the flow.
@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_ahead(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let cell = gas_cell(workgroup, workgroups, local);
    if any(cell >= gas.size) {
        return;
    }
    let own = carried[gas_index(cell)];
    let speed = velocity[gas_index(cell)];
    if !(gas_finite(own.x) && gas_finite(own.y) && gas_finite(own.z) && gas_finite(own.w) && gas_finite(speed.x) && gas_finite(speed.y)) {
        atomicStore(&activity[GAS_POISON], 1u);
    }
    let flows = gas_flows(cell);
    let u = gas_stencil(cell, gas_follow(cell, GAS_WEST, flows.west, -gas.courant) - GAS_WEST);
    let v = gas_stencil(cell, gas_follow(cell, GAS_NORTH, flows.north, -gas.courant) - GAS_NORTH);
    let s = gas_stencil(cell, gas_follow(cell, GAS_CENTRE, flows.centre, -gas.courant) - GAS_CENTRE);
    let upper = mix(carried[gas_index(s.cells[0])].zw, carried[gas_index(s.cells[1])].zw, s.weights.x);
    let lower = mix(carried[gas_index(s.cells[2])].zw, carried[gas_index(s.cells[3])].zw, s.weights.x);
    let faces = vec2f(gas_mix(west_corners(u), u.weights), gas_mix(north_corners(v), v.weights)) * gas_open(cell);
    ahead_out[gas_index(cell)] = vec4f(faces, mix(upper, lower, s.weights.y));
}

fn lowest(corners: vec4f) -> f32 {
    return min(min(corners.x, corners.y), min(corners.z, corners.w));
}

fn highest(corners: vec4f) -> f32 {
    return max(max(corners.x, corners.y), max(corners.z, corners.w));
}

// A step forth from there, half of what the round trip lost, and the limits of what the first step saw.
@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_limited(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let cell = gas_cell(workgroup, workgroups, local);
    if any(cell >= gas.size) {
        return;
    }
    let index = gas_index(cell);
    let flows = gas_flows(cell);
    let u = gas_stencil(cell, gas_follow(cell, GAS_WEST, flows.west, gas.courant) - GAS_WEST);
    let v = gas_stencil(cell, gas_follow(cell, GAS_NORTH, flows.north, gas.courant) - GAS_NORTH);
    let s = gas_stencil(cell, gas_follow(cell, GAS_CENTRE, flows.centre, gas.courant) - GAS_CENTRE);
    let us = vec4f(ahead_west(u.cells[0]), ahead_west(u.cells[1]), ahead_west(u.cells[2]), ahead_west(u.cells[3]));
    let vs = vec4f(ahead_north(v.cells[0]), ahead_north(v.cells[1]), ahead_north(v.cells[2]), ahead_north(v.cells[3]));
    let upper = mix(ahead[gas_index(s.cells[0])].zw, ahead[gas_index(s.cells[1])].zw, s.weights.x);
    let lower = mix(ahead[gas_index(s.cells[2])].zw, ahead[gas_index(s.cells[3])].zw, s.weights.x);
    let back = vec4f(gas_mix(us, u.weights), gas_mix(vs, v.weights), mix(upper, lower, s.weights.y));
    let corrected = ahead[index] + 0.5 * (carried[index] - back);

    let from_west = west_corners(gas_stencil(cell, gas_follow(cell, GAS_WEST, flows.west, -gas.courant) - GAS_WEST));
    let from_north = north_corners(gas_stencil(cell, gas_follow(cell, GAS_NORTH, flows.north, -gas.courant) - GAS_NORTH));
    let origin = gas_stencil(cell, gas_follow(cell, GAS_CENTRE, flows.centre, -gas.courant) - GAS_CENTRE);
    let a = carried[gas_index(origin.cells[0])].zw;
    let b = carried[gas_index(origin.cells[1])].zw;
    let c = carried[gas_index(origin.cells[2])].zw;
    let d = carried[gas_index(origin.cells[3])].zw;
    let low = vec4f(lowest(from_west), lowest(from_north), min(min(a, b), min(c, d)));
    let high = vec4f(highest(from_west), highest(from_north), max(max(a, b), max(c, d)));
    limited[index] = clamp(corrected, low, high) * vec4f(gas_open(cell), 1.0, 1.0);
}
