// Gas, forces: viscosity, vorticity confinement [Fedkiw], buoyancy, the planet's turning, the pull to a row's wind and gas.
//
//   limited   vec4f  read   leading velocity (m/s), density, dye, as the flow carried them
//   rows      -      read   what each row of cells tends to
//   velocity  vec2f  write  the velocity to be projected
//   carried   vec4f  write  the same velocity, density, dye
//   activity  u32    write  how fast a tile is, or may soon be; whether anything is no number
//
// Reads 16 bytes a cell and writes 24. Specification: src/reference/gas_force.rs. Composed after common/gas.wgsl.

struct GasRow {
    wind: f32,                 // m/s
    density: f32,
    dye: f32,
    wind_pull: f32,            // part of the way to the wind that a step goes
    calm_pull: f32,            // part of the velocity along v that a step takes
    gas_pull: f32,             // part of the way to density and dye
    turn_cosine: f32,          // of the angle by which the planet turns a velocity in a step
    turn_sine: f32,
}

@group(1) @binding(2) var<storage, read> limited: array<vec4f>;
@group(1) @binding(3) var<storage, read> rows: array<GasRow>;
@group(1) @binding(4) var<storage, read_write> velocity: array<vec2f>;
@group(1) @binding(5) var<storage, read_write> carried: array<vec4f>;
@group(1) @binding(6) var<storage, read_write> activity: array<atomic<u32>>;

override GAS_POISON: u32;
override GAS_HEADER: u32;

// A push counts as the speed that it leads to in so many steps.
override GAS_FORESIGHT: f32;

// The tile with two cells around it.
const GAS_SIDE: u32 = 20u;
const GAS_AROUND: i32 = 2;
var<workgroup> flow: array<vec2f, 400>;
var<workgroup> vorticity: array<f32, 400>;
var<workgroup> fastest: atomic<u32>;

// The column and row of a place in the tile's surroundings. lavapipe divides integers lane by lane; floats are exact here.
fn surrounding(k: u32) -> vec2u {
    let row = u32((f32(k) + 0.5) * (1.0 / f32(GAS_SIDE)));
    return vec2u(k - row * GAS_SIDE, row);
}

// The push on a face, where `along` its ends |vorticity| rises and `across` it: see the reference.
fn gas_confinement(ends: vec2f, before: vec2f, after: vec2f) -> f32 {
    let along = abs(ends.y) - abs(ends.x);
    let across = 0.25 * (abs(after.x) + abs(after.y) - abs(before.x) - abs(before.y));
    let steep = sqrt(along * along + across * across + gas.confinement_floor * gas.confinement_floor);
    return gas.confinement * 0.5 * (ends.x + ends.y) * along / steep;
}

@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_force(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) local_index: u32,
) {
    let place = gas_place(workgroup, workgroups);
    if place >= tile_list[0] {
        return;
    }
    let tile = gas_tile(place);
    let origin = tile * i32(GAS_TILE) - GAS_AROUND;
    for (var k = local_index; k < GAS_SIDE * GAS_SIDE; k += GAS_TILE * GAS_TILE) {
        let cell = origin + vec2i(surrounding(k));
        flow[k] = limited[gas_index(cell)].xy * gas_open(cell);
    }
    workgroupBarrier();
    for (var k = local_index; k < GAS_SIDE * GAS_SIDE; k += GAS_TILE * GAS_TILE) {
        let at = surrounding(k);
        let open = gas_open(origin + vec2i(at));
        var turning = 0.0;
        if all(at > vec2u(0u)) {
            turning = (flow[k].y - flow[k - 1u].y) - (flow[k].x - flow[k - GAS_SIDE].x);
        }
        vorticity[k] = turning * open.x * open.y;
    }
    workgroupBarrier();

    let cell = tile * i32(GAS_TILE) + vec2i(local.xy);
    if all(cell < gas.size) {
        let index = gas_index(cell);
        let k = (local.y + u32(GAS_AROUND)) * GAS_SIDE + local.x + u32(GAS_AROUND);
        let row = rows[gas_address(cell).y];
        let north_row = rows[gas_address(cell - vec2i(0, 1)).y];
        let open = gas_open(cell);
        let here = flow[k];
        let spread = flow[k - 1u] + flow[k + 1u] + flow[k - GAS_SIDE] + flow[k + GAS_SIDE] - 4.0 * here;
        let v_across = 0.25 * (flow[k - 1u].y + here.y + flow[k + GAS_SIDE - 1u].y + flow[k + GAS_SIDE].y);
        let u_across = 0.25 * (flow[k - GAS_SIDE].x + here.x + flow[k - GAS_SIDE + 1u].x + flow[k + 1u].x);
        let spin = vec2f(vorticity[k], vorticity[k + GAS_SIDE]);
        let confined = vec2f(
            gas_confinement(
                spin,
                vec2f(vorticity[k - 1u], vorticity[k + GAS_SIDE - 1u]),
                vec2f(vorticity[k + 1u], vorticity[k + GAS_SIDE + 1u]),
            ),
            -gas_confinement(
                vec2f(spin.x, vorticity[k + 1u]),
                vec2f(vorticity[k - GAS_SIDE], vorticity[k - GAS_SIDE + 1u]),
                vec2f(spin.y, vorticity[k + GAS_SIDE + 1u]),
            ),
        );
        let scalars = limited[index].zw;
        let excess = scalars.x - row.density + limited[gas_index(cell - vec2i(0, 1))].z - north_row.density;
        let turned = here * row.turn_cosine + vec2f(v_across, -u_across) * row.turn_sine;
        let pull = vec2f(row.wind_pull * (row.wind - here.x), -row.calm_pull * here.y - 0.5 * gas.buoyancy * excess);
        let push = (pull + gas.viscosity * spread + confined) * open;
        let pushed = clamp(turned * open + push, vec2f(-gas.speed_limit), vec2f(gas.speed_limit));
        let gained = row.gas_pull * (vec2f(row.density, row.dye) - scalars);
        let next = scalars + gained;
        velocity[index] = pushed;
        carried[index] = vec4f(pushed, next);
        if !(gas_finite(here.x) && gas_finite(here.y) && gas_finite(push.x) && gas_finite(push.y) && gas_finite(next.x) && gas_finite(next.y)) {
            atomicStore(&activity[GAS_POISON], 1u);
        }
        let speed = gas.courant * max(abs(pushed), GAS_FORESIGHT * abs(push));
        let change = GAS_FORESIGHT * abs(gained);
        atomicMax(&fastest, bitcast<u32>(max(max(speed.x, speed.y), max(change.x, change.y))));
    }
    workgroupBarrier();
    if local_index == 0u {
        atomicStore(&activity[GAS_HEADER + u32(tile.y * gas.tiles.x + tile.x)], atomicLoad(&fastest));
    }
}
