//! The hand: what the brush does where it meets the surface.

use crate::field::gas_emit::Puff;
use crate::field::shallow_water::Event;
use crate::field::wave::Impulse;
use crate::scene::{Addressing, Gas, Scene, Shots};
use crate::stroke::{self, Lattice, Random, Stream, Stroke};

/// What the left mouse button does to the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BrushKind {
    /// A drop upon the water.
    Drop,
    /// A shot: a crater and its scorch, and a ring where it hits shallow water.
    Shot,
    /// A whirling puff into the gas.
    Puff,
    /// Water, poured out.
    Pour,
    /// Water, taken away.
    Drain,
}

impl BrushKind {
    /// Every kind.
    pub const ALL: &'static [Self] = &[Self::Drop, Self::Shot, Self::Puff, Self::Pour, Self::Drain];

    /// Those that do something in a scene.
    pub fn of(scene: &Scene) -> Vec<Self> {
        let does = |kind: &Self| match kind {
            Self::Drop => scene.shallow_water.is_some() || scene.wave.is_some(),
            Self::Shot => true,
            Self::Puff => scene.gas.is_some(),
            Self::Pour | Self::Drain => scene.shallow_water.is_some(),
        };
        Self::ALL.iter().copied().filter(does).collect()
    }

    /// What the panel calls it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Drop => "Drop on water",
            Self::Shot => "Shot into the ground",
            Self::Puff => "Puff into the gas",
            Self::Pour => "Pour water",
            Self::Drain => "Take water",
        }
    }
}

/// The left mouse button.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// What it does.
    pub kind: BrushKind,
    /// How large, metres.
    pub radius_metres: f32,
    /// How often while it is held, 1/s.
    pub per_second: f32,
}

impl Brush {
    /// Smallest and largest radius, metres.
    pub const RADIUS_METRES: [f32; 2] = [0.002, 0.3];

    /// What suits a scene.
    pub fn of(scene: &Scene) -> Self {
        let kind = if scene.gas.is_some() {
            BrushKind::Puff
        } else if scene.shallow_water.is_some() {
            BrushKind::Pour
        } else if scene.wave.is_some() {
            BrushKind::Drop
        } else {
            BrushKind::Shot
        };
        Self { kind, radius_metres: 0.03 * scene.plane.width_metres, per_second: 12.0 }
    }

    /// Grows it by `notches` of the wheel, a tenth each.
    pub fn grow(&mut self, notches: f32) {
        let [least, most] = Self::RADIUS_METRES;
        self.radius_metres = (self.radius_metres * 1.1_f32.powf(notches)).clamp(least, most);
    }
}

/// The stroke of a brush at a lattice position of the surface, the `number`th of the hand; none beyond the border of a field that
/// does not repeat, or upon water where there is none.
pub fn stroke(brush: &Brush, scene: &Scene, at: [f32; 2], number: u64) -> Option<Stroke> {
    let lattice = Lattice::of_scene(scene);
    let uv = [0, 1].map(|axis| (f64::from(at[axis]) + 0.5) / f64::from(lattice.size[axis]));
    let uv = match scene.field.addressing {
        Addressing::Wrap => uv.map(|along| along.rem_euclid(1.0)),
        Addressing::Clamp if uv.iter().all(|along| (0.0..=1.0).contains(along)) => uv,
        Addressing::Clamp => return None,
    };
    let radius = (f64::from(brush.radius_metres) / lattice.texel_metres) as f32;
    match brush.kind {
        // A tenth of its radius deep: what a bucket does.
        BrushKind::Pour | BrushKind::Drain => scene.shallow_water.as_ref().map(|_| {
            let sign = if brush.kind == BrushKind::Pour { 0.1 } else { -0.3 };
            Stroke::Water(Event::pour(lattice.at(uv), radius, sign * brush.radius_metres))
        }),
        BrushKind::Drop if scene.shallow_water.is_some() => {
            Some(Stroke::Water(Event::dent(lattice.at(uv), 2.0 * radius, 0.3 * brush.radius_metres, 0.0)))
        }
        BrushKind::Drop => scene.wave.as_ref().map(|_| {
            // As deep as the heaviest drop of the rain.
            Stroke::Splash(Impulse::new(lattice.at(uv), radius, -1.0))
        }),
        BrushKind::Puff => scene.gas.as_ref().map(|gas| Stroke::Puff(puff(brush, gas, scene.seed, &lattice, uv, number))),
        BrushKind::Shot => {
            let own = scene.shots.clone().unwrap_or_default();
            // As deep for its size as the scene's own.
            let depth_metres = own.depth_metres * brush.radius_metres / own.radius_metres[1];
            let shots = Shots { radius_metres: [brush.radius_metres; 2], depth_metres, ..own };
            let mut random = Random::new(scene.seed, Stream::Hand, number);
            Some(Stroke::Press(stroke::shot(&shots, &lattice, uv, &mut random)))
        }
    }
}

/// How much of a cell's own time a hand's puff takes to turn once: it stirs visibly, and stays below the flow's limit.
const STIR_CELLS: f64 = 0.5;

/// Puffs of a hand that push the same way: a stroke that is held stirs, and does not only tremble.
const PUFFS_A_PUSH: u64 = 8;

/// Bright gas that whirls, and drifts off in a direction of its own.
fn puff(brush: &Brush, gas: &Gas, seed: u64, lattice: &Lattice, uv: [f64; 2], number: u64) -> Puff {
    let mut random = Random::new(seed, Stream::Hand, number / PUFFS_A_PUSH);
    let heading = random.between(0.0, std::f64::consts::TAU);
    let turns = if random.unit() < 0.5 { -1.0 } else { 1.0 };
    let radius_metres = f64::from(brush.radius_metres);
    // Half a cell a step at its middle, and at its edge.
    let speed = STIR_CELLS * gas.cell_metres(lattice.texel_metres) / f64::from(gas.step_seconds);
    let mass = 0.25 * std::f64::consts::PI * radius_metres.powi(2) / 3.0;
    Puff {
        centre: lattice.at(uv),
        radius: (radius_metres / lattice.texel_metres) as f32,
        mass: [mass as f32, mass as f32],
        velocity: [(0.5 * speed * heading.cos()) as f32, (0.5 * speed * heading.sin()) as f32],
        spin: (turns * 2.0 * speed / radius_metres) as f32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Wave;

    fn water() -> Scene {
        Scene { wave: Some(Wave::default()), ..Scene::default() }
    }

    #[test]
    fn a_drop_falls_where_it_was_aimed_with_the_radius_of_the_brush() {
        let scene = water();
        let brush = Brush { radius_metres: 0.05, ..Brush::of(&scene) };
        let Some(Stroke::Splash(drop)) = stroke(&brush, &scene, [100.25, 7.0], 0) else { panic!("water takes drops") };
        assert!((drop.centre()[0] - 100.25).abs() < 1e-3 && (drop.centre()[1] - 7.0).abs() < 1e-3);
        assert!((drop.radius() - 0.05 * 512.0).abs() < 1e-3);
        assert!(drop.strength() < 0.0);
    }

    #[test]
    fn shots_differ_from_one_another_but_not_from_run_to_run() {
        let scene = Scene::default();
        let brush = Brush::of(&scene);
        let shot = |number| stroke(&brush, &scene, [50.0, 60.0], number);
        assert_eq!(shot(3), shot(3));
        assert_ne!(shot(3), shot(4));
        assert!(matches!(shot(3), Some(Stroke::Press(_))));
    }

    #[test]
    fn beyond_the_border_only_a_field_that_repeats_is_hit() {
        let mut scene = Scene::default();
        let brush = Brush::of(&scene);
        assert_eq!(stroke(&brush, &scene, [-3.0, 5.0], 0), None);
        scene.field.addressing = Addressing::Wrap;
        let Some(Stroke::Press(shot)) = stroke(&brush, &scene, [-3.0, 5.0], 0) else { panic!("it repeats") };
        assert!((shot.centre[0] - 509.0).abs() < 1e-3);
    }

    #[test]
    fn a_puff_is_blown_where_it_was_aimed_and_into_gas_alone() {
        let scene = Scene { gas: Some(Gas::default()), ..Scene::default() };
        let brush = Brush::of(&scene);
        let Some(Stroke::Puff(puff)) = stroke(&brush, &scene, [100.25, 7.0], 3) else { panic!("gas takes puffs") };
        assert!((puff.centre[0] - 100.25).abs() < 1e-3 && (puff.centre[1] - 7.0).abs() < 1e-3);
        assert!(puff.mass[0] > 0.0 && puff.spin != 0.0);
        assert_eq!(stroke(&brush, &scene, [100.25, 7.0], 3), stroke(&brush, &scene, [100.25, 7.0], 3));
        assert_eq!(stroke(&brush, &Scene::default(), [100.25, 7.0], 3), None);
    }

    #[test]
    fn without_water_no_drop_falls() {
        let brush = Brush { kind: BrushKind::Drop, ..Brush::of(&water()) };
        assert_eq!(stroke(&brush, &Scene::default(), [50.0, 60.0], 0), None);
    }
}
