//! Shallow water: its shader against its reference, and both against what is known in closed form.

use std::f64::consts::TAU;
use std::time::Instant;

use rilievo::field::Cover;
use rilievo::field::shallow_water::{
    Event, ShallowWater, ShallowWaterBody, ShallowWaterControl, ShallowWaterParams, ShallowWaterSet, ShallowWaterSpell,
    events_in_step,
};
use rilievo::field::wave::Waves;
use rilievo::gpu::{Gpu, Readback, Texture};
use rilievo::reference::shallow_water::{Rules, Water};
use rilievo::scene::{self, Border, Boundary};
use rilievo::stroke::{Lattice, Random, Stream};

use super::normals::from_half;
use crate::support::gpu::{gpu, read, run, wait_for};
use crate::support::tolerances::*;
use crate::support::water::{Dam, GRAVITY, Thacker, seiche, seiche_period};

/// Water on the GPU, whose heights are metres.
struct Basin {
    gpu: &'static Gpu,
    water: ShallowWater,
    set: ShallowWaterSet,
    params: ShallowWaterParams,
    cover: Texture<Cover>,
}

fn params(size: [u32; 2], texel_metres: f64, border: Border) -> ShallowWaterParams {
    let water = scene::ShallowWater {
        gravity_metres_per_second_squared: GRAVITY as f32,
        manning: 0.0,
        borders: [border; 4],
        courant: 0.45,
        ..scene::ShallowWater::default()
    };
    ShallowWaterParams { speed_cap: 100.0, ..ShallowWaterParams::new(&water, size, texel_metres, 1.0) }
}

/// Depth, velocity x and y, foam.
type State = [f64; 4];

impl Basin {
    fn new(params: ShallowWaterParams) -> Option<Self> {
        Self::with_bodies(params, &[])
    }

    fn with_bodies(params: ShallowWaterParams, bodies: &[ShallowWaterBody]) -> Option<Self> {
        let gpu = gpu()?;
        let water = ShallowWater::new(gpu).expect("the shader compiles");
        let cover: Texture<Cover> = Texture::new(gpu, params.size);
        let set = water.bind(gpu, &cover.view, &params, 64, bodies);
        Some(Self { gpu, water, set, params, cover })
    }

    fn texels(&self) -> impl Iterator<Item = [f64; 2]> + use<> {
        let [width, height] = self.params.size;
        let texel = f64::from(self.params.texel_metres);
        (0..height).flat_map(move |y| (0..width).map(move |x| [x, y].map(|at| (f64::from(at) + 0.5) * texel)))
    }

    /// Shapes the bed, metres.
    fn put_bed(&self, bed: impl Fn([f64; 2]) -> f64) {
        self.set.held.bed.write(self.gpu, &self.texels().map(|at| bed(at) as f32).collect::<Vec<_>>());
    }

    /// Puts water into it, by place in metres.
    fn put(&mut self, state: impl Fn([f64; 2]) -> State) {
        let states: Vec<_> = self.texels().map(state).collect();
        self.put_states(&states);
    }

    fn put_states(&mut self, states: &[State]) {
        let depths: Vec<_> = states.iter().map(|[depth, _, _, foam]| [*depth as f32, *foam as f32]).collect();
        let flows: Vec<_> = states.iter().map(|[depth, u, v, _]| [(depth * u) as f32, (depth * v) as f32]).collect();
        let fastest =
            states.iter().map(|[depth, u, v, _]| u.abs().max(v.abs()) + 2.0 * (GRAVITY * depth).sqrt()).fold(0.0, f64::max);
        let held = &self.set.held;
        self.gpu.queue.write_buffer(&held.depths[0], 0, bytemuck::cast_slice(&depths));
        self.gpu.queue.write_buffer(&held.flows[0], 0, bytemuck::cast_slice(&flows));
        let control = ShallowWaterControl { speed: (fastest as f32).to_bits(), ..ShallowWaterControl::default() };
        self.gpu.queue.write_buffer(&held.control, 0, bytemuck::bytes_of(&control));
        self.set.keep();
    }

    /// Allows no more substeps of a step than this: what is not needed still has to be recorded.
    fn cap(&mut self, substeps: u32) {
        self.set.set_params(self.gpu, &self.params, substeps);
    }

    /// Runs so many steps of so many seconds, each in as many substeps as it takes.
    fn run(&mut self, steps: u32, seconds: f64) {
        self.run_with(steps, seconds, &[]);
    }

    fn run_with(&mut self, steps: u32, seconds: f64, events: &[(u32, Event)]) {
        let spells = vec![ShallowWaterSpell { seconds: seconds as f32, ..ShallowWaterSpell::default() }; steps as usize];
        run(self.gpu, |recorder| self.water.record(recorder, &mut self.set, &spells, events, false));
    }

    fn buffer<T: bytemuck::Pod>(&self, buffer: &wgpu::Buffer) -> Vec<T> {
        let mut encoder = self.gpu.encoder("test readback");
        let readback = Readback::record_buffer(self.gpu, &mut encoder, buffer, buffer.size());
        self.gpu.queue.submit([encoder.finish()]);
        readback.start();
        bytemuck::pod_collect_to_vec(&wait_for(self.gpu, &readback))
    }

    fn control(&self) -> ShallowWaterControl {
        self.buffer(&self.set.held.control)[0]
    }

    /// Depth, flow x and y, foam.
    fn states(&self) -> Vec<State> {
        let current = self.control().current as usize;
        let depths: Vec<[f32; 2]> = self.buffer(&self.set.held.depths[current]);
        let flows: Vec<[f32; 2]> = self.buffer(&self.set.held.flows[current]);
        depths.iter().zip(&flows).map(|(depth, flow)| [depth[0], flow[0], flow[1], depth[1]].map(f64::from)).collect()
    }

    fn depths(&self) -> Vec<f64> {
        self.states().iter().map(|state| state[0]).collect()
    }

    fn mass(&self) -> f64 {
        self.depths().iter().sum()
    }

    /// The same water on the CPU.
    fn reference(&self) -> Water {
        let p = self.params;
        let wide = f64::from;
        let borders = p.borders.map(|number| Border::ALL[number as usize]);
        let states = self.states();
        let mut water = Water {
            size: p.size.map(|side| side as usize),
            texel_metres: wide(p.texel_metres),
            rules: Rules {
                gravity: wide(p.gravity),
                manning: (wide(p.friction) / wide(p.gravity)).sqrt(),
                dry_metres: wide(p.dry_metres),
                speed_cap: wide(p.speed_cap),
                courant: wide(p.courant),
                borders,
                sea: [wide(p.sea_metres), 0.0],
                rain: wide(p.rain),
                seepage: wide(p.seepage),
                foam_gain: wide(p.foam_gain),
                foam_loss: wide(p.foam_loss),
            },
            depth: states.iter().map(|state| state[0]).collect(),
            flow: states.iter().map(|state| [state[1], state[2]]).collect(),
            foam: states.iter().map(|state| state[3]).collect(),
            bed: read::<_, f32>(self.gpu, &self.set.held.bed).into_iter().map(wide).collect(),
            steps: u64::from(self.control().substeps),
            speed: 0.0,
        };
        water.measure();
        water
    }
}

fn relative_error(actual: impl IntoIterator<Item = f64>, exact: &[f64]) -> f64 {
    actual.into_iter().zip(exact).map(|(a, e)| (a - e).abs()).sum::<f64>() / exact.iter().sum::<f64>()
}

#[test]
fn closed_forms_have_the_known_figures() {
    for (front, figures) in [(0.5, [0.72692, 0.92336, 2.95792]), (0.1, [0.396175, 2.321355, 3.105134])] {
        let dam = Dam::new(front);
        for (actual, known) in [dam.middle, dam.velocity, dam.fastest].into_iter().zip(figures) {
            assert!((actual - known).abs() <= WATER_STOKER, "front {front}: {actual} is known to be {known}");
        }
    }
}

/// How a dam lies in the field, by the lattice.
#[derive(Clone, Copy, Debug)]
enum Lie {
    X,
    Y,
    /// Two dams back to back along the diagonals of a field that repeats: no border disturbs them.
    Diagonal,
}

#[test]
fn dams_break_as_ritter_and_stoker_say() {
    const CELLS: u32 = 512;
    for lie in [Lie::X, Lie::Y, Lie::Diagonal] {
        for front in [0.0, 0.1, 0.5] {
            let dam = Dam::new(front);
            let (size, border) = match lie {
                Lie::X => ([CELLS, 3], Border::Wall),
                Lie::Y => ([3, CELLS], Border::Wall),
                Lie::Diagonal => ([CELLS, CELLS], Border::Periodic),
            };
            let texel = 10.0 / f64::from(CELLS);
            let Some(mut basin) = Basin::new(params(size, texel, border)) else { return };
            basin.put_bed(|_| 0.0);
            // Metres in front of the nearest dam, less than 0 behind it.
            let ahead = |[x, y]: [f64; 2]| match lie {
                Lie::X => x - 5.0,
                Lie::Y => y - 5.0,
                Lie::Diagonal => {
                    // Texels' sums of coordinates are whole, their centres' one more.
                    let across = (x + y - texel).rem_euclid(10.0);
                    (2.5 - texel / 2.0 - across).max(across - 7.5 + texel / 2.0) / 2.0_f64.sqrt()
                }
            };
            basin.put(|at| [if ahead(at) < 0.0 { 1.0 } else { front }, 0.0, 0.0, 0.0]);
            let length = if matches!(lie, Lie::Diagonal) { 10.0 / 2.0_f64.sqrt() } else { 10.0 };
            let seconds = 0.25 * length / dam.fastest.max(GRAVITY.sqrt());
            basin.run(8, seconds / 8.0);
            let control = basin.control();
            assert_eq!((control.behind, control.halted), (0.0, 0), "{lie:?}, front {front}");
            let exact: Vec<_> = basin.texels().map(|at| dam.depth(ahead(at) / seconds)).collect();
            let error = relative_error(basin.depths(), &exact);
            println!("{lie:?}, front {front}: {error:.5} in {} substeps", control.substeps);
            assert!(error < WATER_DAM, "{lie:?}, front {front}: {error:.5}");
            assert!(basin.depths().iter().all(|depth| *depth >= 0.0), "{lie:?}, front {front}");
        }
    }
}

fn noise(seed: u64, count: usize) -> Vec<f64> {
    let mut random = Random::new(seed, Stream::Stress, 0);
    (0..count).map(|_| random.unit()).collect()
}

#[test]
fn a_lake_at_rest_stays_at_rest_around_its_islands() {
    for (border, size) in [(Border::Wall, [61, 47]), (Border::Periodic, [48, 33]), (Border::Sea, [40, 25])] {
        let mut settings = params(size, 0.1, border);
        settings.sea_metres = 0.8;
        let Some(mut basin) = Basin::new(settings) else { return };
        let ground: Vec<f32> = noise(3, (size[0] * size[1]) as usize).iter().map(|h| (1.1 * h) as f32).collect();
        basin.set.held.bed.write(basin.gpu, &ground);
        let states: Vec<State> = ground.iter().map(|bed| [(0.8_f32 - bed).max(0.0).into(), 0.0, 0.0, 0.0]).collect();
        assert!(states.iter().any(|state| state[0] == 0.0), "there are islands");
        basin.put_states(&states);
        basin.cap(1);
        // Three metres a second is the fastest wave: each of these steps is one substep.
        for _ in 0..10 {
            basin.run(100, 0.45 * 0.1 / 6.0);
        }
        assert!(basin.control().substeps >= 1000);
        let deviation = basin.states().iter().zip(&states).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f64::max);
        println!("{border:?}: {deviation:.2e}");
        assert!(deviation <= WATER_REST * 0.8, "{border:?}: {deviation:.2e}");
    }
}

#[test]
fn a_paraboloid_of_water_comes_back_after_its_period() {
    const SIDE: u32 = 256;
    let thacker = Thacker { basin: 1.0, narrowest: 0.8, middle: 0.1 };
    let Some(mut basin) = Basin::new(params([SIDE; 2], 4.0 / f64::from(SIDE), Border::Wall)) else { return };
    let distance = |[x, y]: [f64; 2]| (x - 2.0).hypot(y - 2.0);
    basin.put_bed(|at| thacker.bed(distance(at)));
    basin.put(|at| [thacker.depth(distance(at), 0.0), 0.0, 0.0, 0.0]);
    let before = basin.mass();
    let seconds = thacker.period();
    basin.run(20, seconds / 40.0);
    let widest: Vec<_> = basin.texels().map(|at| thacker.depth(distance(at), seconds / 2.0)).collect();
    let half_way = relative_error(basin.depths(), &widest);
    basin.run(20, seconds / 40.0);
    let exact: Vec<_> = basin.texels().map(|at| thacker.depth(distance(at), seconds)).collect();
    let error = relative_error(basin.depths(), &exact);
    let drift = basin.mass() / before - 1.0;
    println!("half a period {half_way:.5}, one {error:.5}, {} substeps, mass {drift:.1e}", basin.control().substeps);
    assert!(half_way < WATER_THACKER && error < WATER_THACKER, "{half_way} and {error}");
    assert!(drift.abs() <= WATER_MASS, "{drift:e}");
}

#[test]
fn a_seiche_keeps_its_time() {
    for (size, axis) in [([128, 2], 0), ([2, 128], 1)] {
        let Some(mut basin) = Basin::new(params(size, 10.0 / 128.0, Border::Wall)) else { return };
        basin.put_bed(|_| 0.0);
        basin.put(|at| [1.0 + 0.01 * seiche(at[axis] / 10.0), 0.0, 0.0, 0.0]);
        basin.cap(8);
        let expected = seiche_period(10.0, 1.0);
        let step = expected / 100.0;
        // The times at which the first texel passes the rest level.
        let (mut passed, mut before) = (Vec::new(), basin.depths()[0] - 1.0);
        for number in 1..=320 {
            basin.run(1, step);
            let now = basin.depths()[0] - 1.0;
            if before * now < 0.0 {
                passed.push((f64::from(number) - now / (now - before)) * step);
            }
            before = now;
        }
        let halves = (passed.len() - 1) as f64;
        let period = 2.0 * (passed[passed.len() - 1] - passed[0]) / halves;
        println!("along {axis}: {period:.4} s of {expected:.4} over {halves} halves");
        assert!(halves >= 5.0 && (period / expected - 1.0).abs() <= WATER_SEICHE, "{period} of {expected}");
    }
}

/// A hilly bed with dry hills and water that sloshes in it; where it repeats, it has a cliff.
fn rough(basin: &mut Basin, level: f64) {
    let [width, height] = basin.params.size.map(|side| f64::from(side) * f64::from(basin.params.texel_metres));
    let angle = move |[x, y]: [f64; 2], [u, v]: [f64; 2]| u * x / width + v * y / height;
    let hills =
        move |at| 0.5 + 0.4 * angle(at, [7.0, 0.0]).sin() * angle(at, [0.0, 5.0]).cos() + 0.2 * angle(at, [11.0, 3.0]).sin();
    basin.put_bed(hills);
    basin.put(|at| {
        let depth = (level + 0.3 * angle(at, [3.0, 0.0]).cos() - hills(at)).max(0.0);
        [depth, 0.3 * angle(at, [0.0, 4.0]).sin(), -0.2, if at[0] < width / 3.0 { 0.7 } else { 0.0 }]
    });
}

#[test]
fn equals_the_reference_at_odd_sizes_with_every_border() {
    for border in Border::ALL {
        for size in [[1, 1], [1, 9], [23, 1], [2, 3], [16, 16], [17, 33], [255, 257]] {
            let mut settings = params(size, 0.1, border);
            (settings.friction, settings.rain, settings.seepage) = (0.01, 0.002, 0.001);
            settings.sea_metres = 0.6;
            let Some(mut basin) = Basin::new(settings) else { return };
            rough(&mut basin, 0.6);
            let mut expected = basin.reference();
            // Half of what is stable, so that neither side divides a step.
            let seconds = f64::from((0.2 * 0.1 / expected.speed.max(1.0)) as f32);
            let steps = if size[0] > 100 { 6 } else { 40 };
            for _ in 0..steps {
                expected.step(seconds);
            }
            basin.run(steps, seconds);
            assert_eq!(basin.control().substeps, steps, "{border:?}, {size:?}");
            let states = basin.states();
            let mut worst = 0.0_f64;
            for (index, state) in states.iter().enumerate() {
                let [depth, foam] = [state[0] - expected.depth[index], (state[3] - expected.foam[index]) * state[0]];
                let flow = (state[1] - expected.flow[index][0]).hypot(state[2] - expected.flow[index][1]);
                let off = depth.abs().max(flow.abs()).max(foam.abs());
                assert!(off <= WATER_STEPS, "{border:?}, {size:?}, texel {index}: {off:.2e}, {state:?}");
                worst = worst.max(off);
            }
            println!("{border:?}, {size:?}: {worst:.1e}");
        }
    }
}

#[test]
fn a_substep_costs_at_most_six_steps_of_the_wave() {
    let size = [1024, 1024];
    let Some(mut basin) = Basin::new(params(size, 0.1, Border::Wall)) else { return };
    let waves = Waves::new(basin.gpu).expect("the shader compiles");
    let wave = scene::Wave { boundary: Boundary::Periodic, ..scene::Wave::default() };
    let mut pool = waves.bind(basin.gpu, size, &wave, [1.0, 1.0]);
    rough(&mut basin, 0.7);
    basin.cap(2);
    // More than two substeps can cover, so that each run takes both.
    let seconds = 1.0;
    let mut in_steps = || {
        let mut ratios: Vec<_> = (0..9)
            .map(|_| {
                // Each alone from its recording to its end; in turn, so that both see the same machine.
                let start = Instant::now();
                let moved = run(basin.gpu, |recorder| waves.record(recorder, &mut pool, 8, &[]));
                assert_eq!(moved, Ok(true));
                let step = start.elapsed().as_secs_f64() / 8.0;
                let before = basin.control().substeps;
                let start = Instant::now();
                basin.run(1, seconds);
                let both = start.elapsed().as_secs_f64();
                assert_eq!(basin.control().substeps, before + 2);
                0.5 * both / step
            })
            .collect();
        ratios.sort_by(f64::total_cmp);
        ratios[4]
    };
    // The other tests run beside this one and disturb it; one quiet spell is enough.
    let ratio = (0..5).map(|_| in_steps()).find(|ratio| *ratio <= WATER_BUDGET_STEPS);
    println!("a substep of shallow water over a rough bed, 1024²: {ratio:.2?} wave steps");
    assert!(ratio.is_some(), "a substep cost more than {WATER_BUDGET_STEPS} wave steps, five times over");
}

#[test]
fn walls_keep_the_mass() {
    let Some(mut basin) = Basin::new(params([100, 70], 0.1, Border::Wall)) else { return };
    rough(&mut basin, 0.7);
    basin.cap(4);
    let before = basin.mass();
    for _ in 0..20 {
        basin.run(100, 0.01);
    }
    assert!(basin.control().substeps >= 2000);
    let drift = basin.mass() / before - 1.0;
    println!("mass drifts by {drift:.1e} in {} substeps", basin.control().substeps);
    assert!(drift.abs() <= WATER_MASS, "{drift:e}");
    assert!(basin.depths().iter().all(|depth| *depth >= 0.0));
}

#[test]
fn rain_and_seepage_are_what_falls_and_what_is_taken() {
    let mut settings = params([40, 30], 0.1, Border::Wall);
    settings.rain = 0.01;
    let Some(mut basin) = Basin::new(settings) else { return };
    rough(&mut basin, 0.4);
    let before = basin.mass();
    basin.run(100, 0.01);
    let rained = (basin.mass() - before) / (40.0 * 30.0);
    assert!((rained / 0.01 - 1.0).abs() < 1e-3, "a second of rain at 1 cm/s adds {rained} m");
    settings.rain = 0.0;
    settings.seepage = 10.0;
    basin.set.set_params(basin.gpu, &settings, 64);
    basin.run(30, 0.01);
    assert_eq!(basin.mass(), 0.0, "all of it is gone, and no more than that");
}

#[test]
fn a_dent_and_its_ring_have_no_net() {
    for border in [Border::Wall, Border::Periodic] {
        // In deep water, over hills and their dry tops, in a corner, in a puddle shallower than the dent, and on dry land.
        for (centre, radius, level) in [
            ([40.0, 30.0], 12.0, 2.0),
            ([33.3, 21.7], 20.0, 0.5),
            ([0.2, 69.0], 9.0, 2.0),
            ([50.0, 35.0], 30.0, 0.3),
            ([5.0, 5.0], 4.0, -9.0),
        ] {
            let Some(mut basin) = Basin::new(params([100, 70], 0.1, border)) else { return };
            rough(&mut basin, level);
            let before = basin.states();
            basin.run_with(0, 0.0, &[(0, Event::dent(centre, radius, 0.5, 1.0))]);
            let after = basin.states();
            let changes: Vec<_> = before.iter().zip(&after).map(|(a, b)| b[0] - a[0]).collect();
            let (net, moved) = (changes.iter().sum::<f64>(), changes.iter().map(|change| change.abs()).sum::<f64>() / 2.0);
            assert!(net.abs() <= WATER_NET * moved, "{border:?} at {centre:?}: {net:e} of {moved}");
            assert!(after.iter().all(|state| state[0] >= 0.0), "{border:?} at {centre:?}");
            assert_eq!(moved > 0.1, level > 0.0, "{border:?} at {centre:?}: {moved}");
            let foamed = |states: &[State]| states.iter().filter(|state| state[3] > 0.75).count();
            assert_eq!(foamed(&after) > foamed(&before), level > 0.0, "{border:?} at {centre:?}: it foams");
            // Beyond a border that repeats it falls on the other side.
            if centre == [0.2, 69.0] {
                let opposite = [changes[99], changes[200]].map(|change| change != 0.0);
                assert_eq!(opposite, [border == Border::Periodic; 2], "{border:?} at {centre:?}");
            }
        }
    }
}

#[test]
fn a_shot_into_water_makes_a_ring() {
    let Some(mut basin) = Basin::new(params([101, 101], 0.1, Border::Wall)) else { return };
    basin.put_bed(|_| 0.0);
    basin.put(|_| [1.0, 0.0, 0.0, 0.0]);
    basin.run_with(0, 0.0, &[(0, Event::dent([50.0, 50.0], 10.0, 0.3, 0.0))]);
    let row = |basin: &Basin| basin.depths()[50 * 101..51 * 101].to_vec();
    let start = row(&basin);
    assert!((start[50] - 0.7).abs() < 1e-3 && start[58] > 1.0 && start[61] == 1.0, "{start:?}");
    // After a second the ring has run some 31 texels outward, and is as wide in every direction.
    basin.run(100, 0.01);
    let later = row(&basin);
    let crest = (50..101).max_by(|a, b| later[*a].total_cmp(&later[*b])).expect("there are texels");
    assert!((76..92).contains(&crest), "the crest is {} texels away", crest - 50);
    let depths = basin.depths();
    for (x, y) in [(0, 1), (17, 50), (30, 88)] {
        let pairs = [(x, y), (y, x), (100 - x, y), (x, 100 - y)].map(|(x, y): (usize, usize)| depths[y * 101 + x]);
        let spread = pairs.iter().map(|depth| (depth - pairs[0]).abs()).fold(0.0, f64::max);
        // Which direction goes first changes from substep to substep: the diagonal's mirror image is of the scheme's order only.
        assert!(spread < 2e-3, "({x}, {y}): {pairs:?}");
    }
}

#[test]
fn pours_add_and_take_their_volume() {
    let Some(mut basin) = Basin::new(params([64, 64], 0.1, Border::Wall)) else { return };
    basin.put_bed(|_| 0.0);
    basin.put(|_| [0.05, 0.1, 0.0, 0.0]);
    let before = basin.mass();
    let events = [(0, Event::pour([30.0, 30.0], 10.0, 0.2)), (0, Event::pour([32.0, 31.0], 8.0, 0.1))];
    basin.run_with(0, 0.0, &events);
    // The integral of (1 − s)² over a disc is a third of its area.
    let volume = std::f64::consts::PI / 3.0 * (0.2 * 100.0 + 0.1 * 64.0);
    let added = basin.mass() - before;
    assert!((added / volume - 1.0).abs() < 0.01, "{added} of {volume}");
    // The next substep must not be too long for what stands there now.
    let deepest = basin.depths().into_iter().fold(0.0, f64::max);
    let speed = f64::from(f32::from_bits(basin.control().speed));
    assert!(deepest > 0.2 && speed >= 2.0 * (GRAVITY * deepest).sqrt(), "{speed} m/s are announced of {deepest} m");
    // A drain takes what there is and no more, and what stays keeps its velocity.
    basin.run_with(0, 0.0, &[(0, Event::pour([30.0, 30.0], 12.0, -5.0))]);
    let states = basin.states();
    assert_eq!(states[30 * 64 + 30][0], 0.0);
    assert!(states.iter().all(|state| state[0] >= 0.0 && (state[0] == 0.0) <= (state[1] == 0.0)));
}

#[test]
fn a_fill_stands_level_over_its_bed() {
    let settings = params([40, 30], 0.1, Border::Wall);
    let body = |low, high, level| ShallowWaterBody::new(&scene::Body { low, high, level });
    let bodies = [body([0.0, 0.0], [0.5, 1.0], 0.6), body([0.25, 0.0], [1.0, 1.0], 0.3)];
    let Some(mut basin) = Basin::with_bodies(settings, &bodies) else { return };
    basin.put_bed(|[x, _]| 0.2 * x);
    basin.run(0, 0.0);
    for (at, state) in basin.texels().zip(basin.states()) {
        let level = if at[0] < 2.0 { 0.6 } else { 0.3 };
        assert!((state[0] - (level - 0.2 * at[0]).max(0.0)).abs() < 1e-6, "{at:?}: {state:?}");
    }
    let surface: Vec<f32> = read(basin.gpu, &basin.set.held.surface);
    assert!((surface[0] - 0.6).abs() < 1e-6 && (surface[39] - 0.79).abs() < 1e-6, "{} and {}", surface[0], surface[39]);
    // The first substep, of which no other knows anything yet, must not be too long for it.
    let speed = f64::from(f32::from_bits(basin.control().speed));
    assert!(speed >= 2.0 * (GRAVITY * 0.59).sqrt(), "{speed} m/s are announced");
}

#[test]
fn what_covers_the_field_is_depth_foam_and_velocity() {
    let Some(mut basin) = Basin::new(ShallowWaterParams { depth_metres: 2.0, ..params([37, 18], 0.1, Border::Wall) }) else {
        return;
    };
    basin.put_bed(|[x, y]| 0.1 * x + 0.05 * y);
    basin.put(|[x, y]| [(1.0 - 0.3 * x).max(0.0), 0.5 - 0.2 * x, 0.3 * y, 0.25 * x]);
    basin.run_with(0, 0.0, &[(0, Event::pour([0.0; 2], 1.0, 0.0))]);
    let surfaces: Vec<f32> = read(basin.gpu, &basin.set.held.surface);
    let covers: Vec<[u16; 4]> = read(basin.gpu, &basin.cover);
    for (((at, [depth, along, across, foam]), surface), cover) in basin.texels().zip(basin.states()).zip(surfaces).zip(covers) {
        let velocity = |flow: f64| if depth > 0.0 { flow / depth } else { 0.0 };
        // The test's bed is in heights: metres of a field that is one metre deep.
        let expected = [depth / 2.0, foam, velocity(along), velocity(across)];
        let off = cover.map(from_half).into_iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off <= WATER_COVER, "{at:?}: {:?} for {expected:?}", cover.map(from_half));
        assert!((f64::from(surface) - (0.1 * at[0] + 0.05 * at[1] + depth / 2.0)).abs() <= 1e-6, "{at:?}: {surface}");
    }
}

#[test]
fn a_swell_comes_in_as_its_sea_says_and_as_fast_as_waves_are() {
    // A channel 20 m long and 1 m deep, whose western end is the sea: after 3 s nothing has come back from the other one.
    const AMPLITUDE: f64 = 0.001;
    let mut settings = params([400, 3], 0.05, Border::Wall);
    settings.borders[0] = Border::Sea as u32;
    settings.sea_metres = 1.0;
    let Some(mut basin) = Basin::new(settings) else { return };
    basin.put_bed(|_| 0.0);
    basin.put(|_| [1.0, 0.0, 0.0, 0.0]);
    let water = scene::ShallowWater {
        step_seconds: 0.01,
        swell: Some(scene::Swell { amplitude_metres: AMPLITUDE as f32, period_seconds: 1.0 }),
        ..scene::ShallowWater::default()
    };
    for step in (0..300).step_by(100) {
        let spells: Vec<_> = (step..step + 100).map(|step| ShallowWaterSpell::new(&water, step)).collect();
        run(basin.gpu, |recorder| basin.water.record(recorder, &mut basin.set, &spells, &[], false));
        // The last substep takes the sea as it is in its middle.
        let control = basin.control();
        let middle = 0.01 * (step + 100) as f64 - 0.5 * f64::from(control.dt);
        assert!((f64::from(control.rise) - AMPLITUDE * (TAU * middle).sin()).abs() <= 1e-4 * AMPLITUDE, "{control:?}");
    }
    let celerity = GRAVITY.sqrt();
    // From the centre of the texel beyond the border, where the sea is. Not where the swell began, with a kink in its velocity.
    let depths = basin.depths();
    let off = depths[..180].iter().enumerate().map(|(x, depth)| {
        let seconds = 3.0 - 0.05 * (x as f64 + 1.0) / celerity;
        (depth - 1.0 - if seconds > 0.0 { AMPLITUDE * (TAU * seconds).sin() } else { 0.0 }).abs()
    });
    let off = off.fold(0.0, f64::max) / AMPLITUDE;
    println!("off by {off:.4} amplitudes");
    assert!(off <= WATER_SWELL, "{off}");
}

#[test]
fn what_is_thin_between_fast_water_gives_no_more_than_it_has() {
    for border in [Border::Wall, Border::Periodic] {
        let Some(mut basin) = Basin::new(params([45, 38], 0.1, border)) else { return };
        let drawn = noise(17, 45 * 38 * 3);
        basin.put_bed(|_| 0.0);
        // Deep, thin and dry texels side by side, thrown about faster than their own waves.
        let states: Vec<State> = drawn
            .chunks_exact(3)
            .map(|draw| {
                let depth = if draw[0] < 0.3 { 0.0 } else { 10.0_f64.powf(-5.0 * draw[0] + 1.0) };
                [depth, 16.0 * draw[1] - 8.0, 16.0 * draw[2] - 8.0, 0.0]
            })
            .collect();
        basin.put_states(&states);
        let before = basin.mass();
        basin.cap(4);
        basin.run(200, 0.002);
        let control = basin.control();
        let drift = basin.mass() / before - 1.0;
        println!("{border:?}: {drift:.1e} in {} substeps", control.substeps);
        assert!(drift.abs() <= WATER_MASS && control.halted == 0, "{border:?}: {drift:e}");
    }
}

#[test]
fn a_plunger_sinks_as_deep_as_it_says_adds_nothing_and_makes_rings() {
    const PERIOD: f64 = 0.8;
    let plunger = scene::Plunger { centre: [0.5; 2], radius_metres: 0.3, depth_metres: 0.05, period_seconds: PERIOD as f32 };
    let water = scene::ShallowWater { step_seconds: 0.01, plungers: vec![plunger], ..scene::ShallowWater::default() };
    let lattice = Lattice { size: [201, 201], texel_metres: 0.03, depth_metres: 1.0 };
    let of_step = |step: u64| events_in_step(&water, 0, &lattice, step).collect::<Vec<_>>();
    // Half a period down, half a period up again, which draws nothing after it.
    let sunk: f32 = (0..40).flat_map(of_step).map(|event| event.metres).sum();
    assert!((sunk - 0.05).abs() < 1e-6, "it sank by {sunk}");
    assert_eq!((40..80).flat_map(of_step).count(), 0, "it rises without a pull");

    let Some(mut basin) = Basin::new(params([201, 201], 0.03, Border::Wall)) else { return };
    basin.put_bed(|_| 0.0);
    basin.put(|_| [0.1, 0.0, 0.0, 0.0]);
    basin.cap(2);
    let before = basin.mass();
    // What rises from the plunger eastward, after so many periods. Waves run 1 m/s: in five nothing has come back from a wall to 1.5 m.
    let east = |basin: &Basin| basin.depths()[100 * 201 + 100..101 * 201].iter().map(|depth| depth - 0.1).collect::<Vec<_>>();
    let mut profiles = Vec::new();
    for period in 0..5 {
        let events: Vec<_> =
            (0..80_u64).flat_map(|step| of_step(80 * period + step).into_iter().map(move |event| (step as u32, event))).collect();
        basin.run_with(80, 0.01, &events);
        profiles.push(east(&basin));
        if period == 2 {
            let depths = basin.depths();
            let largest = profiles[2].iter().fold(0.0_f64, |most, rise| most.max(rise.abs()));
            // They are round: every direction has the same.
            let ways: [fn(usize) -> usize; 3] = [|r| 100 * 201 + 100 - r, |r| (100 + r) * 201 + 100, |r| (100 - r) * 201 + 100];
            for way in ways {
                let apart = (0..100).map(|r| (depths[way(r)] - 0.1 - profiles[2][r]).abs()).fold(0.0, f64::max);
                assert!(apart <= 0.02 * largest, "{apart} of {largest}");
            }
            // The first of them is as far as waves of 10 cm of water come in three periods, from within the plunger.
            let front = (0..100).rfind(|&r| profiles[2][r].abs() > 0.1 * largest).expect("there is a ring");
            let way = 3.0 * PERIOD * (GRAVITY * 0.1).sqrt();
            assert!((way - 0.3..way + 0.3).contains(&(0.03 * front as f64)), "{front} texels, {way} m");
        }
    }
    let drift = basin.mass() / before - 1.0;
    assert!(drift.abs() <= WATER_MASS, "{drift:e}");
    assert_eq!(basin.control().behind, 0.0);
    // By then one period is like the next.
    let largest = profiles[4][12..50].iter().fold(0.0_f64, |most, rise| most.max(rise.abs()));
    let apart = (12..50).map(|r| (profiles[4][r] - profiles[3][r]).abs()).fold(0.0, f64::max);
    println!("rings {largest:.5} m high, {:.3} of that from period to period", apart / largest);
    assert!(largest > 1e-3 && apart <= WATER_RING * largest, "{apart} of {largest}");
}

#[test]
fn a_bed_that_is_no_number_is_a_wall() {
    for poison in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30] {
        let Some(mut basin) = Basin::new(params([33, 20], 0.1, Border::Wall)) else { return };
        let mut ground = vec![0.0_f32; 33 * 20];
        (0..20).for_each(|y| ground[y * 33 + 16] = poison);
        ground[5 * 33 + 5] = poison;
        basin.set.held.bed.write(basin.gpu, &ground);
        basin.put(|[x, _]| [if x < 1.6 { 1.0 } else { 0.0 }, 0.0, 0.0, 0.0]);
        let before = basin.mass();
        // Water falls on the wall too, but stays there.
        basin.run_with(50, 0.01, &[(3, Event::dent([8.0, 8.0], 6.0, 0.2, 0.0)), (9, Event::pour([16.0, 8.0], 3.0, 0.0))]);
        let control = basin.control();
        assert_eq!((control.halted, control.behind), (0, 0.0), "{poison}");
        for (index, state) in basin.states().iter().enumerate() {
            assert!(state.iter().all(|value| value.is_finite()), "{poison}, texel {index}: {state:?}");
            assert!(index % 33 < 16 || state[0] == 0.0, "{poison}: water behind the wall at {index}");
        }
        assert!((basin.mass() / before - 1.0).abs() < WATER_MASS, "{poison}");
    }
}

#[test]
fn what_is_no_number_stops_the_water_at_its_last_good_state() {
    for poison in [[f64::from(f32::MAX), 0.0], [f64::NAN, 0.0], [1.0, f64::INFINITY]] {
        let Some(mut basin) = Basin::new(params([40, 40], 0.1, Border::Wall)) else { return };
        rough(&mut basin, 0.7);
        basin.run(3, 0.01);
        let mut states = basin.states();
        let control = basin.control();
        assert_eq!(control.halted, 0);
        // Behind the program's back: nothing that it accepts leads there.
        let texel = 20 * 40 + 20;
        states[texel][0] = poison[0];
        states[texel][1] = poison[1];
        let depths: Vec<_> = states.iter().map(|state| [state[0] as f32, state[3] as f32]).collect();
        let flows: Vec<_> = states.iter().map(|state| [state[1] as f32, state[2] as f32]).collect();
        let current = control.current as usize;
        basin.gpu.queue.write_buffer(&basin.set.held.depths[current], 0, bytemuck::cast_slice(&depths));
        basin.gpu.queue.write_buffer(&basin.set.held.flows[current], 0, bytemuck::cast_slice(&flows));
        basin.run_with(20, 0.01, &[(2, Event::pour([5.0, 5.0], 5.0, 1.0))]);
        let after = basin.control();
        assert_eq!((after.halted, after.substeps), (1, control.substeps), "{poison:?}");
        let kept = basin.states();
        for (index, (a, b)) in kept.iter().zip(&states).enumerate().filter(|(index, _)| *index != texel) {
            assert_eq!(a, b, "{poison:?}: texel {index} is as it was");
        }
    }
}

#[test]
fn falling_behind_is_counted_and_costs_nothing_else() {
    let Some(mut basin) = Basin::new(params([64, 64], 0.01, Border::Wall)) else { return };
    rough(&mut basin, 0.7);
    basin.set.set_params(basin.gpu, &basin.params, 2);
    // 0.1 s would take some 60 substeps.
    basin.run(5, 0.1);
    let control = basin.control();
    assert_eq!((control.substeps, control.halted), (10, 0));
    assert!((0.4..0.5).contains(&control.behind), "{} s of 0.5 were given up", control.behind);
    // Unhurried it takes as many as it needs, and gives up nothing more.
    basin.set.set_params(basin.gpu, &basin.params, 64);
    basin.run(1, 0.01);
    let later = basin.control();
    assert_eq!(later.behind, control.behind);
    assert!((1..40).contains(&(later.substeps - control.substeps)), "{}", later.substeps - control.substeps);
}

#[test]
fn a_step_goes_in_as_many_substeps_as_its_waves_allow() {
    let Some(mut basin) = Basin::new(params([24, 24], 0.1, Border::Wall)) else { return };
    basin.put_bed(|_| 0.0);
    basin.put(|_| [1.0, 0.0, 0.0, 0.0]);
    // Now it knows its waves: 3.13 m/s, which cross 0.45 of a texel in 14.37 ms.
    basin.run(1, 0.001);
    for (seconds, expected) in [(0.0143, 1), (0.0145, 2), (0.0287, 2), (0.0289, 3), (0.1, 7)] {
        let before = basin.control().substeps;
        basin.run(1, seconds);
        assert_eq!(basin.control().substeps - before, expected, "{seconds} s");
    }
}

#[test]
fn steps_cut_into_frames_are_the_same_to_the_bit() {
    let run = |frames: &[u32]| -> Option<Vec<State>> {
        let mut basin = Basin::new(params([50, 40], 0.05, Border::Wall))?;
        rough(&mut basin, 0.6);
        frames.iter().for_each(|steps| basin.run(*steps, 1.0 / 120.0));
        Some(basin.states())
    };
    let Some(one) = run(&[12]) else { return };
    assert_eq!(Some(one), run(&[1, 0, 4, 2, 5]));
}
