//! What a hand, a script or a stress test does to the field, as plain, seeded data.
//!
//! Every random stroke has a number, and its own generator made from the seed and that number: what a stroke looks like depends
//! neither on the strokes before it nor on how frames cut time into pieces. A warm-up of W frames and then N more are W + N.

mod disturb;
pub mod explosions;
pub mod imprints;
pub mod shots;
pub mod tracks;

use std::sync::Arc;

use rand::rngs::Xoshiro256PlusPlus;
use rand::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};

use crate::clock::{Simulation, Tick};
use crate::field::gas_bands::Bands;
use crate::field::gas_emit::Puff;
use crate::field::sequence::Images;
use crate::field::shallow_water::{self, Event};
use crate::field::stamp::{Blend, Profile, Stamp};
use crate::field::wave::{self, Impulse};
use crate::scene::{Gas, GasEmitters, Rain, Scene};

/// One thing done to the field.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum Stroke {
    /// A stamp pressed into the relief.
    Press(Stamp),
    /// An impulse upon the water.
    Splash(Impulse),
    /// What follows belongs to the hand's stroke of this number: all that one press of the button does until it is released. Numbers
    /// rise.
    Number(u64),
    /// The hand's last stroke is taken back, before anything is pressed.
    Undo,
    /// A puff into the gas.
    Puff(Puff),
    /// Something done to shallow water.
    Water(Event),
}

/// All that is done to the field in one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strokes {
    /// The scene's own stamps, in the order of their times.
    pub presses: Vec<Stamp>,
    /// The impulses, each with the step of the frame before which it falls: 0 is the first.
    pub splashes: Vec<(u32, Impulse)>,
    /// The hand's stamps, pressed after the scene's: these can be undone.
    pub hand: Vec<Stamp>,
    /// Which stroke of the hand they belong to: see [`Stroke::Number`].
    pub stroke_number: u64,
    /// How many of the hand's last strokes are taken back, before anything is pressed.
    pub undo: u32,
    /// The puffs, each with the step of the frame before which it falls.
    pub puffs: Vec<(u32, Puff)>,
    /// What is done to shallow water, each with the step of the frame before which it happens.
    pub waters: Vec<(u32, Event)>,
    /// What the moment shows of a series of images, if the scene plays one: whoever reads files hands it over.
    pub images: Option<Arc<Images>>,
}

impl Strokes {
    /// Adds what a hand did since the last frame: a splash falls before the frame's first step, or without one while time stands.
    pub fn push(&mut self, stroke: Stroke) {
        match stroke {
            Stroke::Press(stamp) => self.hand.push(stamp),
            Stroke::Splash(impulse) => self.splashes.push((0, impulse)),
            Stroke::Number(number) => self.stroke_number = number,
            Stroke::Undo => self.undo += 1,
            // Before those of the scene's own particles, which may fall later: the steps stay in order.
            Stroke::Puff(puff) => self.puffs.insert(0, (0, puff)),
            // In order of their steps: a hand's come after the scene's.
            Stroke::Water(event) => {
                let before = self.waters.partition_point(|(step, _)| *step == 0);
                self.waters.insert(before, (0, event));
            }
        }
    }

    /// Adds all that a hand did to a scene since the last frame, and what that disturbs.
    pub fn add_hand(&mut self, scene: &Scene, strokes: &[Stroke]) {
        strokes.iter().for_each(|stroke| self.push(*stroke));
        self.disturb_by_hand(scene);
    }

    /// What the scene itself does in the frame: its rain, its shots, whatever else it presses.
    pub fn of_scene(scene: &Scene, seed: u64, tick: &Tick) -> Self {
        let lattice = Lattice::of_scene(scene);
        let mut strokes =
            Self { presses: presses_between(scene, seed, &lattice, tick.previous_seconds, tick.time_seconds), ..Self::default() };
        if let Some((wave, rain)) = scene.wave.as_ref().and_then(|wave| Some((wave, wave.rain.as_ref()?))) {
            let step_seconds = wave::step_seconds(wave, lattice.texel_metres);
            let owed = tick.owed(Simulation::Wave);
            for step in 0..owed.steps {
                let impulses = rain_in_step(rain, seed, &lattice, step_seconds, owed.first_step + u64::from(step));
                strokes.splashes.extend(impulses.map(|impulse| (step, impulse)));
            }
        }
        if let Some((gas, emitters)) = scene.gas.as_ref().and_then(|gas| Some((gas, gas.emitters.as_ref()?))) {
            let owed = tick.owed(Simulation::Gas);
            for step in 0..owed.steps {
                let puffs = emitted_in_step(gas, emitters, seed, &lattice, owed.first_step + u64::from(step));
                strokes.puffs.extend(puffs.map(|puff| (step, puff)));
            }
        }
        if let Some(water) = &scene.shallow_water {
            let owed = tick.owed(Simulation::ShallowWater);
            for step in 0..owed.steps {
                let number = owed.first_step + u64::from(step);
                let events = shallow_water::events_in_step(water, seed, &lattice, number);
                strokes.waters.extend(events.map(|event| (step, event)));
            }
        }
        strokes.disturb(scene, seed, tick);
        strokes
    }
}

/// Whether what happens at a time has happened at another, seconds: a frame that is due at its very time shows it, however products
/// round.
fn due(at_seconds: f64, now_seconds: f64) -> bool {
    at_seconds <= now_seconds + 1e-9
}

/// The numbers k of what happens at (k + `phase`)/rate after one time and until another.
fn numbers_between(rate: f64, phase: f64, after_seconds: f64, until_seconds: f64) -> std::ops::Range<u64> {
    let happened = |seconds: f64| ((seconds + 1e-9) * rate - phase + 1.0).floor().max(0.0) as u64;
    happened(after_seconds)..happened(until_seconds)
}

/// All stamps that a scene itself presses after one time and until another, seconds, in the order of their times.
pub fn presses_between(scene: &Scene, seed: u64, lattice: &Lattice, after_seconds: f64, until_seconds: f64) -> Vec<Stamp> {
    let mut presses = Vec::new();
    if let Some(shots) = &scene.shots {
        presses.extend(shots::between(shots, &scene.base, seed, lattice, after_seconds, until_seconds));
    }
    if let Some(explosions) = &scene.explosions {
        presses.extend(explosions::between(explosions, seed, lattice, after_seconds, until_seconds));
    }
    for track in &scene.tracks {
        presses.extend(tracks::between(track, lattice, scene.field.addressing, after_seconds, until_seconds));
    }
    for (number, imprint) in (0..).zip(&scene.imprints) {
        presses.extend(imprints::between(imprint, number, lattice, after_seconds, until_seconds));
    }
    // Stable: of what happens at once, the order is that above.
    presses.sort_by(|a, b| a.at_seconds.total_cmp(&b.at_seconds));
    presses
}

/// The field's texels, as strokes see them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Size of the field, texels.
    pub size: [u32; 2],
    /// Side of a texel, metres.
    pub texel_metres: f64,
    /// Depth of h = 0, metres.
    pub depth_metres: f64,
}

impl Lattice {
    /// The lattice of a scene's field.
    pub fn of_scene(scene: &Scene) -> Self {
        Self { size: scene.field.size, texel_metres: scene.texel_metres(), depth_metres: f64::from(scene.plane.depth_metres) }
    }

    /// A point of the plane, metres along u and v from its upper left corner.
    pub fn metres(&self, uv: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| uv[axis] * f64::from(self.size[axis]) * self.texel_metres)
    }

    /// Texels of a length in metres.
    pub fn texels(&self, metres: f64) -> f32 {
        (metres / self.texel_metres) as f32
    }

    /// Heights of a depth in metres.
    pub fn heights(&self, metres: f64) -> f32 {
        (metres / self.depth_metres) as f32
    }

    /// A point of the plane in lattice coordinates.
    pub fn at(&self, uv: [f64; 2]) -> [f32; 2] {
        [0, 1].map(|axis| (uv[axis] * f64::from(self.size[axis]) - 0.5) as f32)
    }
}

/// The drops that fall in one step of the wave.
///
/// Drop k falls at time (k + U)/rate, U uniform: as irregular as rain looks, but never later than two mean intervals after the one
/// before. With the exponential gaps of a Poisson process some seeds would leave the water still for the first eight frames.
pub fn rain_in_step(
    rain: &Rain,
    seed: u64,
    lattice: &Lattice,
    step_seconds: f64,
    step: u64,
) -> impl Iterator<Item = Impulse> + use<> {
    // Both ends by one expression: the end of a step is the start of the next to the bit, and no drop is lost or doubled.
    let start_of = |step: u64| step as f64 * (f64::from(rain.drops_per_second) * step_seconds);
    let (start, end) = (start_of(step), start_of(step + 1));
    let radius = (f64::from(rain.radius_metres) / lattice.texel_metres) as f32;
    let (lattice, strength) = (*lattice, rain.strength);
    let candidates = if rain.drops_per_second > 0.0 { start as u64..end as u64 + 1 } else { 0..0 };
    candidates.filter_map(move |number| {
        let mut random = Random::new(seed, Stream::Rain, number);
        let time = number as f64 + random.unit();
        (start <= time && time < end).then(|| {
            let centre = lattice.at([random.unit(), random.unit()]);
            // A drop dents the water; drops differ by a factor of two.
            Impulse::new(centre, radius, -strength * random.between(0.5, 1.0) as f32)
        })
    })
}

/// What the particles that live in one step of the gas emit in it.
///
/// Particle k is born at time (k + U)/rate, U uniform, drifts with the wind of the row that it is born in, and emits most in the middle
/// of its life. Each turns as a vortex does that the shear around it keeps alive.
pub fn emitted_in_step(
    gas: &Gas,
    emitters: &GasEmitters,
    seed: u64,
    lattice: &Lattice,
    step: u64,
) -> impl Iterator<Item = Puff> + use<> {
    let step_seconds = f64::from(gas.step_seconds);
    let rate = f64::from(emitters.per_second);
    let lifetime = f64::from(emitters.lifetime_seconds);
    let now = (step as f64 + 0.5) * step_seconds;
    let first = ((now - lifetime) * rate - 1.0).floor().max(0.0) as u64;
    let born = if rate > 0.0 { first..(now * rate).ceil() as u64 + 1 } else { 0..0 };
    let (lattice, emitters, bands) = (*lattice, emitters.clone(), gas.bands.clone());
    let metres = lattice.size.map(|side| f64::from(side) * lattice.texel_metres);
    born.filter_map(move |number| {
        let mut random = Random::new(seed, Stream::Gas, number);
        let age = now - (number as f64 + random.unit()) / rate;
        if !(0.0..lifetime).contains(&age) {
            return None;
        }
        // Not where the wind dies away.
        let [u, v] = [random.unit(), random.between(0.14, 0.86)];
        let size = random.between(0.4, 1.0);
        let heading = random.between(0.0, std::f64::consts::TAU);
        let dye = random.unit();
        let bands = bands.as_ref().map(|bands| Bands::new(bands, seed));
        let wind = |v: f64| bands.as_ref().map_or(0.0, |bands| bands.wind(v));
        let shear = wind(v + 0.01) - wind(v - 0.01);
        let at = [(u + wind(v) * age / metres[0]).rem_euclid(1.0), v];
        let strength = (std::f64::consts::PI * age / lifetime).sin() * step_seconds;
        let radius_metres = size * f64::from(emitters.radius_metres);
        // The profile holds a third of the disc's area: that makes its middle what the settings say.
        let mass = f64::from(emitters.density_per_second) * strength * std::f64::consts::PI * radius_metres.powi(2) / 3.0;
        let push = f64::from(emitters.push) * strength;
        Some(Puff {
            centre: lattice.at(at),
            radius: (radius_metres / lattice.texel_metres) as f32,
            mass: [mass as f32, (mass * (dye - 0.4)) as f32],
            velocity: [(push * heading.cos()) as f32, (push * heading.sin()) as f32],
            spin: (-shear.signum() * f64::from(emitters.spin) * strength) as f32,
        })
    })
}

/// The discs that a stress test presses in a frame. Even frames press them in, odd frames lift the same ones again: the load is
/// that of every frame, and the field neither saturates nor wears out.
pub fn stress_discs(seed: u64, frame: u64, count: u32, radius: f32, size: [u32; 2]) -> impl Iterator<Item = Stamp> {
    let height = if frame.is_multiple_of(2) { -0.02 } else { 0.02 };
    (0..u64::from(count)).map(move |index| {
        let mut random = Random::new(seed, Stream::Stress, frame / 2 * u64::from(count) + index);
        let centre = [0, 1].map(|axis| (random.unit() * f64::from(size[axis]) - 0.5) as f32);
        Stamp { centre, radius, height, profile: Profile::Disc, blend: Blend::Add, ..Stamp::default() }
    })
}

/// Which sequence of random numbers: strokes of different kinds share none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Drops.
    Rain,
    /// A scene's shots.
    Shots,
    /// A stress test's discs.
    Stress,
    /// What a hand does in the window.
    Hand,
    /// A gas's particles.
    Gas,
    /// Drops on shallow water.
    Drops,
    /// A scene's charges.
    Explosions,
}

/// The random numbers of one stroke. Xoshiro256++ and the conversion below are fixed for ever; `rand`'s distributions are not.
#[derive(Clone, Debug)]
pub struct Random(Xoshiro256PlusPlus);

impl Random {
    /// The generator of one numbered stroke.
    pub fn new(seed: u64, stream: Stream, number: u64) -> Self {
        // `seed_from_u64` mixes its argument well, so consecutive numbers give unrelated generators; the seed goes through it once
        // on its own, else seed 1's first stroke would be seed 0's second.
        let mut of_stream = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut key = of_stream.next_u64();
        for _ in 0..stream as u32 {
            key = of_stream.next_u64();
        }
        Self(Xoshiro256PlusPlus::seed_from_u64(key.wrapping_add(number)))
    }

    /// Uniform in 0..1, 1 excluded.
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform between two bounds.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::{Clock, Pace};
    use crate::scene::{self, Shots};

    fn wall() -> Scene {
        Scene { shots: Some(Shots::default()), ..Scene::default() }
    }

    fn water() -> Scene {
        Scene { wave: Some(scene::Wave { rain: Some(Rain::default()), ..scene::Wave::default() }), ..Scene::default() }
    }

    /// All strokes of a run, each with the number of the step before which it falls.
    fn run(scene: &Scene, seed: u64, dt_seconds: f64, frames: u32) -> (Vec<Stamp>, Vec<(u64, Impulse)>) {
        let step = scene.wave.as_ref().map(|wave| wave::step_seconds(wave, Lattice::of_scene(scene).texel_metres));
        let mut clock = Clock::new([step, None, None]);
        let (mut presses, mut splashes) = (Vec::new(), Vec::new());
        for _ in 0..frames {
            let tick = clock.advance(Pace::Fixed { dt_seconds });
            let strokes = Strokes::of_scene(scene, seed, &tick);
            presses.extend(strokes.presses);
            splashes.extend(
                strokes
                    .splashes
                    .into_iter()
                    .map(|(step, impulse)| (tick.owed(Simulation::Wave).first_step + u64::from(step), impulse)),
            );
        }
        (presses, splashes)
    }

    #[test]
    fn frames_do_not_change_what_falls_and_when() {
        // 12 s cut into frames of 1/60 s and of 1/25 s.
        let cut = |scene: &Scene| [run(scene, 7, 1.0 / 60.0, 721), run(scene, 7, 1.0 / 25.0, 301)];
        let [sixty, twenty_five] = cut(&wall());
        assert_eq!(sixty, twenty_five);
        assert_eq!(sixty.0.iter().filter(|stamp| stamp.profile == Profile::Crater).count(), 120);
        let [sixty, twenty_five] = cut(&water());
        assert_eq!(sixty, twenty_five);
        // The last of the 288 intervals is cut by the last step that is owed.
        assert!((287..=288).contains(&sixty.1.len()));
    }

    #[test]
    fn a_shot_into_water_makes_a_ring_and_no_hole_and_frames_do_not_change_when() {
        let mut scene = water();
        scene.wave.as_mut().unwrap().rain = None;
        scene.shots = Some(Shots::default());
        let [sixty, twenty_five] = [run(&scene, 7, 1.0 / 60.0, 721), run(&scene, 7, 1.0 / 25.0, 301)];
        assert_eq!(sixty, twenty_five);
        assert!(sixty.0.is_empty());
        assert!((119..=120).contains(&sixty.1.len()), "{}", sixty.1.len());
        // A post is no water: what hits it breaks it.
        let post = scene::Obstacle { centre: [0.5, 0.5], half_extent_metres: [2.0, 2.0], corner_metres: 0.0, top: 1.0 };
        scene.wave.as_mut().unwrap().obstacles.push(post);
        let (presses, splashes) = run(&scene, 7, 1.0 / 60.0, 721);
        assert!(splashes.is_empty());
        assert_eq!(presses.iter().filter(|stamp| stamp.profile == Profile::Crater).count(), 120);
        // The hand's are no other.
        let mut strokes = Strokes { hand: presses, ..Strokes::default() };
        strokes.disturb_by_hand(&scene);
        assert!(!strokes.hand.is_empty() && strokes.splashes.is_empty());
        scene.wave.as_mut().unwrap().obstacles.clear();
        strokes.disturb_by_hand(&scene);
        assert!(strokes.hand.is_empty() && strokes.splashes.len() == 120);
    }

    #[test]
    fn particles_are_a_function_of_the_step_and_live_their_time() {
        let gas = Gas::default();
        let emitters = GasEmitters { per_second: 2.0, lifetime_seconds: 4.0, ..GasEmitters::default() };
        let lattice = Lattice::of_scene(&Scene::default());
        let puffs = |seed, step| emitted_in_step(&gas, &emitters, seed, &lattice, step).collect::<Vec<_>>();
        assert_eq!(puffs(3, 500), puffs(3, 500));
        assert_ne!(puffs(3, 500), puffs(4, 500));
        // Eight live at a time, one more or less; each emits for its four seconds, 120 steps of them.
        let alive: Vec<usize> = (300..3300).map(|step| puffs(3, step).len()).collect();
        assert!(alive.iter().all(|count| (7..=9).contains(count)), "{alive:?}");
        assert_eq!(alive.iter().sum::<usize>() / 3000, 8 - usize::from(alive.iter().sum::<usize>() < 24_000));
        let none = GasEmitters { per_second: 0.0, ..emitters.clone() };
        assert_eq!(emitted_in_step(&gas, &none, 3, &lattice, 500).count(), 0);
    }

    #[test]
    fn another_seed_is_another_run() {
        let [a, b] = [1, 2].map(|seed| run(&wall(), seed, 1.0 / 60.0, 60).0);
        assert!(a.iter().all(|stamp| !b.contains(stamp)));
        let [a, b] = [1, 2].map(|seed| run(&water(), seed, 1.0 / 60.0, 60).1);
        assert!(a.iter().all(|(_, impulse)| b.iter().all(|(_, other)| impulse != other)));
    }

    #[test]
    fn every_seed_changes_something_within_eight_frames_and_nothing_in_the_first() {
        for seed in 0..500 {
            for (frames, moves) in [(8, true), (1, false)] {
                assert_eq!(!run(&wall(), seed, 1.0 / 60.0, frames).0.is_empty(), moves, "seed {seed}");
                assert_eq!(!run(&water(), seed, 1.0 / 60.0, frames).1.is_empty(), moves, "seed {seed}");
            }
        }
    }

    #[test]
    fn shots_and_drops_come_when_they_are_due() {
        let scene = water();
        let lattice = Lattice::of_scene(&scene);
        let fired = |until| numbers_between(10.0, 0.5, 0.0, until).count();
        // The first at 0.05 s, which is the third frame's very time at 60 Hz; then one every tenth of a second.
        assert_eq!([0.0, 2.0 / 60.0, 3.0 / 60.0, 0.149, 0.15, 1.0].map(fired), [0, 0, 1, 1, 2, 10]);
        // Each drop falls in its own interval, and no interval goes without.
        let rain = Rain { drops_per_second: 20.0, ..Rain::default() };
        let step = 1e-3;
        for interval in 0..200_u64 {
            let drops = (interval * 50..(interval + 1) * 50).flat_map(|number| rain_in_step(&rain, 4, &lattice, step, number));
            assert_eq!(drops.count(), 1, "interval {interval}");
        }
    }

    #[test]
    fn stress_lifts_what_it_pressed() {
        let frame = |frame| stress_discs(3, frame, 100, 8.0, [256, 128]).collect::<Vec<_>>();
        let lifted: Vec<_> = frame(1).into_iter().map(|stamp| Stamp { height: -stamp.height, ..stamp }).collect();
        assert_eq!(frame(0), lifted);
        assert_ne!(frame(0), frame(2));
    }

    #[test]
    fn random_numbers_are_the_same_for_ever() {
        // Printed once by this program; another value means that every capture of every scene changes.
        let mut random = Random::new(42, Stream::Shots, 7);
        let numbers = [random.unit(), random.unit(), random.between(-1.0, 1.0)];
        assert_eq!(numbers, [0.5699612037129008, 0.3888441762761321, -0.055890590508624216]);
    }
}
