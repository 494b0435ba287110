// Normals: the slope of the height field, by a 3×3 Sobel gradient.
//
//   height  r32float     read    1 = reference surface, 0 = deepest; texel centres
//   normal  rgba16float  write   level 0: xyz = unit normal in field space (u right, v down, out), w = height
//
// 4 bytes in, 8 out a texel, the halo apart. Specification: src/reference/normals.rs. Composed after common/region.wgsl.

struct NormalsParams {
    blocks: Blocks,
    slope_per_height: vec2f, // depth over the texel's width and height
    size: vec2u,             // of the field, texels
}

override WORKGROUP_X: u32;
override WORKGROUP_Y: u32;

@group(1) @binding(0) var<storage, read> params: NormalsParams;
@group(1) @binding(1) var height: texture_2d<f32>;
@group(1) @binding(2) var normal: texture_storage_2d<rgba16float, write>;
@group(1) @binding(3) var<storage, read> block_list: array<u32>;
@group(1) @binding(4) var nearest: sampler;

fn listed_block(index: u32) -> u32 {
    return block_list[index];
}

// The four texels that meet at a texel's upper left corner, (x−1, y), (x, y), (x, y−1), (x−1, y−1): what the sampler does beyond the
// border is the field's addressing. With four gathers in place of nine loads 1024² take lavapipe 9.7 ms in place of 12.
fn corners_at(texel: vec2u) -> vec4f {
    return textureGather(0, height, nearest, vec2f(texel) / vec2f(params.size));
}

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn normals(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let texel = block_of(params.blocks, workgroup, workgroups) * vec2u(WORKGROUP_X, WORKGROUP_Y) + local.xy;
    if any(texel >= params.size) {
        return;
    }
    let north_west = corners_at(texel);
    let north_east = corners_at(texel + vec2u(1u, 0u));
    let south_west = corners_at(texel + vec2u(0u, 1u));
    let south_east = corners_at(texel + 1u);
    let nw = north_west.w;
    let n = north_west.z;
    let ne = north_east.z;
    let w = north_west.x;
    let e = north_east.y;
    let sw = south_west.x;
    let s = south_west.y;
    let se = south_east.y;
    let slope = vec2f((ne - nw) + 2.0 * (e - w) + (se - sw), (sw - nw) + 2.0 * (s - n) + (se - ne)) / 8.0;
    let leaning = vec3f(-slope * params.slope_per_height, 1.0);
    textureStore(normal, texel, vec4f(normalize(leaning), north_west.y));
}
