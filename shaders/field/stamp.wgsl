// Stamp: presses this frame's stamps into the relief and its material, in the order of their submission.
//
//   relief        r32float  read-write  heights with every stamp so far, unclamped; 1 = reference surface, 0 = deepest
//   material_map  r32uint   read-write  4×unorm8: r = soot, g = bare (fresh broken material), b and a = 0
//
// One workgroup a touched tile gathers its stamps: no two write the same texel, so blends keep their order. 8 bytes a texel of
// a touched tile read and, where a stamp covers it, written; a stamp that misses a texel costs it a distance.
// Specification: src/reference/stamp.rs.

override STAMP_TILE: u32;
// The crater: its rim as a fraction of the radius, squared, and its lip's height as a fraction of its depth.
override STAMP_RIM_SQUARED: f32;
override STAMP_LIP: f32;

const STAMP_DISC: u32 = 0u;
const STAMP_CONE: u32 = 1u;
const STAMP_BUMP: u32 = 2u;
const STAMP_CRATER: u32 = 3u;

const STAMP_ADD: u32 = 0u;
const STAMP_MIN: u32 = 1u;
const STAMP_MAX: u32 = 2u;
const STAMP_REPLACE: u32 = 3u;

struct StampParams {
    size: vec2u,
    tile_count: u32,
    spare: u32,
}

struct StampRecord {
    centre: vec2f,       // lattice coordinates
    shift: vec2i,        // texels from the field to the image of it that the centre lies in
    radius: f32,         // texels
    height: f32,         // of the profile's unit
    level: f32,          // from which min, max and replace count
    alpha: f32,          // of replace
    phase: vec2f,        // a unit complex number: which of the irregular rims
    irregularity: f32,   // 0 = a circle
    soot: f32,
    bare: f32,
    profile: u32,
    blend: u32,
    spare: u32,
}

struct StampTile {
    tile: vec2u,         // in units of tiles
    first: u32,          // in `members`
    count: u32,
}

@group(1) @binding(0) var<uniform> params: StampParams;
@group(1) @binding(1) var relief: texture_storage_2d<r32float, read_write>;
@group(1) @binding(2) var material_map: texture_storage_2d<r32uint, read_write>;
@group(1) @binding(3) var<storage, read> tiles: array<StampTile>;
@group(1) @binding(4) var<storage, read> members: array<u32>;
@group(1) @binding(5) var<storage, read> stamps: array<StampRecord>;

@compute @workgroup_size(STAMP_TILE, STAMP_TILE)
fn stamp_press(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let index = workgroup.y * workgroups.x + workgroup.x;
    if index >= params.tile_count {
        return;
    }
    let tile = tiles[index];
    let texel = tile.tile * STAMP_TILE + local.xy;
    if any(texel >= params.size) {
        return;
    }
    var height = textureLoad(relief, texel).x;
    var material = vec4f(0.0);
    var covered = false;
    var soiled = false;
    for (var i = tile.first; i < tile.first + tile.count; i++) {
        let id = members[i];
        let offset = vec2f(vec2i(texel) + stamps[id].shift) - stamps[id].centre;
        let squared = dot(offset, offset);
        let radius = stamps[id].radius;
        if squared >= radius * radius {
            continue;
        }
        let stamp = stamps[id];
        covered = true;
        let s = stamp_irregular(stamp, offset, squared / (radius * radius));
        let profile = stamp_profile(stamp.profile, s);
        let shape = stamp.level + stamp.height * profile;
        switch stamp.blend {
            case STAMP_ADD: { height += stamp.height * profile; }
            case STAMP_MIN: { height = min(height, shape); }
            case STAMP_MAX: { height = max(height, shape); }
            default: { height = mix(height, shape, stamp.alpha); }
        }
        if stamp.soot > 0.0 || stamp.bare > 0.0 {
            if !soiled {
                material = unpack4x8unorm(textureLoad(material_map, texel).x);
                soiled = true;
            }
            material = stamp_soil(stamp, s, material);
        }
    }
    if covered {
        textureStore(relief, texel, vec4f(height, 0.0, 0.0, 0.0));
    }
    if soiled {
        textureStore(material_map, texel, vec4u(pack4x8unorm(material), 0u, 0u, 0u));
    }
}

fn stamp_times(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// The squared distance from the centre, in radii, as seen by an irregular stamp: stretched, never shrunk, by a sum of harmonics
// of the angle, so that the stamp keeps within its radius. cos nθ is the real part of the n-th power of the unit direction; 3, 5,
// 8 and 13 each cost one product, and powers of the phase turn them against each other, so that no two rims are alike.
fn stamp_irregular(stamp: StampRecord, offset: vec2f, s: f32) -> f32 {
    if stamp.irregularity == 0.0 || s == 0.0 {
        return s;
    }
    let turn = stamp.phase;
    let direction = offset * inverseSqrt(dot(offset, offset));
    let third = stamp_times(stamp_times(stamp_times(direction, direction), direction), turn);
    let fifth = stamp_times(stamp_times(stamp_times(direction, direction), third), turn);
    let eighth = stamp_times(third, fifth);
    let thirteenth = stamp_times(fifth, eighth);
    let wave = 0.4 * third.x + 0.3 * fifth.x + 0.2 * eighth.x + 0.1 * thirteenth.x;
    let stretch = 1.0 + stamp.irregularity * (0.5 + 0.5 * wave);
    return s * stretch * stretch;
}

// The profiles, as polynomials of the squared distance in radii (the cone's apex apart). Each is 0 from s = 1 on.
fn stamp_profile(profile: u32, s: f32) -> f32 {
    switch profile {
        case STAMP_DISC: { return select(0.0, 1.0, s < 1.0); }
        case STAMP_CONE: { return max(0.0, 1.0 - sqrt(s)); }
        case STAMP_BUMP: { let w = max(0.0, 1.0 - s); return w * w; }
        default: { return stamp_crater(s); }
    }
}

// A bowl from −1 up to its lip, and the lip's outer flank: slopes vanish at the centre, on the lip and at the border.
fn stamp_crater(s: f32) -> f32 {
    if s < STAMP_RIM_SQUARED {
        let x = s / STAMP_RIM_SQUARED;
        return (1.0 + STAMP_LIP) * x * x * (3.0 - 2.0 * x) - 1.0;
    }
    let y = saturate((s - STAMP_RIM_SQUARED) / (1.0 - STAMP_RIM_SQUARED));
    let w = (1.0 - y) * (1.0 - y);
    return STAMP_LIP * w * w * (1.0 + 4.0 * y);
}

// Bares what lies within the rim, which takes the old soot with it, and lays new soot, most of it round the rim.
fn stamp_soil(stamp: StampRecord, s: f32, material: vec4f) -> vec4f {
    let bared = stamp.bare * (1.0 - smoothstep(0.5 * STAMP_RIM_SQUARED, STAMP_RIM_SQUARED, s));
    let w = max(0.0, 1.0 - s);
    let sooted = saturate(stamp.soot * w * w);
    let soot = material.r * (1.0 - bared);
    return vec4f(soot + (1.0 - soot) * sooted, material.g + (1.0 - material.g) * bared, material.ba);
}
