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

// A pixel is at most so many times longer on the surface than it is wide: where a surface turns away from the eye.
const RASTER_GRAZING: f32 = 0.02;

// Sets what the pixel sees of the reference surface at a point of the world, where the frame is.
fn raster_footprint(position: vec2f, world: vec3f, normal: vec3f) {
    let direction = raster_direction(position);
    let depth = dot(raster_from_eye(world), view.forward_world);
    let fall = max(-dot(direction, normal), RASTER_GRAZING * length(direction));
    // From the pixel's ray to its neighbours' at this depth, and along them to the surface.
    let right = depth * vec3f(view.direction_x.exact.x, view.direction_y.exact.x, view.direction_z.exact.x);
    let down = depth * vec3f(view.direction_x.exact.y, view.direction_y.exact.y, view.direction_z.exact.y);
    let along_right = right + direction * (dot(right, normal) / fall);
    let along_down = down + direction * (dot(down, normal) / fall);
    let size = vec2f(view.field_size);
    footprint = footprint_of(
        vec2f(dot(frame.per_u, along_right), dot(frame.per_v, along_right)) / size,
        vec2f(dot(frame.per_u, along_down), dot(frame.per_v, along_down)) / size,
    );
}

struct ColourAndDepth {
    @location(0) colour: vec4f,
    @builtin(frag_depth) depth: f32,
}
