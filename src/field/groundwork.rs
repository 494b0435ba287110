//! Groundwork: all that is done to the relief and its material in a frame, in the order of its time.
//!
//! What the hand takes back comes first. Then the scene's own stamps, and between them the steps of healing and cooling, each at the
//! time at which it is due: a frame that spans three steps does what three frames of one would have done, to the bit. What the hand
//! presses comes last, at the frame's own time.

use super::bins::BinError;
use super::cool::{self, Cool, CoolSet};
use super::heal::{self, Heal, HealSet};
use super::stamp::{self, Pressing, Stamp, StampImage, StampSet, Stamps};
use super::undo::Undo;
use super::{Dirty, Field, Region};
use crate::clock::Tick;
use crate::gpu::{Gpu, Recorder, ShaderError};
use crate::scene::Scene;
use crate::stroke::Strokes;

/// How late a frame may be for what is due at a time, seconds: the rounding of products of times.
const LATE_SECONDS: f64 = 1e-9;

/// The passes that work on the layers of one field.
pub struct Groundwork {
    stamps: Stamps,
    stamp_set: StampSet,
    heal: Option<(Heal, HealSet)>,
    cool: Option<(Cool, CoolSet)>,
    undo: Undo,
    /// Whether the layers are others than this has made.
    resumed: bool,
    traffic_bytes: u64,
}

/// What is due at some time, besides stamps.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Due {
    /// The step of healing of this number.
    Heal(u64),
    /// A pass of cooling.
    Cool,
}

impl Groundwork {
    /// Builds what a scene's layers need, and binds their field. It has to be told the base: [`Groundwork::reset`].
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu, field: &Field, scene: &Scene, images: &[StampImage]) -> Result<Self, ShaderError> {
        let stamps = Stamps::new(gpu)?;
        let mut stamp_set = stamps.bind(gpu, field, images);
        let heal = match &scene.healing {
            Some(healing) => {
                let heal = Heal::new(gpu)?;
                let set = heal.bind(gpu, field, f64::from(healing.seconds));
                Some((heal, set))
            }
            None => None,
        };
        let cool = match scene.cooling_seconds() {
            Some(seconds) => {
                stamp_set.cooling_seconds = seconds;
                let cool = Cool::new(gpu)?;
                let set = cool.bind(gpu, field);
                Some((cool, set))
            }
            None => None,
        };
        Ok(Self { stamps, stamp_set, heal, cool, undo: Undo::default(), resumed: false, traffic_bytes: 0 })
    }

    /// Starts anew from these heights.
    pub fn reset(&mut self, gpu: &Gpu, base: &[f32]) {
        if let Some((_, set)) = &mut self.heal {
            set.reset(gpu, base);
        }
        self.undo.clear();
    }

    /// The layers have been overwritten by those of a saved state: nothing is known of what is healed, and nothing can be taken back.
    pub fn resume(&mut self) {
        self.undo.clear();
        self.resumed = true;
    }

    /// Builds the passes anew from the device's present shaders.
    ///
    /// # Errors
    ///
    /// A shader does not compile: it goes on with those it had.
    pub fn reload(&mut self, gpu: &Gpu) -> Result<(), ShaderError> {
        let stamps = Stamps::new(gpu)?;
        let heal = if self.heal.is_some() { Some(Heal::new(gpu)?) } else { None };
        let cool = if self.cool.is_some() { Some(Cool::new(gpu)?) } else { None };
        self.stamps = stamps;
        if let (Some((heal, _)), Some(new)) = (&mut self.heal, heal) {
            *heal = new;
        }
        if let (Some((cool, _)), Some(new)) = (&mut self.cool, cool) {
            *cool = new;
        }
        Ok(())
    }

    /// How many strokes of the hand can be taken back.
    pub fn undoable(&self) -> usize {
        self.undo.len()
    }

    /// Whether a surface is still closing.
    pub fn heals(&self) -> bool {
        self.heal.as_ref().is_some_and(|(_, set)| set.is_open())
    }

    /// The images that stamps may have for their form.
    pub fn stamp_set(&self) -> &StampSet {
        &self.stamp_set
    }

    /// Bytes that the last frame read and wrote by design.
    pub fn traffic_bytes(&self) -> u64 {
        self.traffic_bytes
    }

    /// Bytes of GPU memory besides the field's own.
    pub fn memory_bytes(&self) -> u64 {
        let heal = self.heal.as_ref().map_or(0, |(_, set)| set.memory_bytes());
        heal + self.undo.memory_bytes() + self.stamp_set.memory_bytes()
    }

    /// Does to the layers what is to be done in a frame, and says which texels it may have changed.
    ///
    /// # Errors
    ///
    /// The stamps are too many for one frame on this adapter; then none is pressed.
    pub fn record(
        &mut self,
        recorder: &mut Recorder<'_>,
        field: &Field,
        tick: &Tick,
        strokes: &Strokes,
    ) -> Result<Dirty, BinError> {
        // Put back what the hand takes back.
        let mut dirty = Dirty::Nothing;
        for _ in 0..strokes.undo {
            dirty.merge(&self.undo.undo(recorder, field), field.size);
        }
        // Cut the scene's stamps by what is due between them; the hand's are a part of their own.
        let mut presses = strokes.presses.clone();
        presses.sort_by(|a, b| a.at_seconds.total_cmp(&b.at_seconds));
        let due = self.due(tick);
        let mut parts: Vec<&[Stamp]> = Vec::new();
        let mut rest = &presses[..];
        for (seconds, _) in &due {
            let (now, later) = rest.split_at(rest.partition_point(|stamp| stamp.at_seconds <= seconds + LATE_SECONDS));
            parts.push(now);
            rest = later;
        }
        parts.push(rest);
        parts.push(&strokes.hand);
        let pressing = self.stamps.prepare(recorder.gpu, &mut self.stamp_set, &parts)?;
        self.plan(recorder.gpu, tick, &due, &pressing, &mut dirty, field);

        let (mut heals, mut cools) = (0, 0);
        for (part, (_, due)) in due.iter().enumerate() {
            self.stamps.press(recorder, &self.stamp_set, &pressing, part);
            match (due, &self.heal, &self.cool) {
                (Due::Heal(_), Some((heal, set)), _) => {
                    heal.record(recorder, set, heals);
                    heals += 1;
                }
                (Due::Cool, _, Some((cool, set))) => {
                    cool.record(recorder, set, cools);
                    cools += 1;
                }
                _ => {}
            }
        }
        let [last, hand] = [due.len(), due.len() + 1];
        self.stamps.press(recorder, &self.stamp_set, &pressing, last);
        // Keep what is under the hand's, then press them.
        self.undo.keep(recorder, field, strokes.stroke_number, pressing.dirty(hand));
        self.stamps.press(recorder, &self.stamp_set, &pressing, hand);

        (0..parts.len()).for_each(|part| dirty.merge(pressing.dirty(part), field.size));
        let texels = u64::from(field.size[0]) * u64::from(field.size[1]);
        self.traffic_bytes = self.stamp_set.touched_texels() * stamp::TEXEL_BYTES
            + self.heal.as_ref().map_or(0, |(_, set)| set.healed_texels()) * heal::TEXEL_BYTES
            + cools as u64 * texels * cool::TEXEL_BYTES;
        Ok(dirty)
    }

    /// What is due in a frame, in the order of its time.
    fn due(&self, tick: &Tick) -> Vec<(f64, Due)> {
        let mut due = Vec::new();
        if let Some((_, set)) = &self.heal {
            let step = set.step_seconds();
            due.extend(counts(tick, step).map(|number| ((number + 1) as f64 * step, Due::Heal(number))));
        }
        if self.cool.is_some() {
            let every = cool::every_seconds(self.stamp_set.cooling_seconds);
            due.extend(counts(tick, every).map(|number| ((number + 1) as f64 * every, Due::Cool)));
        }
        due.sort_by(|a, b| a.0.total_cmp(&b.0));
        due
    }

    /// Plans and uploads the steps of healing and cooling; what they may change is dirty.
    fn plan(&mut self, gpu: &Gpu, tick: &Tick, due: &[(f64, Due)], pressing: &Pressing, dirty: &mut Dirty, field: &Field) {
        if let Some((heal, set)) = &mut self.heal {
            set.begin();
            let mut next = elapsed(tick.previous_seconds, set.step_seconds());
            // What was put back closes like what is pressed.
            set.open_regions(&dirty.regions(field.size), next);
            // To heal what is healed changes nothing.
            if std::mem::take(&mut self.resumed) {
                set.open_regions(&[Region::all(field.size)], next);
            }
            for (part, (_, due)) in due.iter().enumerate() {
                set.open(self.stamp_set.tiles(pressing, part), next);
                if let Due::Heal(number) = due {
                    dirty.merge(&set.plan(*number), field.size);
                    next = number + 1;
                }
            }
            for part in [due.len(), due.len() + 1] {
                set.open(self.stamp_set.tiles(pressing, part), next);
            }
            heal.upload(gpu, set);
        }
        if let Some((cool, set)) = &mut self.cool {
            let times: Vec<_> = due.iter().filter(|(_, due)| *due == Due::Cool).map(|(seconds, _)| *seconds).collect();
            cool.upload(gpu, set, &times, self.stamp_set.cooling_seconds);
        }
    }
}

/// How many whole steps of so many seconds are over at a time.
fn elapsed(seconds: f64, step_seconds: f64) -> u64 {
    ((seconds + LATE_SECONDS) / step_seconds).floor() as u64
}

/// The numbers of the steps that end in a frame.
fn counts(tick: &Tick, step_seconds: f64) -> std::ops::Range<u64> {
    elapsed(tick.previous_seconds, step_seconds)..elapsed(tick.time_seconds, step_seconds)
}
