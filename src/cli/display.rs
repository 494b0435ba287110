//! What every mode that shows a scene takes about how it is shown.

use clap::Args;

use super::values::one_of;
use crate::scene::{Range, Scene};
use crate::suggest;
use crate::surface::{Display, Shadow, Shows, Split, Technique};

/// The picture or a view, and what is beside it.
#[derive(Args, Clone, Copy, Debug, PartialEq)]
pub struct DisplayOptions {
    #[arg(long, value_name = "NAME", value_parser = view, default_value = "final", help = view_help(), help_heading = "View")]
    view: Shows,

    /// Gain of the view `error`, and of the pictures of errors that compare writes: their brightest heat is an error of 1/G texels
    #[arg(long, value_name = "G", value_parser = gain, default_value = "1", allow_negative_numbers = true, help_heading = "View")]
    gain: f32,

    /// Level of the pyramid at which the traversal of the view `level-cap` ends
    #[arg(long, value_name = "LEVEL", value_parser = level, default_value = "3", allow_negative_numbers = true, help_heading = "View")]
    level_cap: u32,

    /// Show the right side, from this share of the width on, by another technique and shadow [default: none, one picture; the
    /// shadow of the left side, from 0.5 on]
    #[arg(long, value_name = "TECHNIQUE[:SHADOW][@FRACTION]", value_parser = split, help_heading = "View")]
    split: Option<SplitOption>,
}

/// What `--split` says.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SplitOption {
    technique: Technique,
    shadow: Option<Shadow>,
    fraction: f32,
}

impl DisplayOptions {
    /// Gain of what shows errors.
    pub fn gain(&self) -> f64 {
        self.gain.into()
    }

    /// Whether nothing else than the plain picture is asked for.
    pub fn is_plain(&self) -> bool {
        self.view == Shows::default() && self.split.is_none()
    }

    /// What is shown of a scene.
    pub fn display(&self, scene: &Scene) -> Display {
        let split = self.split.map(|SplitOption { technique, shadow, fraction }| Split {
            technique,
            shadow: shadow.unwrap_or(scene.trace.shadow),
            shows: self.view,
            fraction,
        });
        Display { shows: self.view, gain: self.gain, level_cap: self.level_cap, split }
    }
}

fn view_help() -> String {
    let names: Vec<_> = Shows::ALL.iter().map(|shows| shows.name()).collect();
    format!("What is shown: {}", suggest::enumerate(&names, "or"))
}

fn view(text: &str) -> Result<Shows, String> {
    one_of("view", text, Shows::ALL, Shows::name)
}

fn gain(text: &str) -> Result<f32, String> {
    let range = Range::above(0.0, 1e6, "");
    text.parse().ok().filter(|&gain: &f32| range.contains(gain.into())).ok_or_else(|| format!("it must be {range}"))
}

fn level(text: &str) -> Result<u32, String> {
    text.parse().ok().filter(|level| *level < 32).ok_or_else(|| "it must be a whole number from 0 to 31".to_owned())
}

fn split(text: &str) -> Result<SplitOption, String> {
    let (look, fraction) = match text.split_once('@') {
        Some((look, fraction)) => {
            let range = Range::from_to(0.0, 1.0, "");
            let share = fraction.parse().ok().filter(|&share: &f32| range.contains(share.into()));
            (look, share.ok_or_else(|| format!("what follows `@` must be {range}, the share of the width on the left"))?)
        }
        None => (text, 0.5),
    };
    let (technique, shadow) = match look.split_once(':') {
        Some((technique, shadow)) => (technique, Some(one_of("shadow", shadow, Shadow::ALL, Shadow::name)?)),
        None => (look, None),
    };
    let technique = one_of("technique", technique, Technique::ALL, Technique::name)?;
    Ok(SplitOption { technique, shadow, fraction })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_split_needs_no_more_than_a_technique() {
        let parts = |text| split(text).map(|split| (split.technique, split.shadow, split.fraction));
        assert_eq!(parts("pom"), Ok((Technique::Pom, None, 0.5)));
        assert_eq!(parts("pom@0.25"), Ok((Technique::Pom, None, 0.25)));
        assert_eq!(parts("exact:none"), Ok((Technique::Exact, Some(Shadow::None), 0.5)));
        assert_eq!(parts("normal:pom-soft@1"), Ok((Technique::Normal, Some(Shadow::PomSoft), 1.0)));
        for (text, part) in [
            ("", "technique is missing"),
            ("pmo", "did you mean `pom`"),
            ("pom:hrad", "did you mean `hard`"),
            ("pom:", "shadow is missing"),
            ("pom@", "share of the width"),
            ("pom@1.5", "from 0 to 1"),
            ("pom@nan", "from 0 to 1"),
        ] {
            let error = split(text).expect_err(text);
            assert!(error.contains(part), "{text}: {error}");
        }
    }

    #[test]
    fn the_right_side_has_the_shadow_of_the_left_unless_told() {
        let mut scene = Scene::default();
        scene.trace.shadow = Shadow::PomSoft;
        let options = |text| DisplayOptions { view: Shows::Steps, gain: 2.0, level_cap: 5, split: split(text).ok() };
        let shown = options("pom@0.25").display(&scene);
        let right = Split { technique: Technique::Pom, shadow: Shadow::PomSoft, shows: Shows::Steps, fraction: 0.25 };
        assert_eq!(shown, Display { shows: Shows::Steps, gain: 2.0, level_cap: 5, split: Some(right) });
        assert_eq!(options("pom:hard").display(&scene).split.map(|split| split.shadow), Some(Shadow::Hard));
    }
}
