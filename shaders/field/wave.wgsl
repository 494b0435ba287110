// Wave: one step of the damped wave equation, and the impulses that disturb it.
//
//   current   r32float  read        u at this step, unclamped; the wave's own unit
//   previous  r32float  read-write  u one step ago; a step overwrites it with u one step ahead, then the two change roles
//   mask      r8uint    read        what a texel is free to do and which neighbours it exchanges with (WAVE_* below)
//
// A step reads 9 bytes a texel and writes 4. A splash reads and writes 8 bytes a texel of each touched tile, and reads 1.
// Borders and obstacles are in the mask alone: a closed neighbour is one with which nothing is exchanged.
// Specification: src/reference/wave.rs.

override WAVE_STEP_X: u32;
override WAVE_STEP_Y: u32;
override WAVE_TILE: u32;

// The mask's bits.
override WAVE_WEST: u32;
override WAVE_EAST: u32;
override WAVE_NORTH: u32;
override WAVE_SOUTH: u32;
override WAVE_FREE: u32;

struct WaveParams {
    size: vec2u,
    velocity_kept: f32,        // (1 − γ/2) / (1 + γ/2), γ the damping of a step
    pull: f32,                 // C² / (1 + γ/2), C the Courant number
    courant_squared: f32,
    damping: f32,              // γ
    sponge_damping: f32,       // what the sponge adds to γ at the border
    sponge_width: f32,         // texels; 0: there is no sponge
}

@group(1) @binding(0) var<storage, read> params: WaveParams;
@group(1) @binding(1) var mask: texture_2d<u32>;
@group(1) @binding(2) var previous: texture_storage_2d<r32float, read_write>;
@group(1) @binding(3) var current: texture_2d<f32>;

// u⁺ = u + (1 − γ/2)/(1 + γ/2)·(u − u⁻) + C²/(1 + γ/2)·L(u).
//
// Written as increments, not as the textbook's 2u − u⁻: level water stays level to the bit whatever γ is, and only one rounding is of
// the size of u. Over 10,000 damped steps the mean drifts by 8e-7 so, and by 5e-6 the other way; undamped, both walk at random
// by some 1e-5.
@compute @workgroup_size(WAVE_STEP_X, WAVE_STEP_Y)
fn wave_step(@builtin(global_invocation_id) id: vec3u) {
    let texel = id.xy;
    if any(texel >= params.size) {
        return;
    }
    let flags = textureLoad(mask, texel, 0).x;
    if (flags & WAVE_FREE) == 0u {
        textureStore(previous, texel, vec4f(0.0));
        return;
    }
    // Always the opposite border: where nothing is exchanged with it, the mask says so.
    let last = params.size - 1u;
    let low = select(texel - 1u, last, texel == vec2u(0u));
    let high = select(texel + 1u, vec2u(0u), texel == last);
    let u = textureLoad(current, texel, 0).x;
    let west = textureLoad(current, vec2u(low.x, texel.y), 0).x - u;
    let east = textureLoad(current, vec2u(high.x, texel.y), 0).x - u;
    let north = textureLoad(current, vec2u(texel.x, low.y), 0).x - u;
    let south = textureLoad(current, vec2u(texel.x, high.y), 0).x - u;
    let laplacian = (select(0.0, west, (flags & WAVE_WEST) != 0u) + select(0.0, east, (flags & WAVE_EAST) != 0u))
        + (select(0.0, north, (flags & WAVE_NORTH) != 0u) + select(0.0, south, (flags & WAVE_SOUTH) != 0u));

    var velocity_kept = params.velocity_kept;
    var pull = params.pull;
    if params.sponge_width > 0.0 {
        let inward = min(texel, last - texel);
        let depth = saturate(1.0 - f32(min(inward.x, inward.y)) / params.sponge_width);
        let half_damping = 0.5 * (params.damping + params.sponge_damping * depth * depth);
        velocity_kept = (1.0 - half_damping) / (1.0 + half_damping);
        pull = params.courant_squared / (1.0 + half_damping);
    }
    let before = textureLoad(previous, texel).x;
    textureStore(previous, texel, vec4f(u + (velocity_kept * (u - before) + pull * laplacian), 0.0, 0.0, 0.0));
}

// An impulse: a dent and the ring of water that it pushed aside.
struct WaveImpulse {
    strength: f32,             // u at the centre
    ring: f32,                 // makes the sum over the free texels zero; computed on the CPU
}

// An impulse as a tile sees it.
struct WaveMember {
    centre: vec2f,             // texels from the tile's first one
    radius: f32,               // texels
    disc: u32,                 // in `impulses`
}

struct WaveTile {
    tile: vec2u,               // in units of tiles
    first: u32,                // in `members`
    count: u32,
}

struct WaveBatch {
    first: u32,                // in `tiles`
    count: u32,
}

// A splash binds the current state to be written, at the place where a step binds it to be read.
@group(1) @binding(3) var current_as_well: texture_storage_2d<r32float, read_write>;
@group(1) @binding(4) var<storage, read> tiles: array<WaveTile>;
@group(1) @binding(5) var<storage, read> members: array<WaveMember>;
@group(1) @binding(6) var<storage, read> impulses: array<WaveImpulse>;
@group(1) @binding(7) var<storage, read> batch: WaveBatch;

// Adds this step's impulses, one workgroup a touched tile, to u and u⁻ alike: to u alone they would be a kick as well.
@compute @workgroup_size(WAVE_TILE, WAVE_TILE)
fn wave_splash(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let index = workgroup.y * workgroups.x + workgroup.x;
    if index >= batch.count {
        return;
    }
    let tile = tiles[batch.first + index];
    let texel = tile.tile * WAVE_TILE + local.xy;
    if any(texel >= params.size) || (textureLoad(mask, min(texel, params.size - 1u), 0).x & WAVE_FREE) == 0u {
        return;
    }
    var sum = 0.0;
    for (var i = tile.first; i < tile.first + tile.count; i++) {
        let member = members[i];
        let impulse = impulses[member.disc];
        let offset = (vec2f(local.xy) - member.centre) / member.radius;
        let s = dot(offset, offset);
        let w = max(0.0, 1.0 - s);
        sum += impulse.strength * w * w * (1.0 - impulse.ring * s);
    }
    textureStore(current_as_well, texel, vec4f(textureLoad(current_as_well, texel).x + sum, 0.0, 0.0, 0.0));
    textureStore(previous, texel, vec4f(textureLoad(previous, texel).x + sum, 0.0, 0.0, 0.0));
}
