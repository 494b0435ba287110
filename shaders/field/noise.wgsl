// Noise: procedural heights, each a closed form of place, seed and time. Nothing is read, so no frame needs the one before it.
//
//   noise  r32float  write  height of the pattern, 0 to 1
//
// 0 bytes in, 4 out a texel. A pattern is a part of its own (field/noise_…), which defines `fn pattern(texel: vec2f) -> f32`.
// Time reaches it as phases and cells that Rust reduced in f64: f32 is as fine after a year as at the start.
// Composed after common/noise.wgsl. Specification: src/reference/noise.rs.

override NOISE_X: u32;
override NOISE_Y: u32;

struct NoiseParams {
    size: vec2u,          // of the field, texels
    texel_metres: f32,
    count: u32,           // of what the pattern has several of: octaves, wheels
    salt: u32,            // the seed
    wrap: u32,            // 1 where the field wraps, 0 where it clamps
    field_metres: vec2f,
}

// A lattice of gradient noise over the field, and the slice of time.
struct NoiseLattice {
    scale: vec2f,         // cells a texel
    fraction: vec2f,      // where in its cell the field's upper left corner lies
    cell: vec2i,          // which cell that is
    period: vec2i,        // cells after which the lattice repeats; 0: never
    slice: u32,           // the cell of time
    slice_fraction: f32,  // where in it
    weight: f32,
    salt: u32,
}

@group(1) @binding(0) var<storage, read> params: NoiseParams;
@group(1) @binding(1) var heights: texture_storage_2d<r32float, write>;

@compute @workgroup_size(NOISE_X, NOISE_Y)
fn noise(@builtin(global_invocation_id) id: vec3u) {
    if all(id.xy < params.size) {
        // Texel centres lie at halves.
        textureStore(heights, id.xy, vec4f(pattern(vec2f(id.xy) + 0.5), 0.0, 0.0, 0.0));
    }
}

fn noise_address(cell: vec2i, period: vec2i) -> vec2i {
    // Where the lattice repeats, cells are counted from 0: no remainder is negative.
    return select(cell, cell % max(period, vec2i(1)), period > vec2i(0));
}

fn noise_fade(t: vec2f) -> vec2f {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

// How much a lattice point adds at an offset from it: its gradient is one of the twelve edges of a cube (Perlin 2002).
fn noise_corner(hash: u32, offset: vec3f) -> f32 {
    let edge = ((hash >> 16u) * 12u) >> 16u;
    let axes = edge >> 2u;
    let a = select(select(offset.x, offset.y, axes == 1u), offset.z, axes == 2u);
    let b = select(select(offset.y, offset.z, axes == 1u), offset.x, axes == 2u);
    return select(-a, a, (edge & 1u) == 0u) + select(-b, b, (edge & 2u) == 0u);
}

// The four lattice points of a slice, `z` away from it.
fn noise_slice(low: vec2i, high: vec2i, f: vec2f, fade: vec2f, z: f32, salt: u32) -> f32 {
    let seed = hash_u32(salt);
    let north = hash_u32(bitcast<u32>(low.y) ^ seed);
    let south = hash_u32(bitcast<u32>(high.y) ^ seed);
    let nw = noise_corner(hash_u32(bitcast<u32>(low.x) ^ north), vec3f(f, z));
    let ne = noise_corner(hash_u32(bitcast<u32>(high.x) ^ north), vec3f(f.x - 1.0, f.y, z));
    let sw = noise_corner(hash_u32(bitcast<u32>(low.x) ^ south), vec3f(f.x, f.y - 1.0, z));
    let se = noise_corner(hash_u32(bitcast<u32>(high.x) ^ south), vec3f(f - 1.0, z));
    return mix(mix(nw, ne, fade.x), mix(sw, se, fade.x), fade.y);
}

// Gradient noise that changes in time, −1.04 to 1.04.
fn noise_moving(lattice: NoiseLattice, texel: vec2f) -> f32 {
    let position = texel * lattice.scale + lattice.fraction;
    let cell = floor(position);
    let f = position - cell;
    let low = noise_address(vec2i(cell) + lattice.cell, lattice.period);
    let high = noise_address(vec2i(cell) + lattice.cell + 1, lattice.period);
    let fade = noise_fade(f);
    let z = lattice.slice_fraction;
    let before = noise_slice(low, high, f, fade, z, lattice.slice ^ lattice.salt);
    let after = noise_slice(low, high, f, fade, z - 1.0, (lattice.slice + 1u) ^ lattice.salt);
    return mix(before, after, noise_fade(vec2f(z)).x);
}

// A slice of it that stays, −1 to 1.
fn noise_still(lattice: NoiseLattice, texel: vec2f) -> f32 {
    let position = texel * lattice.scale + lattice.fraction;
    let cell = floor(position);
    let f = position - cell;
    let low = noise_address(vec2i(cell) + lattice.cell, lattice.period);
    let high = noise_address(vec2i(cell) + lattice.cell + 1, lattice.period);
    return noise_slice(low, high, f, noise_fade(f), 0.0, lattice.slice ^ lattice.salt);
}

// A smooth pulse of a phase in turns: 1 at whole turns, 0 at halves.
fn noise_pulse(turns: f32) -> f32 {
    let apart = abs(2.0 * fract(turns) - 1.0);
    return apart * apart * (3.0 - 2.0 * apart);
}

// 0 outside, 1 deeper inside than the edge is wide.
fn noise_edge(inside: f32, width: f32) -> f32 {
    let t = clamp(inside / width, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
