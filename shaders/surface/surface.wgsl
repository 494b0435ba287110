// Surface: the plane with its relief, and what is behind it, traced pixel by pixel.
//
//   radiance  rgba16float  write  linear, unbounded
//
// One triangle covers the picture: the plane's border is computed, which antialiases it for nothing. Among other things, with a depth
// buffer, the background is drawn first and the plane blends into it at its border.

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return vec4f(corner, 0.0, 1.0);
}

@fragment
fn surface(@builtin(position) position: vec4f) -> @location(0) vec4f {
    view = view_buffer;
    let behind = background(position.xy, pixel_direction(position.xy));
    let pixel = pixel_ray(position.xy);
    let coverage = plane_coverage(pixel);
    if coverage == 0.0 {
        return vec4f(behind, 1.0);
    }
    frame = plane_frame();
    return vec4f(mix(behind, shown(shade(pixel.ray)), coverage), 1.0);
}

@fragment
fn backdrop(@builtin(position) position: vec4f) -> @location(0) vec4f {
    view = view_buffer;
    return vec4f(background(position.xy, pixel_direction(position.xy)), 1.0);
}
