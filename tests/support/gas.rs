//! A gas on the GPU, and what a test asks of it.

use rilievo::field::gas::{Buffers, Gas, GasSet, Physics};
use rilievo::field::gas_activity::HEADER;
use rilievo::gpu::{Gpu, Readback};
use rilievo::reference::gas::{Grid, State};
use rilievo::reference::gas_emit::Emission;
use rilievo::reference::gas_force::{Forces, Row};
use rilievo::stroke::{Random, Stream};

use super::gpu::{gpu, run, wait_for};

/// A gas, its kernels, and the textures that it shows itself in.
pub struct Tank {
    pub gpu: &'static Gpu,
    pub gas: Gas,
    pub set: GasSet,
    pub physics: Physics,
    pub heights: wgpu::Texture,
    pub cover: wgpu::Texture,
}

/// Cells of one metre, steps of one second, no forces, and no tile is ever still.
pub fn calm(rows: usize) -> Physics {
    let forces = Forces {
        viscosity: 0.0,
        confinement: 0.0,
        buoyancy: 0.0,
        speed_limit: 8.0,
        confinement_floor: 1e-3,
        rows: vec![Row::default(); rows],
    };
    Physics { cell_metres: 1.0, step_seconds: 1.0, forces, stillness: -1.0 }
}

impl Tank {
    pub fn new(size: [usize; 2], periodic: [bool; 2], physics: Physics, coarsening: u32) -> Option<Self> {
        let gpu = gpu()?;
        let grid = Grid { size, periodic };
        let texture = |format| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("tank"),
                size: wgpu::Extent3d {
                    width: size[0] as u32 * coarsening,
                    height: size[1] as u32 * coarsening,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            })
        };
        let (heights, cover) = (texture(wgpu::TextureFormat::R32Float), texture(wgpu::TextureFormat::Rgba16Float));
        let gas = Gas::new(gpu, coarsening).expect("the shaders compile");
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut set = gas.bind(gpu, Buffers::new(gpu, &grid), coarsening, &view(&heights), &view(&cover));
        set.set_physics(gpu, &physics);
        Some(Self { gpu, gas, set, physics, heights, cover })
    }

    pub fn put(&mut self, state: &State) {
        self.set.reset(self.gpu, state);
    }

    pub fn run(&mut self, steps: u32, emissions: &[(u32, Emission)]) -> bool {
        let changed = run(self.gpu, |recorder| self.gas.record(recorder, &mut self.set, steps, emissions))
            .expect("few puffs fit every buffer");
        // What a frame later would hear.
        (0..2).for_each(|_| {
            self.set.listen();
            run(self.gpu, |_| ());
        });
        self.set.listen();
        changed
    }

    /// Runs some of its kernels in a compute pass, after a step's beginning has found every tile active.
    pub fn kernels(&self, record: impl FnOnce(&mut wgpu::ComputePass<'_>)) {
        let activity = self.gas.activity.bind(self.gpu, &self.set.buffers);
        let carried = self.gas.activity.bind_carried(self.gpu, &self.set.buffers, self.set.role());
        run(self.gpu, |recorder| {
            recorder.compute("kernels", |pass| {
                self.gas.activity.record(pass, &activity, &carried, &self.set.buffers.dispatches);
                record(pass);
            });
        });
    }

    fn bytes(&self, buffer: &wgpu::Buffer) -> Vec<u8> {
        let mut encoder = self.gpu.encoder("tank");
        let readback = Readback::record_buffer(self.gpu, &mut encoder, buffer, buffer.size());
        self.gpu.queue.submit([encoder.finish()]);
        readback.start();
        wait_for(self.gpu, &readback)
    }

    /// The pairs of one of the velocity buffers.
    pub fn velocity(&self, index: usize) -> Vec<[f64; 2]> {
        let all: Vec<[f32; 2]> = bytemuck::pod_collect_to_vec(&self.bytes(&self.set.buffers.velocity[index]));
        all.into_iter().map(|pair| pair.map(f64::from)).collect()
    }

    /// The leading velocity and the scalars of one of the buffers of what is carried.
    pub fn carried(&self, index: usize) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
        let all: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&self.bytes(&self.set.buffers.carried[index]));
        all.into_iter().map(|four| four.map(f64::from)).map(|[u, v, density, dye]| ([u, v], [density, dye])).unzip()
    }

    /// The pressure of the finest level, and the divergence that is left to the next.
    pub fn pressure(&self) -> [Vec<f32>; 2] {
        let buffers = &self.set.buffers;
        [&buffers.p[0], &buffers.b[0]].map(|buffer| bytemuck::pod_collect_to_vec(&self.bytes(buffer)))
    }

    pub fn state(&self) -> State {
        let start = self.set.role().start();
        let (leading, scalars) = self.carried(start);
        State { velocity: self.velocity(start), leading, scalars }
    }

    /// The words of the activity after its header: motion, touched and state of each tile.
    pub fn activity(&self) -> [Vec<u32>; 3] {
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(&self.bytes(&self.set.buffers.activity));
        let tiles = (words.len() - HEADER as usize) / 3;
        [0, 1, 2].map(|part| words[HEADER as usize + part * tiles..][..tiles].to_vec())
    }

    pub fn texels<T: bytemuck::Pod>(&self, texture: &wgpu::Texture) -> Vec<T> {
        let mut encoder = self.gpu.encoder("tank");
        let readback = Readback::record_texture(self.gpu, &mut encoder, texture, 0);
        self.gpu.queue.submit([encoder.finish()]);
        readback.start();
        bytemuck::pod_collect_to_vec(&wait_for(self.gpu, &readback))
    }
}

/// A state as f32 holds it.
pub fn narrowed(state: &State) -> State {
    let narrow = |of: &[[f64; 2]]| of.iter().map(|pair| pair.map(|value| f64::from(value as f32))).collect();
    State { velocity: narrow(&state.velocity), leading: narrow(&state.leading), scalars: narrow(&state.scalars) }
}

/// A smooth flow with some noise, of speeds up to 1.5 and without regard to divergence, and scalars from 0 to 1.
pub fn stirred(grid: &Grid, seed: u64) -> State {
    let mut random = Random::new(seed, Stream::Stress, 0);
    let size = grid.size.map(|side| side as f64);
    let state = |random: &mut Random| {
        grid.cells()
            .map(|(x, y)| {
                let (x, y) = (std::f64::consts::TAU * x as f64 / size[0], std::f64::consts::TAU * y as f64 / size[1]);
                [
                    (x + 2.0 * y).sin() + 0.3 * y.cos() + random.between(-0.2, 0.2),
                    (2.0 * x - y).cos() + 0.3 * x.sin() + random.between(-0.2, 0.2),
                ]
            })
            .collect::<Vec<_>>()
    };
    let walled = |pairs: Vec<[f64; 2]>| {
        let cells = grid.cells().zip(pairs);
        cells.map(|((x, y), [u, v])| [if grid.open(0, x) { u } else { 0.0 }, if grid.open(1, y) { v } else { 0.0 }]).collect()
    };
    let velocity = walled(state(&mut random));
    let leading = walled(state(&mut random));
    let scalars = grid.cells().map(|_| [random.unit(), random.unit()]).collect();
    narrowed(&State { velocity, leading, scalars })
}

/// Borders, and sizes that are odd, thin, single, or just beyond a tile.
pub const SHAPES: [([usize; 2], [bool; 2]); 9] = [
    ([33, 21], [true, true]),
    ([33, 21], [false, false]),
    ([48, 17], [true, false]),
    ([17, 48], [false, true]),
    ([1, 1], [true, true]),
    ([1, 1], [false, false]),
    ([1, 37], [true, false]),
    ([40, 1], [false, true]),
    ([5, 3], [true, true]),
];

/// The largest difference of pairs.
pub fn apart(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .flat_map(|(a, b)| [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()])
        .fold(0.0, |most, by| if by > most || by.is_nan() { by } else { most })
}
