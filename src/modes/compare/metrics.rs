//! How far a picture is from the true one, pixel by pixel: where the surface was found, how much light arrived, what colour it has.

use glam::{DVec2, DVec3};

use crate::modes::statistics::quantile;
use crate::surface::channels::Channel;

/// Hits nearer to one another than this, texels, are the same hit, whichever side of a cell's border rounding put them on.
const SAME_HIT_TEXELS: f64 = 1e-3;

/// Where a pixel shows the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// In the world, metres.
    pub position: DVec3,
    /// In the field, texels from the centre of the first, not wrapped.
    pub lattice: DVec2,
}

/// The points that a picture shows; none where a pixel shows no surface, or its ray gave up.
pub fn points(pixels: &[Channel], field_size: [u32; 2]) -> Vec<Option<Point>> {
    let size = DVec2::new(f64::from(field_size[0]), f64::from(field_size[1]));
    let point = |pixel: &Channel| Point {
        position: glam::Vec3::from(pixel.position).as_dvec3(),
        lattice: glam::Vec2::from(pixel.uv).as_dvec2() * size - 0.5,
    };
    pixels.iter().map(|pixel| (pixel.steps >= 0.0).then(|| point(pixel))).collect()
}

/// How far a pixel is from the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Deviation {
    /// Neither shows the surface.
    Nothing,
    /// Both do, so many metres apart.
    Metres(f64),
    /// Only one of them does.
    OnlyOne,
}

/// The errors of all pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Positions {
    /// Of each pixel.
    pub deviations: Vec<Deviation>,
    /// Pixels where both show the surface: those that errors are counted over.
    pub pixels: usize,
    /// Root of the mean square distance, metres.
    pub rms: f64,
    /// 99th percentile, metres.
    pub p99: f64,
    /// The largest, metres.
    pub max: f64,
    /// Of the pixels where one or the other shows the surface, the share that shows another cell of the field, or only one of
    /// them shows any.
    pub wrong_cell_share: f64,
}

/// Holds points against the true ones.
///
/// # Panics
///
/// There are not as many of one as of the other.
pub fn positions(truth: &[Option<Point>], found: &[Option<Point>]) -> Positions {
    assert_eq!(truth.len(), found.len(), "pictures of one size");
    let mut deviations = Vec::with_capacity(truth.len());
    let mut distances = Vec::new();
    let (mut shown, mut wrong) = (0_usize, 0_usize);
    for pair in truth.iter().zip(found) {
        let deviation = match pair {
            (None, None) => Deviation::Nothing,
            (Some(truth), Some(found)) => {
                let same_cell = truth.lattice.floor() == found.lattice.floor();
                wrong += usize::from(!same_cell && truth.lattice.distance(found.lattice) > SAME_HIT_TEXELS);
                let distance = truth.position.distance(found.position);
                distances.push(distance);
                Deviation::Metres(distance)
            }
            _ => {
                wrong += 1;
                Deviation::OnlyOne
            }
        };
        shown += usize::from(deviation != Deviation::Nothing);
        deviations.push(deviation);
    }
    distances.sort_by(f64::total_cmp);
    let (p99, max) = distances.last().map_or((0.0, 0.0), |max| (quantile(&distances, 0.99), *max));
    Positions {
        deviations,
        pixels: distances.len(),
        rms: root_mean_square(distances.into_iter()),
        p99,
        max,
        wrong_cell_share: wrong as f64 / shown.max(1) as f64,
    }
}

/// Root of the mean square difference of the light's visibility, over the pixels where both pictures show the surface.
pub fn visibility_rms(truth: &[Channel], found: &[Channel]) -> f64 {
    let both = truth.iter().zip(found).filter(|(truth, found)| truth.steps >= 0.0 && found.steps >= 0.0);
    root_mean_square(
        both.map(|(truth, found)| f64::from(truth.visibility) - f64::from(found.visibility)).collect::<Vec<_>>().into_iter(),
    )
}

/// Peak signal-to-noise ratio of two pictures, RGBA in sRGB, over red, green and blue, decibels; none where they are the same.
pub fn psnr_db(truth: &[u8], found: &[u8]) -> Option<f64> {
    let colours = |rgba: &[u8]| rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect::<Vec<_>>();
    let (truth, found) = (colours(truth), colours(found));
    let rms =
        root_mean_square(truth.iter().zip(&found).map(|(a, b)| f64::from(*a) - f64::from(*b)).collect::<Vec<_>>().into_iter());
    (rms > 0.0).then(|| 20.0 * (255.0 / rms).log10())
}

/// Zero of nothing.
fn root_mean_square(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1);
    (values.map(|value| value * value).sum::<f64>() / count as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64) -> Option<Point> {
        Some(Point { position: DVec3::new(0.1 * x, 0.0, 0.1 * y), lattice: DVec2::new(x, y) })
    }

    #[test]
    fn errors_are_counted_where_both_show_the_surface() {
        let truth = [at(1.5, 2.5), at(1.5, 2.5), at(1.5, 2.5), None, None];
        let found = [at(1.5, 2.5), at(4.5, 6.5), None, at(0.5, 0.5), None];
        let positions = positions(&truth, &found);
        // Distances 0 and 0.1·hypot(3, 4) = 0.5.
        assert_eq!(positions.pixels, 2);
        assert!((positions.rms - 0.5 / 2.0_f64.sqrt()).abs() < 1e-12, "{positions:?}");
        assert!((positions.max - 0.5).abs() < 1e-12 && positions.p99 == positions.max);
        // Of the four that show something three are wrong: another cell, and twice only one.
        assert_eq!(positions.wrong_cell_share, 0.75);
        assert_eq!(positions.deviations[2..], [Deviation::OnlyOne, Deviation::OnlyOne, Deviation::Nothing]);
    }

    #[test]
    fn a_border_between_equal_hits_is_no_wrong_cell() {
        let near = positions(&[at(2.0 - 1e-5, 0.5)], &[at(2.0 + 1e-5, 0.5)]);
        let apart = positions(&[at(2.0 - 1e-2, 0.5)], &[at(2.0 + 1e-2, 0.5)]);
        assert_eq!((near.wrong_cell_share, apart.wrong_cell_share), (0.0, 1.0));
    }

    #[test]
    fn the_percentile_leaves_out_one_in_a_hundred() {
        let truth = vec![at(0.5, 0.5); 100];
        let mut found = truth.clone();
        found[17] = at(0.5, 8.5);
        let positions = positions(&truth, &found);
        assert_eq!(positions.p99, 0.0);
        assert!((positions.max - 0.8).abs() < 1e-12 && (positions.rms - 0.08).abs() < 1e-12, "{positions:?}");
    }

    #[test]
    fn nothing_is_no_error() {
        let positions = positions(&[None], &[None]);
        assert_eq!((positions.pixels, positions.rms, positions.max, positions.wrong_cell_share), (0, 0.0, 0.0, 0.0));
    }

    #[test]
    fn decibels_follow_from_the_mean_square() {
        // Every colour off by 5: 20·log₁₀(255/5). Alpha does not count.
        let (a, b) = (vec![100; 40], [[105, 95, 105, 0]; 10].concat());
        assert!((psnr_db(&a, &b).unwrap() - 20.0 * 51.0_f64.log10()).abs() < 1e-12);
        assert_eq!(psnr_db(&a, &a), None);
    }

    #[test]
    fn light_is_compared_where_both_show_the_surface() {
        let pixel = |steps: f32, visibility: f32| Channel { steps, visibility, ..Channel::default() };
        let truth = [pixel(3.0, 1.0), pixel(3.0, 0.5), pixel(3.0, 1.0), pixel(-1.0, 0.0)];
        let found = [pixel(1.0, 0.0), pixel(1.0, 0.5), pixel(-9.0, 0.0), pixel(1.0, 1.0)];
        assert!((visibility_rms(&truth, &found) - 0.5_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_ray_that_gave_up_shows_nothing() {
        let pixel = |steps: f32| Channel { steps, uv: [0.5, 0.25], ..Channel::default() };
        let found = points(&[pixel(4.0), pixel(-1.0), pixel(-9.0)], [8, 4]);
        assert_eq!(found[0].unwrap().lattice, DVec2::new(3.5, 0.5));
        assert_eq!(found[1..], [None, None]);
    }
}
