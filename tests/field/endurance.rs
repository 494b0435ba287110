//! Endurance: 100,000 steps of shallow water, and as many of gas, at the ends of all that their scenes may say and of every slider of
//! the panel, one at a time and many together. Nothing explodes: validation refuses what would.

use rilievo::field::shallow_water::{
    ShallowWater, ShallowWaterBody, ShallowWaterControl, ShallowWaterParams, ShallowWaterSpell, events_in_step, state_bytes,
};
use rilievo::field::{Cover, gas_source};
use rilievo::gpu::{Gpu, Readback, Texture};
use rilievo::scene::{
    self, Addressing, Border, FieldSettings, Gas, GasBands, GasBorder, GasEmitters, Plane, Plunger, Scene, Spring, Swell,
};
use rilievo::stroke::{Lattice, emitted_in_step};

use crate::support::extremes::{Extreme, corner, ends, numbers, slider_ends};
use crate::support::gas::{Tank, calm};
use crate::support::gpu::{gpu, run, wait_for};
use crate::support::tolerances::*;

/// Substeps that the water runs through in all.
const SUBSTEPS: u32 = 100_000;

/// Drops, springs and dips of plungers after which a scene has seen enough.
const EVENTS: usize = 10_000;

/// Steps of the gas in all: each is some twenty dispatches, whose number is their price here.
const STEPS: u32 = 10_000;

/// Scenes with the numbers of these tables at their ends: each alone, each slider, and corners until there are `count`.
fn extremes<T: PartialEq>(base: &Scene, tables: &[&str], counts: impl Fn(&Scene) -> T, count: usize) -> Vec<Extreme> {
    // What a cell of gas covers is a divisor, not a range; colours move nothing.
    let others = ["coarsening", "absorption", "scatter"];
    let paths: Vec<_> =
        numbers(base, tables).into_iter().filter(|path| !others.iter().any(|other| path.contains(other))).collect();
    let mut all: Vec<_> = paths.iter().flat_map(|path| ends(base, path)).collect();
    all.extend(slider_ends(base, counts));
    println!("{} alone of {} numbers", all.len(), paths.len());
    assert!(all.len() + 20 < count, "{} leave no room for corners", all.len());
    let first = all.len();
    all.extend((first..count).map(|seed| corner(base, &paths, seed as u64)));
    all
}

/// A pond with one of everything.
fn pond() -> Scene {
    let water = scene::ShallowWater {
        // Few: every one that is recorded costs, needed or not.
        substep_cap: 2,
        swell: Some(Swell { amplitude_metres: 0.1, period_seconds: 0.7 }),
        bodies: vec![scene::Body { level: 0.6, ..scene::Body::default() }],
        drops: Some(scene::Drops::default()),
        springs: vec![
            Spring { centre: [0.3, 0.2], radius_metres: 0.3, metres_per_second: 0.2 },
            Spring { centre: [0.6, 0.7], radius_metres: 0.2, metres_per_second: -0.2 },
        ],
        plungers: vec![Plunger { centre: [0.5; 2], radius_metres: 0.3, depth_metres: 0.1, period_seconds: 0.5 }],
        rain_metres_per_second: 1e-4,
        ..scene::ShallowWater::default()
    };
    Scene {
        field: FieldSettings { size: [12, 12], addressing: Addressing::Clamp },
        plane: Plane { width_metres: 1.2, depth_metres: 0.5, ..Plane::default() },
        shallow_water: Some(water),
        ..Scene::default()
    }
}

/// West, east, north, south.
const SHORES: [[Border; 4]; 5] = [
    [Border::Wall; 4],
    [Border::Sea, Border::Open, Border::Wall, Border::Open],
    [Border::Open; 4],
    [Border::Sea; 4],
    [Border::Periodic; 4],
];

/// An error where something does not hold.
fn check(holds: bool, says: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(says()) }
}

/// Water of a scene, run through so many substeps.
fn endure_water(gpu: &Gpu, kernels: &ShallowWater, extreme: &Extreme, substeps: u32) -> Result<(u32, f64), String> {
    let Extreme { name, scene } = extreme;
    assert_eq!(scene.validate(), Ok(()), "{name}");
    let water = scene.shallow_water.as_ref().expect("it is a scene of water");
    let size = scene.field.size;
    let params = ShallowWaterParams::new(water, size, scene.texel_metres(), f64::from(scene.plane.depth_metres));
    let cover: Texture<Cover> = Texture::new(gpu, size);
    let bodies: Vec<_> = water.bodies.iter().map(ShallowWaterBody::new).collect();
    let mut set = kernels.bind(gpu, &cover.view, &params, water.substep_cap, &bodies);
    // Hills, some of them dry, and a cliff.
    let texels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y].map(|at| at as f32)));
    let bed: Vec<f32> =
        texels.map(|[x, y]| 0.4 + 0.3 * (0.9 * x).sin() * (0.7 * y).cos() + if x + y > 18.0 { 0.3 } else { 0.0 }).collect();
    set.held.bed.write(gpu, &bed);

    let (lattice, mut step, mut first_mass, mut happened) = (Lattice::of_scene(scene), 0, None, 0);
    let closed = water.borders.iter().all(|border| matches!(border, Border::Wall | Border::Periodic));
    let keeps =
        closed && water.springs.is_empty() && water.rain_metres_per_second == 0.0 && water.seepage_metres_per_second == 0.0;
    loop {
        // Some of them at a time; a step may be several substeps.
        let steps = if first_mass.is_none() {
            1
        } else if happened > EVENTS / 8 {
            8
        } else {
            u64::from(substeps.div_ceil(8))
        };
        let spells: Vec<_> = (step..step + steps).map(|step| ShallowWaterSpell::new(water, step)).collect();
        let of_step = |number: u64| events_in_step(water, 7, &lattice, step + number).map(move |event| (number as u32, event));
        let events: Vec<_> = (0..steps).flat_map(of_step).collect();
        run(gpu, |recorder| kernels.record(recorder, &mut set, &spells, &events, false));
        step += steps;
        happened += events.len();

        let read = |buffer: &wgpu::Buffer, bytes: u64| {
            let mut encoder = gpu.encoder("endurance");
            let readback = Readback::record_buffer(gpu, &mut encoder, buffer, bytes);
            gpu.queue.submit([encoder.finish()]);
            readback.start();
            wait_for(gpu, &readback)
        };
        let control: ShallowWaterControl =
            bytemuck::pod_read_unaligned(&read(&set.held.control, size_of::<ShallowWaterControl>() as u64));
        let current = control.current as usize;
        let pairs = |buffer| bytemuck::pod_collect_to_vec::<u8, [f32; 2]>(&read(buffer, state_bytes(size)));
        let (depths, flows) = (pairs(&set.held.depths[current]), pairs(&set.held.flows[current]));
        let when = format!("in step {step}, substep {}", control.substeps);
        check((control.halted, control.fault) == (0, 0), || format!("stopped {when}"))?;
        for (texel, ([depth, foam], flow)) in depths.iter().zip(&flows).enumerate() {
            let place = || format!("texel {texel} {when}: {depth} m, foam {foam}, {flow:?}");
            check(depth.is_finite() && *depth >= 0.0 && (0.0..=1.0).contains(foam), place)?;
            // A component of a velocity is clamped, then multiplied by the depth.
            let most = f64::from(params.speed_cap) * f64::from(*depth) * (1.0 + WATER_CAP);
            check(flow.iter().all(|component| f64::from(component.abs()) <= most), place)?;
        }
        let owed = step as f64 * f64::from(water.step_seconds);
        let behind = f64::from(control.behind);
        check((0.0..=1.001 * owed).contains(&behind), || format!("{behind} s of {owed} given up"))?;
        let mass = depths.iter().map(|[depth, _]| f64::from(*depth)).sum::<f64>();
        let first = *first_mass.get_or_insert(mass);
        check(!keeps || (mass - first).abs() <= WATER_MASS_ENDURED * first, || format!("{first} m became {mass} {when}"))?;
        // Thousands of drops a second fall one after the other: such a scene may end sooner.
        if control.substeps >= substeps || happened > EVENTS {
            return Ok((control.substeps, behind / owed));
        }
    }
}

#[test]
fn water_endures_the_ends_of_every_range_and_slider() {
    let Some(gpu) = gpu() else { return };
    let kernels = ShallowWater::new(gpu).expect("the shaders compile");
    let base = pond();
    let tables = ["/plane/width_metres", "/plane/depth_metres", "/shallow_water"];
    let all = extremes(&base, &tables, |scene| (scene.shallow_water.clone(), scene.plane.clone()), 200);
    // Most overshoot: a step is whole, and so are several.
    let share = (SUBSTEPS - SUBSTEPS / 10).div_ceil(all.len() as u32);
    let (mut substeps, mut late, mut failures) = (0, 0, Vec::new());
    for (number, mut extreme) in all.into_iter().enumerate() {
        let scene = &mut extreme.scene;
        // Some of them of several tiles. Texels stay as large as they were, but where the plane would be too wide.
        let width = scene.field.size[0] as f32;
        scene.field.size = [[12, 12], [13, 9], [19, 16]][[0, 1, 0, 1, 2][number % 5]];
        scene.plane.width_metres = (scene.plane.width_metres * scene.field.size[0] as f32 / width).min(1e6);
        let water = scene.shallow_water.as_mut().expect("it is a scene of water");
        water.borders = SHORES[number % SHORES.len()];
        if water.borders[0] == Border::Periodic {
            scene.field.addressing = Addressing::Wrap;
        }
        // Half of those that are closed keep what they have: that is weighed.
        if number % 2 == 0 && !extreme.name.contains("spring") {
            water.springs.clear();
            (water.rain_metres_per_second, water.seepage_metres_per_second) = (0.0, 0.0);
        }
        match endure_water(gpu, &kernels, &extreme, share) {
            Ok((done, behind)) => {
                substeps += done;
                late += u32::from(behind > 0.01);
            }
            Err(failure) => failures.push(format!("{}: {failure}", extreme.name)),
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    println!("{substeps} substeps; {late} scenes fell behind by more than a hundredth of their time");
    assert!(substeps >= SUBSTEPS);
}

/// A gas with one of everything.
fn weather() -> Scene {
    let gas = Gas {
        viscosity: 1e-4,
        buoyancy: 0.2,
        beta: 1.0,
        bands: Some(GasBands { pairs: 2, storm_radius_metres: 0.3, ..GasBands::default() }),
        emitters: Some(GasEmitters { radius_metres: 0.2, ..GasEmitters::default() }),
        ..Gas::default()
    };
    Scene {
        field: FieldSettings { size: [16, 16], addressing: Addressing::Wrap },
        plane: Plane { width_metres: 1.6, ..Plane::default() },
        gas: Some(gas),
        ..Scene::default()
    }
}

/// A gas of a scene, run through so many steps.
fn endure_gas(tank: &mut Tank, extreme: &Extreme, steps: u32) -> Result<(), String> {
    let Extreme { name, scene } = extreme;
    assert_eq!(scene.validate(), Ok(()), "{name}");
    let gas = scene.gas.as_ref().expect("it is a scene of gas");
    tank.physics = gas_source::physics(gas, scene);
    tank.set.set_physics(tank.gpu, &tank.physics);
    tank.put(&gas_source::start(gas, scene));
    let (lattice, grid, cell_metres) =
        (Lattice::of_scene(scene), gas_source::grid(gas, scene.field.size), gas.cell_metres(scene.texel_metres()));
    let mut done = 0;
    while done < steps {
        let now = steps.div_ceil(4).min(steps - done);
        let emitted: Vec<_> = (done..done + now)
            .flat_map(|step| {
                let puffs =
                    gas.emitters.iter().flat_map(move |emitters| emitted_in_step(gas, emitters, 3, &lattice, u64::from(step)));
                puffs.filter_map(move |puff| Some((step - done, puff.emission(&grid, gas.coarsening, cell_metres)?)))
            })
            .collect();
        tank.run(now, &emitted);
        done += now;
        check(tank.set.stopped().is_none(), || format!("stopped in step {:?}", tank.set.stopped()))?;
        let state = tank.state();
        let limit = tank.physics.forces.speed_limit * GAS_SPEED;
        for (cell, ([u, v], [density, dye])) in state.velocity.iter().zip(&state.scalars).enumerate() {
            let place = || format!("cell {cell} after {done} steps: ({u}, {v}) m/s of {limit}, {density}, {dye}");
            check(u.abs() <= limit && v.abs() <= limit && density.is_finite() && dye.is_finite(), place)?;
        }
        check(state.leading.iter().flatten().all(|component| component.is_finite()), || format!("after {done} steps"))?;
    }
    Ok(())
}

#[test]
fn gas_endures_the_ends_of_every_range_and_slider() {
    let base = weather();
    let all = extremes(&base, &["/plane/width_metres", "/gas"], |scene| scene.gas.clone(), 100);
    let share = STEPS.div_ceil(all.len() as u32);
    // Bands between walls, walls all around, none at all.
    let shapes = [([16, 16], [true, false]), ([15, 21], [false, false]), ([16, 16], [true, true])];
    let Some(mut tanks) =
        shapes.iter().map(|(size, repeats)| Tank::new(*size, *repeats, calm(size[1]), 1)).collect::<Option<Vec<_>>>()
    else {
        return;
    };
    let mut failures = Vec::new();
    for (number, mut extreme) in all.into_iter().enumerate() {
        let mut shape = number % shapes.len();
        let mut of_shape = extreme.scene.clone();
        let (size, repeats) = shapes[shape];
        let gas = of_shape.gas.as_mut().expect("it is a scene of gas");
        [gas.border_u, gas.border_v] = repeats.map(|repeats| if repeats { GasBorder::Periodic } else { GasBorder::Closed });
        if repeats[1] {
            gas.bands = None;
        }
        of_shape.field.size = size.map(|side| side as u32);
        // A texel stays as large as it was, or a rounding larger: what is stable depends on it.
        of_shape.plane.width_metres *= size[0] as f32 / 16.0 * (1.0 + 1e-6);
        if of_shape.validate().is_ok() {
            extreme.scene = of_shape;
        } else {
            shape = 0;
        }
        let endured = endure_gas(&mut tanks[shape], &extreme, share);
        failures.extend(endured.err().map(|failure| format!("{}: {failure}", extreme.name)));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
