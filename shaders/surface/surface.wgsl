// Surface: the plane with its relief, and what is behind it, traced pixel by pixel.
//
//   radiance  rgba16float  write  linear, unbounded
//
// One triangle covers the picture: the plane's border is computed, which antialiases it for nothing. Among other things, with a depth
// buffer, the background is drawn first and the plane blends into it at its border.

// What every pixel needs of the view comes along from the corners, where it is the same: lavapipe reads a number of a buffer by a check
// of its bounds and a branch, some nine cycles, and a flat varying in one or two. That is 3 of 22 ms of `normal` over `relief`.
struct Cover {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) lattice_x_exact: vec3f,
    @location(1) @interpolate(flat) lattice_x_rest: vec3f,
    @location(2) @interpolate(flat) lattice_y_exact: vec3f,
    @location(3) @interpolate(flat) lattice_y_rest: vec3f,
    @location(4) @interpolate(flat) travel_x_exact: vec3f,
    @location(5) @interpolate(flat) travel_x_rest: vec3f,
    @location(6) @interpolate(flat) travel_y_exact: vec3f,
    @location(7) @interpolate(flat) travel_y_rest: vec3f,
    @location(8) @interpolate(flat) denominator_exact: vec3f,
    @location(9) @interpolate(flat) denominator_rest: vec3f,
    @location(10) @interpolate(flat) u_world: vec3f,
    @location(11) @interpolate(flat) v_world: vec3f,
    @location(12) @interpolate(flat) up_world: vec3f,
    @location(13) @interpolate(flat) origin_world: vec3f,
    @location(14) @interpolate(flat) eye_world: vec3f,
}

@vertex
fn cover(@builtin(vertex_index) index: u32) -> Cover {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return Cover(
        vec4f(corner, 0.0, 1.0),
        view_buffer.lattice_x.exact.xyz, view_buffer.lattice_x.rest.xyz,
        view_buffer.lattice_y.exact.xyz, view_buffer.lattice_y.rest.xyz,
        view_buffer.travel_x.exact.xyz, view_buffer.travel_x.rest.xyz,
        view_buffer.travel_y.exact.xyz, view_buffer.travel_y.rest.xyz,
        view_buffer.denominator.exact.xyz, view_buffer.denominator.rest.xyz,
        view_buffer.u_world, view_buffer.v_world, view_buffer.up_world, view_buffer.origin_world, view_buffer.eye_world,
    );
}

// Sets the view.
fn cover_view(cover: Cover) {
    view = view_buffer;
    view.lattice_x = LinearForm(vec4f(cover.lattice_x_exact, 0.0), vec4f(cover.lattice_x_rest, 0.0));
    view.lattice_y = LinearForm(vec4f(cover.lattice_y_exact, 0.0), vec4f(cover.lattice_y_rest, 0.0));
    view.travel_x = LinearForm(vec4f(cover.travel_x_exact, 0.0), vec4f(cover.travel_x_rest, 0.0));
    view.travel_y = LinearForm(vec4f(cover.travel_y_exact, 0.0), vec4f(cover.travel_y_rest, 0.0));
    view.denominator = LinearForm(vec4f(cover.denominator_exact, 0.0), vec4f(cover.denominator_rest, 0.0));
    view.u_world = cover.u_world;
    view.v_world = cover.v_world;
    view.up_world = cover.up_world;
    view.origin_world = cover.origin_world;
    view.eye_world = cover.eye_world;
}

@fragment
fn surface(cover: Cover) -> @location(0) vec4f {
    cover_view(cover);
    let position = cover.position.xy;
    let behind = background(position);
    let pixel = pixel_ray(position);
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
    return vec4f(background(position.xy), 1.0);
}
