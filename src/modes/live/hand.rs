//! The hand: what the brush does where it meets the surface.

use crate::field::gas_emit::Puff;
use crate::field::shallow_water::Event;
use crate::field::stamp::{Blend, Profile, Stamp};
use crate::field::wave::Impulse;
use crate::scene::{Addressing, Gas, Scene, Shots, Struck};
use crate::stroke::{Lattice, Random, Stream, Stroke, explosions, imprints, shots};

/// What the left mouse button does to the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BrushKind {
    /// A drop upon the water.
    Drop,
    /// A shot: a hole and what it does round itself, and a ring where it hits water.
    Shot,
    /// A charge: a crater that grows, and what it throws out.
    Charge,
    /// A groove along the way of the mouse.
    Groove,
    /// The scene's first imprint.
    Imprint,
    /// A whirling puff into the gas.
    Puff,
    /// Water, poured out.
    Pour,
    /// Water, taken away.
    Drain,
}

impl BrushKind {
    /// Those that a scene has a use for.
    pub fn of(scene: &Scene) -> Vec<Self> {
        let (wave, water, gas) = (scene.wave.is_some(), scene.shallow_water.is_some(), scene.gas.is_some());
        let kinds = [
            (Self::Drop, wave || water),
            (Self::Pour, water),
            (Self::Drain, water),
            (Self::Puff, gas),
            (Self::Shot, true),
            (Self::Charge, scene.explosions.is_some()),
            (Self::Groove, true),
            (Self::Imprint, !scene.imprints.is_empty()),
        ];
        kinds.into_iter().filter(|(_, is_there)| *is_there).map(|(kind, _)| kind).collect()
    }

    /// What the panel calls it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Drop => "Drop on water",
            Self::Shot => "Shot",
            Self::Charge => "Charge",
            Self::Groove => "Groove",
            Self::Imprint => "Imprint",
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
    /// What a shot hits.
    pub material: Struck,
    /// How large, metres.
    pub radius_metres: f32,
    /// How often while it is held, 1/s.
    pub per_second: f32,
}

impl Brush {
    /// Smallest and largest radius, metres.
    pub const RADIUS_METRES: [f32; 2] = [0.002, 2.0];

    /// What suits a scene.
    pub fn of(scene: &Scene) -> Self {
        let kind = match scene {
            Scene { gas: Some(_), .. } => BrushKind::Puff,
            Scene { shallow_water: Some(_), .. } => BrushKind::Pour,
            Scene { wave: Some(_), .. } => BrushKind::Drop,
            Scene { explosions: Some(_), .. } => BrushKind::Charge,
            Scene { tracks, .. } if !tracks.is_empty() => BrushKind::Groove,
            _ => BrushKind::Shot,
        };
        let material = scene.shots.as_ref().map_or(Struck::Stone, |shots| shots.material);
        let [_, largest] = Self::RADIUS_METRES;
        Self { kind, material, radius_metres: (0.03 * scene.plane.width_metres).min(largest), per_second: 12.0 }
    }

    /// Grows it by `notches` of the wheel, a tenth each.
    pub fn grow(&mut self, notches: f32) {
        let [least, most] = Self::RADIUS_METRES;
        self.radius_metres = (self.radius_metres * 1.1_f32.powf(notches)).clamp(least, most);
    }
}

/// What the hand has done, and what of it is still to come.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hand {
    /// How many random things it has done: each has a number.
    random: u64,
    /// The number of its stroke: all that one press of the button does.
    stroke: u64,
    /// Where the stroke was last and before that, as it came.
    way: [Option<[f32; 2]>; 2],
    /// How far the stroke has gone, texels.
    along: f32,
    /// What a charge will still press.
    pending: Vec<Stamp>,
}

impl Hand {
    /// Begins a stroke: the button is pressed.
    pub fn begin(&mut self) {
        self.stroke += 1;
        self.way = [None; 2];
        self.along = 0.0;
    }

    /// The number of the present stroke.
    pub fn stroke_number(&self) -> u64 {
        self.stroke
    }

    /// Forgets what is still to come: the last stroke is taken back.
    pub fn stop(&mut self) {
        self.pending.clear();
        self.way = [None; 2];
    }

    /// Whether something is still to come.
    pub fn waits(&self) -> bool {
        !self.pending.is_empty()
    }

    /// What is due at a time, in its order.
    pub fn due(&mut self, now_seconds: f64) -> Vec<Stroke> {
        self.pending.sort_by(|a, b| a.at_seconds.total_cmp(&b.at_seconds));
        let count = self.pending.partition_point(|stamp| stamp.at_seconds <= now_seconds);
        self.pending.drain(..count).map(Stroke::Press).collect()
    }

    /// The brush meets the surface at a lattice position, at a time. Nothing comes of it beyond the border of a field that does not
    /// repeat, or upon water where there is none.
    pub fn act(&mut self, brush: &Brush, scene: &Scene, at: [f32; 2], now_seconds: f64) -> Vec<Stroke> {
        let lattice = Lattice::of_scene(scene);
        let uv = [0, 1].map(|axis| (f64::from(at[axis]) + 0.5) / f64::from(lattice.size[axis]));
        let uv = match scene.field.addressing {
            Addressing::Wrap => uv.map(|along| along.rem_euclid(1.0)),
            Addressing::Clamp if uv.iter().all(|along| (0.0..=1.0).contains(along)) => uv,
            Addressing::Clamp => return Vec::new(),
        };
        let mut random = Random::new(scene.seed, Stream::Hand, self.random);
        self.random += 1;
        let radius = brush.radius_metres;
        match brush.kind {
            // A tenth of its radius deep: what a bucket does.
            BrushKind::Pour | BrushKind::Drain if scene.shallow_water.is_some() => {
                let share = if brush.kind == BrushKind::Pour { 0.1 } else { -0.3 };
                vec![Stroke::Water(Event::pour(lattice.at(uv), lattice.texels(f64::from(radius)), share * radius))]
            }
            BrushKind::Drop if scene.shallow_water.is_some() => {
                let wide = lattice.texels(2.0 * f64::from(radius));
                vec![Stroke::Water(Event::dent(lattice.at(uv), wide, 0.3 * radius, 0.0))]
            }
            BrushKind::Drop if scene.wave.is_some() => {
                // As deep as the heaviest drop of the rain.
                vec![Stroke::Splash(Impulse::new(lattice.at(uv), lattice.texels(f64::from(radius)), -1.0))]
            }
            BrushKind::Pour | BrushKind::Drain | BrushKind::Drop => Vec::new(),
            BrushKind::Puff => {
                let number = self.random - 1;
                let puff = |gas| Stroke::Puff(puff(brush, gas, scene.seed, &lattice, uv, number));
                scene.gas.as_ref().map(puff).into_iter().collect()
            }
            BrushKind::Shot => {
                let own = scene.shots.clone().unwrap_or_default();
                // As deep for its size as the scene's own.
                let depth_metres = own.depth_metres * radius / own.radius_metres[1];
                let shots = Shots { radius_metres: [radius; 2], depth_metres, material: brush.material, ..own };
                shots::shot(&shots, &scene.base, &lattice, uv, now_seconds, &mut random).into_iter().map(Stroke::Press).collect()
            }
            BrushKind::Charge => {
                let own = scene.explosions.clone().unwrap_or_default();
                let depth_metres = own.depth_metres * radius / own.radius_metres[1];
                let charge = crate::scene::Explosions { radius_metres: [radius; 2], depth_metres, ..own };
                self.pending.extend(explosions::explosion(&charge, &lattice, uv, now_seconds, &mut random));
                self.due(now_seconds)
            }
            BrushKind::Groove => vec![Stroke::Press(self.groove(&lattice, radius, at, now_seconds))],
            BrushKind::Imprint => {
                let stamp = scene.imprints.first().map(|imprint| imprints::pressed(imprint, 0, &lattice, uv));
                stamp.into_iter().map(|stamp| Stroke::Press(Stamp { at_seconds: now_seconds, ..stamp })).collect()
            }
        }
    }

    /// A piece of a groove, from where the stroke was last.
    fn groove(&mut self, lattice: &Lattice, radius_metres: f32, at: [f32; 2], now_seconds: f64) -> Stamp {
        let [last, before] = self.way;
        let centre = last.unwrap_or(at);
        let toward = |to: [f32; 2]| [0, 1].map(|axis| to[axis] - centre[axis]);
        let span = toward(at);
        self.way = [Some(at), last];
        let along = self.along;
        self.along += span[0].hypot(span[1]);
        let radius = f64::from(radius_metres);
        Stamp {
            at_seconds: now_seconds,
            centre,
            span,
            // Where the stroke began it joins the round end that its first touch pressed.
            joins: if last.is_some() { before.map_or([1e-3, 0.0], toward) } else { [0.0; 2] },
            radius: lattice.texels(radius),
            height: lattice.heights(0.35 * radius),
            profile: Profile::Rut,
            blend: Blend::Add,
            along,
            gloss: 0.4,
            ..Stamp::default()
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
    use crate::scene::{Explosions, Wave};

    fn water() -> Scene {
        Scene { wave: Some(Wave::default()), ..Scene::default() }
    }

    #[test]
    fn a_drop_falls_where_it_was_aimed_with_the_radius_of_the_brush() {
        let scene = water();
        let brush = Brush { radius_metres: 0.05, ..Brush::of(&scene) };
        let [Stroke::Splash(drop)] = Hand::default().act(&brush, &scene, [100.25, 7.0], 0.0)[..] else {
            panic!("water takes drops")
        };
        assert!((drop.centre()[0] - 100.25).abs() < 1e-3 && (drop.centre()[1] - 7.0).abs() < 1e-3);
        assert!((drop.radius() - 0.05 * 512.0).abs() < 1e-3);
        assert!(drop.strength() < 0.0);
    }

    #[test]
    fn shots_differ_from_one_another_but_not_from_run_to_run() {
        let scene = Scene::default();
        let brush = Brush::of(&scene);
        let shots = |count: u32| {
            let mut hand = Hand::default();
            (0..count).map(|_| hand.act(&brush, &scene, [50.0, 60.0], 0.5)).collect::<Vec<_>>()
        };
        assert_eq!(shots(3), shots(3));
        assert_ne!(shots(2)[0], shots(2)[1]);
        assert!(shots(1)[0].iter().all(|stroke| matches!(stroke, Stroke::Press(stamp) if stamp.at_seconds == 0.5)));
    }

    #[test]
    fn beyond_the_border_only_a_field_that_repeats_is_hit() {
        let mut scene = Scene::default();
        let brush = Brush::of(&scene);
        assert_eq!(Hand::default().act(&brush, &scene, [-3.0, 5.0], 0.0), []);
        scene.field.addressing = Addressing::Wrap;
        let strokes = Hand::default().act(&brush, &scene, [-3.0, 5.0], 0.0);
        assert!(strokes.iter().any(|stroke| {
            matches!(stroke, Stroke::Press(hole) if hole.profile == Profile::Crater && (hole.centre[0] - 509.0).abs() < 1e-3)
        }));
    }

    #[test]
    fn a_puff_is_blown_where_it_was_aimed_and_into_gas_alone() {
        let scene = Scene { gas: Some(Gas::default()), ..Scene::default() };
        let brush = Brush::of(&scene);
        let blown = |scene: &Scene| Hand::default().act(&brush, scene, [100.25, 7.0], 0.0);
        let [Stroke::Puff(puff)] = blown(&scene)[..] else { panic!("gas takes puffs") };
        assert!((puff.centre[0] - 100.25).abs() < 1e-3 && (puff.centre[1] - 7.0).abs() < 1e-3);
        assert!(puff.mass[0] > 0.0 && puff.spin != 0.0);
        assert_eq!(blown(&scene), blown(&scene));
        assert_eq!(blown(&Scene::default()), []);
    }

    #[test]
    fn without_water_no_drop_falls() {
        let brush = Brush { kind: BrushKind::Drop, ..Brush::of(&water()) };
        assert_eq!(Hand::default().act(&brush, &Scene::default(), [50.0, 60.0], 0.0), []);
    }

    #[test]
    fn a_charge_goes_on_until_it_is_stopped() {
        let scene = Scene { explosions: Some(Explosions::default()), ..Scene::default() };
        let brush = Brush::of(&scene);
        assert_eq!(brush.kind, BrushKind::Charge);
        let mut hand = Hand::default();
        assert!(hand.act(&brush, &scene, [200.0, 200.0], 1.0).is_empty() && hand.waits());
        let first = hand.due(1.1);
        assert!((1..=16).contains(&first.len()), "{}", first.len());
        let mut stopped = hand.clone();
        stopped.stop();
        assert!(!stopped.waits());
        let rest = hand.due(100.0);
        assert_eq!((first.len() + rest.len()) as u32, 16 + Explosions::default().ejecta);
    }

    #[test]
    fn a_groove_is_a_chain_whose_pieces_join() {
        let scene = Scene::default();
        let brush = Brush { kind: BrushKind::Groove, ..Brush::of(&scene) };
        let mut hand = Hand::default();
        hand.begin();
        let pieces: Vec<_> = [[10.0, 10.0], [30.0, 10.0], [50.0, 20.0], [60.0, 40.0]]
            .into_iter()
            .flat_map(|at| hand.act(&brush, &scene, at, 0.0))
            .filter_map(|stroke| if let Stroke::Press(stamp) = stroke { Some(stamp) } else { None })
            .collect();
        assert_eq!(pieces[0].span, [0.0, 0.0]);
        assert_eq!((pieces[2].centre, pieces[2].span, pieces[2].joins), ([30.0, 10.0], [20.0, 10.0], [-20.0, 0.0]));
        assert_eq!(pieces[3].along, 20.0 + 500.0_f32.sqrt());
        hand.begin();
        let [Stroke::Press(apart)] = hand.act(&brush, &scene, [100.0, 100.0], 0.0)[..] else { panic!("it presses") };
        assert_eq!((apart.span, apart.joins), ([0.0, 0.0], [0.0, 0.0]));
    }
}
