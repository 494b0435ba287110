// Compose: relief and waves become the height field, clamped to [0, 1].
//
//   relief   r32float  read    base height with every stamp pressed into it, unclamped
//   wave     r32float  read    displacement in units of the amplitude; not read where the amplitude is 0
//   height   r32float  write   the height field: 1 = reference surface, 0 = deepest
//   clipped  u32       write   texels of each tile that were out of range
//
// 4 or 8 bytes in, 4 out a texel. Specification: src/reference/compose.rs. Composed after common/region.wgsl.

struct ComposeParams {
    blocks: Blocks,     // its tiles
    amplitude: f32,     // height that a wave of displacement 1 adds
    tiles_per_row: u32,
    size: vec2u,        // of the field, texels
}

override TILE: u32;

@group(1) @binding(0) var<storage, read> params: ComposeParams;
@group(1) @binding(1) var relief: texture_2d<f32>;
@group(1) @binding(2) var wave: texture_2d<f32>;
@group(1) @binding(3) var height: texture_storage_2d<r32float, write>;
@group(1) @binding(4) var<storage, read_write> clipped: array<u32>;
@group(1) @binding(5) var<storage, read> block_list: array<u32>;

fn listed_block(index: u32) -> u32 {
    return block_list[index];
}

var<workgroup> clipped_here: atomic<u32>;

// The value clamped to [0, 1]: NaN becomes 0 and ±Inf the bound that it exceeds. Decided on the bits, since compilers may assume
// that a float is neither.
fn into_range(value: f32) -> f32 {
    let bits = bitcast<u32>(value);
    let magnitude = bits & 0x7fffffffu;
    let negative = (bits >> 31u) == 1u;
    // Above 0x7f800000 lie the NaNs; below 0 everything negative, −0 too, so that the field holds no −0.
    if magnitude > 0x7f800000u || negative {
        return 0.0;
    }
    // Positive floats are ordered like their bits: 0x3f800000 is 1.
    return select(value, 1.0, bits > 0x3f800000u);
}

// Whether the value was out of range; −0 counts as 0.
fn out_of_range(value: f32) -> bool {
    let bits = bitcast<u32>(value);
    return bits > 0x3f800000u && bits != 0x80000000u;
}

@compute @workgroup_size(TILE, TILE)
fn compose(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) local_index: u32,
) {
    let tile = block_of(params.blocks, workgroup, workgroups);
    let texel = tile * TILE + local.xy;
    if all(texel < params.size) {
        var value = textureLoad(relief, texel, 0).r;
        if params.amplitude != 0.0 {
            value += params.amplitude * textureLoad(wave, texel, 0).r;
        }
        textureStore(height, texel, vec4f(into_range(value), 0.0, 0.0, 0.0));
        if out_of_range(value) {
            atomicAdd(&clipped_here, 1u);
        }
    }
    workgroupBarrier();
    if local_index == 0u && all(tile * TILE < params.size) {
        clipped[tile.y * params.tiles_per_row + tile.x] = atomicLoad(&clipped_here);
    }
}
