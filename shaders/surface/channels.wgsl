// Channels: what the picture is made of, as exact numbers, from the same rays through the same functions.
//
//   channels  storage, 48 bytes a pixel  write  a band of rows of the picture

struct Channel {
    position: vec3f,  // world, on the ray
    steps: f32,       // −1 where the pixel shows no surface, −1 − n where its ray gave up after n
    normal: vec3f,    // world, as shaded
    height: f32,      // of the field there
    uv: vec2f,        // not wrapped
    visibility: f32,
    lod: f32,
}

override WORKGROUP_X: u32;
override WORKGROUP_Y: u32;

@group(2) @binding(0) var<storage, read_write> channels: array<Channel>;

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn write_channels(@builtin(global_invocation_id) id: vec3u) {
    view = view_buffer;
    let index = id.y * view.image_size.x + id.x;
    if id.x >= view.image_size.x || index >= arrayLength(&channels) {
        return;
    }
    let pixel = pixel_ray(vec2f(id.xy + vec2u(0u, view.first_row)) + 0.5);
    if !shows_plane(pixel) {
        channels[index] = Channel(vec3f(0.0), -1.0, vec3f(0.0), 0.0, vec2f(0.0), 0.0, 0.0);
        return;
    }
    frame = plane_frame();
    let shaded = shade(pixel.ray);
    if shaded.hit.status == CAPPED {
        // It found no surface, and says how long it looked.
        channels[index] = Channel(vec3f(0.0), -1.0 - f32(shaded.hit.steps), vec3f(0.0), 0.0, vec2f(0.0), 0.0, 0.0);
        return;
    }
    channels[index] = Channel(
        world_of(shaded.hit.lattice, shaded.hit.height),
        f32(shaded.hit.steps),
        shaded.normal_world,
        shaded.height,
        uv_of(shaded.hit.lattice),
        shaded.visibility,
        0.0,
    );
}
