// Gears: spoked wheels whose straight-sided teeth mesh. Composed after field/noise.wgsl.
// Specification: src/reference/noise_gears.rs.

struct NoiseGears {
    half_module: f32,     // half of the pitch circle's diameter for each tooth, metres
    edge: f32,            // metres
    top: f32,
}

struct NoiseGear {
    centre: vec2f,        // metres
    rotation: vec2f,      // cosine and sine of the angle that it has turned by, u toward v
    teeth: f32,
    spokes: f32,
}

@group(1) @binding(2) var<storage, read> gears: NoiseGears;
@group(1) @binding(3) var<storage, read> train: array<NoiseGear>;

// The turn, −½ to ½, that a direction makes with u. WGSL grants atan2 4,096 ulp, which would shake the teeth; this one is off by
// some two (Cephes' atanf, S. Moshier).
fn gear_turn(direction: vec2f) -> f32 {
    let a = abs(direction);
    let low = min(a.x, a.y);
    let high = max(max(a.x, a.y), 1e-30);
    // Above tan(π/8) by the addition theorem for π/4.
    let shift = low > 0.41421356 * high;
    let x = select(low, low - high, shift) / select(high, low + high, shift);
    let z = x * x;
    let odd = ((8.05374449538e-2 * z - 1.38776856032e-1) * z + 1.99777106478e-1) * z - 3.33329491539e-1;
    var angle = odd * z * x + x + select(0.0, 0.78539816, shift);
    angle = select(angle, 1.57079633 - angle, a.y > a.x);
    angle = select(angle, 3.14159265 - angle, direction.x < 0.0);
    return select(angle, -angle, direction.y < 0.0) * 0.15915494;
}

fn pattern(texel: vec2f) -> f32 {
    var highest = 0.0;
    for (var i = 0u; i < params.count; i++) {
        highest = max(highest, gear_height(train[i], texel * params.texel_metres));
    }
    return highest;
}

fn gear_height(gear: NoiseGear, at: vec2f) -> f32 {
    let apart = at - gear.centre;
    // Where the field wraps, the nearest of the wheel's images.
    let offset = select(apart, apart - round(apart / params.field_metres) * params.field_metres, params.wrap == 1u);
    let turned = vec2f(dot(offset, gear.rotation), dot(offset, vec2f(-gear.rotation.y, gear.rotation.x)));
    let distance = length(offset);
    let turn = gear_turn(turned);
    let m = 2.0 * gears.half_module;
    let pitch = gears.half_module * gear.teeth;

    // Teeth narrow by tan 20° on each side; a twentieth of the module is play.
    let tooth = turn * gear.teeth;
    let arc = abs(tooth - round(tooth)) / gear.teeth * 6.28318531 * distance;
    let flank = (0.78539816 * m - 0.0125 * m - arc - (distance - pitch) * 0.36397023) * 0.93969262;
    var inside = max(pitch - 1.25 * m - distance, min(pitch + m - distance, flank));

    // Between hub and rim, and in the middle of the hub, there is nothing but spokes.
    let rim = pitch - 2.75 * m;
    let hub = 0.28 * pitch;
    let spoke = turn * gear.spokes;
    let from_spoke = abs(spoke - round(spoke)) / gear.spokes * 6.28318531 * distance;
    let between = min(distance - hub, rim - distance);
    inside = min(inside, max(-between, 0.07 * pitch + 0.25 * m - from_spoke));
    inside = min(inside, distance - 0.12 * pitch);
    // The spokes lie lower than hub and rim.
    let sunk = 1.0 - 0.3 * noise_edge(between, 2.0 * gears.edge);
    return gears.top * sunk * noise_edge(inside, gears.edge);
}
