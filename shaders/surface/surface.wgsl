// Surface: the plane with its relief, and what is behind it, traced pixel by pixel.
//
//   radiance  rgba16float  write  linear, unbounded
//
// The background is drawn first, and the plane over it: within its outline, and no more opaque at its border than its share of the
// pixel, which antialiases it for nothing.

// What every pixel needs of the view comes along from the corners, where it is the same: lavapipe reads a number of a buffer lane by
// lane, some 120 instructions for eight of them and 250 for a vector, and a flat varying in one or two. The first three numbers of each
// save 3 of 22 ms of `normal` over `relief`, the others 1.6 of 19.4 of `exact`.
//
// There are sixteen locations, all that WebGPU promises: the fourth numbers of the first fifteen are of the first light, of what
// surrounds the surface, and of its tint.
struct Outline {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) lattice_x_exact: vec4f, // w: light.toward.x
    @location(1) @interpolate(flat) lattice_x_rest: vec4f, // w: light.toward.y
    @location(2) @interpolate(flat) lattice_y_exact: vec4f, // w: light.toward.z
    @location(3) @interpolate(flat) lattice_y_rest: vec4f, // w: light.radiance.x
    @location(4) @interpolate(flat) travel_x_exact: vec4f, // w: light.radiance.y
    @location(5) @interpolate(flat) travel_x_rest: vec4f, // w: light.radiance.z
    @location(6) @interpolate(flat) travel_y_exact: vec4f, // w: sky.x
    @location(7) @interpolate(flat) travel_y_rest: vec4f, // w: sky.y
    @location(8) @interpolate(flat) denominator_exact: vec4f, // w: sky.z
    @location(9) @interpolate(flat) denominator_rest: vec4f, // w: ground.x
    @location(10) @interpolate(flat) u_world: vec4f, // w: ground.y
    @location(11) @interpolate(flat) v_world: vec4f, // w: ground.z
    @location(12) @interpolate(flat) up_world: vec4f, // w: tint.x
    @location(13) @interpolate(flat) origin_world: vec4f, // w: tint.y
    @location(14) @interpolate(flat) eye_world: vec4f, // w: tint.z
    @location(15) @interpolate(flat) extent: vec4f, // plane_size_metres, repeat
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
    let light = view_buffer.lights[0];
    return Outline(
        vec4f(view_buffer.outline[corner], 0.0, 1.0),
        vec4f(view_buffer.lattice_x.exact.xyz, light.toward.x),
        vec4f(view_buffer.lattice_x.rest.xyz, light.toward.y),
        vec4f(view_buffer.lattice_y.exact.xyz, light.toward.z),
        vec4f(view_buffer.lattice_y.rest.xyz, light.radiance.x),
        vec4f(view_buffer.travel_x.exact.xyz, light.radiance.y),
        vec4f(view_buffer.travel_x.rest.xyz, light.radiance.z),
        vec4f(view_buffer.travel_y.exact.xyz, view_buffer.sky.x),
        vec4f(view_buffer.travel_y.rest.xyz, view_buffer.sky.y),
        vec4f(view_buffer.denominator.exact.xyz, view_buffer.sky.z),
        vec4f(view_buffer.denominator.rest.xyz, view_buffer.ground.x),
        vec4f(view_buffer.u_world, view_buffer.ground.y),
        vec4f(view_buffer.v_world, view_buffer.ground.z),
        vec4f(view_buffer.up_world, view_buffer.tint.x),
        vec4f(view_buffer.origin_world, view_buffer.tint.y),
        vec4f(view_buffer.eye_world, view_buffer.tint.z),
        vec4f(view_buffer.plane_size_metres, view_buffer.repeat),
    );
}

// Sets the view.
fn outline_view(outline: Outline) {
    view = view_buffer;
    view.lattice_x = LinearForm(outline.lattice_x_exact, outline.lattice_x_rest);
    view.lattice_y = LinearForm(outline.lattice_y_exact, outline.lattice_y_rest);
    view.travel_x = LinearForm(outline.travel_x_exact, outline.travel_x_rest);
    view.travel_y = LinearForm(outline.travel_y_exact, outline.travel_y_rest);
    view.denominator = LinearForm(outline.denominator_exact, outline.denominator_rest);
    view.u_world = outline.u_world.xyz;
    view.v_world = outline.v_world.xyz;
    view.up_world = outline.up_world.xyz;
    view.origin_world = outline.origin_world.xyz;
    view.eye_world = outline.eye_world.xyz;
    view.light_world = vec3f(outline.lattice_x_exact.w, outline.lattice_x_rest.w, outline.lattice_y_exact.w);
    view.light_radiance = vec3f(outline.lattice_y_rest.w, outline.travel_x_exact.w, outline.travel_x_rest.w);
    view.lights[0].toward = view.light_world;
    view.lights[0].radiance = view.light_radiance;
    view.sky = vec3f(outline.travel_y_exact.w, outline.travel_y_rest.w, outline.denominator_exact.w);
    view.ground = vec3f(outline.denominator_rest.w, outline.u_world.w, outline.v_world.w);
    view.tint = vec3f(outline.up_world.w, outline.origin_world.w, outline.eye_world.w);
    view.plane_size_metres = outline.extent.xy;
    view.repeat = outline.extent.zw;
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
