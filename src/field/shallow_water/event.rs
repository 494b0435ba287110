//! What is done to shallow water, step by step, as data.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

use crate::scene::{self, Spring};
use crate::stroke::{Lattice, Random, Stream};

/// One thing done to the water before a step.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Event {
    /// Lattice coordinates.
    pub centre: [f32; 2],
    /// Texels.
    pub radius: f32,
    /// [`Event::POUR`] or [`Event::DENT`].
    pub kind: u32,
    /// Depth at the centre.
    pub metres: f32,
    /// Share of foam at the centre.
    pub foam: f32,
}

impl Event {
    /// Number of a pour in the shader.
    pub const POUR: u32 = 0;
    /// Number of a dent.
    pub const DENT: u32 = 1;

    /// The largest radius, texels: one workgroup visits all of its texels.
    pub const MAX_RADIUS: f32 = 256.0;

    /// Adds a smooth heap of this height, metres, that falls to nothing at the radius; below 0 it takes as much, as far as there is
    /// any.
    pub fn pour(centre: [f32; 2], radius: f32, metres: f32) -> Self {
        Self::new(centre, radius, Self::POUR, metres, 0.0)
    }

    /// Takes a smooth dent of this depth, metres, within half the radius, and heaps the same volume up in a ring around it, where there
    /// is water: its net is nothing.
    pub fn dent(centre: [f32; 2], radius: f32, metres: f32, foam: f32) -> Self {
        Self::new(centre, radius, Self::DENT, metres, foam)
    }

    fn new(centre: [f32; 2], radius: f32, kind: u32, metres: f32, foam: f32) -> Self {
        // What is no number does nothing: a place that no texel is near, a depth of 0.
        let finite = |value: f32, otherwise: f32| if value.is_finite() { value } else { otherwise };
        let radius = finite(radius, 1.0).clamp(1.0, Self::MAX_RADIUS);
        // Beyond, f32 lattice positions lose their fraction.
        let centre = centre.map(|at| finite(at, -1e6).clamp(-1e6, 1e6));
        Self { centre, radius, kind, metres: finite(metres, 0.0).clamp(-1e4, 1e4), foam: finite(foam, 0.0).clamp(0.0, 1.0) }
    }
}

/// What the scene's water does to itself before a step: its drops, springs and plungers.
pub fn events_in_step(
    water: &scene::ShallowWater,
    seed: u64,
    lattice: &Lattice,
    step: u64,
) -> impl Iterator<Item = Event> + use<> {
    let seconds = f64::from(water.step_seconds);
    let texels = |metres: f32| (f64::from(metres) / lattice.texel_metres) as f32;
    let mut events = drops_in_step(water, seed, lattice, step);
    let at = |uv: [f32; 2]| lattice.at(uv.map(f64::from));
    let flows = |spring: &&Spring| spring.metres_per_second != 0.0;
    events.extend(water.springs.iter().filter(flows).map(|spring| {
        Event::pour(at(spring.centre), texels(spring.radius_metres), (f64::from(spring.metres_per_second) * seconds) as f32)
    }));
    // A plunger that stands at depth·sin² has sunk by the difference since the step before. Only going down pushes.
    let dips = |step: u64, period: f64| (std::f64::consts::PI * step as f64 * seconds / period).sin().powi(2);
    events.extend(water.plungers.iter().filter_map(|plunger| {
        let period = f64::from(plunger.period_seconds);
        let sinks = f64::from(plunger.depth_metres) * (dips(step + 1, period) - dips(step, period));
        (sinks > 0.0).then(|| Event::dent(at(plunger.centre), texels(plunger.radius_metres), sinks as f32, 0.0))
    }));
    events.into_iter()
}

/// Drop k falls at time (k + U)/rate, as [`crate::stroke::rain_in_step`] has it.
fn drops_in_step(water: &scene::ShallowWater, seed: u64, lattice: &Lattice, step: u64) -> Vec<Event> {
    let Some(drops) = &water.drops else { return Vec::new() };
    let start_of = |step: u64| step as f64 * (f64::from(drops.per_second) * f64::from(water.step_seconds));
    let (start, end) = (start_of(step), start_of(step + 1));
    // A drop of interval k falls within it: the step that begins in an interval may end in the next, or later.
    let candidates = if drops.per_second > 0.0 { start as u64..end as u64 + 1 } else { 0..0 };
    candidates
        .filter_map(|number| {
            let mut random = Random::new(seed, Stream::Drops, number);
            let time = number as f64 + random.unit();
            (start <= time && time < end).then(|| {
                let centre = lattice.at([random.unit(), random.unit()]);
                let depth = f64::from(drops.depth_metres) * random.between(0.5, 1.0);
                Event::dent(centre, (f64::from(drops.radius_metres) / lattice.texel_metres) as f32, depth as f32, 0.0)
            })
        })
        .collect()
}
