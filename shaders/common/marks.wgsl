// How much of its soot, bareness, gloss and heat a stamp leaves where, by the squared distance in radii.
//
// Composed after common/material. Specification: src/reference/stamp.rs.

// What lies well within the rim, or within a hard edge: laid bare, or polished.
fn stamp_core(s: vec4f, rim_squared: f32, hard: bool) -> vec4f {
    if hard {
        return select(vec4f(0.0), vec4f(1.0), s < vec4f(1.0));
    }
    return 1.0 - smoothstep(vec4f(0.5 * rim_squared), vec4f(rim_squared), s);
}

// Where soot falls: most round the rim.
fn stamp_fall(s: vec4f, rim_squared: f32) -> vec4f {
    let falloff = max(vec4f(0.0), 1.0 - s);
    let outward = saturate(s * (1.0 / rim_squared));
    return saturate(falloff * falloff * (0.25 + 0.75 * outward * outward));
}

// What must still cover what is left, so that the whole covers so much, where a part of it has been covered before.
fn stamp_rest(whole: vec4f, part: vec4f) -> vec4f {
    return select(vec4f(0.0), (whole - part) / max(1.0 - part, vec4f(1e-6)), whole > part);
}

// The hotter of a heat and of a glow at a moment.
fn stamp_hotter(heat: u32, glow: f32, moment: f32) -> u32 {
    let age = -MATERIAL_MOMENTS_PER_FALL * log(max(glow, 1e-9));
    if age >= MATERIAL_GLOWING_MOMENTS || age >= material_age(heat, moment) {
        return heat;
    }
    let began = i32(floor(moment - age));
    return 1u + u32(select(began, began + MATERIAL_MOMENTS, began < 0));
}
