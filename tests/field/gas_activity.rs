//! Activity of the gas: which tiles its shader finds work in, and that nothing is lost by skipping the others.

use rilievo::reference::gas::{Grid, State};
use rilievo::reference::gas_activity::active;
use rilievo::reference::gas_emit::Emission;
use rilievo::stroke::{Random, Stream};

use crate::support::gas::{Tank, apart, calm, narrowed};
use crate::support::tolerances::*;

/// Nothing but a vortex of this radius, whose edge is as fast as that, and a wall of density through it.
fn vortex(grid: &Grid, centre: [f64; 2], radius: f64, speed: f64) -> State {
    let stream = |x: i64, y: i64| {
        let away = [x as f64 - centre[0], y as f64 - centre[1]];
        let s = (away[0] * away[0] + away[1] * away[1]) / (radius * radius);
        -0.5 * speed * radius * (1.0 - s).max(0.0).powi(3)
    };
    let velocity: Vec<_> =
        grid.cells().map(|(x, y)| [stream(x, y + 1) - stream(x, y), stream(x, y) - stream(x + 1, y)]).collect();
    let scalars = grid.cells().map(|(x, _)| [if (x as f64) < centre[0] { 0.0 } else { 1.0 }, 0.5]).collect();
    narrowed(&State { leading: velocity.clone(), velocity, scalars })
}

fn still(grid: &Grid) -> State {
    let none = vec![[0.0; 2]; grid.count()];
    State { velocity: none.clone(), leading: none.clone(), scalars: none }
}

#[test]
fn tiles_are_active_as_the_reference_says() {
    for (size, periodic) in
        [([200, 130], [true, false]), ([97, 160], [true, true]), ([16, 16], [true, true]), ([300, 17], [false, false])]
    {
        let grid = Grid { size, periodic };
        let mut physics = calm(size[1]);
        physics.stillness = 0.25;
        let Some(mut tank) = Tank::new(size, periodic, physics, 1) else { return };
        tank.put(&still(&grid));
        let tiles = size.map(|side: usize| side.div_ceil(16));
        let mut random = Random::new(2, Stream::Stress, 1);
        for _ in 0..5 {
            let motion: Vec<f32> = (0..tiles[0] * tiles[1]).map(|_| random.unit().powi(12) as f32).collect();
            let touched: Vec<bool> = motion.iter().map(|_| random.unit() < 0.03).collect();
            let words: Vec<u32> =
                motion.iter().map(|value| value.to_bits()).chain(touched.iter().map(|touched| u32::from(*touched))).collect();
            let offset = 4 * u64::from(rilievo::field::gas_activity::HEADER);
            tank.gpu.queue.write_buffer(&tank.set.buffers.activity, offset, bytemuck::cast_slice(&words));
            tank.kernels(|_| ());
            let [_, touched_after, state] = tank.activity();
            let expected = active(tiles, periodic, &motion, &touched, 0.25);
            let actual: Vec<bool> = state.iter().map(|state| state & 1 != 0).collect();
            assert_eq!(actual, expected, "{size:?} {periodic:?}");
            assert!(touched_after.iter().all(|touched| *touched == 0));
        }
    }
}

#[test]
fn what_skips_still_tiles_is_what_skips_none() {
    let grid = Grid { size: [176, 144], periodic: [true, false] };
    let start = vortex(&grid, [70.0, 66.0], 20.0, 1.0);
    let run = |stillness: f64| {
        let mut physics = calm(144);
        physics.stillness = stillness;
        let mut tank = Tank::new(grid.size, grid.periodic, physics, 1)?;
        tank.put(&start);
        tank.run(30, &[]);
        Some((tank.state(), tank.set.active_tiles()))
    };
    let Some((whole, all)) = run(-1.0) else { return };
    let Some((skipping, some)) = run(1e-4) else { return };
    println!("{some:?} of {all:?} tiles");
    assert_eq!(all, Some(99));
    assert!(some.is_some_and(|some| some < 60), "{some:?}");
    let (velocity, scalars) = (apart(&whole.velocity, &skipping.velocity), apart(&whole.scalars, &skipping.scalars));
    println!("velocities differ by {velocity:.1e}, scalars by {scalars:.1e}");
    assert!(velocity <= GAS_SKIPPING, "{velocity:.1e}");
    // The wall of density moves by that much a step at most, in 30 steps.
    assert!(scalars <= 30.0 * GAS_SKIPPING, "{scalars:.1e}");
}

#[test]
fn a_flow_that_died_down_is_at_rest_everywhere_and_not_even_recorded() {
    let grid = Grid { size: [96, 80], periodic: [true, true] };
    let mut physics = calm(80);
    physics.stillness = 1e-2;
    physics.forces.viscosity = 0.2;
    let Some(mut tank) = Tank::new(grid.size, grid.periodic, physics, 1) else { return };
    tank.put(&vortex(&grid, [40.0, 40.0], 12.0, 0.05));
    let mut recorded = 0;
    while tank.run(1, &[]) {
        recorded += 1;
        assert!(recorded < 1000, "it never dies");
    }
    println!("still after {recorded} steps");
    assert!(recorded > 5);
    assert_eq!(tank.set.active_tiles(), Some(0));
    for index in 0..3 {
        assert!(tank.velocity(index).iter().all(|velocity| *velocity == [0.0, 0.0]));
        assert_eq!(tank.carried(index), tank.carried(0), "all buffers hold the same");
    }
    // Nor does a tile that wakes start from the pressure of a flow long gone.
    assert!(tank.pressure().iter().flatten().all(|value| *value == 0.0));
    // A puff wakes it, where it falls.
    let puff = Emission { centre: [48.0, 48.0], radius: 4.0, mass: [1.0, 0.0], velocity: [0.5, 0.0], spin: 0.0 };
    assert!(tank.run(1, &[(0, puff)]));
    assert_eq!(tank.set.active_tiles(), Some(16), "the four tiles that it touches, and those beside them");
    assert!(tank.state().velocity.iter().any(|velocity| velocity[0] > 0.1));
}
