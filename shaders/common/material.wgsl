// The material of a texel: what stamps left on it, in 32 bits. The layout stands here and in src/field/material.rs, which a test
// compares.
//
//   bits  0 to  7  soot: how black, of 255
//   bits  8 to 15  bare: how freshly broken, of 255
//   bit  16        post: 1 where one stands
//   bits 17 to 21  gloss: how much smoother than the material itself, of 31
//   bits 22 to 31  heat: 0 is cold; else 1 + the moment, modulo MATERIAL_MOMENTS, at which it glowed or would have glowed fully
//
// Heat is a time and not a brightness: e^(−age) needs no pass to cool, and no frame's length enters it. A moment is a 32nd of the
// time in which a glow falls to 1/e.

override MATERIAL_MOMENTS: i32;
override MATERIAL_MOMENTS_PER_FALL: f32;
// After so many a glow is none.
override MATERIAL_GLOWING_MOMENTS: f32;

fn material_soot(bits: u32) -> f32 {
    return f32(bits & 0xffu);
}

fn material_bare(bits: u32) -> f32 {
    return f32((bits >> 8u) & 0xffu);
}

fn material_post(bits: u32) -> f32 {
    return f32((bits >> 16u) & 1u);
}

fn material_gloss(bits: u32) -> f32 {
    return f32((bits >> 17u) & 0x1fu);
}

fn material_heat(bits: u32) -> u32 {
    return bits >> 22u;
}

// Levels of soot, bare and gloss, and a heat, over the post of other bits.
fn material_bits(before: u32, soot: f32, bare: f32, gloss: f32, heat: u32) -> u32 {
    return u32(soot) | (u32(bare) << 8u) | (before & 0x10000u) | (u32(gloss) << 17u) | (heat << 22u);
}

// Moments since a heat, at a moment of the clock; far too many where it is cold. The clock is at most as far ahead as glows last,
// twice; what rounding puts into the future is now.
fn material_age(heat: u32, moment: f32) -> f32 {
    if heat == 0u {
        return 1e9;
    }
    let age = moment - f32(heat - 1u);
    return max(0.0, select(age, age + f32(MATERIAL_MOMENTS), age < -400.0));
}

// How brightly a heat glows, of 1.
fn material_glow(heat: u32, moment: f32) -> f32 {
    let age = material_age(heat, moment);
    return select(0.0, exp(-age / MATERIAL_MOMENTS_PER_FALL), age < MATERIAL_GLOWING_MOMENTS);
}
