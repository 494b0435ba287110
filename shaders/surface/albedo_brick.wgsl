// Brick: running bond, each brick of its own firing, mortar between, pale dust where a shot broke it open.
//
// The layout is that of the base `bricks` (src/field/base/masonry.rs), which owns the constants.

override BRICK_LENGTH: f32; // metres, its joint included
override BRICK_HEIGHT: f32;
override BRICK_JOINT: f32;

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let metres = plane_metres(point.lattice);
    let course = floor(metres.y / BRICK_HEIGHT);
    let along = metres.x / BRICK_LENGTH + 0.5 * (course - 2.0 * floor(course / 2.0));
    let brick = vec2i(vec2f(floor(along), course));
    let inside = vec2f(along - floor(along), metres.y / BRICK_HEIGHT - course);
    let size = vec2f(BRICK_LENGTH, BRICK_HEIGHT);
    let from_joint = (0.5 - abs(inside - 0.5)) * size;
    let seen = footprint.texels * view.texel_metres;
    // Of single bricks, and of the joints along either axis, what the pixel still tells apart.
    let apart = detail_left(max(seen.x / size.x, seen.y / size.y));
    let joints = vec2f(detail_left(seen.x / size.x), detail_left(seen.y / size.y));

    let firing = mix(0.5, hash_cell(brick, 11u), apart);
    let grain = noise_over(metres, 160.0, 5u);
    let stain = noise_over(metres, 9.0, 23u);
    let clay = mix(vec3f(0.28, 0.085, 0.050), vec3f(0.50, 0.195, 0.105), firing);
    // One brick in nine was fired too hot.
    let burnt = mix(0.11, step(0.89, hash_cell(brick, 12u)), apart);
    let face = mix(clay, vec3f(0.115, 0.070, 0.065), 0.75 * burnt) * mix(0.72, 1.18, grain) * mix(0.82, 1.08, stain);
    let mortar = vec3f(0.40, 0.375, 0.335) * mix(0.80, 1.05, grain);
    let ragged = from_joint + 0.0022 * (grain - 0.5);
    let beside = vec2f(
        beside_stripe(ragged.x, BRICK_JOINT, seen.x, 0.0024),
        beside_stripe(ragged.y, BRICK_JOINT, seen.y, 0.0024),
    );
    let each = mix(1.0 - BRICK_JOINT / size, beside, joints);
    let is_brick = each.x * each.y;
    let broken = mix(vec3f(0.56, 0.50, 0.44), vec3f(0.66, 0.30, 0.175), is_brick) * mix(0.85, 1.15, grain);
    // Soot settles on the face, less on what broke off clean.
    return sooty(mix(mix(mortar, face, is_brick), broken, stamped.g), stamped.r * (1.0 - 0.55 * stamped.g));
}
