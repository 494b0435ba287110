//! The material of a texel: what stamps left on it, in 32 bits, and the clock of what glows. The layout is that of
//! `shaders/common/material.wgsl`.

/// The bits of [`Material`](super::Material) where a post stands.
pub const POST: u32 = 1 << 16;

/// How many moments the clock of heat tells apart before it starts over.
pub const MOMENTS: u32 = 1023;

/// Moments in which a glow falls to 1/e.
pub const MOMENTS_PER_FALL: f64 = 32.0;

/// After how many moments a full glow is none: at e⁻⁹, an eight-thousandth.
pub const GLOWING_MOMENTS: f64 = 288.0;

/// What every kernel is told that reads or writes materials.
pub(crate) const CONSTANTS: [(&str, f64); 3] = [
    ("MATERIAL_MOMENTS", MOMENTS as f64),
    ("MATERIAL_MOMENTS_PER_FALL", MOMENTS_PER_FALL),
    ("MATERIAL_GLOWING_MOMENTS", GLOWING_MOMENTS),
];

/// What stamps left on a texel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Marks {
    /// How black, of 255.
    pub soot: u8,
    /// How freshly broken, of 255.
    pub bare: u8,
    /// Whether a post stands there.
    pub post: bool,
    /// How much smoother than the material itself, of 31.
    pub gloss: u8,
    /// 0 is cold; else 1 + the moment, modulo [`MOMENTS`], at which it glowed or would have glowed fully.
    pub heat: u16,
}

impl Marks {
    /// The marks in the bits of a texel.
    pub const fn from_bits(bits: u32) -> Self {
        Self {
            soot: (bits & 0xff) as u8,
            bare: (bits >> 8 & 0xff) as u8,
            post: bits & POST != 0,
            gloss: (bits >> 17 & 0x1f) as u8,
            heat: (bits >> 22) as u16,
        }
    }

    /// The bits of these marks.
    pub const fn bits(self) -> u32 {
        self.soot as u32
            | (self.bare as u32) << 8
            | if self.post { POST } else { 0 }
            | (self.gloss as u32 & 0x1f) << 17
            | (self.heat as u32) << 22
    }
}

/// The clock of heat at a time, where a glow falls to 1/e in so many seconds: moments, of [`MOMENTS`].
pub fn moment(seconds: f64, cooling_seconds: f64) -> f32 {
    let moment = (seconds * (MOMENTS_PER_FALL / cooling_seconds)).rem_euclid(f64::from(MOMENTS)) as f32;
    // What rounds up to the end is the beginning.
    if moment < MOMENTS as f32 { moment } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_hold_every_mark() {
        for marks in [
            Marks { soot: 200, bare: 3, post: true, gloss: 31, heat: 1023 },
            Marks { soot: 0, bare: 255, post: false, gloss: 17, heat: 1 },
            Marks::default(),
        ] {
            assert_eq!(Marks::from_bits(marks.bits()), marks);
        }
        assert_eq!(Marks { post: true, ..Marks::default() }.bits(), POST);
    }

    #[test]
    fn the_clock_of_heat_starts_over() {
        assert_eq!(moment(0.0, 2.0), 0.0);
        assert_eq!(moment(2.0, 2.0), 32.0);
        assert_eq!(moment(2.0 * 1024.0 / 32.0, 2.0), 1.0);
        assert!((0..100_000).all(|step| moment(f64::from(step) * 0.0137, 1.3) < 1023.0));
    }
}
