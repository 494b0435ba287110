// Shallow water: what the stack and the albedo see of it.
//
//   bed       r32float      read    height of what it flows over, heights
//   depths    2 vec2f       read    of either state; the control says which is the present one
//   flows     2 vec2f       read
//   surface   r32float      write   height of the water, or of the bed where there is none; unclamped
//   cover     rgba16float   write   depth in heights, share of foam, velocity x and y in m/s
//
// Reads 20 bytes a texel and writes 12. Composed after common/shallow_water.wgsl.

@group(1) @binding(0) var<storage, read> params: ShallowWaterParams;
@group(1) @binding(1) var<storage, read_write> control: ShallowWaterControl;
@group(1) @binding(2) var bed: texture_2d<f32>;
@group(1) @binding(3) var<storage, read> depths_0: array<vec2f>;
@group(1) @binding(4) var<storage, read> flows_0: array<vec2f>;
@group(1) @binding(5) var<storage, read> depths_1: array<vec2f>;
@group(1) @binding(6) var<storage, read> flows_1: array<vec2f>;
@group(1) @binding(7) var surface: texture_storage_2d<r32float, write>;
@group(1) @binding(8) var cover: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(SHALLOW_WATER_TILE, SHALLOW_WATER_TILE)
fn shallow_water_publish(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= params.size) {
        return;
    }
    let index = id.y * params.size.x + id.x;
    let first = control.current == 0u;
    let state = select(depths_1[index], depths_0[index], first);
    let flow = select(flows_1[index], flows_0[index], first);
    let velocity = shallow_water_velocity(flow, state.x, params.dry_metres, params.speed_cap);
    let depth = state.x / params.depth_metres;
    textureStore(surface, id.xy, vec4f(textureLoad(bed, id.xy, 0).x + depth, 0.0, 0.0, 0.0));
    // A half holds no more.
    textureStore(cover, id.xy, clamp(vec4f(depth, state.y, velocity), vec4f(-65504.0), vec4f(65504.0)));
}
