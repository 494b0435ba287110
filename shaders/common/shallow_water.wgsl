// Shallow water: what its kernels share. Depths and levels are metres, velocities m/s, lengths on the lattice texels.

override SHALLOW_WATER_TILE: u32;      // side of a workgroup that takes a texel an invocation
override SHALLOW_WATER_SPAN: u32;      // invocations of a workgroup that takes a substep, and texels of its tile along the first direction
override SHALLOW_WATER_HALO: u32;      // texels that a tile sees beyond its own: the half step takes one, the slopes of what it gives two
override SHALLOW_WATER_WALL: u32;      // the borders' numbers
override SHALLOW_WATER_OPEN: u32;
override SHALLOW_WATER_SEA: u32;
override SHALLOW_WATER_PERIODIC: u32;

// Heights beyond which, up or down, a bed is a wall that no water climbs: so are NaN and Inf.
const SHALLOW_WATER_BED_MAX: f32 = 1e4;

struct ShallowWaterParams {
    size: vec2u,
    texel_metres: f32,
    depth_metres: f32,         // of height 0 below the reference surface
    borders: vec4u,            // west, east, north, south
    gravity: f32,              // m/s²
    friction: f32,             // gravity times the square of Manning's n
    dry_metres: f32,           // under this depth a velocity is no quotient any more
    speed_cap: f32,            // m/s, of each component
    courant: f32,              // share of a texel that the fastest wave may cross in a step
    rain: f32,                 // m/s
    seepage: f32,              // m/s
    sea_metres: f32,           // level of the sea beyond its borders
    foam_gain: f32,            // 1/s, where it breaks
    foam_loss: f32,            // 1/s
}

// What the kernels tell one another, and the CPU later.
struct ShallowWaterControl {
    speed: atomic<u32>,        // bits of the fastest wave's speed, m/s: the order of positive floats is that of their bits
    fault: atomic<u32>,        // not 0 once a number came out that is none
    remaining: f32,            // of the step, seconds
    dt: f32,                   // of the substep, seconds
    behind: f32,               // time given up so far, seconds
    rise: f32,                 // of the sea by its swell, metres, in the substep
    substeps: u32,             // done so far
    current: u32,              // which of the two states is the present one
    pending: u32,              // whether a substep was begun whose result is not judged yet
    halted: u32,               // whether it stopped for good: the present state is the last good one
}

fn shallow_water_is_number(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}

// A bed's height in metres.
fn shallow_water_bed_metres(height: f32, depth_metres: f32) -> f32 {
    let known = shallow_water_is_number(height) && abs(height) <= SHALLOW_WATER_BED_MAX;
    return depth_metres * select(SHALLOW_WATER_BED_MAX, height, known);
}

// flow / depth, which for thin films is 0/0 ([KP] eq. 2.17).
fn shallow_water_velocity(flow: vec2f, depth: f32, dry: f32, cap: f32) -> vec2f {
    let squared = depth * depth;
    return clamp(2.0 * depth / (squared + max(squared, dry * dry)) * flow, vec2f(-cap), vec2f(cap));
}
