// Normal mips: for each texel of a level the means of the normals and of the heights beneath it.
//
//   source  rgba16float  read   the level below: xyz mean of the unit normals, w mean height
//   normal  rgba16float  write  one level
//
// Means are not normalised: what a mean lacks to length 1 is how much the normals beneath it differ. A level's texel is the mean
// of all texels of the field beneath it: where the last child is wider or narrower than the others it weighs as much more or less.
//
// 8 bytes in and 2⅔ out a texel, 2⅔ of them read once more. Specification: src/reference/normal_mips.rs. Composed after
// common/region.wgsl.

struct NormalMipsParams {
    blocks: Blocks,     // of the level that is written
    source_size: vec2u,
    size: vec2u,
    last_weight: vec2f, // how wide and high the source's last texel is, in widths and heights of its others
}

override WORKGROUP_X: u32;
override WORKGROUP_Y: u32;

@group(1) @binding(0) var<storage, read> params: NormalMipsParams;
@group(1) @binding(1) var source: texture_2d<f32>;
@group(1) @binding(2) var normal: texture_storage_2d<rgba16float, write>;
@group(1) @binding(3) var<storage, read> block_list: array<u32>;

fn listed_block(index: u32) -> u32 {
    return block_list[index];
}

// The same parents as the pyramid's: two children an axis, and the last texel takes the remainder.
@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn average(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let texel = block_of(params.blocks, workgroup, workgroups) * vec2u(WORKGROUP_X, WORKGROUP_Y) + local.xy;
    if any(texel >= params.size) {
        return;
    }
    let first = 2u * texel;
    let end = select(first + 2u, params.source_size, texel == params.size - 1u);
    let last = params.source_size - 1u;
    var sum = vec4f(0.0);
    var weights = 0.0;
    for (var y = first.y; y < end.y; y++) {
        for (var x = first.x; x < end.x; x++) {
            let wide = select(vec2f(1.0), params.last_weight, vec2u(x, y) == last);
            let weight = wide.x * wide.y;
            sum += weight * textureLoad(source, vec2u(x, y), 0);
            weights += weight;
        }
    }
    textureStore(normal, texel, sum / weights);
}
