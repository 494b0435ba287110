//! The gas as a whole: its steps against its reference, and both against what is known of fluids.

use std::f64::consts::TAU;

use rilievo::field::gas::Buffers;
use rilievo::field::gas_source::GasDensity;
use rilievo::field::{bytes_per_texel, gas_source};
use rilievo::gpu::Role as _;
use rilievo::reference::gas::{Grid, State, kinetic_energy, step};
use rilievo::reference::gas_emit::Emission;
use rilievo::reference::gas_force::{Forces, Row};

use crate::support::gas::{SHAPES, Tank, apart, calm, narrowed, stirred};
use crate::support::gpu::gpu;
use crate::support::tolerances::*;

fn puff(centre: [f64; 2]) -> Emission {
    Emission { centre, radius: 4.0, mass: [3.0, 1.0], velocity: [0.4, -0.2], spin: 0.05 }
}

#[test]
fn holds_what_its_contract_says() {
    for size in [[512, 256], [640, 480]] {
        let grid = Grid { size, periodic: [true, false] };
        let Some(gpu) = gpu() else { return };
        let held = Buffers::new(gpu, &grid).memory_bytes() as f64 / grid.count() as f64;
        let density = GasDensity::CONTRACT.bytes_per_texel();
        let contract = bytes_per_texel(gas_source::CONTRACT) - density;
        // Tiles, rows and what levels are told, too: a hundredth.
        assert!((held / contract - 1.0).abs() <= 0.01, "{size:?}: {held} bytes a cell, where the contract says {contract}");
    }
}

#[test]
fn steps_equal_the_reference() {
    for (size, periodic) in SHAPES.into_iter().chain([([70, 50], [true, false])]) {
        let grid = Grid { size, periodic };
        let mut physics = calm(size[1]);
        // Half of what it would be: the limiter decides by comparison, and a rounding that decides otherwise grows with the flow.
        physics.step_seconds = 0.5;
        physics.forces.viscosity = 0.1;
        physics.forces.confinement = 0.1;
        physics.forces.rows = vec![Row { wind: 0.2, wind_pull: 0.1, density: 0.5, gas_pull: 0.1, ..Row::default() }; size[1]];
        let mut expected = stirred(&grid, 6);
        let Some(mut tank) = Tank::new(size, periodic, physics, 1) else { return };
        tank.put(&expected);
        let middle = puff(size.map(|side| 0.5 * side as f64));
        // A puff that does not fit a thin grid would overlap itself.
        let fits = (0..2).all(|axis| !periodic[axis] || size[axis] >= 8);
        let emitted: Vec<_> = if fits { vec![(2, middle)] } else { Vec::new() };
        tank.run(5, &emitted);
        for number in 0..5 {
            let now: Vec<_> = emitted.iter().filter(|(step, _)| *step == number).map(|(_, emission)| *emission).collect();
            expected = step(&grid, &tank.physics.forces, tank.physics.courant(), &now, &expected);
        }
        let state = tank.state();
        let errors = [
            apart(&state.velocity, &expected.velocity),
            apart(&state.leading, &expected.leading),
            apart(&state.scalars, &expected.scalars),
        ];
        println!("{size:?} {periodic:?}: {errors:?}");
        assert!(errors.iter().all(|error| *error <= GAS_STEPS), "{size:?} {periodic:?}: {errors:?}");
    }
}

/// Viscosity of the vortex, as lengths and times go there.
const NU: f64 = 1e-3;

/// Runs the Taylor–Green vortex on the 2π square for a second at a Courant number of a half, and checks its energy at every step.
/// Answers with its effective viscosity: energy falls as e^(−4νt).
fn taylor_green(cells: usize) -> Option<f64> {
    let grid = Grid { size: [cells; 2], periodic: [true; 2] };
    let dx = TAU / cells as f64;
    let steps = (1.0 / (0.5 * dx)).ceil() as u32;
    let dt = 1.0 / f64::from(steps);
    let forces = Forces { viscosity: NU * dt / (dx * dx), speed_limit: 8.0 * dx / dt, ..calm(cells).forces };
    let physics = rilievo::field::gas::Physics { cell_metres: dx, step_seconds: dt, forces, stillness: 1e-4 };
    let velocity: Vec<_> = grid
        .cells()
        .map(|(x, y)| (x as f64 * dx, y as f64 * dx))
        .map(|(x, y)| [x.cos() * (y + 0.5 * dx).sin(), -(x + 0.5 * dx).sin() * y.cos()])
        .collect();
    let start = narrowed(&State { leading: velocity.clone(), velocity, scalars: vec![[0.0; 2]; grid.count()] });
    let mut tank = Tank::new(grid.size, grid.periodic, physics, 1)?;
    tank.put(&start);
    let first = kinetic_energy(&start.velocity);
    let mut energy = first;
    for number in 0..steps {
        tank.run(1, &[]);
        let next = kinetic_energy(&tank.state().velocity);
        assert!(next <= energy * (1.0 + GAS_ENERGY_RISE), "{cells}², step {number}: {energy} to {next}");
        energy = next;
    }
    let effective = -(energy / first).ln() / 4.0;
    println!("{cells}²: energy {:.6} of what it was, effective viscosity {effective:.6}", energy / first);
    Some(effective)
}

#[test]
fn the_taylor_green_vortex_decays_as_it_should() {
    let mut excess = Vec::new();
    for cells in [32, 64, 128] {
        let Some(effective) = taylor_green(cells) else { return };
        excess.push(effective - NU);
    }
    // First order or better.
    assert!(excess[1] <= 0.5 * excess[0] && excess[2] <= 0.5 * excess[1], "{excess:?}");
    assert!(excess[2] > 0.0, "{excess:?}");
    let energy = (-4.0 * (excess[2] + NU)).exp() / (-4.0 * NU).exp();
    assert!((energy - 1.0).abs() <= GAS_DECAY, "{energy}");
}

#[test]
fn how_steps_are_cut_into_frames_changes_no_bit() {
    let grid = Grid { size: [60, 40], periodic: [true, false] };
    let run_in = |frames: &[u32]| {
        let mut physics = calm(40);
        physics.stillness = 1e-3;
        let mut tank = Tank::new(grid.size, grid.periodic, physics, 1)?;
        let none = vec![[0.0; 2]; grid.count()];
        tank.put(&State { velocity: none.clone(), leading: none.clone(), scalars: none });
        let emitted: Vec<_> = [(0, [9.0, 9.0]), (2, [30.0, 20.0]), (2, [31.0, 22.0]), (7, [59.0, 39.0])].to_vec();
        let mut first = 0;
        for &steps in frames {
            let of_frame: Vec<_> = emitted
                .iter()
                .filter(|(step, _)| (first..first + steps).contains(step))
                .map(|(step, centre)| (step - first, puff(*centre)))
                .collect();
            tank.run(steps, &of_frame);
            first += steps;
        }
        Some((tank.state(), tank.texels::<f32>(&tank.heights), tank.texels::<[u16; 4]>(&tank.cover)))
    };
    let Some(whole) = run_in(&[12]) else { return };
    assert!(Some(whole) == run_in(&[1, 4, 0, 1, 3, 3]));
}

#[test]
fn what_is_no_number_stops_the_gas_at_its_last_good_state() {
    let grid = Grid { size: [64, 48], periodic: [true, false] };
    for poison in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for component in 0..4_u64 {
            let Some(mut tank) = Tank::new(grid.size, grid.periodic, calm(48), 1) else { return };
            tank.put(&stirred(&grid, 9));
            tank.run(4, &[]);
            // It gets in from outside, into what is carried: a step that reads it must not leave anything behind.
            let at = (20 * 64 + 30) * 16 + 4 * component;
            tank.gpu.queue.write_buffer(&tank.set.buffers.carried[tank.set.role().start()], at, bytemuck::bytes_of(&poison));
            let heights: Vec<f32> = tank.texels(&tank.heights);
            let before = tank.state();
            tank.run(3, &[]);
            assert_eq!(tank.set.stopped(), Some(5), "{poison}, component {component}");
            let after = tank.state();
            let bits = |pairs: &[[f64; 2]]| pairs.iter().flatten().map(|value| value.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&after.velocity), bits(&before.velocity));
            assert_eq!(bits(&after.leading), bits(&before.leading));
            assert_eq!(bits(&after.scalars), bits(&before.scalars));
            assert_eq!(tank.texels::<f32>(&tank.heights), heights, "what is shown stays");
            assert!(!tank.run(1, &[(0, puff([9.0, 9.0]))]), "nothing is done to it any more");
            // A reset starts it anew.
            tank.put(&stirred(&grid, 9));
            assert!(tank.run(2, &[]));
            assert_eq!(tank.set.stopped(), None);
        }
    }
}

#[test]
fn a_state_that_was_read_back_goes_on_as_the_one_it_was_taken_from() {
    let grid = Grid { size: [80, 48], periodic: [true, false] };
    let mut physics = calm(48);
    physics.stillness = 1e-3;
    let none = vec![[0.0; 2]; grid.count()];
    let still = State { velocity: none.clone(), leading: none.clone(), scalars: none };
    let Some(mut whole) = Tank::new(grid.size, grid.periodic, physics.clone(), 1) else { return };
    let Some(mut resumed) = Tank::new(grid.size, grid.periodic, physics, 1) else { return };
    whole.put(&still);
    resumed.put(&still);
    whole.run(4, &[(0, puff([20.0, 20.0]))]);
    // As a saved state is: what is current goes into what is current there, in another role.
    let (from, to) = (whole.set.role().start(), resumed.set.role().start());
    assert_ne!(from, to);
    let mut encoder = whole.gpu.encoder("save and load");
    let (a, b) = (&whole.set.buffers, &resumed.set.buffers);
    for (source, target) in [(&a.velocity[from], &b.velocity[to]), (&a.carried[from], &b.carried[to]), (&a.activity, &b.activity)]
    {
        encoder.copy_buffer_to_buffer(source, 0, target, 0, source.size());
    }
    whole.gpu.queue.submit([encoder.finish()]);
    resumed.set.resume(whole.set.steps());
    whole.run(9, &[]);
    resumed.run(9, &[]);
    assert_eq!(whole.state(), resumed.state());
    assert_eq!(whole.set.active_tiles(), resumed.set.active_tiles());
}
