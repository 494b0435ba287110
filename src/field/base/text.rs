//! Text: lettering to heights, with a bevel that follows the distance from the outline.

use glam::DVec2;

use super::lettering::{Cubic, Lettering};
use super::noise::fractal_noise;
use super::outline::{Edge, signed_distance};
use crate::scene::{Text, TextRelief};

/// How far a chord may stray from its curve, texels: a fiftieth is far below what a bilinear cell of a slope shows.
const FLATNESS_TEXELS: f64 = 0.02;

/// Half the width that the steepest slope has, texels: a sheer outline, filtered.
const SOFTNESS_TEXELS: f64 = 1.0;

/// Size of the ground's grain, metres.
const GRAIN_METRES: f64 = 0.006;

/// The heights of a sign, row by row.
pub fn heights(text: &Text, lettering: &Lettering, size: [u32; 2], texel_metres: f64) -> Vec<f32> {
    let field = DVec2::from(size.map(f64::from));
    let frame = f64::from(text.frame) * field.min_element();
    let weight = f64::from(text.weight);
    let [low, high] = lettering.bounds;
    // Between frame and text there is at least as much room as the frame is wide, on either side.
    let room = (field - 6.0 * frame) * f64::from(text.size);
    let em = (room / (high - low + 2.0 * weight.max(0.0))).min_element();
    let shift = 0.5 * field - 0.5 * em * (low + high);
    let outline: Vec<Edge> =
        lettering.segments.iter().flat_map(|cubic| flattened(cubic.map(|point| em * point + shift))).collect();

    let (weight, bevel) = (em * weight, em * f64::from(text.bevel));
    let reach = (bevel - weight).max(weight).max(0.0) + 2.0 * SOFTNESS_TEXELS;
    let distances = signed_distance(&outline, size, reach);
    let grain = f64::from(text.grain);
    let of_texel = |(index, distance): (usize, &f32)| {
        let at = DVec2::new((index % size[0] as usize) as f64 + 0.5, (index / size[0] as usize) as f64 + 0.5);
        let inside =
            (f64::from(*distance) + weight).max(if frame > 0.0 { inside_frame(text.relief, at, field, frame) } else { -reach });
        let cut = ((inside + SOFTNESS_TEXELS) / (bevel + 2.0 * SOFTNESS_TEXELS)).clamp(0.0, 1.0);
        let metres = at * texel_metres / GRAIN_METRES;
        let rough = if grain > 0.0 { grain * fractal_noise(metres.x, metres.y, 51, 4) * (1.0 - cut) } else { 0.0 };
        let height = match text.relief {
            TextRelief::Raised => rough + (1.0 - rough) * cut,
            TextRelief::Engraved => (1.0 - rough) * (1.0 - cut),
        };
        height as f32
    };
    distances.iter().enumerate().map(of_texel).collect()
}

/// Distance from the border of a frame of this width, texels; positive on it. A raised one is the rim of the sign, so that the sign
/// ends at the reference surface; an engraved one is a line that stands as far from the rim as it is wide.
fn inside_frame(relief: TextRelief, at: DVec2, field: DVec2, width: f64) -> f64 {
    let inset = match relief {
        TextRelief::Raised => width,
        TextRelief::Engraved => 2.0 * width,
    };
    let radius = 2.5 * width;
    let corner = (at - 0.5 * field).abs() - (0.5 * field - inset - radius).max(DVec2::ZERO);
    let from_inner = corner.max(DVec2::ZERO).length() + corner.max_element().min(0.0) - radius;
    match relief {
        TextRelief::Raised => from_inner,
        TextRelief::Engraved => 0.5 * width - (from_inner - 0.5 * width).abs(),
    }
}

/// A cubic as straight pieces.
fn flattened(cubic: Cubic) -> impl Iterator<Item = Edge> {
    let [a, b, c, d] = cubic;
    // A chord of 1/n of the parameter strays by at most 1/(8n²) of the largest second derivative, six times these.
    let bend = (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
    let pieces = (0.75 * bend / FLATNESS_TEXELS).sqrt().ceil().clamp(1.0, 4096.0) as u32;
    let at = move |piece: u32| {
        let t = f64::from(piece) / f64::from(pieces);
        let s = 1.0 - t;
        match piece {
            // To the bit, so that contours close.
            0 => a,
            _ if piece == pieces => d,
            _ => s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d,
        }
    };
    (0..pieces).map(move |piece| [at(piece), at(piece + 1)]).filter(|[from, to]| from != to)
}

#[cfg(test)]
mod tests {
    use super::super::lettering::EMBEDDED_FONT;
    use super::*;

    fn sign(text: &Text, size: [u32; 2]) -> Vec<f32> {
        let lettering = Lettering::new(&text.text, EMBEDDED_FONT).expect("the font has these letters");
        heights(text, &lettering, size, 1.0 / f64::from(size[0]))
    }

    fn extent(heights: &[f32], size: [u32; 2]) -> [[usize; 2]; 2] {
        let inked: Vec<_> = (0..heights.len()).filter(|i| heights[*i] > 0.5).collect();
        let range = |of: &dyn Fn(usize) -> usize| [inked.iter().map(|i| of(*i)).min(), inked.iter().map(|i| of(*i)).max()];
        [range(&|i| i % size[0] as usize), range(&|i| i / size[0] as usize)]
            .map(|range| range.map(|end| end.expect("there is ink")))
    }

    #[test]
    fn it_is_in_the_middle_and_as_large_as_fits() {
        for (words, size) in [("Rilievo", [400, 300]), ("Rilievo", [300, 40]), ("O", [200, 333]), ("a\nb\nc\nd", [256, 256])] {
            let text = Text { text: words.to_owned(), bevel: 0.0, ..Text::default() };
            let [x, y] = extent(&sign(&text, size), size);
            let shares = [(x, size[0]), (y, size[1])].map(|([low, high], size)| {
                assert!((low as f64 + high as f64 + 1.0 - f64::from(size)).abs() <= 2.0, "{words} {size}: from {low} to {high}");
                (high - low + 1) as f64 / f64::from(size)
            });
            let larger = shares[0].max(shares[1]);
            assert!((larger - 0.86).abs() < 3.0 / f64::from(size[0].min(size[1])), "{words} {size:?} takes {shares:?}");
        }
    }

    #[test]
    fn the_bevel_is_a_slope_of_its_width() {
        // A capital I is a box: heights rise along a row by 1 over the bevel, and two texels of filter.
        let size = [512, 512];
        let text = Text { text: "I".to_owned(), weight: 0.0, bevel: 0.02, ..Text::default() };
        let lettering = Lettering::new("I", EMBEDDED_FONT).expect("the font has it");
        let em = 0.86 * 512.0 / (lettering.bounds[1].y - lettering.bounds[0].y);
        let row = &sign(&text, size)[256 * 512..][..512];
        let slope = row.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f32::max);
        let expected = 1.0 / (0.02 * em + 2.0);
        assert!((f64::from(slope) - expected).abs() < 1e-4, "{slope} for {expected}");
        assert!(row[0] == 0.0 && row[256] == 1.0);
    }

    #[test]
    fn engraved_is_raised_upside_down_and_weight_makes_bolder() {
        let raised = sign(&Text::default(), [256, 128]);
        let engraved = sign(&Text { relief: TextRelief::Engraved, ..Text::default() }, [256, 128]);
        assert!(raised.iter().zip(&engraved).all(|(up, down)| (up + down - 1.0).abs() < 1e-6));
        let ink = |weight| sign(&Text { weight, ..Text::default() }, [256, 128]).iter().sum::<f32>();
        assert!(ink(-0.02) < 0.7 * ink(0.0) && ink(0.03) > 1.3 * ink(0.0), "{} {} {}", ink(-0.02), ink(0.0), ink(0.03));
    }

    #[test]
    fn frame_and_grain_stay_within_the_heights() {
        let text = Text { frame: 0.02, grain: 0.1, ..Text::default() };
        let size = [300, 200];
        let heights = sign(&text, size);
        assert!(heights.iter().all(|height| (0.0..=1.0).contains(height)));
        // The frame: a rim of 4 texels all round.
        for [x, y] in [[150, 0], [150, 199], [0, 100], [299, 100], [0, 0]] {
            assert!(heights[y * 300 + x] > 0.7, "{x}, {y}: {}", heights[y * 300 + x]);
            let [x, y] = [x.clamp(12, 287), y.clamp(12, 187)];
            assert!(heights[y * 300 + x] < 0.11, "{x}, {y}: {}", heights[y * 300 + x]);
        }
    }

    #[test]
    fn another_field_is_a_finer_look_at_the_same_sign() {
        let [coarse, fine] = [[128, 64], [512, 256]].map(|size| sign(&Text::default(), size));
        let mean = |heights: &[f32]| heights.iter().sum::<f32>() / heights.len() as f32;
        assert!((mean(&coarse) - mean(&fine)).abs() < 0.02, "{} and {}", mean(&coarse), mean(&fine));
    }
}
