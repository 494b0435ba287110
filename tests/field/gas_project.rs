//! Projection of the gas: its shader against its reference, and what it leaves of the divergence.

use std::f64::consts::TAU;

use rilievo::reference::gas::{Grid, State};
use rilievo::reference::gas_project::project;

use crate::support::gas::{SHAPES, Tank, apart, calm, narrowed, stirred};
use crate::support::tolerances::*;

/// The state after the projection alone.
fn projected(tank: &Tank) -> State {
    let set = tank.gas.project.bind(tank.gpu, &tank.set.buffers);
    let finest = tank.gas.project.bind_finest(tank.gpu, &tank.set.buffers, tank.set.role());
    tank.kernels(|pass| tank.gas.project.record(pass, &set, &finest, &tank.set.buffers.dispatches));
    let (leading, scalars) = tank.carried(tank.set.role().last());
    State { velocity: tank.velocity(tank.set.role().last()), leading, scalars }
}

#[test]
fn equals_the_reference() {
    let larger = [([130, 67], [true, false]), ([65, 81], [false, true]), ([300, 3], [true, true]), ([96, 64], [false, false])];
    for (size, periodic) in SHAPES.into_iter().chain(larger) {
        let grid = Grid { size, periodic };
        let mut state = stirred(&grid, 11);
        // What forces leave: one velocity, to be projected, which leads nothing yet.
        state.velocity = state.leading.clone();
        let expected = project(&grid, &state);
        let Some(mut tank) = Tank::new(size, periodic, calm(size[1]), 1) else { return };
        tank.put(&state);
        let actual = projected(&tank);
        let errors = [apart(&actual.velocity, &expected.velocity), apart(&actual.leading, &expected.leading)];
        println!("{size:?} {periodic:?}: {errors:?}");
        assert!(errors.iter().all(|error| *error <= GAS_KERNEL), "{size:?} {periodic:?}: {errors:?}");
        assert_eq!(actual.scalars, state.scalars);
    }
}

#[test]
fn three_cycles_leave_a_thousandth_of_the_divergence() {
    let shapes = [
        ([64, 64], [true, true]),
        ([128, 64], [true, false]),
        ([63, 65], [true, true]),
        ([63, 65], [false, false]),
        ([257, 129], [true, false]),
        ([33, 21], [false, true]),
        ([1, 300], [true, false]),
        ([257, 3], [false, false]),
        ([255, 257], [true, true]),
    ];
    for (size, periodic) in shapes {
        let grid = Grid { size, periodic };
        let Some(mut tank) = Tank::new(size, periodic, calm(size[1]), 1) else { return };
        let noisy = stirred(&grid, 4).leading;
        // The longest waves that fit, which the coarsest levels must account for.
        let smooth = grid.cells().map(|(x, y)| {
            let (x, y) = (TAU * x as f64 / size[0] as f64, TAU * y as f64 / size[1] as f64);
            let [u, v] = [x.sin() + 0.3 * y.cos(), (2.0 * y).cos() * x.cos()];
            [if grid.open(0, x.round() as i64) { u } else { 0.0 }, if grid.open(1, y.round() as i64) { v } else { 0.0 }]
        });
        for (name, velocity) in [("noise", noisy), ("waves", smooth.collect())] {
            let state = narrowed(&State { leading: velocity.clone(), velocity, scalars: vec![[0.0; 2]; grid.count()] });
            tank.put(&state);
            let rms = |velocity: &[[f64; 2]]| grid.divergence(velocity).iter().map(|d| d * d).sum::<f64>().sqrt();
            let left = rms(&projected(&tank).velocity) / rms(&state.velocity);
            println!("{size:?} {periodic:?} {name}: {left:.1e}");
            assert!(left <= GAS_DIVERGENCE, "{size:?} {periodic:?} {name}: {left:.1e}");
        }
    }
}

#[test]
fn a_flow_without_divergence_stays_and_nothing_crosses_a_wall() {
    let grid = Grid { size: [50, 34], periodic: [false, false] };
    let Some(mut tank) = Tank::new(grid.size, grid.periodic, calm(34), 1) else { return };
    // Slopes of a stream function that is level along the walls.
    let stream = |x: i64, y: i64| 4.0 * (TAU / 2.0 * x as f64 / 50.0).sin() * (TAU / 2.0 * y as f64 / 34.0).sin();
    let velocity: Vec<_> =
        grid.cells().map(|(x, y)| [stream(x, y + 1) - stream(x, y), stream(x, y) - stream(x + 1, y)]).collect();
    let state = narrowed(&State { leading: velocity.clone(), velocity, scalars: vec![[0.0; 2]; grid.count()] });
    tank.put(&state);
    let after = projected(&tank);
    assert!(apart(&after.velocity, &state.velocity) <= GAS_KERNEL);
    let walls = grid.cells().zip(&after.velocity).filter(|((x, y), _)| *x == 0 || *y == 0);
    assert!(walls.into_iter().all(|((x, y), [u, v])| (x > 0 || *u == 0.0) && (y > 0 || *v == 0.0)));
}
