//! ꟻLIP: how much of a difference one sees when two pictures take turns on a screen.
//!
//! P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. Fairchild, *ꟻLIP: A Difference Evaluator for
//! Alternating Images*, HPG 2020, for pictures of low dynamic range. Two pipelines meet in every pixel: colours, blurred as the eye
//! blurs them at this distance (§4.1), and features, edges and points, whose loss or gain makes a difference of colour more
//! obvious (§4.2). 0 is the same, 1 as different as can be. Section numbers below are the paper's.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

/// Pixels of a degree of the field of view: a screen of 3840 pixels on 0.7 m, seen from 0.7 m, the paper's own setting.
const PIXELS_PER_DEGREE: f64 = 0.7 * 3840.0 / 0.7 * PI / 180.0;

/// Exponent of the colour difference (§4.1.3).
const COLOUR_EXPONENT: f64 = 0.7;
/// Share of the largest colour difference up to which differences are spread over [`SPREAD_TO`] of the result (§4.1.3).
const SPREAD_FROM: f64 = 0.4;
/// See [`SPREAD_FROM`].
const SPREAD_TO: f64 = 0.95;
/// Exponent of the feature difference (§4.2.2).
const FEATURE_EXPONENT: f64 = 0.5;
/// Width of a feature, degrees: a peak of the eye's response (§4.2.1).
const FEATURE_WIDTH_DEGREES: f64 = 0.082;

/// A Gaussian of the contrast sensitivity function of one opponent channel: `a·√(π/b)·e^(−π²d²/b)` at d degrees (Table 1).
struct Sensitivity {
    a: f64,
    b: f64,
}

/// Achromatic.
const LIGHTNESS: [Sensitivity; 1] = [Sensitivity { a: 1.0, b: 0.0047 }];
/// Red against green.
const RED_GREEN: [Sensitivity; 1] = [Sensitivity { a: 1.0, b: 0.0053 }];
/// Blue against yellow, the widest.
const BLUE_YELLOW: [Sensitivity; 2] = [Sensitivity { a: 34.1, b: 0.04 }, Sensitivity { a: 13.5, b: 0.025 }];

/// What one sees of a picture: the half of the work that is its own.
pub struct Seen {
    /// L*, a* and b*, blurred by the eye, the latter two as weak as the light (§4.1.2).
    lab: [Plane; 3],
    /// Gradient and curvature of the luminance, along x and y.
    edge: [Plane; 2],
    point: [Plane; 2],
}

impl Seen {
    /// Looks at a picture: RGBA in sRGB, row by row.
    pub fn new(rgba: &[u8], size: [u32; 2]) -> Self {
        let size = size.map(|side| side as usize);
        let space = Space::new();
        let opponent = Plane::three(size, rgba.chunks_exact(4).map(|pixel| space.opponent(space.linear(pixel))));
        let blurred = [blurred(&opponent[0], &LIGHTNESS), blurred(&opponent[1], &RED_GREEN), blurred(&opponent[2], &BLUE_YELLOW)];
        let pixels =
            (0..size[0] * size[1]).map(|i| space.hunt_lab(DVec3::from([0, 1, 2].map(|c| f64::from(blurred[c].values[i])))));
        let lab = Plane::three(size, pixels);
        // Luminance from 0 to 1.
        let [mut luminance, ..] = opponent;
        luminance.values.iter_mut().for_each(|y| *y = (*y + 16.0) / 116.0);
        let Features { smooth, slope, curve } = Features::new();
        let edge = [luminance.filtered(&slope, &smooth), luminance.filtered(&smooth, &slope)];
        let point = [luminance.filtered(&curve, &smooth), luminance.filtered(&smooth, &curve)];
        Self { lab, edge, point }
    }

    /// The difference of every pixel, 0 to 1.
    ///
    /// # Panics
    ///
    /// The pictures have different sizes.
    pub fn differences(&self, other: &Self) -> Vec<f32> {
        assert_eq!(self.lab[0].size, other.lab[0].size, "pictures of one size");
        let space = Space::new();
        let greatest = hyab(space.hunt_lab_of_linear(DVec3::Y), space.hunt_lab_of_linear(DVec3::Z)).powf(COLOUR_EXPONENT);
        let at = |planes: &[Plane], i: usize| DVec3::from([0, 1, 2].map(|c| f64::from(planes[c].values[i])));
        let magnitude = |[x, y]: &[Plane; 2], i: usize| f64::from(x.values[i]).hypot(f64::from(y.values[i]));
        (0..self.lab[0].values.len())
            .map(|i| {
                let colour = spread(hyab(at(&self.lab, i), at(&other.lab, i)).powf(COLOUR_EXPONENT), greatest);
                let edge = (magnitude(&self.edge, i) - magnitude(&other.edge, i)).abs();
                let point = (magnitude(&self.point, i) - magnitude(&other.point, i)).abs();
                // (§4.2.2): a lost or new feature lowers the exponent and so brings the colour's difference nearer to 1 (§4.3).
                let feature = (edge.max(point) / 2.0_f64.sqrt()).powf(FEATURE_EXPONENT);
                #[expect(clippy::cast_possible_truncation, reason = "a number from 0 to 1")]
                let difference = colour.powf(1.0 - feature) as f32;
                difference
            })
            .collect()
    }
}

/// The distance of two colours for the eye: lightness by city blocks, the rest as the crow flies (HyAB, §4.1.3).
fn hyab(a: DVec3, b: DVec3) -> f64 {
    (a.x - b.x).abs() + (a.y - b.y).hypot(a.z - b.z)
}

/// Spreads colour differences over 0 to 1: the greatest are rare, and would leave the others crowded near 0 (§4.1.3).
fn spread(difference: f64, greatest: f64) -> f64 {
    let knee = SPREAD_FROM * greatest;
    if difference < knee {
        SPREAD_TO / knee * difference
    } else {
        SPREAD_TO + (difference - knee) / (greatest - knee) * (1.0 - SPREAD_TO)
    }
}

/// The filter of a contrast sensitivity function, a sum of Gaussians, and so of separable filters.
fn blurred(plane: &Plane, sum: &[Sensitivity]) -> Plane {
    // Three standard deviations of the widest Gaussian of all, for every channel alike.
    let widest = BLUE_YELLOW.iter().map(|term| term.b).fold(0.0, f64::max);
    let radius = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil();
    let terms: Vec<(f64, Vec<f64>)> = sum
        .iter()
        .map(|Sensitivity { a, b }| {
            (a * (PI / b).sqrt(), taps(radius, |pixels| (-(PI * pixels / PIXELS_PER_DEGREE).powi(2) / b).exp()))
        })
        .collect();
    // Each Gaussian weighs as much as its taps over the plane; together they weigh 1.
    let weights = terms.iter().map(|(height, taps)| height * taps.iter().sum::<f64>().powi(2));
    let total: f64 = weights.clone().sum();
    let mut blurred = Plane { size: plane.size, values: vec![0.0; plane.values.len()] };
    for (weight, (_, taps)) in weights.zip(&terms) {
        let sum: f64 = taps.iter().sum();
        let unit: Vec<f32> = taps.iter().map(|tap| (tap / sum) as f32).collect();
        let share = (weight / total) as f32;
        let term = plane.filtered(&unit, &unit);
        blurred.values.iter_mut().zip(&term.values).for_each(|(sum, value)| *sum += share * value);
    }
    blurred
}

fn taps(radius: f64, tap: impl Fn(f64) -> f64) -> Vec<f64> {
    let radius = radius as i32;
    (-radius..=radius).map(|pixels| tap(f64::from(pixels))).collect()
}

/// The kernels of the feature detectors along one axis (§4.2.1): a Gaussian and its first and second derivatives.
struct Features {
    smooth: Vec<f32>,
    slope: Vec<f32>,
    curve: Vec<f32>,
}

impl Features {
    fn new() -> Self {
        let deviation = 0.5 * FEATURE_WIDTH_DEGREES * PIXELS_PER_DEGREE;
        let radius = (3.0 * deviation).ceil();
        let gauss = |x: f64| (-(x * x) / (2.0 * deviation * deviation)).exp();
        Self {
            smooth: balanced(&taps(radius, gauss)),
            slope: balanced(&taps(radius, |x| -x * gauss(x))),
            curve: balanced(&taps(radius, |x| (x * x / (deviation * deviation) - 1.0) * gauss(x))),
        }
    }
}

/// Positive taps that sum to 1 and negative ones that sum to −1: a feature as strong as can be has magnitude 1.
fn balanced(taps: &[f64]) -> Vec<f32> {
    let sum = |sign: f64| taps.iter().map(|tap| (sign * tap).max(0.0)).sum::<f64>();
    let (up, down) = (sum(1.0), sum(-1.0));
    taps.iter()
        .map(|tap| {
            (if *tap > 0.0 {
                tap / up
            } else if *tap < 0.0 {
                tap / down
            } else {
                0.0
            }) as f32
        })
        .collect()
}

/// Colour spaces: sRGB with its white of D65.
struct Space {
    xyz_from_linear: DMat3,
    linear_from_xyz: DMat3,
    white: DVec3,
}

impl Space {
    fn new() -> Self {
        // IEC 61966-2-1's primaries and white, columns R, G, B.
        let xyz_from_linear = DMat3::from_cols(
            DVec3::new(0.412_390_799_3, 0.212_639_005_9, 0.019_330_818_7),
            DVec3::new(0.357_584_339_4, 0.715_168_678_8, 0.119_194_779_8),
            DVec3::new(0.180_480_788_4, 0.072_192_315_4, 0.950_532_152_2),
        );
        Self { xyz_from_linear, linear_from_xyz: xyz_from_linear.inverse(), white: xyz_from_linear * DVec3::ONE }
    }

    /// sRGB's bytes to light.
    fn linear(&self, pixel: &[u8]) -> DVec3 {
        DVec3::from([0, 1, 2].map(|c| {
            let value = f64::from(pixel[c]) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        }))
    }

    /// Light to YyCxCz, which is linear and has the axes of CIELAB (§4.1.1).
    fn opponent(&self, linear: DVec3) -> DVec3 {
        let xyz = self.xyz_from_linear * linear / self.white;
        DVec3::new(116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z))
    }

    /// YyCxCz to CIELAB under Hunt's effect; what blurring made brighter than the screen is clipped (§4.1.2).
    fn hunt_lab(&self, opponent: DVec3) -> DVec3 {
        let y = (opponent.x + 16.0) / 116.0;
        let xyz = DVec3::new(y + opponent.y / 500.0, y, y - opponent.z / 200.0) * self.white;
        self.hunt_lab_of_linear((self.linear_from_xyz * xyz).clamp(DVec3::ZERO, DVec3::ONE))
    }

    fn hunt_lab_of_linear(&self, linear: DVec3) -> DVec3 {
        let root = |t: f64| {
            // CIE 15: a straight line below (6/29)³.
            let edge = 6.0_f64 / 29.0;
            if t > edge.powi(3) { t.cbrt() } else { t / (3.0 * edge * edge) + 4.0 / 29.0 }
        };
        let [x, y, z] = (self.xyz_from_linear * linear / self.white).to_array().map(root);
        let lightness = 116.0 * y - 16.0;
        // Colours look paler in the dark (Hunt).
        DVec3::new(lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z))
    }
}

/// One channel of a picture.
struct Plane {
    size: [usize; 2],
    values: Vec<f32>,
}

impl Plane {
    /// The three channels of a picture.
    fn three(size: [usize; 2], pixels: impl Iterator<Item = DVec3>) -> [Self; 3] {
        let mut planes = [0, 1, 2].map(|_| Self { size, values: Vec::with_capacity(size[0] * size[1]) });
        for pixel in pixels {
            planes.iter_mut().zip(pixel.as_vec3().to_array()).for_each(|(plane, value)| plane.values.push(value));
        }
        planes
    }

    /// The plane under a separable filter, `across` along rows and `down` along columns. Beyond its border lies its border.
    fn filtered(&self, across: &[f32], down: &[f32]) -> Self {
        let [width, height] = self.size;
        let mut rows = Vec::with_capacity(self.values.len());
        let mut line = Vec::new();
        let reach = across.len() / 2;
        for row in self.values.chunks_exact(width.max(1)) {
            line.clear();
            line.extend(std::iter::repeat_n(row[0], reach));
            line.extend_from_slice(row);
            line.extend(std::iter::repeat_n(row[width - 1], reach));
            rows.extend(line.windows(across.len()).map(|window| window.iter().zip(across).map(|(v, tap)| v * tap).sum::<f32>()));
        }
        let mut values = vec![0.0; self.values.len()];
        let reach = down.len() / 2;
        for (y, sums) in values.chunks_exact_mut(width.max(1)).enumerate() {
            for (i, tap) in down.iter().enumerate() {
                let from = (y + i).saturating_sub(reach).min(height - 1);
                sums.iter_mut().zip(&rows[from * width..]).for_each(|(sum, value)| *sum += tap * value);
            }
        }
        Self { size: self.size, values }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [48, 32];

    fn picture(pixel: impl Fn(u32, u32) -> [u32; 3]) -> Vec<u8> {
        let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
        pixels.flat_map(|(x, y)| pixel(x, y).map(|value| (value & 255) as u8).into_iter().chain([255])).collect()
    }

    fn mean(reference: &[u8], test: &[u8]) -> f64 {
        let differences = Seen::new(reference, SIZE).differences(&Seen::new(test, SIZE));
        assert!(differences.iter().all(|difference| (0.0..=1.0).contains(difference)));
        differences.iter().map(|difference| f64::from(*difference)).sum::<f64>() / differences.len() as f64
    }

    fn noise(seed: u32) -> impl Fn(u32, u32) -> [u32; 3] {
        move |x, y| {
            [0_u32, 1, 2].map(|c| {
                let places = x.wrapping_mul(0x9e37_79b1).wrapping_add(y.wrapping_mul(0x85eb_ca77));
                let v = places.wrapping_add(c.wrapping_mul(0xc2b2_ae3d)).wrapping_add(seed.wrapping_mul(0x27d4_eb2f));
                let v = (v ^ (v >> 15)).wrapping_mul(0x2c1b_3c6d);
                let v = (v ^ (v >> 12)).wrapping_mul(0x297a_2d39);
                v ^ (v >> 15)
            })
        }
    }

    /// What the authors' own tool (flip-evaluator 1.7, LDR, its default distance) says of the same pictures. Its f32 and its
    /// rounded matrices leave four digits.
    #[test]
    fn agrees_with_the_authors_own_figures() {
        let ramp = |shift: u32| move |x: u32, y: u32| [(x + shift) * 5, y * 7, x * 3 + y * 2];
        let step = |at: u32| move |x: u32, _: u32| if x < at { [20, 40, 60] } else { [200, 180, 160] };
        let plain = |colour: [u32; 3]| picture(move |_, _| colour);
        for (name, reference, test, expected) in [
            ("black, white", plain([0; 3]), plain([255; 3]), 0.967_399),
            ("green, blue", plain([0, 255, 0]), plain([0, 0, 255]), 1.0),
            ("two greys", plain([128; 3]), plain([120, 128, 128]), 0.103_186),
            ("noise", picture(noise(1)), picture(noise(2)), 0.467_721),
            ("a ramp and noise", picture(ramp(0)), picture(noise(2)), 0.789_156),
            ("a ramp and another", picture(ramp(0)), picture(ramp(1)), 0.075_572),
            ("an edge two pixels on", picture(step(24)), picture(step(26)), 0.100_037),
        ] {
            let found = mean(&reference, &test);
            assert!((found - expected).abs() < 1e-4, "{name}: {found} for {expected}");
        }
    }

    #[test]
    fn the_same_picture_does_not_differ() {
        for pixel in [noise(7), noise(8)] {
            assert_eq!(mean(&picture(&pixel), &picture(&pixel)), 0.0);
        }
    }

    #[test]
    fn it_does_not_matter_which_comes_first() {
        let (a, b) = (picture(noise(1)), picture(|x, y| [x * 5, y * 7, 90]));
        assert_eq!(mean(&a, &b), mean(&b, &a));
    }

    #[test]
    fn more_noise_is_more_different() {
        let base = picture(|x, y| [x * 5, y * 7, 90]);
        let noisy = |amplitude: u32| {
            picture(|x, y| {
                let [r, g, b] = noise(3)(x, y).map(|value| (value & 255) * amplitude / 255);
                [(x * 5 + r).min(255), (y * 7 + g).min(255), 90 + b]
            })
        };
        let found: Vec<f64> = [0, 2, 8, 32, 128].map(|amplitude| mean(&base, &noisy(amplitude))).to_vec();
        assert!(found[0] == 0.0 && found.is_sorted_by(|a, b| a < b), "{found:?}");
    }

    #[test]
    fn the_smallest_pictures_have_a_difference_too() {
        let differences = |size: [u32; 2]| {
            let count = (size[0] * size[1] * 4) as usize;
            Seen::new(&vec![0; count], size).differences(&Seen::new(&vec![255; count], size))
        };
        assert_eq!(differences([1, 1]).len(), 1);
        assert!(differences([1, 40]).iter().all(|difference| (f64::from(*difference) - 0.967_399).abs() < 1e-4));
    }
}
