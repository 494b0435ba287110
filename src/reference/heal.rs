//! Healing in f64: the specification of `shaders/field/heal.wgsl`.

use crate::field::heal::{fades, law};
use crate::field::material::Marks;

/// A height one step nearer to its base; what is no number, or infinite, is the base at once.
pub fn heal(height: f32, base: f32) -> f64 {
    let [kept, closes] = law();
    let base = f64::from(base);
    if !height.is_finite() {
        return base;
    }
    let departure = (f64::from(height) - base).clamp(-1.0, 1.0);
    base + departure.signum() * (kept * departure.abs() - closes).max(0.0)
}

/// Marks one step fainter, in the step of this number. Posts and heat stay.
pub fn wipe(marks: Marks, step: u64) -> Marks {
    // At most as many levels as a mark has.
    let [dust, gloss] = [255, 31].map(|levels| fades(levels, step) as u8);
    Marks {
        soot: marks.soot.saturating_sub(dust),
        bare: marks.bare.saturating_sub(dust),
        gloss: marks.gloss.saturating_sub(gloss),
        ..marks
    }
}
