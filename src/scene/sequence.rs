//! A numbered series of images, played as the field.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::validate::{Range, number, refuse};
use super::{LayerBlend, SceneError, exactly_or_none};

/// A numbered series of images, played as the field.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Sequence {
    /// How its heights meet what lies beneath.
    pub blend: LayerBlend,
    /// What its heights are multiplied by, or how much they count.
    pub amplitude: f32,
    /// The heights: a folder of one series, or a pattern like `depth_%05d.png` or `depth_*.png` whose `%05d` or `*` stands for the
    /// number.
    pub heights: PathBuf,
    /// The colours that lie over them, if any: as many PNG images, named likewise, for albedo `image`.
    pub colours: Option<PathBuf>,
    /// The heights in the files that become 0 and 1; absent: they stand as they are.
    #[serde(deserialize_with = "exactly_or_none", skip_serializing_if = "Option::is_none")]
    pub range: Option<[f32; 2]>,
    /// Images a second.
    pub images_per_second: f32,
    /// What comes after the last.
    pub playback: Playback,
    /// Whether what lies between two images in time is their mean, weighted by how near they are; else the earlier one stays.
    pub interpolate: bool,
}

/// What comes after the last image of a series.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Playback {
    /// The first again.
    #[default]
    Loop,
    /// The one before it, and so on back to the first.
    PingPong,
    /// Itself, for ever.
    Hold,
}

impl Playback {
    /// Every playback.
    pub const ALL: &[Self] = &[Self::Loop, Self::PingPong, Self::Hold];

    /// Its name on the command line and in scenes.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Loop => "loop",
            Self::PingPong => "ping-pong",
            Self::Hold => "hold",
        }
    }
}

/// The two images that a moment lies between: the second counts by `share`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Between {
    /// The earlier image.
    pub first: usize,
    /// The later one.
    pub second: usize,
    /// How much the later one counts, from 0 to below 1.
    pub share: f64,
}

/// A fraction of an image's time by which a frame may come too early for it, as for the clock's steps: t·rate rounds to just below a
/// whole number where it is one.
const EARLY: f64 = 1e-9;

impl Sequence {
    /// Where a time lies in a series of so many images: a function of the time alone.
    pub fn between(&self, count: usize, time_seconds: f64) -> Between {
        let images = (time_seconds * f64::from(self.images_per_second)).max(0.0) + EARLY;
        let (whole, share) = (images.floor(), images - images.floor());
        let share = if self.interpolate && share > 2.0 * EARLY { share - EARLY } else { 0.0 };
        // The image at a whole number of images' times.
        let at = |number: f64| {
            let last = count as f64 - 1.0;
            let index = match self.playback {
                Playback::Loop => number % count as f64,
                Playback::PingPong if count > 1 => last - (number % (2.0 * last) - last).abs(),
                Playback::PingPong => 0.0,
                Playback::Hold => number.min(last),
            };
            index as usize
        };
        Between { first: at(whole), second: at(whole + 1.0), share }
    }
}

impl Default for Sequence {
    fn default() -> Self {
        Self {
            blend: LayerBlend::Replace,
            amplitude: 1.0,
            heights: PathBuf::new(),
            colours: None,
            range: None,
            images_per_second: 30.0,
            playback: Playback::Loop,
            interpolate: false,
        }
    }
}

/// Images a second. Beyond a thousand a frame shows every sixteenth.
pub const IMAGES_PER_SECOND: Range = Range::above(0.0, 1000.0, "per second");

pub(super) fn validate(sequence: &Sequence) -> Result<(), SceneError> {
    const SERIES: &str = "the path of a folder, or a pattern like depth_%05d.png";
    number("sequence.amplitude", sequence.amplitude, Range::from_to(-100.0, 100.0, ""))?;
    number("sequence.images_per_second", sequence.images_per_second, IMAGES_PER_SECOND)?;
    if sequence.heights.as_os_str().is_empty() {
        return refuse("sequence.heights", "empty", SERIES);
    }
    if sequence.colours.as_ref().is_some_and(|colours| colours.as_os_str().is_empty()) {
        return refuse("sequence.colours", "empty", format!("{SERIES}, or left out"));
    }
    match sequence.range {
        Some([low, high]) if !(low < high && (high - low).is_finite()) => {
            refuse("sequence.range", format!("[{low}, {high}]"), "two finite numbers, the first less than the second")
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn indices(playback: Playback, count: usize, numbers: std::ops::Range<u32>) -> Vec<usize> {
        let sequence = Sequence { playback, images_per_second: 60.0, ..Sequence::default() };
        // As a clock has them: 31 · (1/60) · 60 is less than 31.
        numbers.map(|number| sequence.between(count, f64::from(number) * (1.0 / 60.0)).first).collect()
    }

    #[test]
    fn every_image_has_its_turn() {
        assert_eq!(indices(Playback::Loop, 3, 0..8), [0, 1, 2, 0, 1, 2, 0, 1]);
        assert_eq!(indices(Playback::PingPong, 3, 0..8), [0, 1, 2, 1, 0, 1, 2, 1]);
        assert_eq!(indices(Playback::Hold, 3, 0..6), [0, 1, 2, 2, 2, 2]);
        for &playback in Playback::ALL {
            assert_eq!(indices(playback, 1, 0..3), [0, 0, 0]);
        }
        // No rounding shows the image before.
        assert!(indices(Playback::Loop, 1 << 20, 0..100_000).into_iter().eq(0..100_000));
    }

    #[test]
    fn between_images_their_share_grows() {
        let sequence = Sequence { images_per_second: 10.0, interpolate: true, ..Sequence::default() };
        let between = sequence.between(4, 0.325);
        assert_eq!((between.first, between.second), (3, 0));
        assert!((between.share - 0.25).abs() < 1e-6);
        assert_eq!(sequence.between(4, 0.2), Between { first: 2, second: 3, share: 0.0 });
        let held = Sequence { playback: Playback::Hold, ..sequence.clone() };
        assert_eq!((held.between(4, 9.05).first, held.between(4, 9.05).second), (3, 3));
        let back = Sequence { playback: Playback::PingPong, ..sequence.clone() };
        assert_eq!((back.between(4, 0.45).first, back.between(4, 0.45).second), (2, 1));
        assert_eq!(Sequence { interpolate: false, ..sequence }.between(4, 0.325).share, 0.0);
    }
}
