// Stamp: presses this frame's stamps into the relief and its material, in the order of their submission.
//
//   relief        r32float  read-write  heights with every stamp so far, unclamped; 1 = reference surface, 0 = deepest
//   material_map  r32uint   read-write  4×unorm8: r = soot, g = bare (fresh broken material), b = post, kept; a = 0
//
// One workgroup a touched tile gathers its stamps: no two write the same texel, so blends keep their order. 8 bytes a texel of
// a touched tile read and, where a stamp covers it, written; half of that if all stamps are plain. A stamp that misses a texel
// costs it a distance.
// Specification: src/reference/stamp.rs. Composed after common/noise.wgsl.

override STAMP_TILE_X: u32;
override STAMP_TILE_Y: u32;
// Whether all stamps are round and leave the material alone.
override STAMP_PLAIN: bool;
// The crater: its rim as a fraction of the radius, squared, and its lip's height as a fraction of its depth.
override STAMP_RIM_SQUARED: f32;
override STAMP_LIP: f32;
// How far grains of the broken material in an irregular crater stand out or lack, as a fraction of its depth.
override STAMP_GRAIN: f32;

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

// A stamp as a tile sees it.
struct StampMember {
    centre: vec2f,       // texels from the tile's first one
    radius: f32,         // texels
    disc: u32,           // in `stamps`
}

struct StampRecord {
    height: f32,         // of the profile's unit
    level: f32,          // from which min, max and replace count
    alpha: f32,          // of replace
    irregularity: f32,   // 0 = a circle
    phase: vec2f,        // a unit complex number: which of the irregular rims
    soot: f32,
    bare: f32,
    profile: u32,
    blend: u32,
}

struct StampTile {
    tile: vec2u,         // in units of tiles
    first: u32,          // in `members`
    count: u32,
}

@group(1) @binding(0) var<storage, read> params: StampParams;
@group(1) @binding(1) var relief: texture_storage_2d<r32float, read_write>;
@group(1) @binding(2) var material_map: texture_storage_2d<r32uint, read_write>;
@group(1) @binding(3) var<storage, read> tiles: array<StampTile>;
@group(1) @binding(4) var<storage, read> members: array<StampMember>;
@group(1) @binding(5) var<storage, read> stamps: array<StampRecord>;

// Four texels of a column at a time, a vector of them: what is read of a stamp serves them all.
@compute @workgroup_size(STAMP_TILE_X, STAMP_TILE_Y / 4)
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
    let texel = tile.tile * vec2u(STAMP_TILE_X, STAMP_TILE_Y) + vec2u(local.x, 4u * local.y);
    if any(texel >= params.size) {
        return;
    }
    let rows = vec4u(texel.y) + vec4u(0u, 1u, 2u, 3u);
    let within = rows < vec4u(params.size.y);
    let from_tile = vec2f(local.xy) * vec2f(1.0, 4.0);
    let from_tile_rows = from_tile.y + vec4f(0.0, 1.0, 2.0, 3.0);

    var height: vec4f;
    var material: vec4u;
    var soot: vec4f;
    var bare: vec4f;
    var grain: vec4f;
    for (var k = 0u; k < 4u; k++) {
        height[k] = textureLoad(relief, vec2u(texel.x, rows[k])).x;
        if !STAMP_PLAIN {
            material[k] = textureLoad(material_map, vec2u(texel.x, rows[k])).x;
            let unpacked = unpack4x8unorm(material[k]);
            soot[k] = unpacked.r;
            bare[k] = unpacked.g;
            grain[k] = 2.0 * STAMP_GRAIN * (hash_cell(vec2i(i32(texel.x), i32(rows[k])), 0u) - 0.5);
        }
    }
    var covered = vec4<bool>(false);
    for (var i = tile.first; i < tile.first + tile.count; i++) {
        let member = members[i];
        let offset_x = vec4f(from_tile.x - member.centre.x);
        let offset_y = from_tile_rows - member.centre.y;
        let squared = offset_x * offset_x + offset_y * offset_y;
        let inside = (squared < vec4f(member.radius * member.radius)) & within;
        if !any(inside) {
            continue;
        }
        covered |= inside;
        let stamp = stamps[member.disc];
        let s = stamp_irregular(stamp, offset_x, offset_y, squared, 1.0 / (member.radius * member.radius));
        var profile = stamp_profile(stamp.profile, s);
        if !STAMP_PLAIN && stamp.profile == STAMP_CRATER {
            profile += stamp.irregularity * grain * saturate(3.0 - s * (3.0 / STAMP_RIM_SQUARED));
        }
        height = select(height, stamp_blend(stamp, height, profile), inside);
        if !STAMP_PLAIN {
            // What lies within the rim is laid bare, which takes the old soot with it; then new soot falls, most round the rim.
            let bared = stamp.bare * (1.0 - smoothstep(vec4f(0.5 * STAMP_RIM_SQUARED), vec4f(STAMP_RIM_SQUARED), s));
            let falloff = max(vec4f(0.0), 1.0 - s);
            let outward = saturate(s * (1.0 / STAMP_RIM_SQUARED));
            let sooted = saturate(stamp.soot * falloff * falloff * (0.25 + 0.75 * outward * outward));
            let left = soot * (1.0 - bared);
            soot = select(soot, left + (1.0 - left) * sooted, inside);
            bare = select(bare, bare + (1.0 - bare) * bared, inside);
        }
    }
    for (var k = 0u; k < 4u; k++) {
        if covered[k] {
            textureStore(relief, vec2u(texel.x, rows[k]), vec4f(height[k], 0.0, 0.0, 0.0));
            if !STAMP_PLAIN {
                let packed = pack4x8unorm(vec4f(soot[k], bare[k], 0.0, 0.0)) | (material[k] & 0xffff0000u);
                textureStore(material_map, vec2u(texel.x, rows[k]), vec4u(packed, 0u, 0u, 0u));
            }
        }
    }
}

fn stamp_blend(stamp: StampRecord, height: vec4f, profile: vec4f) -> vec4f {
    let shape = stamp.level + stamp.height * profile;
    switch stamp.blend {
        case STAMP_ADD: { return height + stamp.height * profile; }
        case STAMP_MIN: { return min(height, shape); }
        case STAMP_MAX: { return max(height, shape); }
        default: { return mix(height, shape, stamp.alpha); }
    }
}

// The squared distance from the centre, in radii, as an irregular stamp sees it: stretched, never shrunk, by a sum of harmonics of
// the angle, so that the stamp keeps within its radius. cos nθ is the real part of the n-th power of the unit direction; 3, 5, 8
// and 13 each cost one product of powers at hand, and powers of the phase turn them against each other, so that no two rims are
// alike.
fn stamp_irregular(stamp: StampRecord, x: vec4f, y: vec4f, squared: vec4f, inverse_squared_radius: f32) -> vec4f {
    let s = squared * inverse_squared_radius;
    if STAMP_PLAIN {
        return s;
    }
    // At the very centre any direction will do.
    let inverse = inverseSqrt(max(squared, vec4f(1e-12)));
    let first = StampComplex(x * inverse, y * inverse);
    let second = stamp_times(first, first);
    let turn = StampComplex(vec4f(stamp.phase.x), vec4f(stamp.phase.y));
    let third = stamp_times(stamp_times(second, first), turn);
    let fifth = stamp_times(stamp_times(second, third), turn);
    let eighth = stamp_times(third, fifth);
    let thirteenth = stamp_times(fifth, eighth);
    let wave = 0.4 * third.re + 0.3 * fifth.re + 0.2 * eighth.re + 0.1 * thirteenth.re;
    let stretch = 1.0 + stamp.irregularity * (0.5 + 0.5 * wave);
    return s * stretch * stretch;
}

struct StampComplex {
    re: vec4f,
    im: vec4f,
}

fn stamp_times(a: StampComplex, b: StampComplex) -> StampComplex {
    return StampComplex(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}

// The profiles, as functions of the squared distance in radii. Each is 0 from s = 1 on.
fn stamp_profile(profile: u32, s: vec4f) -> vec4f {
    let w = max(vec4f(0.0), 1.0 - s);
    switch profile {
        case STAMP_DISC: { return select(vec4f(0.0), vec4f(1.0), s < vec4f(1.0)); }
        case STAMP_CONE: { return max(vec4f(0.0), 1.0 - sqrt(s)); }
        case STAMP_BUMP: { return w * w; }
        default: { return stamp_crater(s); }
    }
}

// A bowl from −1 up to its lip, half of it a bore down its middle, and the lip's outer flank. Slopes vanish at the centre, on the
// lip and at the border.
fn stamp_crater(s: vec4f) -> vec4f {
    let x = s * (1.0 / STAMP_RIM_SQUARED);
    let u = (1.0 - x) * (1.0 - x);
    let bowl = 0.5 * (1.0 + STAMP_LIP) * (x * x * (3.0 - 2.0 * x) + (1.0 - u * u * u)) - 1.0;
    let y = saturate((s - STAMP_RIM_SQUARED) * (1.0 / (1.0 - STAMP_RIM_SQUARED)));
    let w = (1.0 - y) * (1.0 - y);
    let flank = STAMP_LIP * w * w * (1.0 + 4.0 * y);
    return select(flank, bowl, x < vec4f(1.0));
}
