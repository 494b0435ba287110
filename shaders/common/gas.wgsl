// Gas: what its kernels share. The grid is staggered: a cell's own velocities are those of its western and its northern face, its
// scalars stand at its centre. An axis repeats, or is closed by walls that the gas slides along.

override GAS_TILE: u32;

struct GasParams {
    size: vec2i,               // cells
    tiles: vec2i,              // tiles of GAS_TILE² cells
    periodic: vec2i,           // 1 where an axis repeats, 0 where it is closed
    coarse: vec2i,             // cells of the projection's second level
    courant: f32,              // cells that 1 m/s crosses in a step
    viscosity: f32,            // ν·dt/dx²
    confinement: f32,          // ε·dt
    buoyancy: f32,             // m/s that a step adds for a unit of density
    speed_limit: f32,          // m/s
    confinement_floor: f32,    // m/s
    stillness: f32,            // cells a step
    turning_per_speed: f32,    // 1/dx, 1/m
}

@group(1) @binding(0) var<storage, read> gas: GasParams;

// How many tiles there is work in, then their columns and rows, 16 bits each.
@group(1) @binding(1) var<storage, read> tile_list: array<u32>;

// The tile of a workgroup, in units of tiles.
fn gas_tile(place: u32) -> vec2i {
    let packed = tile_list[1u + place];
    return vec2i(i32(packed & 0xffffu), i32(packed >> 16u));
}

// A workgroup's place in the list of tiles.
fn gas_place(workgroup: vec3u, workgroups: vec3u) -> u32 {
    return workgroup.y * workgroups.x + workgroup.x;
}

// The cell of an invocation that works on the listed tiles; as large as the grid where they end.
fn gas_cell(workgroup: vec3u, workgroups: vec3u, local: vec3u) -> vec2i {
    let place = gas_place(workgroup, workgroups);
    if place >= tile_list[0] {
        return gas.size;
    }
    return gas_tile(place) * i32(GAS_TILE) + vec2i(local.xy);
}

// The cell that a coordinate beyond the border means. Floats, since integer division is slow on vectors of lanes; exact while the
// quotient and the size have no more than 24 bits between them.
fn gas_address(cell: vec2i) -> vec2i {
    let images = vec2i(floor((vec2f(cell) + 0.5) / vec2f(gas.size)));
    return select(clamp(cell, vec2i(0), gas.size - 1), cell - images * gas.size, gas.periodic == vec2i(1));
}

fn gas_index(cell: vec2i) -> u32 {
    let inside = gas_address(cell);
    return u32(inside.y * gas.size.x + inside.x);
}

// 1 where something can cross the western, the northern face of a cell.
fn gas_open(cell: vec2i) -> vec2f {
    return select(vec2f(0.0), vec2f(1.0), (gas.periodic == vec2i(1)) | ((cell > vec2i(0)) & (cell < gas.size)));
}

// Decided on the bits: compilers assume that there is nothing else.
fn gas_finite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}
