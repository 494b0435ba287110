//! Tracks: boots, tyres and skis, laid while time passes as swept capsules.
//!
//! A track is a line that weaves about its heading, a function of the way along it; step k is done at a time of its own. Where the
//! field wraps it goes on at the opposite border.

use super::{Lattice, due, numbers_between};
use crate::field::stamp::{Blend, Profile, Stamp};
use crate::scene::{Addressing, Track, TrackMaker};

/// From one footprint to the next, metres, of someone with boots of the usual size.
const STRIDE_METRES: f64 = 0.68;

/// Between the middles of left and right soles, of tyres, of skis, metres.
const APART_METRES: [f64; 3] = [0.20, 1.45, 0.24];

/// Half the width of a sole, of a tyre, of a ski, metres.
const HALF_METRES: [f64; 3] = [0.055, 0.105, 0.048];

/// A piece of a tyre's or a ski's track, metres.
const PIECE_METRES: f64 = 0.12;

/// From lug to lug of a tyre, metres.
const LUG_METRES: f64 = 0.062;

/// Of the radius of a rut, what its floor and half its wall take: how wide a print seems.
const SEEN: f64 = 0.75;

/// The stamps of a track after one time and until another, both seconds.
pub fn between<'a>(
    track: &'a Track,
    lattice: &'a Lattice,
    addressing: Addressing,
    after_seconds: f64,
    until_seconds: f64,
) -> impl Iterator<Item = Stamp> + 'a {
    let line = Line { track, lattice, wrap: addressing == Addressing::Wrap };
    let step_metres = line.step_metres();
    let begin = f64::from(track.begin_seconds);
    let rate = f64::from(track.speed_metres_per_second) / step_metres;
    // Step k is done when its end is reached.
    numbers_between(rate, 1.0, after_seconds - begin, until_seconds - begin)
        .map(move |number| (number, begin + (number + 1) as f64 / rate))
        .filter(move |(_, at_seconds)| due(*at_seconds, begin + f64::from(track.seconds)))
        .flat_map(move |(number, at_seconds)| line.step(number, at_seconds))
}

/// The line that a track follows.
#[derive(Clone, Copy)]
struct Line<'a> {
    track: &'a Track,
    lattice: &'a Lattice,
    wrap: bool,
}

impl Line<'_> {
    fn scale(&self) -> f64 {
        f64::from(self.track.scale)
    }

    fn step_metres(&self) -> f64 {
        self.scale() * if self.track.by == TrackMaker::Boots { STRIDE_METRES } else { PIECE_METRES }
    }

    /// Metres from the start, along u and v, of a point so far along and so far to the right; and the way it faces there.
    fn at(&self, along: f64, aside: f64) -> ([f64; 2], [f64; 2]) {
        let (sin, cos) = f64::from(self.track.heading_degrees).to_radians().sin_cos();
        let (weave, length) = (f64::from(self.track.weave_metres), f64::from(self.track.weave_length_metres));
        let turns = std::f64::consts::TAU / length;
        let sway = weave * (turns * along).sin();
        let slope = weave * turns * (turns * along).cos();
        let norm = 1.0_f64.hypot(slope);
        let facing = [(cos - slope * sin) / norm, (sin + slope * cos) / norm];
        let point = [along * cos - sway * sin - aside * facing[1], along * sin + sway * cos + aside * facing[0]];
        (point, facing)
    }

    /// A point in lattice coordinates, brought back into a field that wraps together with others: `of` decides where.
    fn lattice(&self, point: [f64; 2], of: [f64; 2]) -> [f32; 2] {
        [0, 1].map(|axis| {
            let size = f64::from(self.lattice.size[axis]);
            let texels = |metres: f64| metres / self.lattice.texel_metres + f64::from(self.track.start[axis]) * size - 0.5;
            let shift = if self.wrap { (texels(of[axis]) / size).floor() * size } else { 0.0 };
            (texels(point[axis]) - shift) as f32
        })
    }

    /// A capsule from one point to another.
    fn capsule(&self, from: [f64; 2], to: [f64; 2], half_metres: f64, at_seconds: f64) -> Stamp {
        let centre = self.lattice(from, from);
        let end = self.lattice(to, from);
        Stamp {
            at_seconds,
            centre,
            span: [0, 1].map(|axis| end[axis] - centre[axis]),
            radius: self.lattice.texels(half_metres / SEEN),
            height: self.lattice.heights(f64::from(self.track.depth_metres)),
            profile: Profile::Rut,
            blend: Blend::Add,
            ..Stamp::default()
        }
    }

    fn step(&self, number: u64, at_seconds: f64) -> Vec<Stamp> {
        let (kind, scale) = (self.track.by as usize, self.scale());
        let (apart, half) = (0.5 * scale * APART_METRES[kind], scale * HALF_METRES[kind]);
        let begin = number as f64 * self.step_metres();
        match self.track.by {
            TrackMaker::Boots => {
                let side = if number.is_multiple_of(2) { -apart } else { apart };
                let (middle, facing) = self.at(begin, side);
                // Toes out a little; the heel goes in first and deepest.
                let out = 0.12 * side.signum();
                let facing = [facing[0] - out * facing[1], facing[1] + out * facing[0]];
                let point = |along: f64| [0, 1].map(|axis| middle[axis] + scale * along * facing[axis]);
                let sole = self.capsule(point(0.015), point(0.115), half, at_seconds);
                let heel = self.capsule(point(-0.125), point(-0.095), 0.82 * half, at_seconds);
                vec![
                    Stamp {
                        height: 0.85 * sole.height,
                        gloss: 0.35,
                        tread: 0.28,
                        lug_texels: self.lattice.texels(0.026 * scale),
                        ..sole
                    },
                    Stamp { gloss: 0.35, ..heel },
                ]
            }
            TrackMaker::Tyres | TrackMaker::Skis => {
                let piece = self.step_metres();
                let tyre = self.track.by == TrackMaker::Tyres;
                [-apart, apart]
                    .into_iter()
                    .map(|side| {
                        let point = |pieces: f64| self.at(begin + pieces * piece, side).0;
                        let from = point(0.0);
                        let stamp = self.capsule(from, point(1.0), half, at_seconds);
                        let before = self.lattice(point(-1.0), from);
                        Stamp {
                            joins: if number > 0 { [0, 1].map(|axis| before[axis] - stamp.centre[axis]) } else { [0.0; 2] },
                            // As if each piece were as long as all: the tread goes on.
                            along: self.lattice.texels(begin.rem_euclid(LUG_METRES * scale)),
                            tread: if tyre { 0.45 } else { 0.0 },
                            lug_texels: self.lattice.texels(LUG_METRES * scale),
                            gloss: if tyre { 0.4 } else { 0.7 },
                            ..stamp
                        }
                    })
                    .collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::presses_between;
    use super::*;
    use crate::scene::Scene;

    fn scene() -> Scene {
        let track = |by, begin_seconds| Track { by, begin_seconds, weave_metres: 0.2, ..Track::default() };
        let mut scene = Scene {
            tracks: vec![track(TrackMaker::Boots, 0.0), track(TrackMaker::Tyres, 0.5), track(TrackMaker::Skis, 1.0)],
            ..Scene::default()
        };
        scene.field.addressing = Addressing::Wrap;
        scene
    }

    #[test]
    fn what_is_pressed_does_not_depend_on_how_frames_cut_time() {
        let scene = scene();
        let lattice = Lattice::of_scene(&scene);
        let cut = |frames: u32| -> Vec<Stamp> {
            let time = |frame: u32| 5.0 * f64::from(frame) / f64::from(frames);
            (0..frames).flat_map(|frame| presses_between(&scene, 5, &lattice, time(frame), time(frame + 1))).collect()
        };
        let whole = cut(1);
        assert!(whole.len() > 150, "{}", whole.len());
        for frames in [7, 96, 300] {
            assert_eq!(cut(frames), whole, "in {frames} frames");
        }
    }

    #[test]
    fn pieces_of_a_tyre_begin_where_the_one_before_ended() {
        let mut scene = scene();
        scene.tracks.truncate(2);
        scene.tracks.remove(0);
        let lattice = Lattice::of_scene(&scene);
        let size = lattice.size.map(|side| side as f32);
        let stamps = presses_between(&scene, 5, &lattice, 0.0, 8.0);
        for pair in stamps.chunks(2).collect::<Vec<_>>().windows(2) {
            for (before, now) in pair[0].iter().zip(pair[1]) {
                let ends = before.centre.iter().zip(before.span).zip(now.centre).zip(size);
                for (((centre, span), next), size) in ends {
                    // In the image of the field where both are near.
                    let gap = centre + span - next;
                    let gap = gap - (gap / size).round() * size;
                    assert!(gap.abs() < 1e-2, "{gap}");
                }
                assert!(before.span.iter().zip(now.joins).all(|(span, joins)| (span + joins).abs() < 1e-2));
            }
        }
    }
}
