//! The wave: its shader against its reference, and both against what is known of the wave equation.

use std::f64::consts::TAU;

use rilievo::field::bins::BinError;
use rilievo::field::wave::{Impulse, Mask, WaveError, WaveParams, WaveSet, Waves, check, step_seconds};
use rilievo::gpu::Gpu;
use rilievo::reference;
use rilievo::scene::{Boundary, LayerBlend, Obstacle, Wave};
use rilievo::stroke::{Random, Stream};

use crate::support::gpu::{gpu, read, run};
use crate::support::tolerances::*;

/// Water on the GPU. A texel is a metre wide, so that lengths in a scene are texels.
struct Pool {
    gpu: &'static Gpu,
    waves: Waves,
    size: [u32; 2],
    set: WaveSet,
    scene: Wave,
}

impl Pool {
    fn new(size: [u32; 2], scene: Wave) -> Option<Self> {
        let gpu = gpu()?;
        let waves = Waves::new(gpu).expect("the shader compiles");
        let set = waves.bind(gpu, size, &scene, size.map(f64::from));
        Some(Self { gpu, waves, size, set, scene })
    }

    /// Puts the water into a state, and one step ago into another.
    fn put(&self, current: impl Fn(f64, f64) -> f64, previous: impl Fn(f64, f64) -> f64) {
        let [width, height] = self.size;
        let fill = |function: &dyn Fn(f64, f64) -> f64| -> Vec<f32> {
            (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| function(x.into(), y.into()) as f32).collect()
        };
        self.set.states[self.set.current()].write(self.gpu, &fill(&current));
        self.set.states[1 - self.set.current()].write(self.gpu, &fill(&previous));
    }

    fn run(&mut self, steps: u32, splashes: &[(u32, Impulse)]) -> bool {
        run(self.gpu, |recorder| self.waves.record(recorder, &mut self.set, steps, splashes))
            .expect("few impulses fit every buffer")
    }

    /// u and u⁻ as the reference holds them, for its measures.
    fn state(&self) -> reference::wave::Wave {
        let wide = |state: usize| read::<_, f32>(self.gpu, &self.set.states[state]).into_iter().map(f64::from).collect();
        reference::wave::Wave { current: wide(self.set.current()), previous: wide(1 - self.set.current()), ..self.reference() }
    }

    /// Still water of the same settings on the CPU.
    fn reference(&self) -> reference::wave::Wave {
        let [width, height] = self.size;
        let mut wave = reference::wave::Wave::still(
            [width as usize, height as usize],
            self.scene.boundary,
            f64::from(self.scene.courant).powi(2),
        );
        let params = WaveParams::new(&self.scene, self.size, 1.0);
        wave.damping = f64::from(params.damping);
        wave.sponge_damping = f64::from(params.sponge_damping);
        wave.sponge_texels = f64::from(params.sponge_width);
        for (index, closed) in wave.closed.iter_mut().enumerate() {
            // The texels' centres, metres, against the obstacles' boxes, whose corners are square here.
            let centre = [(index % width as usize) as f32 + 0.5, (index / width as usize) as f32 + 0.5];
            *closed = self.scene.obstacles.iter().any(|obstacle| {
                (0..2).all(|axis| {
                    let size = self.size[axis] as f32;
                    let apart = (centre[axis] - obstacle.centre[axis] * size).abs();
                    let apart = if self.scene.boundary == Boundary::Periodic { apart.min(size - apart) } else { apart };
                    apart <= obstacle.half_extent_metres[axis]
                })
            });
        }
        wave
    }
}

/// Waves that cross a texel in 1/courant steps, with a damping γ a step.
fn scene(boundary: Boundary, courant: f32, damping: f32) -> Wave {
    Wave {
        speed_metres_per_second: 1.0,
        courant,
        damping_per_second: damping / courant,
        boundary,
        sponge_texels: 6,
        amplitude: 1.0,
        blend: LayerBlend::Add,
        rain: None,
        obstacles: Vec::new(),
    }
}

/// A block in the field, its bounds between texels.
fn block(size: [u32; 2], centre: [f32; 2], half: [f32; 2]) -> Obstacle {
    let centre = [centre[0] / size[0] as f32, centre[1] / size[1] as f32];
    Obstacle { centre, half_extent_metres: half, corner_metres: 0.0, top: 1.0 }
}

const BOUNDARIES: [Boundary; 4] = [Boundary::Periodic, Boundary::Reflecting, Boundary::Fixed, Boundary::Absorbing];

#[test]
fn equals_the_reference_with_every_boundary_and_obstacles() {
    for boundary in BOUNDARIES {
        for size in [[33, 21], [64, 48], [12, 70]] {
            let mut scene = scene(boundary, 0.69, 0.01);
            scene.obstacles = vec![block(size, [9.0, 11.0], [2.6, 1.6]), block(size, [0.0, 16.0], [1.6, 3.6])];
            let Some(mut pool) = Pool::new(size, scene) else { return };
            let mut expected = pool.reference();
            let mut random = Random::new(5, Stream::Rain, u64::from(size[0]));
            let mut frame = 0;
            for steps in [0, 1, 3, 0, 2, 40, 27, 27] {
                frame += 1;
                let splashes: Vec<_> = (0..steps.max(1))
                    .filter(|step| step % 9 == 0)
                    .flat_map(|step| (0..3).map(|_| (step, splash_anywhere(&mut random, size))).collect::<Vec<_>>())
                    .collect();
                assert!(pool.run(steps, &splashes));
                for step in 0..steps.max(1) {
                    splashes.iter().filter(|(before, _)| *before == step).for_each(|(_, impulse)| expected.splash(impulse));
                    if step < steps {
                        expected.step();
                    }
                }
                let actual = pool.state();
                let error = difference(&actual.current, &expected.current).max(difference(&actual.previous, &expected.previous));
                let amplitude = peak(&expected.current).max(1.0);
                assert!(error <= WAVE_STEPS * amplitude, "{boundary:?}, {size:?}, frame {frame}: {error:.2e} of {amplitude}");
            }
        }
    }
}

/// An impulse somewhere on the field or over its border, of a radius up to the field's own.
fn splash_anywhere(random: &mut Random, size: [u32; 2]) -> Impulse {
    let centre = [0, 1].map(|axis| random.between(-2.0, f64::from(size[axis]) + 2.0) as f32);
    Impulse::new(centre, random.between(2.0, 14.0) as f32, random.between(-1.0, 1.0) as f32)
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn peak(u: &[f64]) -> f64 {
    u.iter().map(|u| u.abs()).fold(0.0, f64::max)
}

#[test]
fn runs_on_the_smallest_fields() {
    for boundary in [Boundary::Periodic, Boundary::Reflecting, Boundary::Fixed] {
        for size in [[1, 1], [1, 9], [9, 1], [2, 2]] {
            let Some(mut pool) = Pool::new(size, scene(boundary, 0.7, 0.02)) else { return };
            let mut expected = pool.reference();
            let impulse = Impulse::new([0.3, 0.4], 3.0, 1.0);
            expected.splash(&impulse);
            (0..20).for_each(|_| expected.step());
            pool.run(20, &[(0, impulse)]);
            let error = difference(&pool.state().current, &expected.current);
            assert!(error <= WAVE_STEPS, "{boundary:?}, {size:?}: {error:.2e}");
        }
    }
}

#[test]
fn standing_waves_obey_the_discrete_dispersion_relation() {
    let size = [96, 80];
    for (courant, waves) in [(0.7, [1.0, 0.0]), (0.7, [3.0, 2.0]), (0.5, [0.0, 7.0]), (0.3, [12.0, 20.0]), (0.7, [48.0, 40.0])] {
        let Some(mut pool) = Pool::new(size, scene(Boundary::Periodic, courant, 0.0)) else { return };
        let k = [0, 1].map(|axis| TAU * waves[axis] / f64::from(size[axis]));
        let squared = f64::from(courant).powi(2) * ((k[0] / 2.0).sin().powi(2) + (k[1] / 2.0).sin().powi(2));
        let omega = 2.0 * squared.sqrt().asin();
        let crest = |x: f64, y: f64| (k[0] * x + k[1] * y).cos();
        pool.put(crest, |x, y| crest(x, y) * omega.cos());
        for done in [100, 500] {
            pool.run(if done == 100 { 100 } else { 400 }, &[]);
            let expected: Vec<_> = texels(size).map(|(x, y)| crest(x, y) * (f64::from(done) * omega).cos()).collect();
            let error = difference(&pool.state().current, &expected);
            println!("courant {courant}, {waves:?} waves, {done} steps: {error:.2e}");
            assert!(error <= WAVE_DISPERSION, "courant {courant}, {waves:?} waves, {done} steps: {error:.2e}");
        }
    }
}

fn texels(size: [u32; 2]) -> impl Iterator<Item = (f64, f64)> {
    (0..size[1]).flat_map(move |y| (0..size[0]).map(move |x| (x.into(), y.into())))
}

#[test]
fn energy_is_conserved_undamped() {
    let size = [128, 96];
    for boundary in [Boundary::Periodic, Boundary::Reflecting, Boundary::Fixed] {
        let mut scene = scene(boundary, 0.7, 0.0);
        scene.obstacles = vec![block(size, [40.0, 40.0], [7.4, 3.4]), block(size, [100.0, 60.0], [2.4, 12.4])];
        let Some(mut pool) = Pool::new(size, scene) else { return };
        let drops = [([20.0, 20.0], 9.0), ([70.5, 50.2], 5.0), ([110.0, 10.0], 14.0)];
        pool.run(1, &drops.map(|(centre, radius)| (0, Impulse::new(centre, radius, -1.0))));
        let before = pool.state().energy();
        pool.run(500, &[]);
        let drift = (pool.state().energy() - before) / before;
        println!("{boundary:?}: energy drifts by {drift:.2e}");
        assert!(drift.abs() <= WAVE_ENERGY, "{boundary:?}: {drift:.2e}");
    }
}

#[test]
fn energy_never_rises_damped() {
    let size = [48, 40];
    for boundary in BOUNDARIES {
        let mut scene = scene(boundary, 0.7, 0.02);
        scene.obstacles = vec![block(size, [20.0, 20.0], [3.4, 5.4])];
        let Some(mut pool) = Pool::new(size, scene) else { return };
        pool.run(1, &[(0, Impulse::new([30.0, 12.0], 8.0, 1.0))]);
        let mut energy = pool.state().energy();
        let first = energy;
        for step in (0..200).step_by(5) {
            pool.run(5, &[]);
            let next = pool.state().energy();
            assert!(next <= energy * (1.0 + WAVE_ENERGY_RISE), "{boundary:?}, step {step}: {energy} to {next}");
            energy = next;
        }
        assert!(energy < 0.5 * first, "{boundary:?}: damping takes energy");
    }
}

#[test]
fn the_mean_level_stays_through_ten_thousand_steps_and_a_thousand_impulses() {
    for (damping, bar) in [(0.002, WAVE_MEAN_DAMPED), (0.0, WAVE_MEAN_UNDAMPED)] {
        let size = [128, 128];
        let Some(mut pool) = Pool::new(size, scene(Boundary::Periodic, 0.7, damping)) else { return };
        let mut random = Random::new(11, Stream::Rain, 0);
        let (mut worst, mut amplitude) = (0.0_f64, 0.0_f64);
        for _ in 0..100 {
            let splashes: Vec<_> = (0..10).map(|impulse| (10 * impulse, splash_anywhere(&mut random, size))).collect();
            pool.run(100, &splashes);
            let state = pool.state();
            (worst, amplitude) = (worst.max(state.mean().abs()), amplitude.max(peak(&state.current)));
        }
        println!("damping {damping}: mean up to {worst:.2e}, amplitude {amplitude:.2}");
        assert!(worst <= bar * amplitude, "damping {damping}: mean {worst:.2e} of amplitude {amplitude}");
    }
}

#[test]
fn impulses_have_no_net_even_where_obstacles_and_borders_cut_them() {
    let size = [40, 32];
    for boundary in BOUNDARIES {
        let mut scene = scene(boundary, 0.7, 0.0);
        scene.obstacles = vec![block(size, [20.0, 16.0], [4.4, 2.4])];
        let Some(mut pool) = Pool::new(size, scene) else { return };
        for (centre, radius) in
            [([10.0, 9.0], 6.0), ([15.3, 15.8], 5.0), ([20.0, 16.0], 7.0), ([0.2, 31.0], 8.0), ([12.0, 5.5], 2.0)]
        {
            pool.set.reset(pool.gpu);
            pool.run(0, &[(0, Impulse::new(centre, radius, 1.0))]);
            let state = pool.state();
            assert!(peak(&state.current) > 0.05, "{boundary:?} at {centre:?}: something happens");
            assert_eq!(state.current, state.previous, "no kick");
            let net = state.current.iter().sum::<f64>().abs();
            let covered = state.current.iter().filter(|u| **u != 0.0).count() as f64;
            assert!(net <= IMPULSE_NET * covered, "{boundary:?} at {centre:?}: net {net:.2e} over {covered} texels");
            for (index, u) in state.current.iter().enumerate() {
                let (x, y) = (index % size[0] as usize, index / size[0] as usize);
                assert!(*u == 0.0 || state.is_free(x as i64, y as i64), "{boundary:?}: an impulse at ({x}, {y})");
            }
        }
    }
}

/// A plane Gaussian ridge that has just moved east by the Courant number.
fn put_ridge_moving_east(pool: &Pool, middle: f64, sigma: f64, wavelength: f64) {
    let k = TAU / wavelength;
    let courant = f64::from(pool.scene.courant);
    let omega = 2.0 * (courant * (k / 2.0).sin()).asin();
    let group = if k == 0.0 { courant } else { courant * (k / 2.0).cos() / (omega / 2.0).cos() };
    let ridge = |x: f64, ago: f64| {
        let away = x - middle;
        (-0.5 * ((away + group * ago) / sigma).powi(2)).exp() * (k * away + omega * ago).cos()
    };
    pool.put(|x, _| ridge(x, 0.0), |x, _| ridge(x, 1.0));
}

/// u along the middle row, as far from the other two borders as can be.
fn middle_row(state: &reference::wave::Wave) -> &[f64] {
    let [width, height] = state.size;
    &state.current[height / 2 * width..][..width]
}

#[test]
fn a_front_travels_three_hundred_cells_on_time() {
    let Some(mut pool) = Pool::new([512, 8], scene(Boundary::Periodic, 0.6, 0.0)) else { return };
    for sigma in [6.0, 10.0, 20.0] {
        put_ridge_moving_east(&pool, 100.0, sigma, f64::INFINITY);
        pool.run(500, &[]);
        let state = pool.state();
        let row = middle_row(&state);
        // The leading flank: the last place where u falls through one half.
        let before = (0..511).rev().find(|x| row[*x] >= 0.5 && row[x + 1] < 0.5).expect("the ridge is still there");
        let front = before as f64 + (row[before] - 0.5) / (row[before] - row[before + 1]);
        let late = 400.0 + sigma * (2.0 * 2.0_f64.ln()).sqrt() - front;
        println!("sigma {sigma}: {late:.2} cells late");
        assert!(late.abs() <= WAVE_FRONT_CELLS, "sigma {sigma}: {late} cells late");
    }
}

#[test]
fn walls_keep_the_sign_of_a_reflection_and_held_borders_invert_it() {
    for (boundary, sign) in [(Boundary::Reflecting, 1.0), (Boundary::Fixed, -1.0)] {
        // So high that nothing from the other two borders arrives at the middle row in time.
        let Some(mut pool) = Pool::new([200, 520], scene(boundary, 0.6, 0.0)) else { return };
        put_ridge_moving_east(&pool, 100.0, 10.0, f64::INFINITY);
        pool.run(330, &[]);
        let state = pool.state();
        let row = middle_row(&state);
        let reflected = row.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).expect("the row has texels");
        assert!((reflected - sign).abs() < 0.05, "{boundary:?}: {reflected}");
    }
}

#[test]
fn an_obstacle_reflects_like_a_wall() {
    let size = [200, 16];
    let mut scene = scene(Boundary::Periodic, 0.6, 0.0);
    scene.obstacles = vec![block(size, [160.5, 8.0], [8.0, 8.0])];
    let Some(mut pool) = Pool::new(size, scene) else { return };
    put_ridge_moving_east(&pool, 80.0, 10.0, f64::INFINITY);
    pool.run(200, &[]);
    let state = pool.state();
    assert!((peak(middle_row(&state)) - 1.0).abs() < 0.05);
    assert!(middle_row(&state)[153..168].iter().all(|u| *u == 0.0), "an obstacle stays at rest");
    let crest = (0..200).max_by(|a, b| middle_row(&state)[*a].total_cmp(&middle_row(&state)[*b])).expect("the row has texels");
    // 72 cells to the wall's face at 152, 48 back.
    assert!(crest.abs_diff(104) <= 2, "its crest is at {crest}");
}

#[test]
fn a_sponge_of_48_cells_swallows_waves_of_6_to_64() {
    for wavelength in [6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0] {
        let mut scene = scene(Boundary::Absorbing, 0.6, 0.0);
        scene.sponge_texels = 48;
        let Some(mut pool) = Pool::new([384, 1100], scene) else { return };
        put_ridge_moving_east(&pool, 192.0, 24.0, wavelength);
        let energy = |pool: &Pool| {
            let state = pool.state();
            let start = state.size[1] / 2 * state.size[0];
            let slope = |u: &[f64], x: usize| u[start + x + 1] - u[start + x];
            (0..state.size[0] - 1)
                .map(|x| {
                    let moved = state.current[start + x] - state.previous[start + x];
                    0.5 * moved * moved + 0.5 * state.courant_squared * slope(&state.current, x) * slope(&state.previous, x)
                })
                .sum::<f64>()
        };
        let before = energy(&pool);
        // To the border and back to where it started, at the packet's own speed.
        let k = TAU / wavelength;
        let omega = 2.0 * (0.6 * (k / 2.0).sin()).asin();
        let group = 0.6 * (k / 2.0).cos() / (omega / 2.0).cos();
        pool.run((384.0 / group) as u32, &[]);
        let back = energy(&pool) / before;
        println!("wavelength {wavelength}: {:.4} % of the energy comes back", 100.0 * back);
        assert!(back <= SPONGE_ENERGY, "wavelength {wavelength}: {back}");
    }
}

#[test]
fn how_steps_are_cut_into_frames_changes_no_bit() {
    let size = [40, 30];
    let splash = |random: &mut Random| splash_anywhere(random, size);
    let mut random = Random::new(3, Stream::Rain, 0);
    let splashes: Vec<_> = [0_u32, 2, 2, 5, 7, 11].map(|step| (step, splash(&mut random))).to_vec();
    let run_in = |frames: &[u32]| {
        let mut pool = Pool::new(size, scene(Boundary::Reflecting, 0.7, 0.01))?;
        let mut first = 0;
        for &steps in frames {
            let of_frame: Vec<_> = splashes
                .iter()
                .filter(|(step, _)| (first..first + steps).contains(step))
                .map(|(step, impulse)| (step - first, *impulse))
                .collect();
            pool.run(steps, &of_frame);
            first += steps;
        }
        Some(pool.state())
    };
    let Some(whole) = run_in(&[12]) else { return };
    assert_eq!(Some(whole), run_in(&[1, 4, 0, 1, 3, 3]));
}

#[test]
fn nothing_owed_and_nothing_done_changes_nothing() {
    let Some(mut pool) = Pool::new([16, 16], scene(Boundary::Periodic, 0.7, 0.0)) else { return };
    assert!(!pool.run(0, &[]));
    // Neither do impulses that are no numbers, or that lie off the field.
    let nothing = [
        Impulse::new([f32::NAN, 3.0], 4.0, 1.0),
        Impulse::new([3.0, f32::INFINITY], 4.0, 1.0),
        Impulse::new([3.0, 3.0], f32::NAN, 1.0),
        Impulse::new([3.0, 3.0], 4.0, f32::NAN),
        Impulse::new([3.0, 3.0], 4.0, f32::INFINITY),
    ];
    assert!(!pool.run(0, &nothing.map(|impulse| (0, impulse))));
    let Some(mut pool) = Pool::new([16, 16], scene(Boundary::Fixed, 0.7, 0.0)) else { return };
    assert!(!pool.run(0, &[(0, Impulse::new([-30.0, 3.0], 4.0, 1.0))]));
}

#[test]
fn too_many_impulses_are_an_error_that_says_so() {
    let Some(mut pool) = Pool::new([2, 2], scene(Boundary::Periodic, 0.7, 0.0)) else { return };
    // On a field of 2×2 each of these covers 256² images of it.
    let splashes = vec![(0, Impulse::new([0.0, 0.0], 256.0, 1.0)); 200];
    let error = run(pool.gpu, |recorder| pool.waves.record(recorder, &mut pool.set, 1, &splashes));
    assert!(matches!(error, Err(BinError::TooMany { discs: 200, .. })), "{error:?}");
}

#[test]
fn the_highest_courant_number_keeps_a_checkerboard_bounded() {
    let Some(mut pool) = Pool::new([64, 64], scene(Boundary::Periodic, 0.7, 0.0)) else { return };
    let board = |x: f64, y: f64| if (x + y) % 2.0 == 0.0 { 1.0 } else { -1.0 };
    pool.put(board, board);
    let mut worst = 0.0_f64;
    for _ in 0..20 {
        pool.run(100, &[]);
        worst = worst.max(peak(&pool.state().current));
    }
    // 1/cos(ω/2) of the mode, which starts between two steps: ω/2 = asin √0.98.
    assert!(worst <= 1.0 / 0.02_f64.sqrt() * 1.01, "{worst}");
}

#[test]
fn settings_that_cannot_be_simulated_are_refused_with_their_numbers() {
    let good = scene(Boundary::Absorbing, 0.7, 0.01);
    assert_eq!(check(&good, [64, 64], 1.0), Ok(()));
    assert_eq!(step_seconds(&good, 0.5), f64::from(0.7_f32) * 0.5);
    let refused = |change: &dyn Fn(&mut Wave)| {
        let mut bad = good.clone();
        change(&mut bad);
        check(&bad, [64, 64], 1.0).expect_err("it is out of range")
    };
    let unstable = refused(&|wave| wave.courant = 0.71);
    assert_eq!(
        unstable.to_string(),
        "the wave's courant number 0.71 is unstable: its square, 0.5041, must be at most 0.49; set courant to 0.7 or less"
    );
    for value in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(matches!(refused(&|wave| wave.speed_metres_per_second = value), WaveError::NotPositive { .. }));
        assert!(matches!(refused(&|wave| wave.courant = value), WaveError::NotPositive { .. }));
    }
    for rate in [-1.0, 100.0, f32::NAN] {
        assert!(matches!(refused(&|wave| wave.damping_per_second = rate), WaveError::Damping { .. }));
    }
    for texels in [0, 33] {
        assert!(matches!(refused(&|wave| wave.sponge_texels = texels), WaveError::Sponge { limit: 32, .. }));
    }
}

#[test]
fn rounded_obstacles_stand_where_they_should() {
    let size = [100, 50];
    let mut scene = scene(Boundary::Reflecting, 0.7, 0.0);
    scene.obstacles = vec![Obstacle { centre: [0.5, 0.5], half_extent_metres: [10.0, 10.0], corner_metres: 10.0, top: 1.0 }];
    let free = |scene: &Wave| {
        let mask = Mask::of_scene(scene, size, [100.0, 50.0]);
        move |x, y| mask.is_free(x, y)
    };
    // As round as it can be: a disc of radius 10.
    let round = free(&scene);
    let area = texels(size).filter(|(x, y)| !round(*x as i64, *y as i64)).count() as f64;
    assert!((area - 314.0).abs() < 8.0, "{area}");
    scene.obstacles[0].corner_metres = 0.0;
    let square = free(&scene);
    assert_eq!(texels(size).filter(|(x, y)| !square(*x as i64, *y as i64)).count(), 400);
    // Over the border of periodic water it stands on both sides.
    scene.obstacles[0].centre = [0.0, 0.5];
    scene.boundary = Boundary::Periodic;
    let wrapped = free(&scene);
    assert!(!wrapped(99, 25) && !wrapped(0, 25) && wrapped(50, 25));
    scene.boundary = Boundary::Reflecting;
    let cut = free(&scene);
    assert!(cut(99, 25) && !cut(0, 25));
}
