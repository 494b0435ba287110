// The frame's uniform: what is seen, how it is traced, how it is lit. Its Rust twin is surface::view::View.

// A linear form of the pixel, split so that cancellation costs nothing: with x and y multiples of ½ the products and sums of
// `exact` are free of rounding, in whatever order a compiler takes them, and `rest` is smaller by some 2²².
struct LinearForm {
    exact: vec4f, // coefficients of x, y, 1
    rest: vec4f,
}

// How level of detail is chosen: see surface/level_of_detail.wgsl.
struct ViewDetail {
    threshold: f32, // mip level beyond which normal mapping alone is left
    traces: u32,    // 1 where the trace heeds it
    filters: u32,   // 1 where light falls on what a pixel sees, not on one point
    pad: u32,
}

// A light without extent, infinitely far away.
struct ViewLight {
    toward: vec3f,      // unit vector toward it, world
    casts_shadow: u32,  // 1 where the relief hides it from itself
    radiance: vec3f,    // that a white surface facing it has
}

// A ball beside the relief.
struct Ball {
    centre: vec3f,  // world, metres
    radius: f32,
    colour: vec3f,  // albedo, linear
}

// A flat relief as it casts shadows on others: a rectangle, h = 1, under which its field lies.
struct Slab {
    middle: vec3f,          // world, metres
    depth: f32,             // of h = 0 below it, metres
    along_u: vec3f,         // unit
    half_extent_u: f32,     // metres; negative where it hides nothing
    along_v: vec3f,
    half_extent_v: f32,
}

struct View {
    // The ray of pixel (x, y) meets the plane at lattice position (lattice_x, lattice_y) / denominator, and travels
    // (travel_x, travel_y) / denominator while it falls from height 1 to 0. The denominator grows downward from 0 at the horizon.
    lattice_x: LinearForm,
    lattice_y: LinearForm,
    travel_x: LinearForm,
    travel_y: LinearForm,
    denominator: LinearForm,

    field_size: vec2u,           // texels
    wrap: u32,                   // 1 where the field wraps, 0 where it clamps
    step_cap: u32,               // nodes that a ray may visit
    plane_size_metres: vec2f,
    depth_metres: f32,
    nearest: f32,                // largest denominator of a point that is not too near

    pom_samples_min: f32,
    pom_samples_max: f32,
    shadow_samples: f32,
    shadow_strength: f32,

    pom_counts: u32,             // how pom chooses its counts: see surface/march.wgsl
    steep_layers: f32,
    relief_linear_steps: f32,
    relief_binary_steps: u32,
    relief_depth_bias: u32,      // 1 where relief shortens the offset of grazing rays, else 0
    pyramid_leaf: u32,           // what pyramid makes of a leaf: see surface/trace_pyramid.wgsl

    // The plane's axes, unit vectors in the world, and its middle.
    u_world: vec3f,
    first_row: u32,              // of the band that channels are written for
    v_world: vec3f,
    displaced_depth: u32,        // 1 where the depth of a pixel is that of the relief, 0 where it is that of the polygon
    up_world: vec3f,
    mesh_quads: u32,             // of the micropolygon mesh along either side of a tile
    origin_world: vec3f,

    eye_world: vec3f,
    specular: f32,
    light_world: vec3f,          // unit vector toward the light
    shininess: f32,
    light_radiance: vec3f,       // that a white surface facing the light has
    rest_height: f32,            // height of the undisturbed surface: the water line
    sky: vec3f,                  // radiance from overhead
    texel_metres: f32,
    ground: vec3f,               // radiance from below
    shows: u32,                  // what the picture shows: see surface/shade.wgsl
    tint: vec3f,
    roughness: f32,              // 0 a mirror, 1 matt

    image_size: vec2u,           // of the traced picture, pixels
    // 1 where what is drawn takes its rays from the forms above, 2 where it is the plane alone, clipped to its border, 0 where it
    // takes them from each point's tangent space.
    planar: u32,
    ball_count: u32,
    metallic: f32,               // 0 a dielectric, 1 a metal
    reflection: f32,             // how much of its surroundings the surface mirrors
    index: f32,                  // of refraction, where the surface is transparent
    gain: f32,                   // of the view of errors: the brightest heat is an error of 1 / gain texels
    light_radius: f32,           // tangent of half the angle that the light's disc spans
    area_samples: u32,           // points of the light's disc
    level_cap: u32,              // of the view that ends the traversal at a level
    lights: array<ViewLight, 4>, // the first is that of light_world and light_radiance

    // The pixel's direction in the world, with unit length along the view axis.
    direction_x: LinearForm,
    direction_y: LinearForm,
    direction_z: LinearForm,
    clip_from_eye: mat4x4f,      // from what is counted from the eye, in the world's axes; depth is near over distance
    eye_rest: vec3f,             // what eye_world lacks
    near_metres: f32,
    forward_world: vec3f,        // unit, along the view axis
    balls: array<Ball, 4>,
    repeat: vec2f,               // how often the plane shows the field along u and v
    slab_count: u32,
    own_slab: u32,               // that of the relief that is drawn
    moment: f32,                 // of the clock of heat: see common/material.wgsl
    glow: f32,                   // radiance of what glows fully
    detail: ViewDetail,
    slabs: array<Slab, 8>,
    water_absorption: vec3f,     // of red, green and blue in a metre of the water that covers the field
    slab_penumbra: f32,          // tangent of half the angle of the light's disc, as slabs see it
    water_scatter: vec3f,        // what deep water gives back of them
    core_centre: vec3f,          // of the ball in a closed shell that no ray reaches, world: see src/surface/shell.rs
    core_radius: f32,            // 0: there is none
    outline: array<vec2f, 9>,    // of the plane in the picture, in clip space: see src/surface/outline.rs
}

@group(0) @binding(0) var<storage, read> view_buffer: View;
@group(0) @binding(1) var bilinear: sampler;
@group(0) @binding(2) var nearest: sampler;

// How many lights shine; there are no more in `lights`. Fixed when the pipeline is built: a software adapter runs a loop's body once
// more than it need, and reads every light there for each lane by itself.
override LIGHTS: u32 = 4u;

// Whether the field wraps: 1 it does, 0 it clamps, 2 as the view says. Fixed when the pipeline is built, where that is known: a tenth of
// what the exact traversal computes over a field that clamps is about the tiles of one that wraps.
override WRAPS: u32 = 2u;

fn view_wraps() -> bool {
    if WRAPS == 2u {
        return view.wrap != 0u;
    }
    return WRAPS == 1u;
}

// Light i. By comparisons: an index that varies would keep the whole of the private `view` in memory.
fn view_light(i: u32) -> ViewLight {
    var source = view.lights[0];
    if LIGHTS > 1u && i == 1u {
        source = view.lights[1];
    }
    if LIGHTS > 2u && i == 2u {
        source = view.lights[2];
    }
    if LIGHTS > 3u && i == 3u {
        source = view.lights[3];
    }
    return source;
}

// The invocation's own copy, which every entry point makes first: a traversal reads some of it at every step, and a software
// adapter would go to the buffer each time.
var<private> view: View;
