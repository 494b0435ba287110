// From the pixel to its ray in field space. Composed after common/view.wgsl and surface/ray.wgsl; built by src/surface/ray_map.rs.

struct PixelRay {
    ray: Ray,
    lattice: vec2f,   // where it meets the plane
    denominator: f32, // eye height over distance along the view axis: grows downward from 0 at the horizon
}

fn ray_map_evaluate(form: LinearForm, pixel: vec3f) -> f32 {
    return dot(form.exact.xyz, pixel) + dot(form.rest.xyz, pixel);
}

// The form less `whole` denominators.
fn ray_map_remainder(form: LinearForm, whole: f32, pixel: vec3f) -> f32 {
    let exact = fma(-whole, dot(view.denominator.exact.xyz, pixel), dot(form.exact.xyz, pixel));
    return exact + (dot(form.rest.xyz, pixel) - whole * dot(view.denominator.rest.xyz, pixel));
}

// What a pixel sees of the plane: the gradient of a quotient of two linear forms.
fn ray_map_footprint(lattice: vec2f, denominator: f32) {
    let u = (view.lattice_x.exact.xy - lattice.x * view.denominator.exact.xy) / denominator;
    let v = (view.lattice_y.exact.xy - lattice.y * view.denominator.exact.xy) / denominator;
    let size = vec2f(view.field_size);
    footprint = footprint_of(vec2f(u.x, v.x) / size, vec2f(u.y, v.y) / size);
}

// The ray through a point of the picture, in pixels from its upper left corner: pixel centres lie at ½.
fn pixel_ray(position: vec2f) -> PixelRay {
    let pixel = vec3f(position, 1.0);
    let denominator = ray_map_evaluate(view.denominator, pixel);
    let nearly = vec2f(ray_map_evaluate(view.lattice_x, pixel), ray_map_evaluate(view.lattice_y, pixel)) / denominator;
    // What is left over a whole cell, from the unrounded parts: a ray that all but grazes the surface magnifies every error of
    // its start, and a position near 400 is rounded by 1.5e-5 cells.
    let around = 0.5 * (view.repeat - 1.0) * vec2f(view.field_size);
    let cell = floor(clamp(nearly, -1.0 - around, vec2f(view.field_size) + around));
    let left = vec2f(ray_map_remainder(view.lattice_x, cell.x, pixel), ray_map_remainder(view.lattice_y, cell.y, pixel));
    let lattice = left / denominator;
    let travel = vec2f(ray_map_evaluate(view.travel_x, pixel), ray_map_evaluate(view.travel_y, pixel)) / denominator;
    ray_map_footprint(cell + lattice, denominator);
    return PixelRay(view_ray(lattice, travel, vec2i(cell)), cell + lattice, denominator);
}

// The unit direction into which a point of the picture looks, world.
fn pixel_direction(position: vec2f) -> vec3f {
    let pixel = vec3f(position, 1.0);
    return normalize(vec3f(
        ray_map_evaluate(view.direction_x, pixel),
        ray_map_evaluate(view.direction_y, pixel),
        ray_map_evaluate(view.direction_z, pixel),
    ));
}

// Whether the pixel looks down upon the plane's own plane, beyond the near distance.
fn ray_map_looks_down(denominator: f32) -> bool {
    return denominator > 0.0 && denominator < view.nearest;
}

// Where the pixel's centre meets the plane, from the plane's middle, texels.
fn ray_map_from_middle(pixel: PixelRay) -> vec2f {
    return pixel.lattice + 0.5 - 0.5 * vec2f(view.field_size);
}

// Whether the pixel's centre shows the plane.
fn shows_plane(pixel: PixelRay) -> bool {
    let inside = all(abs(ray_map_from_middle(pixel)) <= 0.5 * view.repeat * vec2f(view.field_size));
    return inside && ray_map_looks_down(pixel.denominator);
}

// How much of the pixel shows the plane, 0 to 1, by the distance of its centre from the plane's borders in pixels.
fn plane_coverage(pixel: PixelRay) -> f32 {
    if !ray_map_looks_down(pixel.denominator) {
        return 0.0;
    }
    // A border is a line of the picture: where a linear form less a share of the denominator is 0. A quotient's own gradient would
    // find the plane everywhere along the horizon, where a pixel sees as much of it as lies before it.
    let from_middle = ray_map_from_middle(pixel);
    let half = 0.5 * view.repeat * vec2f(view.field_size);
    let border = select(-half, half, from_middle > vec2f(0.0)) + 0.5 * vec2f(view.field_size) - 0.5;
    let slope = view.denominator.exact.xy;
    let per_pixel = vec2f(
        length(view.lattice_x.exact.xy - border.x * slope),
        length(view.lattice_y.exact.xy - border.y * slope),
    ) / pixel.denominator;
    let inside = (half - abs(from_middle)) / per_pixel;
    return clamp(min(inside.x, inside.y) + 0.5, 0.0, 1.0);
}
