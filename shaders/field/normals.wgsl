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
    wrap: u32,               // 1 where the field wraps, 0 where it clamps
}

override WORKGROUP_X: u32;
override WORKGROUP_Y: u32;

@group(1) @binding(0) var<storage, read> params: NormalsParams;
@group(1) @binding(1) var height: texture_2d<f32>;
@group(1) @binding(2) var normal: texture_storage_2d<rgba16float, write>;
@group(1) @binding(3) var<storage, read> block_list: array<u32>;

fn listed_block(index: u32) -> u32 {
    return block_list[index];
}

// The neighbour before and after a texel of an axis.
fn neighbours(texel: u32, size: u32) -> vec2u {
    let before = select(texel - 1u, select(0u, size - 1u, params.wrap == 1u), texel == 0u);
    let after = select(texel + 1u, select(size - 1u, 0u, params.wrap == 1u), texel + 1u == size);
    return vec2u(before, after);
}

fn height_at(x: u32, y: u32) -> f32 {
    return textureLoad(height, vec2u(x, y), 0).r;
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
    let x = neighbours(texel.x, params.size.x); // west, east
    let y = neighbours(texel.y, params.size.y); // north, south
    let nw = height_at(x.x, y.x);
    let n = height_at(texel.x, y.x);
    let ne = height_at(x.y, y.x);
    let w = height_at(x.x, texel.y);
    let e = height_at(x.y, texel.y);
    let sw = height_at(x.x, y.y);
    let s = height_at(texel.x, y.y);
    let se = height_at(x.y, y.y);
    let slope = vec2f((ne - nw) + 2.0 * (e - w) + (se - sw), (sw - nw) + 2.0 * (s - n) + (se - ne)) / 8.0;
    let leaning = vec3f(-slope * params.slope_per_height, 1.0);
    textureStore(normal, texel, vec4f(normalize(leaning), height_at(texel.x, texel.y)));
}
