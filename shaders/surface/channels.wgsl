// Channels: what the picture is made of, as exact numbers, from the same rays through the same functions.
//
//   channels  storage, 48 bytes a pixel  write  a band of rows of the picture

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
        channels[index] = NO_CHANNEL;
        return;
    }
    frame = plane_frame();
    channels[index] = channel_of(shade(pixel.ray));
}
