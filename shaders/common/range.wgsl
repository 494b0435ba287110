// Range: both ends of a range of heights in one f32, as integers in the bits that are exact: the upper, rounded up, and the lower,
// rounded down. src/field/bounds.rs owns the steps.

override HIGH_STEPS: u32;
override LOW_STEPS: u32;

struct Range {
    low: f32,
    high: f32,
}

fn range_packed(range: Range) -> f32 {
    return ceil(range.high * f32(HIGH_STEPS)) * f32(LOW_STEPS + 1u) + floor(range.low * f32(LOW_STEPS));
}

// A product by the reciprocal may be an ulp below the quotient: whoever reads the upper end allows for that.
fn range_unpacked(packed: f32) -> Range {
    let high = floor(packed * (1.0 / f32(LOW_STEPS + 1u)));
    let low = packed - high * f32(LOW_STEPS + 1u);
    return Range(low * (1.0 / f32(LOW_STEPS)), high * (1.0 / f32(HIGH_STEPS)));
}
