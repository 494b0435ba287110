// Heal: closes the relief toward its base, one step of many, and wipes the marks off its material.
//
//   relief        r32float  read-write  heights, unclamped
//   material_map  r32uint   read-write  soot, bare and gloss fade; posts and heat stay
//   base          r32float  read        the heights that the field started from
//
// A departure d becomes q·d less a constant, and 0 where that would change its sign: after so many steps every d of at most 1 is 0
// to the bit. What departs by more is invisible and counts as 1. Tiles that are listed, 12 bytes in and 8 out a texel of them.
// Specification: src/reference/heal.rs. Composed after common/material.

struct HealParams {
    size: vec2u,      // of the field, texels
    first_tile: u32,  // in `tiles`
    tile_count: u32,
    kept: f32,        // q
    closes: f32,      // the constant
    soot: f32,        // levels by which soot and bareness fall in this step
    gloss: f32,       // the same of gloss
}

override HEAL_TILE_X: u32;
override HEAL_TILE_Y: u32;

@group(1) @binding(0) var<storage, read> params: HealParams;
@group(1) @binding(1) var relief: texture_storage_2d<r32float, read_write>;
@group(1) @binding(2) var material_map: texture_storage_2d<r32uint, read_write>;
@group(1) @binding(3) var base: texture_2d<f32>;
@group(1) @binding(4) var<storage, read> tiles: array<u32>; // column and row, 16 bits each

@compute @workgroup_size(HEAL_TILE_X, HEAL_TILE_Y)
fn heal(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let index = workgroup.y * workgroups.x + workgroup.x;
    if index >= params.tile_count {
        return;
    }
    let tile = tiles[params.first_tile + index];
    let texel = vec2u(tile & 0xffffu, tile >> 16u) * vec2u(HEAL_TILE_X, HEAL_TILE_Y) + local.xy;
    if any(texel >= params.size) {
        return;
    }
    let ground = textureLoad(base, texel, 0).x;
    let height = textureLoad(relief, texel).x;
    // Decided on the bits: a height that is no number, or infinite, is the base at once.
    let is_number = (bitcast<u32>(height) & 0x7fffffffu) < 0x7f800000u;
    let departure = clamp(select(0.0, height - ground, is_number), -1.0, 1.0);
    let left = max(0.0, params.kept * abs(departure) - params.closes);
    let healed = select(ground, ground + select(left, -left, departure < 0.0), left > 0.0);
    textureStore(relief, texel, vec4f(healed, 0.0, 0.0, 0.0));

    let bits = textureLoad(material_map, texel).x;
    let soot = max(0.0, material_soot(bits) - params.soot);
    let bare = max(0.0, material_bare(bits) - params.soot);
    let gloss = max(0.0, material_gloss(bits) - params.gloss);
    let wiped = material_bits(bits, soot, bare, gloss, material_heat(bits));
    textureStore(material_map, texel, vec4u(wiped, 0u, 0u, 0u));
}
