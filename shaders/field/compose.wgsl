// Compose: what lies beneath and the layers over it become one height, clamped to [0, 1] at the top of the stack.
//
//   beneath  r32float  read    relief, or the bed of the water below: unclamped
//   layer_i  r32float  read    the value of a layer, LAYERS of them from the ground up
//   composed r32float  write   the height field, 1 = reference surface, 0 = deepest; or, below the top, a bed, unclamped
//   clipped  u32       write   texels of each tile that were out of range, at the top
//
// 4 bytes and 4 more a layer in, 4 out a texel. Specification: src/reference/compose.rs. Composed after common/region.wgsl.

struct ComposeParams {
    blocks: Blocks,     // its tiles
    size: vec2u,        // of the field, texels
    tiles_per_row: u32,
    layers: array<ComposeLayer, 4>,
}

struct ComposeLayer {
    amplitude: f32,
    blend: u32,         // COMPOSE_ADD and so on
}

override TILE: u32;
override LAYERS: u32;
override AT_TOP: bool;

// The blends: a test compares them with Rust's.
const COMPOSE_ADD: u32 = 0u;
const COMPOSE_MULTIPLY: u32 = 1u;
const COMPOSE_MIN: u32 = 2u;
const COMPOSE_MAX: u32 = 3u;
const COMPOSE_REPLACE: u32 = 4u;

@group(1) @binding(0) var<storage, read> params: ComposeParams;
@group(1) @binding(1) var beneath: texture_2d<f32>;
@group(1) @binding(2) var layer_0: texture_2d<f32>;
@group(1) @binding(3) var layer_1: texture_2d<f32>;
@group(1) @binding(4) var layer_2: texture_2d<f32>;
@group(1) @binding(5) var layer_3: texture_2d<f32>;
@group(1) @binding(6) var composed: texture_storage_2d<r32float, write>;
@group(1) @binding(7) var<storage, read_write> clipped: array<u32>;
@group(1) @binding(8) var<storage, read> block_list: array<u32>;

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

fn compose_blend(layer: ComposeLayer, below: f32, value: f32) -> f32 {
    switch layer.blend {
        case COMPOSE_ADD: { return below + layer.amplitude * value; }
        case COMPOSE_MULTIPLY: { return below * (1.0 + layer.amplitude * (value - 1.0)); }
        case COMPOSE_MIN: { return min(below, layer.amplitude * value); }
        case COMPOSE_MAX: { return max(below, layer.amplitude * value); }
        // To the bit what lies beneath where the amplitude is 0, and the layer alone where it is 1.
        default: { return below * (1.0 - layer.amplitude) + layer.amplitude * value; }
    }
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
        var value = textureLoad(beneath, texel, 0).r;
        if LAYERS > 0u {
            value = compose_blend(params.layers[0], value, textureLoad(layer_0, texel, 0).r);
        }
        if LAYERS > 1u {
            value = compose_blend(params.layers[1], value, textureLoad(layer_1, texel, 0).r);
        }
        if LAYERS > 2u {
            value = compose_blend(params.layers[2], value, textureLoad(layer_2, texel, 0).r);
        }
        if LAYERS > 3u {
            value = compose_blend(params.layers[3], value, textureLoad(layer_3, texel, 0).r);
        }
        if AT_TOP {
            textureStore(composed, texel, vec4f(into_range(value), 0.0, 0.0, 0.0));
            if out_of_range(value) {
                atomicAdd(&clipped_here, 1u);
            }
        } else {
            textureStore(composed, texel, vec4f(value, 0.0, 0.0, 0.0));
        }
    }
    if AT_TOP {
        workgroupBarrier();
        if local_index == 0u && all(tile * TILE < params.size) {
            clipped[tile.y * params.tiles_per_row + tile.x] = atomicLoad(&clipped_here);
        }
    }
}
