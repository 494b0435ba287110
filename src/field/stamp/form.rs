//! What a stamp is: plain data, which journals and scenes can hold.

use serde::{Deserialize, Serialize};

use crate::field::bins::{Capsule, Disc};

/// The form of a stamp: its profile p over ρ, the distance from its centre in radii. Each is 0 from ρ = 1 on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum Profile {
    /// 1 everywhere, with a hard edge.
    Disc = 0,
    /// 1 − ρ.
    Cone = 1,
    /// (1 − ρ²)², smooth everywhere.
    #[default]
    Bump = 2,
    /// A bowl of depth 1 with a bore down its middle, its rim at ρ = [`CRATER_RIM`], the rim's lip [`CRATER_LIP`] high; slopes are
    /// continuous.
    Crater = 3,
    /// A level floor at −1 to [`RUT_FLOOR`], a wall up to a lip of [`CRATER_LIP`] at [`RUT_RIM`], and the lip's flank: what a sole, a tyre
    /// or a ski leaves.
    Rut = 4,
}

impl Profile {
    /// Every profile.
    pub const ALL: [Self; 5] = [Self::Disc, Self::Cone, Self::Bump, Self::Crater, Self::Rut];

    /// The integral of the profile over its disc, in units of the squared radius.
    pub fn volume(self) -> f64 {
        use std::f64::consts::PI;
        match self {
            Self::Disc => PI,
            Self::Cone | Self::Bump => PI / 3.0,
            // With s = ρ², dA = π ds. Over 0..1 the bowl's x²(3 − 2x) is 1/2, the bore's 1 − (1 − x)⁶ is 6/7, the mean of the two
            // 19/28; the flank's (1 − y)⁴(1 + 4y) is 1/3.
            Self::Crater => {
                let (rim, lip) = (CRATER_RIM * CRATER_RIM, CRATER_LIP);
                PI * (rim * ((1.0 + lip) * 19.0 / 28.0 - 1.0) + (1.0 - rim) * lip / 3.0)
            }
            Self::Rut => {
                let (floor, rim, lip) = (RUT_FLOOR * RUT_FLOOR, RUT_RIM * RUT_RIM, CRATER_LIP);
                PI * (-floor + (rim - floor) * ((1.0 + lip) / 2.0 - 1.0) + (1.0 - rim) * lip / 3.0)
            }
        }
    }
}

/// Radius of a rut's floor, in radii of its stamp.
pub const RUT_FLOOR: f64 = 0.6;

/// Radius at which a rut's lip is highest, in radii of its stamp.
pub const RUT_RIM: f64 = 0.85;

/// Radius of a crater's rim, in radii of its stamp. What lies beyond is the lip's flank and the soot.
pub const CRATER_RIM: f64 = 0.5;

/// Height of a crater's lip, in depths of its bowl.
pub const CRATER_LIP: f64 = 0.1;

/// How far grains of the broken material stand out of an irregular crater or lack in it, in depths of its bowl: a texel each, whatever
/// its size.
pub const CRATER_GRAIN: f64 = 0.06;

/// How a stamp meets what is there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum Blend {
    /// layer + height·p.
    #[default]
    Add = 0,
    /// The lower of the layer and level + height·p.
    Min = 1,
    /// The higher of the layer and level + height·p.
    Max = 2,
    /// Mixes the layer toward level + height·p, by alpha.
    Replace = 3,
}

impl Blend {
    /// Every blend.
    pub const ALL: [Self; 4] = [Self::Add, Self::Min, Self::Max, Self::Replace];
}

/// One stamp.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stamp {
    /// When it is pressed, seconds: what is due in one frame is pressed in this order.
    pub at_seconds: f64,
    /// Its centre, or where it begins if it is swept, lattice coordinates.
    pub centre: [f32; 2],
    /// Radius beyond which it changes nothing, texels.
    pub radius: f32,
    /// From its centre to the end of the segment along which it is swept, texels; zero for a round stamp.
    pub span: [f32; 2],
    /// From its centre back to where the segment before it in a chain began, texels; zero where it is the first. Then `add` adds what
    /// that one has not: a chain that bends gently is pressed once everywhere. Min, max and replace press nothing twice anyway.
    pub joins: [f32; 2],
    /// What its profile is multiplied by, in heights. A crater's depth.
    pub height: f32,
    /// From which height min, max and replace count.
    pub level: f32,
    /// Its form.
    pub profile: Profile,
    /// How it meets what is there.
    pub blend: Blend,
    /// How much of the layer it replaces, 0 to 1.
    pub alpha: f32,
    /// How far its form departs from a circle: 0 none, 1 by up to half its radius. An irregular crater has grains in it, too.
    pub irregularity: f32,
    /// Which of the irregular forms, radians.
    pub phase: f32,
    /// How much of its height the lugs of a tread take, 0 to 1.
    pub tread: f32,
    /// From lug to lug, texels along its track.
    pub lug_texels: f32,
    /// How far along its track it begins, texels.
    pub along: f32,
    /// The image that is its form, instead of its profile.
    pub image: Option<ImageForm>,
    /// How black the soot is that it lays, 0 to 1.
    pub soot: f32,
    /// How bare it lays the material within, 0 to 1.
    pub bare: f32,
    /// How smooth it leaves the material within, 0 to 1.
    pub gloss: f32,
    /// How brightly it glows when it is pressed, 0 to 1.
    pub heat: f32,
}

/// An image as the form of a stamp: its values are the profile.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageForm {
    /// Which of the images of [`StampImages`](super::StampImages).
    pub number: u32,
    /// Half its width and height upon the field, texels.
    pub half_extent: [f32; 2],
    /// From the field's u axis to its rows, radians toward v.
    pub turn: f32,
}

impl Default for Stamp {
    fn default() -> Self {
        Self {
            at_seconds: 0.0,
            centre: [0.0, 0.0],
            radius: 8.0,
            span: [0.0, 0.0],
            joins: [0.0, 0.0],
            height: 0.1,
            level: 0.0,
            profile: Profile::default(),
            blend: Blend::default(),
            alpha: 1.0,
            irregularity: 0.0,
            phase: 0.0,
            tread: 0.0,
            lug_texels: 1.0,
            along: 0.0,
            image: None,
            soot: 0.0,
            bare: 0.0,
            gloss: 0.0,
            heat: 0.0,
        }
    }
}

impl Stamp {
    /// A stamp whose form is an image.
    pub fn of_image(image: ImageForm, centre: [f32; 2]) -> Self {
        let [width, height] = image.half_extent;
        Self { centre, radius: width.hypot(height), image: Some(image), ..Self::default() }
    }

    /// What it is swept along, and how far it reaches from there.
    pub const fn capsule(&self) -> Capsule {
        let span = if self.image.is_some() { [0.0; 2] } else { self.span };
        Capsule { disc: Disc { centre: self.centre, radius: self.radius }, span }
    }

    /// Whether it is round and leaves the material alone.
    pub(super) fn is_plain(&self) -> bool {
        let marks = [self.soot, self.bare, self.gloss, self.heat, self.irregularity];
        marks == [0.0; 5] && !self.has_form()
    }

    /// Whether it is swept, or an image, or has a tread.
    pub(super) fn has_form(&self) -> bool {
        self.span != [0.0; 2] || self.joins != [0.0; 2] || self.tread != 0.0 || self.image.is_some()
    }
}
