// Cool: forgets the heat of what no longer glows, before the clock of heat has run once round and would take it for new.
//
//   material_map  r32uint  read-write  heat alone
//
// A glow fades by itself, being a time: this changes nothing that anyone sees. 4 bytes in a texel, 4 out where something had glowed.
// Specification: src/reference/cool.rs. Composed after common/material.

struct CoolParams {
    size: vec2u,  // of the field, texels
    moment: f32,  // of the clock, at the time of this pass
}

override COOL_TILE_X: u32;
override COOL_TILE_Y: u32;

@group(1) @binding(0) var<storage, read> params: CoolParams;
@group(1) @binding(1) var material_map: texture_storage_2d<r32uint, read_write>;

@compute @workgroup_size(COOL_TILE_X, COOL_TILE_Y)
fn cool(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= params.size) {
        return;
    }
    let bits = textureLoad(material_map, id.xy).x;
    let heat = material_heat(bits);
    if heat != 0u && material_age(heat, params.moment) >= MATERIAL_GLOWING_MOMENTS {
        textureStore(material_map, id.xy, vec4u(bits & 0x3fffffu, 0u, 0u, 0u));
    }
}
