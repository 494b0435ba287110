//! Emission of the gas: its shader against its reference, and the sums of what it adds.

use rilievo::field::bins::BinError;
use rilievo::field::gas_emit::{GasPuff, Puff};
use rilievo::gpu::List;
use rilievo::reference::gas::{Grid, State};
use rilievo::reference::gas_emit::{Emission, emit};
use rilievo::stroke::{Random, Stream};

use crate::support::gas::{SHAPES, Tank, apart, calm, stirred};
use crate::support::gpu::run;
use crate::support::tolerances::*;

fn puffs(grid: &Grid, count: usize) -> Vec<Emission> {
    let mut random = Random::new(9, Stream::Gas, 1);
    (0..count)
        .map(|_| {
            let puff = Puff {
                // Over the borders, and somewhat beyond those that repeat.
                centre: [0, 1].map(|axis| {
                    let (low, high) = if grid.periodic[axis] { (-0.1, 1.1) } else { (0.05, 0.95) };
                    (random.between(low, high) * grid.size[axis] as f64 - 0.5) as f32
                }),
                radius: random.between(0.5, 9.0) as f32,
                mass: [random.between(0.0, 20.0) as f32, random.between(-5.0, 5.0) as f32],
                velocity: [random.between(-0.5, 0.5) as f32, random.between(-0.5, 0.5) as f32],
                spin: random.between(-0.1, 0.1) as f32,
            };
            puff.emission(grid, 1, 1.0).expect("all are numbers")
        })
        .collect()
}

#[test]
fn equals_the_reference() {
    for (size, periodic) in SHAPES {
        let grid = Grid { size, periodic };
        let mut expected = stirred(&grid, 2);
        let Some(mut tank) = Tank::new(size, periodic, calm(size[1]), 1) else { return };
        tank.put(&expected);
        let emissions = puffs(&grid, 12);
        tank.run(0, &emissions.iter().map(|emission| (0, *emission)).collect::<Vec<_>>());
        emissions.iter().for_each(|emission| emit(&grid, emission, &mut expected));
        let state = tank.state();
        let largest = expected.scalars.iter().flatten().fold(1.0_f64, |most, value| most.max(value.abs()));
        let errors = [
            apart(&state.velocity, &expected.velocity),
            apart(&state.leading, &expected.leading),
            apart(&state.scalars, &expected.scalars) / largest,
        ];
        assert!(errors.iter().all(|error| *error <= GAS_KERNEL), "{size:?} {periodic:?}: {errors:?}");
    }
}

#[test]
fn what_is_emitted_adds_up_wherever_it_falls() {
    for (size, periodic) in [([65, 43], [true, false]), ([64, 64], [false, false]), ([31, 90], [true, true])] {
        let grid = Grid { size, periodic };
        let Some(mut tank) = Tank::new(size, periodic, calm(size[1]), 1) else { return };
        let still = vec![[0.0; 2]; grid.count()];
        tank.put(&State { velocity: still.clone(), leading: still.clone(), scalars: still });
        // Those whose middle lies inside reach some cell.
        let inside = |emission: &Emission| {
            (0..2).all(|axis| periodic[axis] || (0.5..size[axis] as f64 - 0.5).contains(&emission.centre[axis]))
        };
        let emissions: Vec<_> = puffs(&grid, 60).into_iter().filter(inside).map(|emission| (0, emission)).collect();
        tank.run(0, &emissions);
        let scalars = tank.state().scalars;
        for scalar in 0..2 {
            let sum: f64 = scalars.iter().map(|pair| pair[scalar]).sum();
            let emitted: f64 = emissions.iter().map(|(_, emission)| emission.mass[scalar]).sum();
            let all: f64 = emissions.iter().map(|(_, emission)| emission.mass[scalar].abs()).sum();
            assert!((sum - emitted).abs() <= GAS_EMITTED * all, "{size:?}: {sum} of {emitted}");
            assert!(all > 1.0);
        }
    }
}

#[test]
fn more_puffs_than_a_buffer_holds_are_refused() {
    let (size, periodic) = ([16, 16], [true, true]);
    let Some(mut tank) = Tank::new(size, periodic, calm(size[1]), 1) else { return };
    // Each in nine images, of which few touch a tile.
    let count = List::<GasPuff>::limit(tank.gpu) as usize / 9 + 1;
    let emission = Emission { radius: 0.5, ..puffs(&Grid { size, periodic }, 1)[0] };
    let emissions = vec![(0, emission); count];
    let error = run(tank.gpu, |recorder| tank.gas.record(recorder, &mut tank.set, 1, &emissions)).expect_err("they are too many");
    assert!(matches!(error, BinError::TooManyDiscs { discs, .. } if discs == 9 * count), "{error}");
}

#[test]
fn what_is_no_number_is_not_emitted() {
    let grid = Grid { size: [16, 16], periodic: [true, true] };
    let good = Puff { centre: [3.0, 4.0], radius: 3.0, mass: [1.0, 0.0], velocity: [0.0, 0.0], spin: 0.0 };
    assert!(good.emission(&grid, 1, 1.0).is_some());
    // Nor is what falls beyond a wall.
    let beyond = Puff { centre: [-3.0, 4.0], ..good };
    assert!(beyond.emission(&grid, 1, 1.0).is_some());
    assert!(beyond.emission(&Grid { periodic: [false, true], ..grid }, 1, 1.0).is_none());
    for poison in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let bad = [
            Puff { centre: [poison, 0.0], ..good },
            Puff { radius: poison, ..good },
            Puff { mass: [0.0, poison], ..good },
            Puff { velocity: [poison, 0.0], ..good },
            Puff { spin: poison, ..good },
        ];
        assert!(bad.iter().all(|puff| puff.emission(&grid, 1, 1.0).is_none()));
    }
}
