// Bounds: between which heights the bilinear surface lies over ever larger nodes, all levels in one texture.
//
//   height  r32float  read        texel centres
//   bounds  r32float  read_write  a range of heights: see common/range.wgsl
//
// 9 bytes in and 1½ out a texel, ½ of them read once more. Specification: src/reference/bounds.rs. Composed after common/region.wgsl
// and common/range.wgsl.

struct BoundsParams {
    blocks: Blocks,        // of the level that is written
    source_size: vec2u,    // of the field, or of the level below
    source_origin: vec2u,  // where that lies
    size: vec2u,
    origin: vec2u,
    wrap: u32,             // 1 where the field wraps, 0 where it clamps
}

override WORKGROUP_X: u32;
override WORKGROUP_Y: u32;

@group(1) @binding(0) var<storage, read> params: BoundsParams;
@group(1) @binding(1) var height: texture_2d<f32>;
@group(1) @binding(2) var bounds: texture_storage_2d<r32float, read_write>;
@group(1) @binding(3) var<storage, read> block_list: array<u32>;

fn listed_block(index: u32) -> u32 {
    return block_list[index];
}

// The texel of an axis that a lattice line up to the field's size means.
fn line(at: u32, size: u32) -> u32 {
    let beyond = select(size - 1u, 0u, params.wrap == 1u);
    return select(at, beyond, at >= size);
}

// Level 1: the corners of up to two cells an axis. The last cell's far side is the line after the last texel.
@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn bound_cells(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let node = block_of(params.blocks, workgroup, workgroups) * vec2u(WORKGROUP_X, WORKGROUP_Y) + local.xy;
    if any(node >= params.size) {
        return;
    }
    var range = Range(1.0, 0.0);
    for (var y = 0u; y < 3u; y++) {
        for (var x = 0u; x < 3u; x++) {
            let at = min(2u * node + vec2u(x, y), params.source_size);
            let z = textureLoad(height, vec2u(line(at.x, params.source_size.x), line(at.y, params.source_size.y)), 0).r;
            range = Range(min(range.low, z), max(range.high, z));
        }
    }
    textureStore(bounds, params.origin + node, vec4f(range_packed(range), 0.0, 0.0, 0.0));
}

// Upper levels: up to two children an axis. Their ends are steps already: unpacked and packed again they would creep.
@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn bound_nodes(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let node = block_of(params.blocks, workgroup, workgroups) * vec2u(WORKGROUP_X, WORKGROUP_Y) + local.xy;
    if any(node >= params.size) {
        return;
    }
    var low = LOW_STEPS;
    var high = 0u;
    for (var y = 0u; y < 2u; y++) {
        for (var x = 0u; x < 2u; x++) {
            let child = min(2u * node + vec2u(x, y), params.source_size - 1u);
            let packed = u32(textureLoad(bounds, params.source_origin + child).r);
            low = min(low, packed % (LOW_STEPS + 1u));
            high = max(high, packed / (LOW_STEPS + 1u));
        }
    }
    textureStore(bounds, params.origin + node, vec4f(f32(high * (LOW_STEPS + 1u) + low), 0.0, 0.0, 0.0));
}
