// Frame: the affine map between field space and the world where the invocation's ray travels. Over a flat polygon its axes are
// the tangent, the bitangent and the normal; in a piece of a shell they are skewed.
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
    // The reference surface's normal for shading, world: at the anchor, and its change a cell along u and v. Its length is of no
    // account.
    normal: vec3f,
    normal_per_u: vec3f,
    normal_per_v: vec3f,
    cut: vec3f,       // unit normal of the side through which the ray came into a shell, where it came in through one
}

// Every entry point that shades sets it first.
var<private> frame: Frame;

fn frame_of(anchor: vec2f, origin: vec3f, along_u: vec3f, along_v: vec3f, up: vec3f) -> Frame {
    let normal = cross(along_u, along_v);
    let per_volume = 1.0 / dot(normal, up);
    let per_height = normal * per_volume;
    return Frame(
        anchor, origin, along_u, along_v, up, cross(along_v, up) * per_volume, cross(up, along_u) * per_volume, per_height,
        per_height, vec3f(0.0), vec3f(0.0), vec3f(0.0),
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

// The unit vector out of the reference surface above a lattice position, world.
fn frame_normal(lattice: vec2f) -> vec3f {
    let cells = lattice - frame.anchor;
    return normalize(frame.normal + frame.normal_per_u * cells.x + frame.normal_per_v * cells.y);
}

// The unit vector out of the reference surface by the frame alone, world.
fn frame_up() -> vec3f {
    return normalize(frame.per_height);
}

// A world displacement as cells along u, cells along v, heights.
fn field_displacement(world: vec3f) -> vec3f {
    return vec3f(dot(frame.per_u, world), dot(frame.per_v, world), dot(frame.per_height, world));
}

// A world direction above the tangent plane of a smooth reference surface as cells along u, cells along v, heights.
fn field_direction(world: vec3f, normal: vec3f) -> vec3f {
    let out = dot(world, normal);
    let level = world - out * normal;
    return vec3f(dot(frame.per_u, level), dot(frame.per_v, level), out * length(frame.per_height));
}

// The world normal of a relief whose unit normal in field space is `relief`, over a reference surface with this normal. The relief's
// is that of a field with square texels `view.texel_metres` wide; its slopes carry over to whatever cells the frame has.
fn relief_normal(relief: vec3f, normal: vec3f) -> vec3f {
    let slopes = relief.xy / (max(relief.z, 1e-6) * (view.depth_metres / view.texel_metres) * length(frame.per_height));
    return normalize(normal + frame.per_u * slopes.x + frame.per_v * slopes.y);
}
