//! Showing the gas: its shader against its reference.

use rilievo::reference::gas::Grid;
use rilievo::reference::gas_show::shown;

use super::normals::from_half;
use crate::support::gas::{SHAPES, Tank, calm, stirred};
use crate::support::tolerances::*;

#[test]
fn equals_the_reference_at_every_coarsening() {
    for (size, periodic) in SHAPES {
        for coarsening in [1, 2, 3] {
            let grid = Grid { size, periodic };
            let state = stirred(&grid, 8);
            let mut physics = calm(size[1]);
            (physics.cell_metres, physics.step_seconds) = (0.5, 0.5);
            let Some(mut tank) = Tank::new(size, periodic, physics, coarsening) else { return };
            tank.put(&state);
            // Frame 0 shows the untouched start.
            assert!(tank.run(0, &[]));
            let heights: Vec<f32> = tank.texels(&tank.heights);
            let cover: Vec<[u16; 4]> = tank.texels(&tank.cover);
            let width = size[0] * coarsening as usize;
            for (index, (height, cover)) in heights.iter().zip(&cover).enumerate() {
                let expected = shown(&grid, &state, coarsening as usize, 2.0, [index % width, index / width]);
                let at = format!("{size:?} {periodic:?} by {coarsening}, texel {index}");
                assert!((f64::from(*height) - expected[0]).abs() <= GAS_KERNEL, "{at}: {height} for {}", expected[0]);
                for (actual, expected) in cover.map(from_half).into_iter().zip(expected) {
                    assert!((actual - expected).abs() <= GAS_COVER, "{at}: {actual} for {expected}");
                }
            }
            // Once is enough.
            assert!(!tank.run(0, &[]));
        }
    }
}

#[test]
fn a_cell_of_one_texel_shows_its_own_density_to_the_bit() {
    let grid = Grid { size: [35, 18], periodic: [true, false] };
    let state = stirred(&grid, 1);
    let Some(mut tank) = Tank::new(grid.size, grid.periodic, calm(18), 1) else { return };
    tank.put(&state);
    tank.run(0, &[]);
    let heights: Vec<f32> = tank.texels(&tank.heights);
    assert!(heights.iter().zip(&state.scalars).all(|(height, [density, _])| f64::from(*height) == *density));
}
