// Stamp: presses this frame's stamps into the relief and its material, in the order of their submission.
//
//   relief        r32float  read-write  heights with every stamp so far, unclamped; 1 = reference surface, 0 = deepest
//   material_map  r32uint   read-write  soot, bare, post, gloss, heat: see common/material.wgsl
//   images        r32float  read        profiles of image stamps, beside one another
//
// One workgroup a touched tile gathers its stamps: no two write the same texel, so blends keep their order. 8 bytes a texel of
// a touched tile read and, where a stamp covers it, written; half of that if all stamps are plain. A stamp that misses a texel
// costs it a distance. Material is rounded to its levels after every stamp, so that it does not matter how many share a dispatch.
// Specification: src/reference/stamp.rs. Composed after common/noise, common/material, common/profile and common/marks.

override STAMP_TILE_X: u32;
override STAMP_TILE_Y: u32;
// Whether all stamps are round and leave the material alone.
override STAMP_PLAIN: bool;
// Whether some are swept, or images.
override STAMP_FORMS: bool;
// How far grains of the broken material in an irregular crater stand out or lack, as a fraction of its depth.
override STAMP_GRAIN: f32;

const STAMP_ADD: u32 = 0u;
const STAMP_MIN: u32 = 1u;
const STAMP_MAX: u32 = 2u;
const STAMP_REPLACE: u32 = 3u;

struct StampParams {
    size: vec2u,
    tile_count: u32,
    first_tile: u32,
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
    profile: u32,
    blend: u32,
}

// What plain stamps lack.
struct StampExtra {
    phase: vec2f,        // a unit complex number: which of the irregular rims
    span: vec2f,         // from the centre to the end of what it is swept along, texels
    joins: vec2f,        // from the centre back to where the segment before began, texels; 0: it begins on its own
    axis: vec2f,         // unit: where an image's rows run
    half_extent: vec2f,  // of an image, texels; 0: it is none
    image_origin: vec2u, // in `images`
    image_size: vec2u,
    irregularity: f32,   // 0 = a circle
    soot: f32,
    bare: f32,
    gloss: f32,
    heat: f32,           // how brightly it glows when it is pressed, 0 to 1
    moment: f32,         // when that is: see common/material.wgsl
    along: f32,          // how far along its track it begins, in lugs of its tread
    tread: f32,          // how much of the height the lugs take
    lugs_per_texel: f32,
    spare: f32,
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
@group(1) @binding(6) var<storage, read> extras: array<StampExtra>;
@group(1) @binding(7) var images: texture_2d<f32>;

// What four texels of a column are made of, in levels; heats are whole numbers.
struct StampMaterial {
    soot: vec4f,
    bare: vec4f,
    gloss: vec4f,
    heat: vec4u,
}

// Where a stamp's own form sees four texels.
struct StampPlace {
    squared: vec4f,      // distance from what it is swept along, squared, texels
    profile: vec4f,      // its profile there, less what the segment before it has pressed
    s: vec4f,            // the distance in radii, squared, as its irregular form sees it
    before: vec4f,       // the same of the segment before it; far outside where there is none
    inside: vec4<bool>,
}

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
    let tile = tiles[params.first_tile + index];
    let texel = tile.tile * vec2u(STAMP_TILE_X, STAMP_TILE_Y) + vec2u(local.x, 4u * local.y);
    if any(texel >= params.size) {
        return;
    }
    let rows = vec4u(texel.y) + vec4u(0u, 1u, 2u, 3u);
    let within = rows < vec4u(params.size.y);
    let from_tile = vec2f(local.xy) * vec2f(1.0, 4.0);
    let from_tile_rows = from_tile.y + vec4f(0.0, 1.0, 2.0, 3.0);

    var height: vec4f;
    var bits: vec4u;
    var material: StampMaterial;
    var grain: vec4f;
    for (var k = 0u; k < 4u; k++) {
        height[k] = textureLoad(relief, vec2u(texel.x, rows[k])).x;
        if !STAMP_PLAIN {
            bits[k] = textureLoad(material_map, vec2u(texel.x, rows[k])).x;
            material.soot[k] = material_soot(bits[k]);
            material.bare[k] = material_bare(bits[k]);
            material.gloss[k] = material_gloss(bits[k]);
            material.heat[k] = material_heat(bits[k]);
            grain[k] = 2.0 * STAMP_GRAIN * (hash_cell(vec2i(i32(texel.x), i32(rows[k])), 0u) - 0.5);
        }
    }
    var covered = vec4<bool>(false);
    for (var i = tile.first; i < tile.first + tile.count; i++) {
        let member = members[i];
        let offset_x = vec4f(from_tile.x - member.centre.x);
        let offset_y = from_tile_rows - member.centre.y;
        if STAMP_PLAIN {
            let squared = offset_x * offset_x + offset_y * offset_y;
            let inside = (squared < vec4f(member.radius * member.radius)) & within;
            if any(inside) {
                covered |= inside;
                let stamp = stamps[member.disc];
                let profile = stamp_profile(stamp.profile, squared * (1.0 / (member.radius * member.radius)));
                height = select(height, stamp_blend(stamp, height, profile), inside);
            }
        } else {
            let stamp = stamps[member.disc];
            let extra = extras[member.disc];
            var place = stamp_place(stamp, extra, member.radius, offset_x, offset_y);
            place.inside &= within;
            if any(place.inside) {
                covered |= place.inside;
                // An image is all that it is pressed with: no grain is added to it.
                if stamp.profile == STAMP_CRATER && (!STAMP_FORMS || extra.half_extent.x == 0.0) {
                    place.profile += extra.irregularity * grain * saturate(3.0 - place.s * (3.0 / STAMP_RIM_SQUARED));
                }
                height = select(height, stamp_blend(stamp, height, place.profile), place.inside);
                material = stamp_mark(stamp, extra, place, material);
            }
        }
    }
    for (var k = 0u; k < 4u; k++) {
        if covered[k] {
            textureStore(relief, vec2u(texel.x, rows[k]), vec4f(height[k], 0.0, 0.0, 0.0));
            if !STAMP_PLAIN {
                let packed = material_bits(bits[k], material.soot[k], material.bare[k], material.gloss[k], material.heat[k]);
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

fn stamp_place(stamp: StampRecord, extra: StampExtra, radius: f32, offset_x: vec4f, offset_y: vec4f) -> StampPlace {
    let inverse_squared_radius = 1.0 / (radius * radius);
    var place: StampPlace;
    place.before = vec4f(2.0);
    if !STAMP_FORMS {
        place.squared = offset_x * offset_x + offset_y * offset_y;
        place.inside = place.squared < vec4f(radius * radius);
        place.s = stamp_stretched(extra.irregularity, extra.phase, offset_x, offset_y, place.squared) * inverse_squared_radius;
        place.profile = stamp_profile(stamp.profile, place.s);
        return place;
    }
    if extra.half_extent.x > 0.0 {
        return stamp_image_place(extra, offset_x, offset_y);
    }
    let t = stamp_nearest(extra.span, offset_x, offset_y);
    let x = offset_x - t * extra.span.x;
    let y = offset_y - t * extra.span.y;
    place.squared = x * x + y * y;
    place.inside = place.squared < vec4f(radius * radius);
    place.s = stamp_stretched(extra.irregularity, extra.phase, x, y, place.squared) * inverse_squared_radius;
    place.profile = stamp_profile(stamp.profile, place.s);
    if any(extra.joins != vec2f(0.0)) {
        // Of a chain each texel counts its nearest segment once: this one adds what the one before it has not.
        let u = stamp_nearest(extra.joins, offset_x, offset_y);
        let back_x = offset_x - u * extra.joins.x;
        let back_y = offset_y - u * extra.joins.y;
        let back = back_x * back_x + back_y * back_y;
        place.before = stamp_stretched(extra.irregularity, extra.phase, back_x, back_y, back) * inverse_squared_radius;
        place.profile = stamp_profile(stamp.profile, min(place.s, place.before)) - stamp_profile(stamp.profile, place.before);
    }
    if extra.tread > 0.0 {
        // Lugs aslant to the track, alike on both sides of its middle.
        let across = sqrt(place.s);
        let lugs = extra.along + extra.lugs_per_texel * (t * length(extra.span) + 0.5 * radius * across);
        let wave = abs(2.0 * fract(lugs) - 1.0);
        place.profile *= 1.0 - extra.tread * wave * wave * (3.0 - 2.0 * wave);
    }
    return place;
}

// How far along a span its nearest point lies, 0 to 1.
fn stamp_nearest(span: vec2f, x: vec4f, y: vec4f) -> vec4f {
    let squared = dot(span, span);
    return saturate((x * span.x + y * span.y) * select(0.0, 1.0 / squared, squared > 0.0));
}

// An image in a frame of its own: its value is the profile.
fn stamp_image_place(extra: StampExtra, x: vec4f, y: vec4f) -> StampPlace {
    let u = (x * extra.axis.x + y * extra.axis.y) / extra.half_extent.x;
    let v = (y * extra.axis.x - x * extra.axis.y) / extra.half_extent.y;
    var place: StampPlace;
    place.before = vec4f(2.0);
    place.inside = (abs(u) < vec4f(1.0)) & (abs(v) < vec4f(1.0));
    for (var k = 0u; k < 4u; k++) {
        if place.inside[k] {
            place.profile[k] = stamp_image(extra, vec2f(u[k], v[k]));
        }
    }
    place.s = 1.0 - place.profile;
    return place;
}

// Bilinear between the centres of the image's texels, beyond which its border goes on.
fn stamp_image(extra: StampExtra, at: vec2f) -> f32 {
    let last = vec2f(extra.image_size) - 1.0;
    let lattice = clamp((0.5 * at + 0.5) * vec2f(extra.image_size) - 0.5, vec2f(0.0), last);
    let cell = floor(lattice);
    let f = lattice - cell;
    let low = extra.image_origin + vec2u(cell);
    let high = extra.image_origin + vec2u(min(cell + 1.0, last));
    let north = mix(textureLoad(images, low, 0).r, textureLoad(images, vec2u(high.x, low.y), 0).r, f.x);
    let south = mix(textureLoad(images, vec2u(low.x, high.y), 0).r, textureLoad(images, high, 0).r, f.x);
    return mix(north, south, f.y);
}

// What lies within the rim is laid bare, which takes the old soot and gloss with it; then new soot falls, most round the rim. Each is
// rounded to its levels.
fn stamp_mark(stamp: StampRecord, extra: StampExtra, place: StampPlace, before: StampMaterial) -> StampMaterial {
    let rim_squared = select(1.0, STAMP_RIM_SQUARED, stamp.profile == STAMP_CRATER);
    let hard = stamp.profile == STAMP_DISC && !(STAMP_FORMS && extra.half_extent.x > 0.0);
    let core = stamp_core(place.s, rim_squared, hard);
    var bared = extra.bare * core;
    var glossed = extra.gloss * core;
    var sooted = extra.soot * stamp_fall(place.s, rim_squared);
    if STAMP_FORMS {
        let core_before = stamp_core(place.before, rim_squared, hard);
        bared = stamp_rest(bared, extra.bare * core_before);
        glossed = stamp_rest(glossed, extra.gloss * core_before);
        sooted = stamp_rest(sooted, extra.soot * stamp_fall(place.before, rim_squared));
        if extra.half_extent.x > 0.0 {
            sooted = extra.soot * saturate(place.profile);
        }
    }
    let soot = before.soot * (1.0 - bared);
    let gloss = before.gloss * (1.0 - bared);
    var after: StampMaterial;
    after.soot = floor(soot + (255.0 - soot) * sooted + 0.5);
    after.bare = floor(before.bare + (255.0 - before.bare) * bared + 0.5);
    after.gloss = floor(gloss + (31.0 - gloss) * glossed + 0.5);
    after.heat = before.heat;
    if extra.heat > 0.0 {
        let falloff = max(vec4f(0.0), 1.0 - place.s);
        // Within a crater's rim, and hardly beyond.
        let glow = extra.heat * falloff * falloff * falloff * falloff * falloff;
        for (var k = 0u; k < 4u; k++) {
            after.heat[k] = stamp_hotter(before.heat[k], glow[k], extra.moment);
        }
    }
    after.soot = select(before.soot, after.soot, place.inside);
    after.bare = select(before.bare, after.bare, place.inside);
    after.gloss = select(before.gloss, after.gloss, place.inside);
    after.heat = select(before.heat, after.heat, place.inside);
    return after;
}
