//! The one clock: how much time a frame spans, and the steps that it owes each simulation.
//!
//! Live, capture and stress differ in the pace alone. A simulation has its own step; the frame at time t shows it after
//! ⌊t / step⌋ steps *in all*, and owes those that are not yet done. Counting from the start instead of adding up frame times keeps
//! rounding from accumulating, and makes what a frame shows independent of how many came before it: a warm-up and a long run agree
//! to the byte.

use serde::{Deserialize, Serialize};

/// A fraction of a step by which a frame may come too early for it: i·dt / step rounds to just below a whole number where it is
/// one. 1e-9 of a step is far above that rounding, for days of simulation, and far below what one could see.
const EARLY: f64 = 1e-9;

/// What is simulated by a step of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Simulation {
    /// The wave equation.
    Wave = 0,
    /// The shallow-water equations.
    ShallowWater = 1,
    /// The gas.
    Gas = 2,
}

impl Simulation {
    /// How many there are.
    pub const COUNT: usize = 3;
}

/// The step of each [`Simulation`], seconds; none where it does not run.
pub type StepSeconds = [Option<f64>; Simulation::COUNT];

/// How time passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// As it does outside: the seconds since the frame before.
    Realtime {
        /// Seconds since the frame before.
        elapsed_seconds: f64,
    },
    /// By the same time every frame: a function of the frame's number alone.
    Fixed {
        /// Seconds from frame to frame.
        dt_seconds: f64,
    },
    /// Not at all.
    Paused,
}

/// The steps that a frame owes one simulation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Owed {
    /// The steps done before this frame: the number of its first step.
    pub first_step: u64,
    /// The steps that it owes.
    pub steps: u32,
}

/// What one frame spans.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tick {
    /// The time that the frame shows, seconds from the start.
    pub time_seconds: f64,
    /// The time that the frame before showed; for the first frame, the same.
    pub previous_seconds: f64,
    /// What it owes each [`Simulation`].
    pub owed: [Owed; Simulation::COUNT],
    /// Simulated time that was given up because the frame owed more steps than the cap allows, seconds: the most of any simulation.
    pub behind_seconds: f64,
}

impl Tick {
    /// What the frame owes a simulation.
    pub fn owed(&self, simulation: Simulation) -> Owed {
        self.owed[simulation as usize]
    }
}

/// The steps of one simulation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Counter {
    step_seconds: Option<f64>,
    steps: u64,
    // Where counting began: steps since `origin_steps` cover the time since `origin_seconds`.
    origin_seconds: f64,
    origin_steps: u64,
}

impl Counter {
    /// The steps that are owed at a time, at most `cap` of them, and the time that was given up, seconds.
    fn owed(&mut self, time_seconds: f64, cap: u64) -> (Owed, f64) {
        let first_step = self.steps;
        let Some(step_seconds) = self.step_seconds else { return (Owed { first_step, steps: 0 }, 0.0) };
        let since_origin = ((time_seconds - self.origin_seconds) / step_seconds + EARLY).floor();
        let owed = (self.origin_steps + since_origin as u64).saturating_sub(self.steps);
        let done = owed.min(cap);
        // Give the rest up: the simulation runs slower than the clock on the wall, and the frame says by how much.
        let behind_seconds = (owed - done) as f64 * step_seconds;
        self.origin_seconds += behind_seconds;
        self.steps += done;
        (Owed { first_step, steps: done as u32 }, behind_seconds)
    }
}

/// A clock that has shown some frames.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Clock {
    counters: [Counter; Simulation::COUNT],
    time_seconds: f64,
    // Frames of the running fixed pace: its start, its dt and its frames since.
    fixed: Option<(f64, f64, u64)>,
    shown_any: bool,
}

impl Clock {
    /// The most steps that a frame in real time may owe a simulation. At 60 Hz one of 1,000 steps a second owes 17; one that needs
    /// more than this would be late for the next frame too.
    pub const STEP_CAP: u32 = 64;

    /// A clock at 0, for simulations of these steps.
    pub fn new(step_seconds: StepSeconds) -> Self {
        let counters = step_seconds.map(|step_seconds| Counter { step_seconds, ..Counter::default() });
        Self { counters, time_seconds: 0.0, fixed: None, shown_any: false }
    }

    /// The time that the last frame showed, seconds.
    pub fn time_seconds(&self) -> f64 {
        self.time_seconds
    }

    /// Changes the simulations' steps from here on; what has been simulated stays.
    pub fn set_steps(&mut self, step_seconds: StepSeconds) {
        for (counter, step_seconds) in self.counters.iter_mut().zip(step_seconds) {
            if counter.step_seconds != step_seconds {
                counter.step_seconds = step_seconds;
                (counter.origin_seconds, counter.origin_steps) = (self.time_seconds, counter.steps);
            }
        }
    }

    /// Goes on after a frame that another clock owed.
    pub fn follow(&mut self, tick: &Tick) {
        (self.time_seconds, self.fixed, self.shown_any) = (tick.time_seconds, None, true);
        for (counter, owed) in self.counters.iter_mut().zip(&tick.owed) {
            counter.steps = owed.first_step + u64::from(owed.steps);
            (counter.origin_seconds, counter.origin_steps) = (tick.time_seconds, counter.steps);
        }
    }

    /// The next frame. The first shows time 0, whatever the pace: the untouched start.
    pub fn advance(&mut self, pace: Pace) -> Tick {
        let previous_seconds = self.time_seconds;
        let first = !std::mem::replace(&mut self.shown_any, true);
        match pace {
            Pace::Fixed { dt_seconds } => {
                // A multiple of dt, not a sum of them.
                let (start, frames) = match self.fixed {
                    Some((start, dt, frames)) if dt == dt_seconds => (start, frames + 1),
                    _ => (self.time_seconds, if first { 0 } else { 1 }),
                };
                self.fixed = Some((start, dt_seconds, frames));
                self.time_seconds = start + frames as f64 * dt_seconds;
            }
            Pace::Realtime { elapsed_seconds } => {
                self.fixed = None;
                if !first {
                    self.time_seconds += elapsed_seconds.max(0.0);
                }
            }
            Pace::Paused => self.fixed = None,
        }
        let cap = match pace {
            Pace::Realtime { .. } => u64::from(Self::STEP_CAP),
            _ => u64::from(u32::MAX),
        };
        self.tick(previous_seconds, cap)
    }

    /// One frame of `dt_seconds` while paused.
    pub fn single_step(&mut self, dt_seconds: f64) -> Tick {
        let previous_seconds = self.time_seconds;
        self.shown_any = true;
        self.fixed = None;
        self.time_seconds += dt_seconds;
        self.tick(previous_seconds, u64::from(u32::MAX))
    }

    /// The steps that are owed at the present time, at most `cap` of each simulation.
    fn tick(&mut self, previous_seconds: f64, cap: u64) -> Tick {
        let mut tick = Tick { time_seconds: self.time_seconds, previous_seconds, ..Tick::default() };
        for (owed, counter) in tick.owed.iter_mut().zip(&mut self.counters) {
            let behind_seconds;
            (*owed, behind_seconds) = counter.owed(self.time_seconds, cap);
            tick.behind_seconds = tick.behind_seconds.max(behind_seconds);
        }
        tick
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1.0 / 60.0;

    /// A clock of one simulation.
    fn clock(step_seconds: f64) -> Clock {
        Clock::new([Some(step_seconds), None, None])
    }

    fn wave(tick: &Tick) -> Owed {
        tick.owed(Simulation::Wave)
    }

    #[test]
    fn the_first_frame_is_the_untouched_start() {
        for pace in [Pace::Fixed { dt_seconds: DT }, Pace::Realtime { elapsed_seconds: 3.0 }, Pace::Paused] {
            let tick = clock(1e-3).advance(pace);
            assert_eq!(tick, Tick::default(), "{pace:?}");
        }
    }

    #[test]
    fn a_fixed_pace_owes_the_whole_steps_of_its_time_without_drift() {
        for step in [DT / 4.0, DT, DT * 2.5, 1e-3, 0.0123] {
            let mut clock = clock(step);
            let mut steps = 0;
            for frame in 0..20_000_u32 {
                let tick = clock.advance(Pace::Fixed { dt_seconds: DT });
                assert_eq!(wave(&tick).first_step, steps);
                steps += u64::from(wave(&tick).steps);
                assert_eq!(tick.time_seconds, f64::from(frame) * DT);
                assert_eq!(steps, (f64::from(frame) * DT / step + EARLY).floor() as u64, "step {step}, frame {frame}");
            }
        }
    }

    #[test]
    fn four_steps_a_frame_are_four_in_every_frame() {
        // What adding up frame times gets wrong: 5 in one frame and 3 in the next.
        let mut clock = clock(DT / 4.0);
        clock.advance(Pace::Fixed { dt_seconds: DT });
        assert!((0..10_000).all(|_| wave(&clock.advance(Pace::Fixed { dt_seconds: DT })).steps == 4));
    }

    #[test]
    fn real_time_is_capped_and_says_how_far_it_falls_behind() {
        let mut clock = clock(1e-3);
        clock.advance(Pace::Realtime { elapsed_seconds: 0.0 });
        let tick = clock.advance(Pace::Realtime { elapsed_seconds: 1.0 });
        assert_eq!(wave(&tick).steps, Clock::STEP_CAP);
        assert!((tick.behind_seconds - (1.0 - 1e-3 * f64::from(Clock::STEP_CAP))).abs() < 1e-9);
        // What was given up is not owed later.
        let tick = clock.advance(Pace::Realtime { elapsed_seconds: 0.010_5 });
        assert_eq!((wave(&tick).steps, tick.behind_seconds), (10, 0.0));
    }

    #[test]
    fn paused_owes_nothing_and_a_single_step_one_frame() {
        let mut clock = clock(DT / 3.0);
        clock.advance(Pace::Paused);
        assert_eq!(wave(&clock.advance(Pace::Paused)).steps, 0);
        let tick = clock.single_step(DT);
        assert_eq!((wave(&tick).steps, tick.previous_seconds, tick.time_seconds), (3, 0.0, DT));
        assert_eq!(wave(&clock.advance(Pace::Paused)).steps, 0);
    }

    #[test]
    fn changes_of_pace_and_step_keep_what_was_simulated() {
        let mut clock = clock(DT);
        for _ in 0..=10 {
            clock.advance(Pace::Fixed { dt_seconds: DT });
        }
        clock.set_steps([Some(DT / 2.0), None, None]);
        let tick = clock.advance(Pace::Fixed { dt_seconds: DT });
        assert_eq!((wave(&tick).first_step, wave(&tick).steps), (10, 2));
        let tick = clock.advance(Pace::Realtime { elapsed_seconds: DT });
        assert_eq!((wave(&tick).first_step, wave(&tick).steps), (12, 2));
        let tick = clock.advance(Pace::Fixed { dt_seconds: 2.0 * DT });
        assert_eq!((wave(&tick).first_step, wave(&tick).steps), (14, 4));
    }

    #[test]
    fn simulations_count_their_own_steps() {
        let mut clock = Clock::new([Some(DT / 4.0), None, Some(DT * 2.0)]);
        for frame in 0..100_u64 {
            let tick = clock.advance(Pace::Fixed { dt_seconds: DT });
            let owed = |simulation| tick.owed(simulation).first_step + u64::from(tick.owed(simulation).steps);
            assert_eq!(
                [owed(Simulation::Wave), owed(Simulation::ShallowWater), owed(Simulation::Gas)],
                [4 * frame, 0, frame / 2]
            );
        }
    }
}
