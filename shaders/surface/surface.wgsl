// Surface: the plane with its relief, and what is behind it, traced pixel by pixel.
//
//   radiance  rgba16float  write  linear, unbounded
//
// The background is drawn first, and the plane over it: within its outline, and no more opaque at its border than its share of the
// pixel, which antialiases it for nothing.

// What every pixel needs of the view comes along from the corners, where it is the same: lavapipe reads a number of a buffer by a check
// of its bounds and a branch, some nine cycles, and a flat varying in one or two. That is 3 of 22 ms of `normal` over `relief`.
struct Outline {
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

// Over all of the picture.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
}

// Over what shows the plane: a fan of triangles round the outline's first corner.
@vertex
fn outline(@builtin(vertex_index) index: u32) -> Outline {
    let corner = select(0u, index / 3u + index % 3u, index % 3u != 0u);
    return Outline(
        vec4f(view_buffer.outline[corner], 0.0, 1.0),
        view_buffer.lattice_x.exact.xyz, view_buffer.lattice_x.rest.xyz,
        view_buffer.lattice_y.exact.xyz, view_buffer.lattice_y.rest.xyz,
        view_buffer.travel_x.exact.xyz, view_buffer.travel_x.rest.xyz,
        view_buffer.travel_y.exact.xyz, view_buffer.travel_y.rest.xyz,
        view_buffer.denominator.exact.xyz, view_buffer.denominator.rest.xyz,
        view_buffer.u_world, view_buffer.v_world, view_buffer.up_world, view_buffer.origin_world, view_buffer.eye_world,
    );
}

// Sets the view.
fn outline_view(outline: Outline) {
    view = view_buffer;
    view.lattice_x = LinearForm(vec4f(outline.lattice_x_exact, 0.0), vec4f(outline.lattice_x_rest, 0.0));
    view.lattice_y = LinearForm(vec4f(outline.lattice_y_exact, 0.0), vec4f(outline.lattice_y_rest, 0.0));
    view.travel_x = LinearForm(vec4f(outline.travel_x_exact, 0.0), vec4f(outline.travel_x_rest, 0.0));
    view.travel_y = LinearForm(vec4f(outline.travel_y_exact, 0.0), vec4f(outline.travel_y_rest, 0.0));
    view.denominator = LinearForm(vec4f(outline.denominator_exact, 0.0), vec4f(outline.denominator_rest, 0.0));
    view.u_world = outline.u_world;
    view.v_world = outline.v_world;
    view.up_world = outline.up_world;
    view.origin_world = outline.origin_world;
    view.eye_world = outline.eye_world;
}

@fragment
fn surface(outline: Outline) -> @location(0) vec4f {
    outline_view(outline);
    let pixel = pixel_ray(outline.position.xy);
    let coverage = plane_coverage(pixel);
    if coverage == 0.0 {
        discard;
    }
    frame = plane_frame();
    return vec4f(shown(shade(pixel.ray)), coverage);
}

@fragment
fn backdrop(@builtin(position) position: vec4f) -> @location(0) vec4f {
    view = view_buffer;
    return vec4f(background(position.xy), 1.0);
}
