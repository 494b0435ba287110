//! What a scene says about its shallow water.

use serde::{Deserialize, Serialize};

use super::validate::{Range, cell_metres, number, numbers, refuse};
use super::{Addressing, Obstacle, Scene, SceneError, exactly, one};

/// The shallow-water equations over whatever lies beneath: depth and velocity, shores that move, and foam where it breaks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ShallowWater {
    /// Gravity, m/s².
    pub gravity_metres_per_second_squared: f32,
    /// Manning's n of the bed, s/m^⅓: 0.01 is glass, 0.03 gravel, 0.1 undergrowth.
    pub manning: f32,
    /// The step that the clock owes it, seconds; it goes in as many substeps as are stable.
    pub step_seconds: f32,
    /// The most substeps of a step. What is left then is given up, and the water falls behind the clock.
    pub substep_cap: u32,
    /// Share of a texel that the fastest wave may cross in a substep.
    pub courant: f32,
    /// What happens at the borders of the field: west, east, north, south.
    #[serde(deserialize_with = "exactly")]
    pub borders: [Border; 4],
    /// Level of the sea beyond `sea` borders, as a height.
    pub sea_level: f32,
    /// Waves that come in over `sea` borders, if any.
    pub swell: Option<Swell>,
    /// Water that stands there in the beginning.
    pub bodies: Vec<Body>,
    /// Rain everywhere, metres a second. A cloudburst is 3e-5.
    pub rain_metres_per_second: f32,
    /// What the ground takes everywhere, metres a second.
    pub seepage_metres_per_second: f32,
    /// Drops that make rings, if any.
    pub drops: Option<Drops>,
    /// Springs and drains.
    pub springs: Vec<Spring>,
    /// Bodies that beat the water up and down: makers of waves.
    pub plungers: Vec<Plunger>,
    /// Posts that stand in it.
    pub obstacles: Vec<Obstacle>,
    /// Foam that breaking makes, share of the surface a second.
    pub foam_per_second: f32,
    /// Seconds until e⁻¹ of the foam is left.
    pub foam_seconds: f32,
    /// What a metre of it takes of red, green and blue light, 1/m. Pure water takes 0.34, 0.057 and 0.009 (\[Pope\]); what floats in it
    /// takes more, most of the blue.
    #[serde(deserialize_with = "exactly")]
    pub absorption_per_metre: [f32; 3],
    /// What water that is too deep to see through gives back of them.
    #[serde(deserialize_with = "exactly")]
    pub scatter: [f32; 3],
}

/// What water meets at one border of the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Border {
    /// A wall.
    Wall,
    /// The end of the world: what flows out is gone.
    Open,
    /// The sea: a level that is kept, swell that comes in, and waves that go out.
    Sea,
    /// The opposite border.
    Periodic,
}

impl Border {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Wall, Self::Open, Self::Sea, Self::Periodic];
}

/// Regular waves from beyond a sea border.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Swell {
    /// Height of a crest over the sea's level, metres.
    pub amplitude_metres: f32,
    /// Seconds from crest to crest.
    pub period_seconds: f32,
}

/// Water that stands in a rectangle of the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Body {
    /// Its corner of the smallest u and v.
    #[serde(deserialize_with = "exactly")]
    pub low: [f32; 2],
    /// Its corner of the largest u and v.
    #[serde(deserialize_with = "exactly")]
    pub high: [f32; 2],
    /// Height of its surface; where the bed is higher there is none.
    pub level: f32,
}

/// Seeded drops.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Drops {
    /// Mean number of drops a second.
    pub per_second: f32,
    /// Radius of the ring that a drop heaps up, metres.
    pub radius_metres: f32,
    /// Depth of its dent, metres.
    pub depth_metres: f32,
}

/// Water that comes or goes at a place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spring {
    /// Its centre, uv.
    #[serde(deserialize_with = "exactly")]
    pub centre: [f32; 2],
    /// Its radius, metres.
    pub radius_metres: f32,
    /// What it adds, metres a second at its centre; a drain takes, and is less than 0.
    pub metres_per_second: f32,
}

/// A body that dips into the water and rises again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plunger {
    /// Its centre, uv.
    #[serde(deserialize_with = "exactly")]
    pub centre: [f32; 2],
    /// Radius of the ring that it heaps up, metres.
    pub radius_metres: f32,
    /// How far it dips, metres.
    pub depth_metres: f32,
    /// Seconds from dip to dip.
    #[serde(default = "one")]
    pub period_seconds: f32,
}

/// The most substeps that a step may have.
pub const SUBSTEPS_MAX: u32 = 64;

/// Gravity, m/s². Less than that of a pebble in space moves nothing, and leaves f32 no room.
pub const GRAVITY: Range = Range::from_to(1e-6, 100.0, "m/s²");
/// Manning's n.
pub const MANNING: Range = Range::from_to(0.0, 1.0, "s/m^⅓");
/// Depth of a field with water.
pub const DEPTH: Range = Range::from_to(1e-6, 1e6, "metres with `shallow_water`");
/// The step that the clock owes.
pub const STEP_SECONDS: Range = Range::from_to(1e-4, 0.1, "seconds");
/// Share of a texel a substep. Beyond a half, ripples over a rough bed grow.
pub const COURANT: Range = Range::from_to(0.05, 0.5, "");
/// Levels and heights of water.
pub const LEVEL: Range = Range::from_to(-10.0, 10.0, "");
/// Rain and seepage: a metre a second is a waterfall.
pub const RATE: Range = Range::from_to(0.0, 1.0, "metres a second");
/// What a spring adds or a drain takes.
pub const SPRING: Range = Range::from_to(-100.0, 100.0, "metres a second");
/// Foam.
pub const FOAM_PER_SECOND: Range = Range::from_to(0.0, 100.0, "a second");
/// Life of foam.
pub const FOAM_SECONDS: Range = Range::from_to(0.01, 1000.0, "seconds");
/// Lengths of what disturbs.
const LENGTH: Range = Range::above(0.0, 1e6, "metres");
/// Periods of what beats.
pub const PERIOD: Range = Range::from_to(0.02, 1e4, "seconds");

impl ShallowWater {
    /// Checks every value against its range, and the borders against the field.
    pub(super) fn validate(&self, scene: &Scene) -> Result<(), SceneError> {
        let key = |name: &str| format!("shallow_water.{name}");
        cell_metres("shallow_water", scene.texel_metres(), scene.plane.width_metres)?;
        number("plane.depth_metres", scene.plane.depth_metres, DEPTH)?;
        number(key("gravity_metres_per_second_squared"), self.gravity_metres_per_second_squared, GRAVITY)?;
        number(key("manning"), self.manning, MANNING)?;
        number(key("step_seconds"), self.step_seconds, STEP_SECONDS)?;
        number(key("substep_cap"), self.substep_cap, Range::from_to(1.0, f64::from(SUBSTEPS_MAX), "substeps"))?;
        number(key("courant"), self.courant, COURANT)?;
        self.validate_borders(scene.field.addressing)?;
        number(key("sea_level"), self.sea_level, LEVEL)?;
        if let Some(swell) = &self.swell {
            number(key("swell.amplitude_metres"), swell.amplitude_metres, Range::from_to(0.0, 1e4, "metres"))?;
            number(key("swell.period_seconds"), swell.period_seconds, PERIOD)?;
        }
        for (i, body) in self.bodies.iter().enumerate() {
            numbers(&key(&format!("bodies[{i}].low")), &body.low, Range::from_to(-10.0, 10.0, ""))?;
            numbers(&key(&format!("bodies[{i}].high")), &body.high, Range::from_to(-10.0, 10.0, ""))?;
            number(key(&format!("bodies[{i}].level")), body.level, LEVEL)?;
        }
        number(key("rain_metres_per_second"), self.rain_metres_per_second, RATE)?;
        number(key("seepage_metres_per_second"), self.seepage_metres_per_second, RATE)?;
        if let Some(drops) = &self.drops {
            number(key("drops.per_second"), drops.per_second, Range::from_to(0.0, 1e4, "drops a second"))?;
            number(key("drops.radius_metres"), drops.radius_metres, LENGTH)?;
            number(key("drops.depth_metres"), drops.depth_metres, Range::from_to(0.0, 1e4, "metres"))?;
        }
        for (i, spring) in self.springs.iter().enumerate() {
            numbers(&key(&format!("springs[{i}].centre")), &spring.centre, Range::from_to(-1.0, 2.0, ""))?;
            number(key(&format!("springs[{i}].radius_metres")), spring.radius_metres, LENGTH)?;
            number(key(&format!("springs[{i}].metres_per_second")), spring.metres_per_second, SPRING)?;
        }
        for (i, plunger) in self.plungers.iter().enumerate() {
            numbers(&key(&format!("plungers[{i}].centre")), &plunger.centre, Range::from_to(-1.0, 2.0, ""))?;
            number(key(&format!("plungers[{i}].radius_metres")), plunger.radius_metres, LENGTH)?;
            number(key(&format!("plungers[{i}].depth_metres")), plunger.depth_metres, Range::from_to(0.0, 1e4, "metres"))?;
            number(key(&format!("plungers[{i}].period_seconds")), plunger.period_seconds, PERIOD)?;
        }
        for (i, post) in self.obstacles.iter().enumerate() {
            numbers(&key(&format!("obstacles[{i}].centre")), &post.centre, Range::from_to(-1.0, 2.0, ""))?;
            numbers(
                &key(&format!("obstacles[{i}].half_extent_metres")),
                &post.half_extent_metres,
                Range::from_to(0.0, 1e6, "metres"),
            )?;
            number(key(&format!("obstacles[{i}].corner_metres")), post.corner_metres, Range::from_to(0.0, 1e6, "metres"))?;
            number(key(&format!("obstacles[{i}].top")), post.top, Range::from_to(0.0, 1.0, ""))?;
        }
        number(key("foam_per_second"), self.foam_per_second, FOAM_PER_SECOND)?;
        number(key("foam_seconds"), self.foam_seconds, FOAM_SECONDS)?;
        numbers(&key("absorption_per_metre"), &self.absorption_per_metre, Range::from_to(0.0, 1e4, "per metre"))?;
        numbers(&key("scatter"), &self.scatter, Range::from_to(0.0, 1.0, ""))
    }

    /// A border has one owner: where the field repeats it is the field, and the water goes round with it.
    fn validate_borders(&self, addressing: Addressing) -> Result<(), SceneError> {
        let names = ["west", "east", "north", "south"];
        for (border, name) in self.borders.iter().zip(names) {
            let periodic = *border == Border::Periodic;
            let word = format!("{border:?}").to_lowercase();
            if periodic && addressing == Addressing::Clamp {
                return refuse(
                    "shallow_water.borders",
                    format!("{word} in the {name}, while the field ends there"),
                    "wall, open or sea, or field.addressing wrap",
                );
            }
            if !periodic && addressing == Addressing::Wrap {
                return refuse(
                    "shallow_water.borders",
                    format!("{word} in the {name}, while the field repeats there"),
                    "periodic on all four sides, or field.addressing clamp",
                );
            }
        }
        Ok(())
    }
}

impl Default for ShallowWater {
    fn default() -> Self {
        Self {
            gravity_metres_per_second_squared: 9.81,
            manning: 0.02,
            step_seconds: 1.0 / 120.0,
            substep_cap: 16,
            courant: 0.45,
            borders: [Border::Wall; 4],
            sea_level: 0.5,
            swell: None,
            bodies: Vec::new(),
            rain_metres_per_second: 0.0,
            seepage_metres_per_second: 0.0,
            drops: None,
            springs: Vec::new(),
            plungers: Vec::new(),
            obstacles: Vec::new(),
            foam_per_second: 6.0,
            foam_seconds: 2.0,
            absorption_per_metre: [0.42, 0.12, 0.11],
            scatter: [0.016, 0.062, 0.072],
        }
    }
}

impl Default for Swell {
    fn default() -> Self {
        Self { amplitude_metres: 0.05, period_seconds: 1.0 }
    }
}

impl Default for Body {
    fn default() -> Self {
        Self { low: [0.0; 2], high: [1.0; 2], level: 0.5 }
    }
}

impl Default for Drops {
    fn default() -> Self {
        Self { per_second: 24.0, radius_metres: 0.02, depth_metres: 0.004 }
    }
}

#[cfg(test)]
impl ShallowWater {
    /// With one of everything.
    pub(super) fn full() -> Self {
        let post = Obstacle { centre: [0.5; 2], half_extent_metres: [0.1; 2], corner_metres: 0.02, top: 0.9 };
        Self {
            swell: Some(Swell::default()),
            bodies: vec![Body::default()],
            drops: Some(Drops::default()),
            springs: vec![Spring { centre: [0.2; 2], radius_metres: 0.1, metres_per_second: -0.1 }],
            plungers: vec![Plunger { centre: [0.2; 2], radius_metres: 0.1, depth_metres: 0.1, period_seconds: 1.0 }],
            obstacles: vec![post],
            ..Self::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_border_has_one_owner() {
        let mut scene = Scene { shallow_water: Some(ShallowWater::default()), ..Scene::default() };
        assert_eq!(scene.validate(), Ok(()));
        scene.field.addressing = Addressing::Wrap;
        let refusal = scene.validate().expect_err("walls in a field that repeats").to_string();
        assert!(refusal.contains("shallow_water.borders") && refusal.contains("wall in the west"), "{refusal}");
        let water = scene.shallow_water.as_mut().expect("it was just made");
        water.borders = [Border::Periodic; 4];
        assert_eq!(scene.validate(), Ok(()));
        scene.field.addressing = Addressing::Clamp;
        assert!(scene.validate().is_err(), "water that repeats in a field that ends");
    }
}
