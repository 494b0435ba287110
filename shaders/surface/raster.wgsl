// Raster: what everything that is drawn with a depth buffer shares: the rays of pixels in the world, and the depth of a point.
//
// Depth runs from 1 at the near distance to 0 at infinity: a float is finest near 0, where a distance changes it least.

struct RasterVertex {
    position: vec3f,        // world, metres
    u: f32,                 // texture coordinates; they may leave [0, 1]
    normal: vec3f,          // unit, out of the surface
    v: f32,
    tangent: vec3f,         // unit, along u
    handedness: f32,        // the bitangent, along v, is this times normal × tangent
    inward: vec3f,          // from the surface to the floor of the shell, in units of the depth
    pad: f32,
    metres_per_uv: vec2f,   // how long a tile is along u and along v
}

@group(2) @binding(0) var<storage, read> raster_vertices: array<RasterVertex>;

// The direction of a pixel's ray in the world, with unit length along the view axis.
fn raster_direction(position: vec2f) -> vec3f {
    let pixel = vec3f(position, 1.0);
    return vec3f(
        ray_map_evaluate(view.direction_x, pixel),
        ray_map_evaluate(view.direction_y, pixel),
        ray_map_evaluate(view.direction_z, pixel),
    );
}

// A point of the world as seen from the eye, which is known to twice an f32's digits.
fn raster_from_eye(world: vec3f) -> vec3f {
    return (world - view.eye_world) - view.eye_rest;
}

fn raster_clip(world: vec3f) -> vec4f {
    return view.clip_from_eye * vec4f(raster_from_eye(world), 1.0);
}

// The depth of a point in the world.
fn raster_depth(world: vec3f) -> f32 {
    return clamp(view.near_metres / max(dot(raster_from_eye(world), view.forward_world), view.near_metres), 0.0, 1.0);
}

struct ColourAndDepth {
    @location(0) colour: vec4f,
    @builtin(frag_depth) depth: f32,
}
