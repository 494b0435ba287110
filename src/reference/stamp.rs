//! Stamps in f64, one after another over every texel: the specification of `shaders/field/stamp.wgsl`.

use crate::field::base::hash_cell;
use crate::field::stamp::{Blend, CRATER_GRAIN, CRATER_LIP, CRATER_RIM, Profile, Stamp};

/// The layers that stamps are pressed into.
#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    /// Width and height, texels.
    pub size: [usize; 2],
    /// Whether the field repeats beyond its border.
    pub wrap: bool,
    /// Heights, unclamped, row by row.
    pub relief: Vec<f64>,
    /// Soot and bareness, 0 to 1.
    pub material: Vec<[f64; 2]>,
}

impl Layers {
    /// Layers of one height, clean.
    pub fn flat(size: [usize; 2], wrap: bool, height: f64) -> Self {
        let count = size[0] * size[1];
        Self { size, wrap, relief: vec![height; count], material: vec![[0.0; 2]; count] }
    }

    /// Presses one stamp: where the field wraps, once for each image of a texel that it covers.
    pub fn press(&mut self, stamp: &Stamp) {
        let reach = |axis: usize| {
            let (centre, radius, size) = (f64::from(stamp.centre[axis]), f64::from(stamp.radius), self.size[axis] as f64);
            if self.wrap { ((centre - radius) / size).floor() as i64..=((centre + radius) / size).floor() as i64 } else { 0..=0 }
        };
        let (columns, rows) = (reach(0), reach(1));
        for image_y in rows {
            for image_x in columns.clone() {
                for y in 0..self.size[1] {
                    for x in 0..self.size[0] {
                        let offset = [
                            (x as i64 + image_x * self.size[0] as i64) as f64 - f64::from(stamp.centre[0]),
                            (y as i64 + image_y * self.size[1] as i64) as f64 - f64::from(stamp.centre[1]),
                        ];
                        if offset[0].hypot(offset[1]) < f64::from(stamp.radius) {
                            self.press_texel(y * self.size[0] + x, stamp, offset);
                        }
                    }
                }
            }
        }
    }

    fn press_texel(&mut self, index: usize, stamp: &Stamp, offset: [f64; 2]) {
        let rho = stretched(stamp, offset);
        let texel = [(index % self.size[0]) as i32, (index / self.size[0]) as i32];
        let profile = profile(stamp.profile, rho) + grain(stamp, texel, rho);
        let (height, level, alpha) = (f64::from(stamp.height), f64::from(stamp.level), f64::from(stamp.alpha));
        let shape = level + height * profile;
        let layer = &mut self.relief[index];
        *layer = match stamp.blend {
            Blend::Add => *layer + height * profile,
            Blend::Min => layer.min(shape),
            Blend::Max => layer.max(shape),
            Blend::Replace => *layer + (shape - *layer) * alpha,
        };

        let s = rho * rho;
        let rim = CRATER_RIM * CRATER_RIM;
        let bared = f64::from(stamp.bare) * (1.0 - smoothstep(0.5 * rim, rim, s));
        let outward = (s / rim).min(1.0);
        let sooted = f64::from(stamp.soot) * (1.0 - s).max(0.0).powi(2) * (0.25 + 0.75 * outward * outward);
        let [soot, bare] = &mut self.material[index];
        *soot *= 1.0 - bared;
        *soot += (1.0 - *soot) * sooted.clamp(0.0, 1.0);
        *bare += (1.0 - *bare) * bared;
    }
}

/// The distance from the stamp's centre in radii, as its irregular form sees it: never less than on a circle.
pub fn stretched(stamp: &Stamp, offset: [f64; 2]) -> f64 {
    let rho = offset[0].hypot(offset[1]) / f64::from(stamp.radius);
    let (angle, phase) = (offset[1].atan2(offset[0]), f64::from(stamp.phase));
    // Each harmonic's phase is a multiple of the stamp's own, so that another phase is another form and not a turn of the same.
    let wave = 0.4 * (3.0 * angle + phase).cos()
        + 0.3 * (5.0 * angle + 2.0 * phase).cos()
        + 0.2 * (8.0 * angle + 3.0 * phase).cos()
        + 0.1 * (13.0 * angle + 5.0 * phase).cos();
    rho * (1.0 + f64::from(stamp.irregularity) * (0.5 + 0.5 * wave))
}

/// The profile at a distance of ρ radii from the centre.
pub fn profile(profile: Profile, rho: f64) -> f64 {
    if rho >= 1.0 {
        return 0.0;
    }
    match profile {
        Profile::Disc => 1.0,
        Profile::Cone => 1.0 - rho,
        Profile::Bump => (1.0 - rho * rho).powi(2),
        Profile::Crater => {
            let (s, rim) = (rho * rho, CRATER_RIM * CRATER_RIM);
            if s < rim {
                let x = s / rim;
                let (bowl, bore) = (x * x * (3.0 - 2.0 * x), 1.0 - (1.0 - x).powi(6));
                (1.0 + CRATER_LIP) * (bowl + bore) / 2.0 - 1.0
            } else {
                let y = (s - rim) / (1.0 - rim);
                CRATER_LIP * (1.0 - y).powi(4) * (1.0 + 4.0 * y)
            }
        }
    }
}

/// What the grains of the broken material add in an irregular crater: nothing from the rim on.
fn grain(stamp: &Stamp, texel: [i32; 2], rho: f64) -> f64 {
    if stamp.profile != Profile::Crater {
        return 0.0;
    }
    let inward = (3.0 * (1.0 - rho * rho / (CRATER_RIM * CRATER_RIM))).clamp(0.0, 1.0);
    f64::from(stamp.irregularity) * CRATER_GRAIN * (2.0 * hash_cell(texel, 0) - 1.0) * inward
}

fn smoothstep(low: f64, high: f64, value: f64) -> f64 {
    let t = ((value - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
