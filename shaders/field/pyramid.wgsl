// Pyramid: upper bounds of the bilinear surface over ever larger nodes.
//
//   source  r32float  read    level 0: the heights; above: the level below
//   bounds  r32float  write   one level: the maximum over each node
//
// 4 bytes in and 5⅓ out a texel, 1⅓ of them read once more. Specification: src/reference/pyramid.rs. Composed after
// common/region.wgsl.

struct PyramidParams {
    region: Region,      // nodes of the level that is written
    source_size: vec2u,
    size: vec2u,
    wrap: u32,           // 1 where the field wraps, 0 where it clamps
}

override WORKGROUP_X: u32;
override WORKGROUP_Y: u32;

@group(1) @binding(0) var<storage, read> params: PyramidParams;
@group(1) @binding(1) var source: texture_2d<f32>;
@group(1) @binding(2) var bounds: texture_storage_2d<r32float, write>;

fn load(x: u32, y: u32) -> f32 {
    return textureLoad(source, vec2u(x, y), 0).r;
}

// Level 0: a cell's bound is the maximum of its four corners.
@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn bound_cells(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= params.region.extent) {
        return;
    }
    let low = params.region.origin + id.xy;
    let last = params.size - 1u;
    let beyond = select(last, vec2u(0u), params.wrap == 1u);
    let high = select(low + 1u, beyond, low == last);
    let bound = max(max(load(low.x, low.y), load(high.x, low.y)), max(load(low.x, high.y), load(high.x, high.y)));
    textureStore(bounds, low, vec4f(bound, 0.0, 0.0, 0.0));
}

// Upper levels: the maximum over the children, two an axis; the last node takes the remainder, one or three.
@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn bound_parents(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= params.region.extent) {
        return;
    }
    let node = params.region.origin + id.xy;
    let first = 2u * node;
    let end = select(first + 2u, params.source_size, node == params.size - 1u);
    var bound = load(first.x, first.y);
    for (var y = first.y; y < end.y; y++) {
        for (var x = first.x; x < end.x; x++) {
            bound = max(bound, load(x, y));
        }
    }
    textureStore(bounds, node, vec4f(bound, 0.0, 0.0, 0.0));
}
