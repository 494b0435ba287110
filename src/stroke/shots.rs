//! Shots: what a bullet does to what it hits.

use std::f64::consts::TAU;

use super::{Lattice, Random, Stream, numbers_between};
use crate::field::base::facade;
use crate::field::stamp::{Blend, CRATER_RIM, Profile, Stamp};
use crate::scene::{Base, Shots, Struck};

/// The stamps of the shots after one time and until another, both seconds: shot k is fired at (k + ½)/rate.
pub fn between<'a>(
    shots: &'a Shots,
    base: &'a Base,
    seed: u64,
    lattice: &'a Lattice,
    after_seconds: f64,
    until_seconds: f64,
) -> impl Iterator<Item = Stamp> + 'a {
    let rate = f64::from(shots.per_second);
    numbers_between(rate, 0.5, after_seconds, until_seconds).flat_map(move |number| {
        let mut random = Random::new(seed, Stream::Shots, number);
        let uv = [random.unit(), random.unit()];
        shot(shots, base, lattice, uv, (number as f64 + 0.5) / rate, &mut random)
    })
}

/// What one shot at a point of the plane presses.
pub fn shot(shots: &Shots, base: &Base, lattice: &Lattice, uv: [f64; 2], at_seconds: f64, random: &mut Random) -> Vec<Stamp> {
    let [smallest, largest] = shots.radius_metres.map(f64::from);
    // Small ones are common: the square of a uniform number.
    let rim_metres = smallest + (largest - smallest) * random.unit().powi(2);
    let depth_metres = f64::from(shots.depth_metres) * rim_metres / largest;
    let hole = Stamp {
        at_seconds,
        centre: lattice.at(uv),
        radius: lattice.texels(rim_metres / CRATER_RIM),
        height: lattice.heights(depth_metres),
        profile: Profile::Crater,
        blend: Blend::Add,
        irregularity: random.between(0.35, 0.65) as f32,
        phase: random.between(0.0, TAU) as f32,
        soot: shots.scorch,
        bare: 1.0,
        ..Stamp::default()
    };
    let struck = match shots.material {
        Struck::Wall => match base {
            Base::Facade {} => facade::struck(lattice.metres(uv)),
            _ => Struck::Brick,
        },
        struck => struck,
    };
    let mut hit = Hit { hole, rim: lattice.texels(rim_metres), random, stamps: Vec::new() };
    match struck {
        Struck::Brick | Struck::Wall => hit.brick(),
        Struck::Stone => hit.stone(),
        Struck::Metal => hit.metal(),
        Struck::Wood => hit.wood(),
        Struck::Plaster => hit.plaster(lattice),
    }
    hit.stamps
}

/// A hole in the making.
struct Hit<'a> {
    /// As it would be in brick.
    hole: Stamp,
    /// Radius of its rim, texels.
    rim: f32,
    random: &'a mut Random,
    stamps: Vec<Stamp>,
}

impl Hit<'_> {
    fn pick(&mut self, low: f32, high: f32) -> f32 {
        self.random.between(f64::from(low), f64::from(high)) as f32
    }

    /// A point so many rims from the hole, in a random direction, and that direction.
    fn around(&mut self, rims: f32) -> ([f32; 2], [f32; 2]) {
        let angle = self.random.between(0.0, TAU);
        let direction = [angle.cos() as f32, angle.sin() as f32];
        ([0, 1].map(|axis| self.hole.centre[axis] + rims * self.rim * direction[axis]), direction)
    }

    /// Something small beside the hole, of so many rims and depths.
    fn beside(&mut self, centre: [f32; 2], rims: f32, depths: f32) -> Stamp {
        let phase = self.random.between(0.0, TAU) as f32;
        Stamp {
            at_seconds: self.hole.at_seconds,
            centre,
            radius: rims * self.rim,
            height: -depths * self.hole.height,
            profile: Profile::Bump,
            irregularity: 0.6,
            phase,
            bare: 0.8,
            ..Stamp::default()
        }
    }

    /// Cracks from so many rims outward.
    fn cracks(&mut self, count: u32, from: f32, longest: f32, depths: f32) {
        for _ in 0..count {
            let (centre, direction) = self.around(from);
            let length = self.pick(0.4, 1.0) * longest * self.rim;
            let bend = self.pick(-0.35, 0.35);
            let along = |direction: [f32; 2], length: f32| direction.map(|along| along * length);
            let first = along(direction, 0.5 * length);
            let turned = [direction[0] - bend * direction[1], direction[1] + bend * direction[0]];
            let thin = (0.045 * self.rim).max(0.8);
            let stem = Stamp { radius: thin, span: first, irregularity: 0.0, bare: 0.3, ..self.beside(centre, 1.0, depths) };
            self.stamps.push(stem);
            let second = Stamp {
                centre: [0, 1].map(|axis| centre[axis] + first[axis]),
                radius: 0.75 * thin.max(1.0),
                span: along(turned, 0.5 * length),
                joins: first.map(|along| -along),
                ..stem
            };
            self.stamps.push(second);
        }
    }

    /// A crater with a rim, and chips out of its edge.
    fn brick(&mut self) {
        self.stamps.push(self.hole);
        for _ in 0..3 {
            let away = self.pick(0.75, 1.25);
            let (centre, _) = self.around(away);
            let (rims, depths) = (self.pick(0.2, 0.5), self.pick(0.12, 0.35));
            let chip = self.beside(centre, rims, depths);
            self.stamps.push(chip);
        }
    }

    /// A wide spall that hardly goes in, a pale star of cracks.
    fn stone(&mut self) {
        let rims = self.pick(1.5, 2.0);
        let spall = Stamp { irregularity: 0.9, ..self.beside(self.hole.centre, rims, 0.3) };
        self.stamps.push(spall);
        self.stamps.push(Stamp { height: 0.55 * self.hole.height, soot: 0.35 * self.hole.soot, ..self.hole });
        self.cracks(3, 0.8, 1.6, 0.12);
    }

    /// A dent, and a smooth hole in it with a bright burr.
    fn metal(&mut self) {
        let dent = self.beside(self.hole.centre, 2.2, 0.22);
        self.stamps.push(Stamp { irregularity: 0.08, bare: 0.0, ..dent });
        self.stamps.push(Stamp {
            radius: 0.7 * self.hole.radius,
            irregularity: 0.07,
            soot: 0.3 * self.hole.soot,
            gloss: 1.0,
            ..self.hole
        });
    }

    /// A hole that is longer than wide, and splinters along the grain, some of them raised.
    fn wood(&mut self) {
        let half = 0.45 * self.rim;
        let [u, v] = self.hole.centre;
        self.stamps.push(Stamp {
            centre: [u - half, v],
            span: [2.0 * half, 0.0],
            radius: 0.6 * self.hole.radius,
            soot: 0.4 * self.hole.soot,
            ..self.hole
        });
        for _ in 0..7 {
            let side = if self.random.unit() < 0.5 { -1.0 } else { 1.0 };
            let begin = [u + side * self.pick(0.1, 0.7) * self.rim, v + self.pick(-0.6, 0.6) * self.rim];
            let (rims, depths) = (self.pick(0.07, 0.16), self.pick(-0.22, 0.4));
            let splinter = self.beside(begin, rims, depths);
            let length = side * self.pick(0.8, 2.6) * self.rim;
            self.stamps.push(Stamp { span: [length, 0.0], radius: splinter.radius.max(1.0), irregularity: 0.0, ..splinter });
        }
    }

    /// A flake of plaster off what it was laid on, a small hole deep in that, cracks beyond.
    fn plaster(&mut self, lattice: &Lattice) {
        let rims = self.pick(1.7, 2.6);
        let flake = Stamp {
            profile: Profile::Disc,
            blend: Blend::Min,
            // What is beneath, however often it falls off.
            level: 1.0 - lattice.heights(facade::PLASTER_METRES),
            height: 0.0,
            irregularity: 1.0,
            bare: 1.0,
            ..self.beside(self.hole.centre, rims, 0.0)
        };
        self.cracks(4, 0.5 * rims, 3.2, 0.16);
        self.stamps.push(flake);
        self.stamps.push(Stamp { radius: 0.7 * self.hole.radius, ..self.hole });
    }
}
