// Gas, emission: puffs of density, dye and velocity, added where they fall.
//
//   velocity  vec2f  read-write  m/s at the western and northern face
//   carried   vec4f  read-write  leading velocity, density, dye
//   activity  u32    write       that a tile was touched: see gas_activity
//
// Reads and writes 48 bytes a cell of each touched tile. Specification: src/reference/gas_emit.rs. Composed after common/gas.wgsl.

struct GasPuff {
    velocity: vec2f,           // m/s at the middle
    spin: f32,                 // m/s at one cell from the middle
    radius: f32,               // cells
    density: f32,              // at the middle: its mass over the sum of the profile
    dye: f32,
}

// A puff as a tile sees it.
struct GasMember {
    centre: vec2f,             // cells from the tile's first one
    radius: f32,               // cells, and half of one for the faces
    disc: u32,                 // in `puffs`
}

struct GasEmitTile {
    tile: vec2u,               // in units of tiles
    first: u32,                // in `members`
    count: u32,
}

struct GasBatch {
    first: u32,                // in `tiles`
    count: u32,
}

// What a puff adds at an offset from its middle, of its values there.
fn gas_profile(offset: vec2f, radius: f32) -> f32 {
    let w = max(0.0, 1.0 - dot(offset, offset) / (radius * radius));
    return w * w;
}

@group(1) @binding(1) var<storage, read_write> velocity: array<vec2f>;
@group(1) @binding(2) var<storage, read_write> carried: array<vec4f>;
@group(1) @binding(3) var<storage, read_write> activity: array<u32>;
@group(1) @binding(4) var<storage, read> tiles: array<GasEmitTile>;
@group(1) @binding(5) var<storage, read> members: array<GasMember>;
@group(1) @binding(6) var<storage, read> puffs: array<GasPuff>;
@group(1) @binding(7) var<storage, read> batch: GasBatch;

override GAS_STOPPED: u32;
override GAS_HEADER: u32;

@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_emit(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) local_index: u32,
) {
    let place = workgroup.y * workgroups.x + workgroup.x;
    if place >= batch.count || activity[GAS_STOPPED] != 0u {
        return;
    }
    let tile = tiles[batch.first + place];
    if local_index == 0u {
        let count = u32(gas.tiles.x * gas.tiles.y);
        activity[GAS_HEADER + count + tile.tile.y * u32(gas.tiles.x) + tile.tile.x] = 1u;
    }
    let cell = vec2i(tile.tile * GAS_TILE + local.xy);
    if any(cell >= gas.size) {
        return;
    }
    var push = vec2f(0.0);
    var gain = vec2f(0.0);
    for (var i = tile.first; i < tile.first + tile.count; i++) {
        let member = members[i];
        let puff = puffs[member.disc];
        let away = vec2f(local.xy) - member.centre;
        let west = away - vec2f(0.5, 0.0);
        let north = away - vec2f(0.0, 0.5);
        gain += gas_profile(away, puff.radius) * vec2f(puff.density, puff.dye);
        push.x += gas_profile(west, puff.radius) * (puff.velocity.x - puff.spin * west.y);
        push.y += gas_profile(north, puff.radius) * (puff.velocity.y + puff.spin * north.x);
    }
    let index = gas_index(cell);
    push *= gas_open(cell);
    velocity[index] += push;
    carried[index] += vec4f(push, gain);
}
