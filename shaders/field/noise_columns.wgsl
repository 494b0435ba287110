// Columns: pillars side by side, square or six-sided, whose tops rise and sink each by a phase of its own. Composed after
// field/noise.wgsl. Specification: src/reference/noise_columns.rs.

struct NoiseColumns {
    pitch: vec2f,         // metres from axis to axis, and from row to row
    origin: vec2f,        // where the axis of column 0 of row 0 stands, metres
    period: vec2i,        // columns and rows of the field, where it wraps; else 0
    turns: vec2f,         // phase from column to column and from row to row, turns
    phase: f32,           // of the time, turns
    disorder: f32,
    low: f32,
    high: f32,
    ground: f32,
    half_gap: f32,        // metres
    edge: f32,            // metres
    hexagons: u32,
}

@group(1) @binding(2) var<storage, read> columns: NoiseColumns;

fn pattern(texel: vec2f) -> f32 {
    let at = texel * params.texel_metres - columns.origin;
    // Hexagons stand in two lattices of rectangles, the odd rows half a pitch aside.
    let hexagons = columns.hexagons == 1u;
    let step = select(columns.pitch, vec2f(columns.pitch.x, 2.0 * columns.pitch.y), hexagons);
    let aside = vec2f(0.5 * columns.pitch.x, columns.pitch.y);
    let even = round(at / step);
    let odd = round((at - aside) / step);
    let from_even = at - even * step;
    let from_odd = at - aside - odd * step;
    let is_odd = hexagons && dot(from_odd, from_odd) < dot(from_even, from_even);
    let q = abs(select(from_even, from_odd, is_odd));
    var column = vec2i(select(even, odd, is_odd));
    column.y = select(column.y, 2 * column.y + select(0, 1, is_odd), hexagons);

    // To the nearest side: the middle between two axes.
    let slant = length(aside);
    let to_slant = 0.5 * slant - dot(q, aside) / slant;
    let to_side = 0.5 * step - q;
    let inside = min(min(to_side.x, to_side.y), select(to_side.y, to_slant, hexagons)) - columns.half_gap;

    // In a period the lower left of an odd row's columns are half a pitch farther along u.
    let along = vec2f(column) + vec2f(select(0.0, 0.5, is_odd), 0.0);
    let home = noise_home(column, columns.period);
    let turns = dot(columns.turns, along) + columns.disorder * noise_chance(home.x, noise_hash(bitcast<u32>(home.y) ^ params.salt)) + columns.phase;
    let top = mix(columns.low, columns.high, noise_pulse(turns));
    return mix(columns.ground, top, noise_edge(inside, columns.edge));
}
