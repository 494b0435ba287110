//! What is pressed into the ground disturbs what moves over it.

use super::{Lattice, Strokes, presses_between};
use crate::clock::{Simulation, Tick};
use crate::field::stamp::{Profile, Stamp};
use crate::field::wave::{self, Impulse};
use crate::scene::{Boundary, Scene, Wave};

impl Strokes {
    /// Lets this frame's stamps disturb the scene's simulations. The one place where a stamp becomes that:
    ///
    /// - *waves*: what is pressed into open water presses no relief; its craters make rings of no net mass, each before the step
    ///   at whose time it falls. What hits a post breaks it.
    pub(super) fn disturb(&mut self, scene: &Scene, seed: u64, tick: &Tick) {
        let lattice = Lattice::of_scene(scene);
        if let Some(wave) = &scene.wave {
            self.presses.retain(|stamp| !falls_into_water(stamp, wave, scene, &lattice));
            // A frame ends between two steps. What falls after its last step disturbs the first of the next frame: so each step gets
            // what falls in its own time, however frames cut it.
            let step_seconds = wave::step_seconds(wave, lattice.texel_metres);
            let owed = tick.owed(Simulation::Wave);
            let time = |step: u64| step as f64 * step_seconds;
            let [first, end] = [owed.first_step, owed.first_step + u64::from(owed.steps)];
            for stamp in presses_between(scene, seed, &lattice, time(first), time(end)) {
                if stamp.profile == Profile::Crater && falls_into_water(&stamp, wave, scene, &lattice) {
                    let step = ((stamp.at_seconds / step_seconds) as u64).clamp(first, end - 1);
                    self.splashes.push(((step - first) as u32, ring(&stamp, wave)));
                }
            }
            self.splashes.sort_by_key(|(step, _)| *step);
        }
    }

    /// The same for what the hand did, before the frame's first step.
    pub(super) fn disturb_by_hand(&mut self, scene: &Scene) {
        let lattice = Lattice::of_scene(scene);
        if let Some(wave) = &scene.wave {
            let (fallen, pressed) = self.hand.iter().partition(|stamp| falls_into_water(stamp, wave, scene, &lattice));
            self.hand = pressed;
            let fallen: Vec<Stamp> = fallen;
            let craters = fallen.iter().filter(|stamp| stamp.profile == Profile::Crater);
            self.splashes.splice(0..0, craters.map(|stamp| (0, ring(stamp, wave))));
        }
    }
}

/// Whether a stamp falls on open water, not on a post.
fn falls_into_water(stamp: &Stamp, wave: &Wave, scene: &Scene, lattice: &Lattice) -> bool {
    let uv = [0, 1].map(|axis| (f64::from(stamp.centre[axis]) + 0.5) / f64::from(lattice.size[axis]));
    let periodic = wave.boundary == Boundary::Periodic;
    !wave.obstacles.iter().any(|obstacle| wave::stands_on(obstacle, uv, scene.plane_size_metres(), periodic))
}

/// The ring of a stamp: as wide as the stamp, as deep as it would have pressed, but never deeper than the water can move.
fn ring(stamp: &Stamp, wave: &Wave) -> Impulse {
    let depth = stamp.height.abs().min(wave.amplitude) / wave.amplitude.max(1e-6);
    Impulse::new(stamp.centre, stamp.radius, -depth)
}
