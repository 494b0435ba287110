// Pyramid: upper bounds of the bilinear surface over ever larger nodes.
//
//   source  r32float  read    level 0: the heights; above: the level below
//   bounds  r32float  write   one level: the maximum over each node
//
// 4 bytes in and 5⅓ out a texel, 1⅓ of them read once more. Specification: src/reference/pyramid.rs. Composed after
// common/region.wgsl.

struct PyramidParams {
    blocks: Blocks,      // of the level that is written
    source_size: vec2u,
    size: vec2u,
    wrap: u32,           // 1 where the field wraps, 0 where it clamps
}

override WORKGROUP_X: u32;
override WORKGROUP_Y: u32;

@group(1) @binding(0) var<storage, read> params: PyramidParams;
@group(1) @binding(1) var source: texture_2d<f32>;
@group(1) @binding(2) var bounds: texture_storage_2d<r32float, write>;
@group(1) @binding(3) var<storage, read> block_list: array<u32>;

fn listed_block(index: u32) -> u32 {
    return block_list[index];
}

fn load(x: u32, y: u32) -> f32 {
    return textureLoad(source, vec2u(x, y), 0).r;
}

// Level 0: a cell's bound is the maximum of its four corners.
@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn bound_cells(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let low = block_of(params.blocks, workgroup, workgroups) * vec2u(WORKGROUP_X, WORKGROUP_Y) + local.xy;
    if any(low >= params.size) {
        return;
    }
    let last = params.size - 1u;
    let beyond = select(last, vec2u(0u), params.wrap == 1u);
    let high = select(low + 1u, beyond, low == last);
    let bound = max(max(load(low.x, low.y), load(high.x, low.y)), max(load(low.x, high.y), load(high.x, high.y)));
    textureStore(bounds, low, vec4f(bound, 0.0, 0.0, 0.0));
}

// Upper levels: the maximum over the children, two an axis; the last node takes the remainder, one or three.
@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn bound_parents(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let node = block_of(params.blocks, workgroup, workgroups) * vec2u(WORKGROUP_X, WORKGROUP_Y) + local.xy;
    if any(node >= params.size) {
        return;
    }
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
