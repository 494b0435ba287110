//! Height fields of every kind, seeded.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{Rng, SeedableRng};
use rilievo::reference::{Addressing, HeightField};

/// Both ways to read beyond the border.
pub const ADDRESSINGS: [Addressing; 2] = [Addressing::Wrap, Addressing::Clamp];

/// What a field looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// White noise: no two texels have to do with each other.
    Noise,
    /// Spikes one texel wide, one in a hundred, on a low floor.
    Spikes,
    /// Square blocks of four heights with vertical walls.
    Steps,
    /// One height.
    Constant,
    /// Ridges and valleys of every size, as a digital elevation model has them.
    Elevation,
    /// Smooth interfering waves, as a simulation leaves them.
    Waves,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 6] = [Self::Noise, Self::Spikes, Self::Steps, Self::Constant, Self::Elevation, Self::Waves];

    /// A field of this kind.
    pub fn field(self, size: [u32; 2], addressing: Addressing) -> HeightField {
        let mut random = Random::new(self as u64 + 1);
        match self {
            Self::Noise => HeightField::from_fn(size, addressing, |_, _| random.uniform(0.0, 1.0)),
            Self::Spikes => HeightField::from_fn(size, addressing, |_, _| {
                if random.uniform(0.0, 1.0) < 0.01 { random.uniform(0.5, 1.0) } else { random.uniform(0.1, 0.12) }
            }),
            Self::Steps => HeightField::from_fn(size, addressing, |x, y| hash_height(x / 7, y / 5, 4)),
            Self::Constant => HeightField::from_fn(size, addressing, |_, _| 0.625),
            Self::Elevation => HeightField::from_fn(size, addressing, elevation),
            Self::Waves => HeightField::from_fn(size, addressing, |x, y| waves(x, y, size)),
        }
    }
}

/// One of `levels` heights for a block, the highest 1.
fn hash_height(x: u32, y: u32, levels: u32) -> f32 {
    let mixed = (x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77)).wrapping_mul(0xc2b2_ae3d);
    ((mixed >> 16) % levels) as f32 / (levels - 1) as f32
}

/// Folded value noise of six octaves, each half as high as the one before.
fn elevation(x: u32, y: u32) -> f32 {
    let mut height = 0.0;
    for octave in 0..6_u32 {
        let scale = 1.0 / (64 >> octave) as f32;
        let (fx, fy) = (x as f32 * scale, y as f32 * scale);
        let at = |dx: u32, dy: u32| hash_height(fx as u32 + dx + 131 * octave, fy as u32 + dy, 256);
        let (u, v) = (fx.fract(), fy.fract());
        let value = (1.0 - v) * ((1.0 - u) * at(0, 0) + u * at(1, 0)) + v * ((1.0 - u) * at(0, 1) + u * at(1, 1));
        height += (1.0 - (2.0 * value - 1.0).abs()) * 0.5_f32.powi(octave as i32 + 1);
    }
    height.clamp(0.0, 1.0)
}

/// Four waves that fit the field, so that it has no seam where it wraps.
fn waves(x: u32, y: u32, size: [u32; 2]) -> f32 {
    let phase = |kx: f32, ky: f32| std::f32::consts::TAU * (kx * x as f32 / size[0] as f32 + ky * y as f32 / size[1] as f32);
    let sum =
        phase(3.0, 1.0).cos() + 0.6 * phase(-5.0, 7.0).cos() + 0.3 * phase(11.0, -2.0).sin() + 0.15 * phase(23.0, 29.0).cos();
    (0.5 + 0.22 * sum).clamp(0.0, 1.0)
}

/// Seeded random numbers.
pub struct Random(Xoshiro256PlusPlus);

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(seed))
    }

    /// A number of [low, high).
    pub fn uniform(&mut self, low: f32, high: f32) -> f32 {
        let unit = (self.0.next_u64() >> 40) as f32 / (1_u32 << 24) as f32;
        low + unit * (high - low)
    }

    /// A number of [low, high), uniform in its logarithm.
    pub fn logarithmic(&mut self, low: f32, high: f32) -> f32 {
        self.uniform(low.ln(), high.ln()).exp()
    }

    /// An integer of 0..end.
    pub fn below(&mut self, end: u32) -> u32 {
        (self.0.next_u64() % u64::from(end)) as u32
    }

    /// One of −1 and 1.
    pub fn sign(&mut self) -> f32 {
        if self.below(2) == 0 { -1.0 } else { 1.0 }
    }

    /// A direction, a unit vector.
    pub fn direction(&mut self) -> [f32; 2] {
        let angle = self.uniform(0.0, std::f32::consts::TAU);
        [angle.cos(), angle.sin()]
    }
}
