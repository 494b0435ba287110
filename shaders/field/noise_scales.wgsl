// Scales: rows of rounded scales, each lying over the roots of the next, that lift and sink in waves. Composed after
// field/noise.wgsl. Specification: src/reference/noise_scales.rs.

struct NoiseScales {
    pitch: vec2f,         // metres from scale to scale, and from row to row
    origin: vec2f,        // centre of scale 0 of row 0, metres
    period: vec2i,        // scales of a row and rows of the field, where it wraps; else 0
    turns: vec2f,         // phase from scale to scale and from row to row, turns
    phase: f32,           // of the time, turns
    disorder: f32,
    radius: f32,          // metres
    edge: f32,            // metres
    lift: f32,
    keel: f32,
}

@group(1) @binding(2) var<storage, read> scales: NoiseScales;

fn pattern(texel: vec2f) -> f32 {
    let at = texel * params.texel_metres - scales.origin;
    let first_row = i32(floor(at.y / scales.pitch.y)) - 1;
    var highest = 0.0;
    for (var row = first_row; row < first_row + 4; row++) {
        let aside = select(0.0, 0.5, (row & 1) != 0);
        let first = vec2i(i32(floor(at.x / scales.pitch.x - aside)), row);
        let low = noise_home(first, scales.period);
        let high = noise_home(first + vec2i(1, 0), scales.period);
        let row_hash = noise_hash(bitcast<u32>(low.y) ^ params.salt);
        let along = vec2f(first) + vec2f(aside, 0.0);
        let left = scale_height(at - along * scales.pitch, along, noise_chance(low.x, row_hash));
        let next = along + vec2f(1.0, 0.0);
        let right = scale_height(at - next * scales.pitch, next, noise_chance(high.x, row_hash));
        highest = max(highest, max(left, right));
    }
    return highest;
}

// The height of one scale at an offset from its centre: it rises to its free edge, toward larger v.
fn scale_height(offset: vec2f, along: vec2f, chance: f32) -> f32 {
    let turns = dot(scales.turns, along) + scales.disorder * chance + scales.phase;
    let d = offset / scales.radius;
    let rise = 0.5 * (d.y + 1.0) * (1.0 - scales.lift * noise_pulse(turns));
    let ridge = 1.0 - noise_edge(abs(d.x), 0.22);
    let domed = (1.0 - 0.35 * d.x * d.x) * (1.0 - 0.25 * scales.keel * (1.0 - ridge));
    return rise * domed * noise_edge((1.0 - length(d)) * scales.radius, scales.edge);
}
