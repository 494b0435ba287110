// Gas, projection: the sweeps that smooth a level, over a tile with what surrounds it, in workgroup memory.
//
// Two weighted Jacobi sweeps on the way down, three on the way up; each takes a cell of the surroundings, that none is missing in the
// tile. Composed into field/gas_project, whose level and borders it reads. Specification: src/reference/gas_project.rs.

override GAS_BEFORE_0: f32;
override GAS_BEFORE_1: f32;
override GAS_AFTER_0: f32;
override GAS_AFTER_1: f32;
override GAS_AFTER_2: f32;

// A tile with what surrounds it: three cells before and five after it on the way down, four and four on the way up.
const GAS_SIDE: u32 = 24u;
const GAS_AREA: u32 = 576u;
const GAS_DOWN: i32 = 3;
const GAS_UP: i32 = 4;
var<workgroup> one: array<f32, GAS_AREA>;
var<workgroup> other: array<f32, GAS_AREA>;
var<workgroup> source: array<f32, GAS_AREA>;

// The column and row of a place in the tile's surroundings. lavapipe divides integers lane by lane; floats are exact here.
fn surrounding(k: u32) -> vec2u {
    let row = u32((f32(k) + 0.5) * (1.0 / f32(GAS_SIDE)));
    return vec2u(k - row * GAS_SIDE, row);
}

// A cell of the tile's surroundings.
fn project_cell(origin: vec2i, k: u32) -> vec2i {
    return origin + vec2i(surrounding(k));
}

// Whether a place is at least so many from the low and from the high border of the tile's surroundings.
fn within(k: u32, low: u32, high: u32) -> bool {
    let at = surrounding(k);
    return all(at >= vec2u(low)) && all(at < vec2u(GAS_SIDE - high));
}

// What a cell exchanges with its neighbours in the west, east, north and south. An axis of one cell has none.
fn exchanges(cell: vec2i) -> vec4f {
    let several = select(vec2f(0.0), level.exchange, level.size > vec2i(1));
    let low = project_open(cell) * several;
    let high = project_open(cell + 1) * several;
    return vec4f(low.x, high.x, low.y, high.y);
}

// L p − b of `one`, and of `other`.
fn excess_of_one(k: u32, by: vec4f) -> f32 {
    let here = one[k];
    return by.x * (one[k - 1u] - here) + by.y * (one[k + 1u] - here) + by.z * (one[k - GAS_SIDE] - here)
        + by.w * (one[k + GAS_SIDE] - here) - source[k];
}

fn excess_of_other(k: u32, by: vec4f) -> f32 {
    let here = other[k];
    return by.x * (other[k - 1u] - here) + by.y * (other[k + 1u] - here) + by.z * (other[k - GAS_SIDE] - here)
        + by.w * (other[k + GAS_SIDE] - here) - source[k];
}

// A Jacobi sweep's weight over the sum of the exchanges.
fn sweep_factor(weight: f32, by: vec4f) -> f32 {
    let diagonal = by.x + by.y + by.z + by.w;
    return select(0.0, weight / max(diagonal, 1e-30), diagonal > 0.0);
}

fn sweep_one_into_other(local_index: u32, origin: vec2i, low: u32, high: u32, weight: f32) {
    for (var k = local_index; k < GAS_AREA; k += GAS_TILE * GAS_TILE) {
        if within(k, low, high) {
            let by = exchanges(project_cell(origin, k));
            other[k] = one[k] + sweep_factor(weight, by) * excess_of_one(k, by);
        }
    }
    workgroupBarrier();
}

fn sweep_other_into_one(local_index: u32, origin: vec2i, low: u32, high: u32, weight: f32) {
    for (var k = local_index; k < GAS_AREA; k += GAS_TILE * GAS_TILE) {
        if within(k, low, high) {
            let by = exchanges(project_cell(origin, k));
            one[k] = other[k] + sweep_factor(weight, by) * excess_of_other(k, by);
        }
    }
    workgroupBarrier();
}

// Both sweeps of the way down, from p = 0: leaves p in `other` and b − L p in `one`, over all that a coarse cell may sum.
fn descend(local_index: u32, origin: vec2i) {
    for (var k = local_index; k < GAS_AREA; k += GAS_TILE * GAS_TILE) {
        one[k] = -sweep_factor(GAS_BEFORE_0, exchanges(project_cell(origin, k))) * source[k];
    }
    workgroupBarrier();
    sweep_one_into_other(local_index, origin, 1u, 1u, GAS_BEFORE_1);
    for (var k = local_index; k < GAS_AREA; k += GAS_TILE * GAS_TILE) {
        if within(k, 2u, 2u) {
            one[k] = -excess_of_other(k, exchanges(project_cell(origin, k)));
        }
    }
    workgroupBarrier();
}

// The sweeps of the way up: leave p in `other`.
fn ascend(local_index: u32, origin: vec2i) {
    sweep_one_into_other(local_index, origin, 1u, 1u, GAS_AFTER_0);
    sweep_other_into_one(local_index, origin, 2u, 2u, GAS_AFTER_1);
    sweep_one_into_other(local_index, origin, 3u, 3u, GAS_AFTER_2);
}
