// Noise: procedural heights, each a closed form of place, seed and time. Nothing is read, so no frame needs the one before it.
//
//   noise  r32float  write  height of the pattern, 0 to 1
//
// 0 bytes in, 4 out a texel. A pattern is a part of its own (field/noise_…), which defines `fn pattern(texel: vec2f) -> f32`.
// Time reaches it as phases and cells that Rust reduced in f64: f32 is as fine after a year as at the start.
// Specification: src/reference/noise.rs.

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
    slices: vec2u,        // hashes of the slices of time before and after
    slice_fraction: f32,  // from the first of them
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

// The same thing of a lattice that repeats, counted from 0; `period` 0: it never does. For indices at most a period outside: an
// integer remainder is worked out lane by lane on lavapipe, and took a third of the time of fractal noise, two of that of scales.
fn noise_home(index: vec2i, period: vec2i) -> vec2i {
    let low = select(index, index + period, index < vec2i(0));
    return select(index, select(low, low - period, low >= period), period > vec2i(0));
}

fn noise_fade(t: vec2f) -> vec2f {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

// C. Wellons' lowbias32 (hash-prospector, 2018). PCG's output function, which other noise here has, shifts each lane by another
// count: lavapipe does that one lane at a time.
fn noise_hash(x: u32) -> u32 {
    var h = (x ^ (x >> 16u)) * 0x7feb352du;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return h ^ (h >> 16u);
}

// A number in [0, 1) for a column of things, given the hash of its row.
fn noise_chance(column: i32, row_hash: u32) -> f32 {
    return f32(noise_hash(bitcast<u32>(column) ^ row_hash) >> 8u) / 16777216.0;
}

// How much a lattice point adds at an offset from it: its gradient is one of the twelve edges of a cube (Perlin 2002), of which the
// four along the slice count twice.
fn noise_corner(point: u32, slice: u32, offset: vec3f) -> f32 {
    let edge = ((point ^ slice) * 0x9e3779b1u) >> 28u;
    let axes = edge & 12u;
    let a = select(select(offset.x, offset.y, axes == 4u), offset.z, axes == 8u);
    let b = select(select(offset.y, offset.z, axes == 4u), offset.x, axes == 8u);
    return select(-a, a, (edge & 1u) == 0u) + select(-b, b, (edge & 2u) == 0u);
}

// Where a texel lies on a lattice.
struct NoisePlace {
    points: vec4u,        // hashes of the four lattice points about it: nw, ne, sw, se
    f: vec2f,             // from the first of them, cells
    fade: vec2f,
}

fn noise_place(lattice: NoiseLattice, texel: vec2f) -> NoisePlace {
    let position = texel * lattice.scale + lattice.fraction;
    let cell = floor(position);
    let low = noise_home(vec2i(cell) + lattice.cell, lattice.period);
    let high = noise_home(low + 1, lattice.period);
    let north = noise_hash(bitcast<u32>(low.y) ^ lattice.salt);
    let south = noise_hash(bitcast<u32>(high.y) ^ lattice.salt);
    let points = vec4u(
        noise_hash(bitcast<u32>(low.x) ^ north),
        noise_hash(bitcast<u32>(high.x) ^ north),
        noise_hash(bitcast<u32>(low.x) ^ south),
        noise_hash(bitcast<u32>(high.x) ^ south),
    );
    let f = position - cell;
    return NoisePlace(points, f, noise_fade(f));
}

// What its four lattice points of one slice add, `z` away from that.
fn noise_slice(place: NoisePlace, slice: u32, z: f32) -> f32 {
    let f = place.f;
    let nw = noise_corner(place.points.x, slice, vec3f(f, z));
    let ne = noise_corner(place.points.y, slice, vec3f(f.x - 1.0, f.y, z));
    let sw = noise_corner(place.points.z, slice, vec3f(f.x, f.y - 1.0, z));
    let se = noise_corner(place.points.w, slice, vec3f(f - 1.0, z));
    return mix(mix(nw, ne, place.fade.x), mix(sw, se, place.fade.x), place.fade.y);
}

// Gradient noise that changes in time, −1.04 to 1.04.
fn noise_moving(lattice: NoiseLattice, texel: vec2f) -> f32 {
    let place = noise_place(lattice, texel);
    let z = lattice.slice_fraction;
    let before = noise_slice(place, lattice.slices.x, z);
    let after = noise_slice(place, lattice.slices.y, z - 1.0);
    return mix(before, after, noise_fade(vec2f(z)).x);
}

// A slice of it that stays, −1 to 1.
fn noise_still(lattice: NoiseLattice, texel: vec2f) -> f32 {
    return noise_slice(noise_place(lattice, texel), lattice.slices.x, 0.0);
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
