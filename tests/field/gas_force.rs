//! Forces on the gas: their shader against their reference.

use rilievo::reference::gas::Grid;
use rilievo::reference::gas_force::{Row, apply};

use crate::support::gas::{SHAPES, Tank, apart, calm, stirred};
use crate::support::tolerances::*;

#[test]
fn equals_the_reference() {
    for (size, periodic) in SHAPES {
        let grid = Grid { size, periodic };
        let state = stirred(&grid, 5);
        let mut physics = calm(size[1]);
        physics.forces.viscosity = 0.13;
        physics.forces.confinement = 0.4;
        physics.forces.buoyancy = 0.7;
        physics.forces.speed_limit = 1.4;
        physics.forces.rows = (0..size[1])
            .map(|row| {
                let along = row as f64 / size[1] as f64;
                Row {
                    wind: 1.0 - along,
                    density: along,
                    dye: 0.3,
                    wind_pull: 0.2,
                    calm_pull: 0.1,
                    gas_pull: 0.15,
                    turn: 0.4 * along - 0.2,
                }
            })
            .collect();
        let expected = apply(&grid, &physics.forces, &state);
        let Some(mut tank) = Tank::new(size, periodic, physics, 1) else { return };
        tank.put(&state);
        let group = tank.gas.force.bind(tank.gpu, &tank.set.buffers, tank.set.role());
        tank.kernels(|pass| tank.gas.force.record(pass, &group, &tank.set.buffers.dispatches));
        let (leading, scalars) = tank.carried(tank.set.role().last());
        let errors = [
            apart(&leading, &expected.leading),
            apart(&scalars, &expected.scalars),
            apart(&tank.velocity(tank.set.role().between()), &expected.leading),
        ];
        assert!(errors.iter().all(|error| *error <= GAS_KERNEL), "{size:?} {periodic:?}: {errors:?}");
    }
}
