// Hashes and value noise for procedural materials. The hash is PCG's output function (O'Neill 2014) over a mixed coordinate; its
// Rust twin in src/field/base/noise.rs gives the same bits, so that colours can follow heights.

fn hash_u32(x: u32) -> u32 {
    let state = x * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// A number in [0, 1) for a lattice point and a salt.
fn hash_cell(cell: vec2i, salt: u32) -> f32 {
    let mixed = hash_u32(bitcast<u32>(cell.x) ^ hash_u32(bitcast<u32>(cell.y) ^ hash_u32(salt)));
    return f32(mixed >> 8u) / 16777216.0;
}

// Value noise in [0, 1), smooth, with features of size 1.
fn value_noise(position: vec2f, salt: u32) -> f32 {
    let cell = floor(position);
    let i = vec2i(cell);
    let f = position - cell;
    let s = f * f * (3.0 - 2.0 * f);
    let low = mix(hash_cell(i, salt), hash_cell(i + vec2i(1, 0), salt), s.x);
    let high = mix(hash_cell(i + vec2i(0, 1), salt), hash_cell(i + vec2i(1, 1), salt), s.x);
    return mix(low, high, s.y);
}

// Four octaves of it, in [0, 1).
fn fractal_noise(position: vec2f, salt: u32) -> f32 {
    var sum = 0.0;
    var weight = 0.5;
    var p = position;
    for (var octave = 0u; octave < 4u; octave++) {
        sum += weight * value_noise(p, salt + octave);
        p = 2.0 * p + 17.3;
        weight *= 0.5;
    }
    return sum / 0.9375;
}
