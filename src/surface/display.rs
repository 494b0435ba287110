//! Display: what is shown of a frame, apart from the scene: the picture or a view of its numbers, and a second one beside it.

use crate::scene::Scene;

use super::{Shadow, Shows, Technique};

/// What is shown of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Display {
    /// The picture, or a view of the numbers behind it.
    pub shows: Shows,
    /// Gain of the view of errors: the brightest heat is an error of 1 / gain texels.
    pub gain: f32,
    /// The level of the view that ends the traversal at one.
    pub level_cap: u32,
    /// What is on the right of a divider, if there is one.
    pub split: Option<Split>,
}

/// What is on the right of a divider: the same instant of the same field, traced otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Its technique.
    pub technique: Technique,
    /// Its shadow.
    pub shadow: Shadow,
    /// What it shows.
    pub shows: Shows,
    /// Where the divider stands: the share of the picture's width on its left.
    pub fraction: f32,
}

impl Split {
    /// A divider in the middle.
    pub const MIDDLE: f32 = 0.5;

    /// The scene as its side shows it.
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        (scene.trace.technique, scene.trace.shadow) = (self.technique, self.shadow);
        scene
    }
}

impl Display {
    /// The gain where none is asked for.
    pub const GAIN: f32 = 1.0;

    /// The level where none is asked for: boxes of eight cells a side.
    pub const LEVEL_CAP: u32 = 3;

    /// The first column of traced pixels on the right of the divider, in a picture so many pixels wide that each stand for
    /// `supersampling` of them; both sides keep at least one.
    pub fn divider(&self, width: u32, supersampling: u32) -> Option<u32> {
        let split = self.split.as_ref().filter(|_| width > 1)?;
        let column = (f64::from(split.fraction) * f64::from(width)).round() as u32;
        Some(column.clamp(1, width - 1) * supersampling)
    }
}

impl Default for Display {
    fn default() -> Self {
        Self { shows: Shows::Picture, gain: Self::GAIN, level_cap: Self::LEVEL_CAP, split: None }
    }
}

impl From<Shows> for Display {
    fn from(shows: Shows) -> Self {
        Self { shows, ..Self::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_divider_leaves_something_on_both_sides() {
        let split = |fraction| Display {
            split: Some(Split { technique: Technique::Pom, shadow: Shadow::None, shows: Shows::Picture, fraction }),
            ..Display::default()
        };
        for (fraction, column) in [(0.0, 1), (0.25, 25), (0.5, 50), (1.0, 99), (-7.0, 1), (9.0, 99), (f32::NAN, 1)] {
            assert_eq!(split(fraction).divider(100, 1), Some(column), "{fraction}");
            assert_eq!(split(fraction).divider(100, 3), Some(3 * column), "{fraction}");
        }
        assert_eq!(split(0.5).divider(1, 1), None);
        assert_eq!(Display::default().divider(100, 1), None);
    }
}
