//! What a scene itself does to its surface: shots, explosions, tracks, imprints; and whether the surface heals.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::validate::{Range, SceneError, number, numbers, refuse};
use super::{check_text, exactly};
use crate::field::stamp::StampImage;

/// Seeded shots, each a hole and what it does round itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Shots {
    /// Shots a second.
    pub per_second: f32,
    /// Smallest and largest radius of a hole's rim, metres.
    #[serde(deserialize_with = "exactly")]
    pub radius_metres: [f32; 2],
    /// Depth of a hole of the largest radius, metres.
    pub depth_metres: f32,
    /// How black the soot around it is, 0 to 1.
    pub scorch: f32,
    /// What they hit.
    pub material: Struck,
}

/// What a shot hits: how it breaks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Struck {
    /// A crater with a rim, and chips knocked out of its edge.
    #[default]
    Brick,
    /// A shallow, wide spall.
    Stone,
    /// A round, smooth hole in a dent, its burr turned up and bright.
    Metal,
    /// A hole that splinters along the grain, which runs along u.
    Wood,
    /// A small deep hole in a flake that fell off, and cracks from it.
    Plaster,
    /// What the base has there: see [`Base::Facade`](super::Base::Facade); brick elsewhere.
    Wall,
}

impl Struck {
    /// Every one.
    pub const ALL: &'static [Self] = &[Self::Brick, Self::Stone, Self::Metal, Self::Wood, Self::Plaster, Self::Wall];

    /// What the panel calls it.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Brick => "Brick",
            Self::Stone => "Stone",
            Self::Metal => "Metal",
            Self::Wood => "Wood",
            Self::Plaster => "Plaster",
            Self::Wall => "What the wall is made of",
        }
    }
}

/// Seeded charges that go off in the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Explosions {
    /// Charges a second.
    pub per_second: f32,
    /// Smallest and largest radius of a crater's rim, metres.
    #[serde(deserialize_with = "exactly")]
    pub radius_metres: [f32; 2],
    /// Depth of a crater of the largest radius, metres.
    pub depth_metres: f32,
    /// From the flash to the crater's full size, seconds.
    pub growth_seconds: f32,
    /// Clods that each throws out.
    pub ejecta: u32,
    /// How far the farthest flies, in radii of the crater's rim.
    pub reach: f32,
    /// How black the soot is, 0 to 1.
    pub scorch: f32,
    /// How brightly the crater glows at first, 0 to 1.
    pub heat: f32,
    /// In how many seconds the glow falls to 1/e.
    pub cooling_seconds: f32,
    /// Radiance of the brightest glow, in units of a white surface that faces a light of intensity 1.
    pub glow: f32,
}

/// A surface that closes to its base.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Healing {
    /// After how many seconds nothing is left of a stamp.
    pub seconds: f32,
}

/// A track that is laid while time passes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Track {
    /// What makes it.
    pub by: TrackMaker,
    /// Where it begins, uv.
    #[serde(deserialize_with = "exactly")]
    pub start: [f32; 2],
    /// Where it leads: degrees from u toward v.
    pub heading_degrees: f32,
    /// How fast, metres a second.
    pub speed_metres_per_second: f32,
    /// How far it weaves to either side, metres.
    pub weave_metres: f32,
    /// Along how many metres it weaves once to either side.
    pub weave_length_metres: f32,
    /// How deep it is, metres.
    pub depth_metres: f32,
    /// How large whoever makes it is, of the usual size: a boot of 0.3 m, a tyre 0.2 m wide, a ski 0.09 m wide.
    pub scale: f32,
    /// When it begins, seconds.
    pub begin_seconds: f32,
    /// For how many seconds it is laid.
    pub seconds: f32,
}

/// What makes a track.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TrackMaker {
    /// Someone on foot: soles and heels, left and right.
    #[default]
    Boots,
    /// Four wheels, two tracks of tread.
    Tyres,
    /// Two skis.
    Skis,
}

/// A text or an image that is pressed into the surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Imprint {
    /// The text; or else there is an image.
    pub text: Option<String>,
    /// A TTF or OTF font; absent: the program's own.
    pub font: Option<PathBuf>,
    /// A PNG or EXR file whose values are how much of the depth is pressed: 0 to 1.
    pub image: Option<PathBuf>,
    /// Its centre, uv.
    #[serde(deserialize_with = "exactly")]
    pub centre: [f32; 2],
    /// Its width upon the plane, metres.
    pub width_metres: f32,
    /// How much higher it is than its own aspect has it.
    pub stretch: f32,
    /// From u toward v, degrees.
    pub turn_degrees: f32,
    /// How deep it is, metres; less than 0 raises it.
    pub depth_metres: f32,
    /// When it is pressed, seconds.
    pub at_seconds: f32,
    /// After how many seconds again; 0 for once.
    pub every_seconds: f32,
}

impl Default for Shots {
    fn default() -> Self {
        let material = Struck::default();
        Self { per_second: 10.0, radius_metres: [0.012, 0.035], depth_metres: 0.03, scorch: 0.8, material }
    }
}

impl Default for Explosions {
    fn default() -> Self {
        Self {
            per_second: 1.0,
            radius_metres: [0.05, 0.12],
            depth_metres: 0.06,
            growth_seconds: 0.3,
            ejecta: 48,
            reach: 4.0,
            scorch: 0.8,
            heat: 1.0,
            cooling_seconds: 1.2,
            glow: 6.0,
        }
    }
}

impl Default for Healing {
    fn default() -> Self {
        Self { seconds: 12.0 }
    }
}

impl Default for Track {
    fn default() -> Self {
        Self {
            by: TrackMaker::default(),
            start: [0.0, 0.5],
            heading_degrees: 0.0,
            speed_metres_per_second: 1.4,
            weave_metres: 0.0,
            weave_length_metres: 4.0,
            depth_metres: 0.06,
            scale: 1.0,
            begin_seconds: 0.0,
            seconds: 3600.0,
        }
    }
}

impl Default for Imprint {
    fn default() -> Self {
        Self {
            text: None,
            font: None,
            image: None,
            centre: [0.5, 0.5],
            width_metres: 0.3,
            stretch: 1.0,
            turn_degrees: 0.0,
            depth_metres: 0.02,
            at_seconds: 0.0,
            every_seconds: 0.0,
        }
    }
}

/// The most tracks of a scene.
pub const TRACKS_MAX: usize = 16;

const SHARE: Range = Range::from_to(0.0, 1.0, "");
const LENGTH_METRES: Range = Range::above(0.0, 1e6, "metres");

/// The smallest radius, then the largest.
fn radii(key: &str, radii: [f32; 2]) -> Result<(), SceneError> {
    numbers(key, &radii, LENGTH_METRES)?;
    let [smallest, largest] = radii;
    if smallest > largest {
        return refuse(key, format!("[{smallest}, {largest}]"), "the smallest radius, then the largest");
    }
    Ok(())
}

impl Shots {
    pub(super) fn validate(&self) -> Result<(), SceneError> {
        number("shots.per_second", self.per_second, Range::from_to(0.0, 1e5, "per second"))?;
        radii("shots.radius_metres", self.radius_metres)?;
        number("shots.depth_metres", self.depth_metres, Range::from_to(0.0, 1e6, "metres"))?;
        number("shots.scorch", self.scorch, SHARE)
    }
}

impl Explosions {
    pub(super) fn validate(&self) -> Result<(), SceneError> {
        number("explosions.per_second", self.per_second, Range::from_to(0.0, 1e3, "per second"))?;
        radii("explosions.radius_metres", self.radius_metres)?;
        number("explosions.depth_metres", self.depth_metres, Range::from_to(0.0, 1e6, "metres"))?;
        number("explosions.growth_seconds", self.growth_seconds, Range::from_to(0.0, 60.0, "seconds"))?;
        number("explosions.ejecta", self.ejecta, Range::from_to(1.0, 10_000.0, "clods"))?;
        number("explosions.reach", self.reach, Range::from_to(0.0, 100.0, "radii"))?;
        number("explosions.scorch", self.scorch, SHARE)?;
        number("explosions.heat", self.heat, SHARE)?;
        // A moment of the clock of heat is a 32nd of it: a frame must not span hundreds.
        number("explosions.cooling_seconds", self.cooling_seconds, Range::from_to(0.05, 3600.0, "seconds"))?;
        number("explosions.glow", self.glow, Range::from_to(0.0, 1e4, ""))
    }
}

impl Healing {
    pub(super) fn validate(&self) -> Result<(), SceneError> {
        // 240 steps: at the shortest eight a frame.
        number("healing.seconds", self.seconds, Range::from_to(0.5, 86_400.0, "seconds"))
    }
}

pub(super) fn validate_tracks(tracks: &[Track]) -> Result<(), SceneError> {
    if tracks.len() > TRACKS_MAX {
        return refuse("tracks", format!("a list of {}", tracks.len()), format!("at most {TRACKS_MAX} tracks"));
    }
    for (i, track) in tracks.iter().enumerate() {
        let key = |name: &str| format!("tracks[{i}].{name}");
        numbers(&key("start"), &track.start, SHARE)?;
        number(key("heading_degrees"), track.heading_degrees, Range::from_to(-3600.0, 3600.0, "degrees"))?;
        number(key("speed_metres_per_second"), track.speed_metres_per_second, Range::from_to(0.0, 100.0, "metres per second"))?;
        number(key("weave_metres"), track.weave_metres, Range::from_to(0.0, 1e4, "metres"))?;
        number(key("weave_length_metres"), track.weave_length_metres, Range::from_to(0.1, 1e6, "metres"))?;
        number(key("depth_metres"), track.depth_metres, Range::from_to(0.0, 1e6, "metres"))?;
        number(key("scale"), track.scale, Range::from_to(0.1, 100.0, ""))?;
        number(key("begin_seconds"), track.begin_seconds, Range::from_to(0.0, 1e6, "seconds"))?;
        number(key("seconds"), track.seconds, Range::from_to(0.0, 1e6, "seconds"))?;
    }
    Ok(())
}

pub(super) fn validate_imprints(imprints: &[Imprint]) -> Result<(), SceneError> {
    if imprints.len() > StampImage::COUNT_MAX {
        let allowed = format!("at most {} imprints", StampImage::COUNT_MAX);
        return refuse("imprints", format!("a list of {}", imprints.len()), allowed);
    }
    for (i, imprint) in imprints.iter().enumerate() {
        let key = |name: &str| format!("imprints[{i}].{name}");
        match (&imprint.text, &imprint.image) {
            (Some(text), None) => {
                if let Err(problem) = check_text(text) {
                    return refuse(key("text"), format!("{text:?}"), format!("another: {problem}"));
                }
            }
            (None, Some(path)) if !path.as_os_str().is_empty() => {}
            (None, Some(_)) => return refuse(key("image"), "empty", "the path of a PNG or EXR file"),
            (both, _) => {
                let have = if both.is_some() { "given beside `image`" } else { "missing, as is `image`" };
                return refuse(key("text"), have, "given if there is no `image`, and left out if there is one");
            }
        }
        if imprint.font.as_ref().is_some_and(|font| font.as_os_str().is_empty() || imprint.text.is_none()) {
            return refuse(key("font"), "no font for a text", "the path of a TTF or OTF font beside a `text`, or left out");
        }
        numbers(&key("centre"), &imprint.centre, SHARE)?;
        number(key("width_metres"), imprint.width_metres, LENGTH_METRES)?;
        number(key("stretch"), imprint.stretch, Range::from_to(0.01, 100.0, ""))?;
        number(key("turn_degrees"), imprint.turn_degrees, Range::from_to(-3600.0, 3600.0, "degrees"))?;
        number(key("depth_metres"), imprint.depth_metres, Range::from_to(-1e6, 1e6, "metres"))?;
        number(key("at_seconds"), imprint.at_seconds, Range::from_to(0.0, 1e6, "seconds"))?;
        number(key("every_seconds"), imprint.every_seconds, Range::from_to(0.0, 1e6, "seconds"))?;
    }
    Ok(())
}
