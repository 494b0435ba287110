// Façade: plaster over bricks, a steel plate, a door of planks; where a shot broke them, what lies beneath.
//
// The layout is that of the base `facade` (src/field/base/facade.rs), which owns the constants.

override FACADE_WIDTH: f32; // metres, as all of these
override FACADE_HEIGHT: f32;
override FACADE_PLATE_LEFT: f32;
override FACADE_PLATE_UPPER: f32;
override FACADE_PLATE_RIGHT: f32;
override FACADE_PLATE_LOWER: f32;
override FACADE_DOOR_LEFT: f32;
override FACADE_DOOR_UPPER: f32;
override FACADE_DOOR_RIGHT: f32;
override FACADE_DOOR_LOWER: f32;
override FACADE_PLANK: f32;
override BRICK_LENGTH: f32;
override BRICK_HEIGHT: f32;
override BRICK_JOINT: f32;

// How far within the plaster a point is, metres: as the base has it.
fn facade_plastered(at: vec2f) -> f32 {
    let ragged = 0.30 * (value_noise(at * 3.7, 87u) - 0.5)
        + 0.12 * (value_noise(at * 13.0, 88u) - 0.5)
        + 0.04 * (value_noise(at * 47.0, 89u) - 0.5);
    let hole = 0.5 * (value_noise(at * 5.1, 90u) - 0.16);
    return min(min(at.x - 0.74, 0.80 - at.y), hole) + 0.6 * ragged;
}

fn facade_inside(at: vec2f, low: vec2f, high: vec2f) -> f32 {
    let gap = min(at - low, high - at);
    return min(gap.x, gap.y);
}

// Bricks and mortar, with the colour of what is freshly broken.
fn facade_brick(metres: vec2f, grain: f32, bare: f32) -> vec3f {
    let course = floor(metres.y / BRICK_HEIGHT);
    let along = metres.x / BRICK_LENGTH + 0.5 * (course - 2.0 * floor(course / 2.0));
    let brick = vec2i(vec2f(floor(along), course));
    let inside = vec2f(along - floor(along), metres.y / BRICK_HEIGHT - course);
    let size = vec2f(BRICK_LENGTH, BRICK_HEIGHT);
    let from_joint = (0.5 - abs(inside - 0.5)) * size + 0.0022 * (grain - 0.5);
    let seen = footprint.texels * view.texel_metres;
    let is_brick = beside_stripe(from_joint.x, BRICK_JOINT, seen.x, 0.0024) * beside_stripe(from_joint.y, BRICK_JOINT, seen.y, 0.0024);
    let firing = hash_cell(brick, 11u);
    let clay = mix(vec3f(0.27, 0.080, 0.048), vec3f(0.47, 0.185, 0.100), firing) * mix(0.72, 1.18, grain);
    let mortar = vec3f(0.40, 0.375, 0.335) * mix(0.80, 1.05, grain);
    let broken = mix(vec3f(0.56, 0.50, 0.44), vec3f(0.66, 0.30, 0.175), is_brick) * mix(0.85, 1.15, grain);
    return mix(mix(mortar, clay, is_brick), broken, bare);
}

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let metres = plane_metres(point.lattice);
    let size = vec2f(FACADE_WIDTH, FACADE_HEIGHT);
    let at = metres - size * floor(metres / size);
    let grain = noise_over(metres, 160.0, 5u);
    let stain = noise_over(metres, 7.0, 23u);
    let soot = stamped.r * (1.0 - 0.55 * stamped.g);

    let in_door = facade_inside(at, vec2f(FACADE_DOOR_LEFT, FACADE_DOOR_UPPER), vec2f(FACADE_DOOR_RIGHT, FACADE_DOOR_LOWER));
    if in_door > 0.0 {
        // Old green paint that has worn off along the grain, over grey wood; fresh wood is pale.
        let plank = floor(at.x / FACADE_PLANK);
        let fibre = noise_over(metres * vec2f(1.0, 0.06), 190.0, 41u);
        let wood = mix(vec3f(0.20, 0.145, 0.10), vec3f(0.36, 0.27, 0.19), fibre);
        let worn = smoothstep(0.46, 0.62, 0.6 * fibre + 0.55 * stain - 0.06 + 0.10 * (hash_cell(vec2i(i32(plank), 0), 42u) - 0.5));
        let paint = vec3f(0.075, 0.165, 0.135) * mix(0.8, 1.2, grain);
        let face = mix(paint, wood, worn);
        return sooty(mix(face, vec3f(0.72, 0.52, 0.31) * mix(0.75, 1.15, fibre), stamped.g), 0.8 * soot);
    }
    let in_plate = facade_inside(at, vec2f(FACADE_PLATE_LEFT, FACADE_PLATE_UPPER), vec2f(FACADE_PLATE_RIGHT, FACADE_PLATE_LOWER));
    if in_plate > 0.0 {
        // Blue enamel that rust has crept under from the edges; bare steel is bright.
        let rust = smoothstep(0.60, 0.80, noise_over(metres, 34.0, 43u) + 0.30 * smoothstep(0.04, 0.0, in_plate) + 0.30 * (stain - 0.5));
        let enamel = vec3f(0.085, 0.125, 0.150) * mix(0.85, 1.15, grain);
        let face = mix(enamel, mix(vec3f(0.22, 0.085, 0.035), vec3f(0.36, 0.16, 0.06), grain), rust);
        var plate = sooty(mix(face, vec3f(0.56, 0.57, 0.58) * mix(0.85, 1.1, grain), stamped.g), soot);
        plate.specular = max(plate.specular, 0.55 * (1.0 - rust));
        plate.shininess = max(plate.shininess, 40.0);
        // Behind the plate it is dark.
        plate.albedo *= mix(1.0, smoothstep(0.62, 0.86, point.height), stamped.g);
        plate.metallic = 0.6 * stamped.g;
        return plate;
    }
    let plastered = smoothstep(0.0, 0.008, facade_plastered(at));
    // Where plaster broke off, the bricks; a white edge where it is cut.
    let flaked = plastered * smoothstep(0.55, 0.9, stamped.g);
    let brick = facade_brick(metres, grain, stamped.g * (1.0 - plastered) + 0.25 * flaked);
    let wash = mix(vec3f(0.60, 0.49, 0.33), vec3f(0.70, 0.61, 0.46), stain) * mix(0.90, 1.06, grain);
    let run = smoothstep(0.55, 0.85, noise_over(metres * vec2f(1.0, 0.12), 22.0, 44u)) * smoothstep(0.7, 0.0, at.y);
    let chalk = vec3f(0.74, 0.72, 0.68) * mix(0.9, 1.05, grain);
    let plaster = mix(mix(wash, 0.62 * wash, 0.5 * run), chalk, smoothstep(0.1, 0.5, stamped.g));
    return sooty(mix(brick, plaster, plastered * (1.0 - flaked)), soot);
}
