// Frame: the affine map between field space and the world where the invocation's ray travels. Over a flat polygon its axes are
// the tangent, the bitangent and the normal; in a piece of a shell they may be skewed.
//
// Composed after common/view.wgsl and common/field.wgsl.

struct Frame {
    anchor: vec2f,    // a lattice position whose reference surface, h = 1, …
    origin: vec3f,    // … lies here, world
    along_u: vec3f,   // world displacement of a cell along u, metres
    along_v: vec3f,
    up: vec3f,        // world displacement from height 0 to height 1, metres
    // The rows of the inverse: what of a world displacement is cells along u, cells along v, heights.
    per_u: vec3f,
    per_v: vec3f,
    per_height: vec3f,
}

// Every entry point that shades sets it first.
var<private> frame: Frame;

fn frame_of(anchor: vec2f, origin: vec3f, along_u: vec3f, along_v: vec3f, up: vec3f) -> Frame {
    let normal = cross(along_u, along_v);
    let per_volume = 1.0 / dot(normal, up);
    return Frame(
        anchor, origin, along_u, along_v, up,
        cross(along_v, up) * per_volume, cross(up, along_u) * per_volume, normal * per_volume,
    );
}

// The frame of the flat relief that the view describes.
fn plane_frame() -> Frame {
    let cell = view.plane_size_metres / vec2f(view.field_size);
    let middle = 0.5 * vec2f(view.field_size) - 0.5;
    return frame_of(middle, view.origin_world, view.u_world * cell.x, view.v_world * cell.y, view.up_world * view.depth_metres);
}

fn world_of(lattice: vec2f, height: f32) -> vec3f {
    let cells = lattice - frame.anchor;
    return frame.origin + frame.along_u * cells.x + frame.along_v * cells.y + frame.up * (height - 1.0);
}

// A world displacement as cells along u, cells along v, heights.
fn field_direction(world: vec3f) -> vec3f {
    return vec3f(dot(frame.per_u, world), dot(frame.per_v, world), dot(frame.per_height, world));
}

// The unit vector out of the reference surface, world.
fn frame_normal() -> vec3f {
    return normalize(frame.per_height);
}

// The world normal of a unit normal in field space, which is of a field with square texels `view.texel_metres` wide: its slopes
// carry over to whatever cells the frame has.
fn frame_normal_of(normal: vec3f) -> vec3f {
    let slopes = normal.xy / (max(normal.z, 1e-6) * (view.depth_metres / view.texel_metres));
    return normalize(frame.per_height + frame.per_u * slopes.x + frame.per_v * slopes.y);
}
