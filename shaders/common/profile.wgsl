// The profiles of stamps, as functions of the squared distance in radii. Each is 0 from s = 1 on.
//
// Specification: src/reference/stamp.rs.

// The crater: its rim as a fraction of the radius, squared, and its lip's height as a fraction of its depth.
override STAMP_RIM_SQUARED: f32;
override STAMP_LIP: f32;
// The rut: where its floor ends and where its lip is highest, as fractions of the radius, squared.
override STAMP_RUT_FLOOR_SQUARED: f32;
override STAMP_RUT_RIM_SQUARED: f32;

const STAMP_DISC: u32 = 0u;
const STAMP_CONE: u32 = 1u;
const STAMP_BUMP: u32 = 2u;
const STAMP_CRATER: u32 = 3u;
const STAMP_RUT: u32 = 4u;

fn stamp_profile(profile: u32, s: vec4f) -> vec4f {
    let w = max(vec4f(0.0), 1.0 - s);
    switch profile {
        case STAMP_DISC: { return select(vec4f(0.0), vec4f(1.0), s < vec4f(1.0)); }
        case STAMP_CONE: { return max(vec4f(0.0), 1.0 - sqrt(s)); }
        case STAMP_BUMP: { return w * w; }
        case STAMP_RUT: { return stamp_rut(s); }
        default: { return stamp_crater(s); }
    }
}

// A bowl from −1 up to its lip, half of it a bore down its middle, and the lip's outer flank. Slopes vanish at the centre, on the
// lip and at the border.
fn stamp_crater(s: vec4f) -> vec4f {
    let x = s * (1.0 / STAMP_RIM_SQUARED);
    let u = (1.0 - x) * (1.0 - x);
    let bowl = 0.5 * (1.0 + STAMP_LIP) * (x * x * (3.0 - 2.0 * x) + (1.0 - u * u * u)) - 1.0;
    return select(stamp_flank(s, STAMP_RIM_SQUARED), bowl, x < vec4f(1.0));
}

// A level floor at −1, a wall up to a lip, and the lip's outer flank: what a sole or a tyre leaves.
fn stamp_rut(s: vec4f) -> vec4f {
    let x = saturate((s - STAMP_RUT_FLOOR_SQUARED) * (1.0 / (STAMP_RUT_RIM_SQUARED - STAMP_RUT_FLOOR_SQUARED)));
    let inner = (1.0 + STAMP_LIP) * x * x * (3.0 - 2.0 * x) - 1.0;
    return select(stamp_flank(s, STAMP_RUT_RIM_SQUARED), inner, s < vec4f(STAMP_RUT_RIM_SQUARED));
}

// From the lip at a squared distance down to nothing at the border.
fn stamp_flank(s: vec4f, rim_squared: f32) -> vec4f {
    let y = saturate((s - rim_squared) * (1.0 / (1.0 - rim_squared)));
    let w = (1.0 - y) * (1.0 - y);
    return STAMP_LIP * w * w * (1.0 + 4.0 * y);
}

// A squared distance from the centre as an irregular stamp sees it: stretched, never shrunk, by a sum of harmonics of
// the angle, so that the stamp keeps within its radius. cos nθ is the real part of the n-th power of the unit direction; 3, 5, 8
// and 13 each cost one product of powers at hand, and powers of the phase turn them against each other, so that no two rims are
// alike.
fn stamp_stretched(irregularity: f32, phase: vec2f, x: vec4f, y: vec4f, squared: vec4f) -> vec4f {
    // At the very centre any direction will do.
    let inverse = inverseSqrt(max(squared, vec4f(1e-12)));
    let first = StampComplex(x * inverse, y * inverse);
    let second = stamp_times(first, first);
    let turn = StampComplex(vec4f(phase.x), vec4f(phase.y));
    let third = stamp_times(stamp_times(second, first), turn);
    let fifth = stamp_times(stamp_times(second, third), turn);
    let eighth = stamp_times(third, fifth);
    let thirteenth = stamp_times(fifth, eighth);
    let wave = 0.4 * third.re + 0.3 * fifth.re + 0.2 * eighth.re + 0.1 * thirteenth.re;
    let stretch = 1.0 + irregularity * (0.5 + 0.5 * wave);
    return squared * stretch * stretch;
}

struct StampComplex {
    re: vec4f,
    im: vec4f,
}

fn stamp_times(a: StampComplex, b: StampComplex) -> StampComplex {
    return StampComplex(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}
