//! The gas of a scene, as a layer of its stack.

use super::bins::BinError;
use super::gas::{Buffers, Gas, GasSet, Physics};
use super::gas_bands::{Bands, turn};
use super::source::{Health, Heights, Source, SourceInput, State};
use super::{Dirty, Field, LAYER, bytes_per_texel, roles};
use crate::clock::Simulation;
use crate::gpu::{Contract, Gpu, Recorder, Role as _, ShaderError, Texture};
use crate::reference::gas::{self as reference, Grid};
use crate::reference::gas_force::{Forces, Row};
use crate::scene::{self, GasBorder, Layer, LayerBlend, Scene};

roles! {
    /// What is shown of the gas as heights.
    GasDensity = "gas", R32Float, mips false, LAYER, "density", from "gas", to "compose";
    /// Its velocities. In buffers.
    GasVelocity = "gas velocity", Rg32Float, mips false, LAYER, "m/s at the western and northern face of a cell", from "gas", to "gas";
    /// What it carries. In buffers.
    GasCarried = "gas carried", Rgba32Float, mips false, LAYER, "leading velocity, density, dye", from "gas", to "gas";
    /// Its pressure. In a buffer.
    GasPressure = "gas pressure", R32Float, mips false, LAYER, "p of the projection", from "gas", to "gas";
    /// What coarser levels of the projection hold. In buffers.
    GasCoarser = "gas coarser", R32Float, mips false, LAYER, "p, b, q of coarser levels: a third of 12", from "gas", to "gas";
}

/// What it adds to a field where a cell is a texel, each as often as there are of it.
pub const CONTRACT: &[(Contract, u32)] = &[
    (GasDensity::CONTRACT, 1),
    (GasVelocity::CONTRACT, 3),
    (GasCarried::CONTRACT, 3),
    (GasPressure::CONTRACT, 1),
    (GasCoarser::CONTRACT, 1),
];

/// Cells that the flow may cross in a step: half a tile, so that it never outruns the tiles that it wakes.
const CELLS_A_STEP: f64 = 8.0;

/// Speed up to which a tile is still, cells a step: a texel in five minutes.
const STILLNESS: f64 = 1e-4;

/// Slope of |vorticity| from cell to cell below which confinement fades, in cells a step: what is weaker is the noise of the grid,
/// which confinement would feed until it covers everything.
const CONFINEMENT_FLOOR: f64 = 0.005;

/// The cells of a scene's gas.
pub fn grid(gas: &scene::Gas, field: [u32; 2]) -> Grid {
    let periodic = [gas.border_u, gas.border_v].map(|border| border == GasBorder::Periodic);
    Grid { size: gas.cells(field).map(|side| side as usize), periodic }
}

/// The physics of a scene's gas on a field of this size.
pub fn physics(gas: &scene::Gas, scene: &Scene) -> Physics {
    let grid = grid(gas, scene.field.size);
    let cell_metres = gas.cell_metres(scene.texel_metres());
    let step_seconds = f64::from(gas.step_seconds);
    let height_metres = grid.size[1] as f64 * cell_metres;
    let rows = match &gas.bands {
        Some(bands) => Bands::new(bands, scene.seed).rows(gas, grid.size[1], height_metres),
        None => (0..grid.size[1])
            .map(|row| Row { turn: turn(gas, (row as f64 + 0.5) / grid.size[1] as f64, height_metres), ..Row::default() })
            .collect(),
    };
    Physics {
        cell_metres,
        step_seconds,
        forces: Forces {
            viscosity: f64::from(gas.viscosity) * step_seconds / (cell_metres * cell_metres),
            confinement: f64::from(gas.confinement_per_second) * step_seconds,
            buoyancy: f64::from(gas.buoyancy) * step_seconds,
            speed_limit: CELLS_A_STEP * cell_metres / step_seconds,
            confinement_floor: CONFINEMENT_FLOOR * cell_metres / step_seconds,
            rows,
        },
        stillness: STILLNESS,
    }
}

/// What a scene's gas starts from.
pub fn start(gas: &scene::Gas, scene: &Scene) -> reference::State {
    let grid = grid(gas, scene.field.size);
    let still = vec![[0.0; 2]; grid.count()];
    match &gas.bands {
        Some(bands) => Bands::new(bands, scene.seed).start(&grid, gas.cell_metres(scene.texel_metres())),
        None => reference::State { velocity: still.clone(), leading: still.clone(), scalars: still },
    }
}

/// The gas of a scene, as a layer of its stack.
pub struct GasSource {
    gas: Gas,
    set: GasSet,
    density: Texture<GasDensity>,
    /// The field's, which this source writes.
    cover: wgpu::Texture,
    coarsening: u32,
    cell_metres: f64,
    steps: u32,
}

impl GasSource {
    /// A gas over a field, at its start.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu, field: &Field, scene: &Scene, gas: &scene::Gas) -> Result<Self, ShaderError> {
        let kernels = Gas::new(gpu, gas.coarsening)?;
        let density = Texture::new(gpu, field.size);
        let buffers = Buffers::new(gpu, &grid(gas, field.size));
        let set = kernels.bind(gpu, buffers, gas.coarsening, &density.view, &field.cover.view);
        let (cover, coarsening) = (field.cover.texture.clone(), gas.coarsening);
        let cell_metres = gas.cell_metres(scene.texel_metres());
        let mut source = Self { gas: kernels, set, density, cover, coarsening, cell_metres, steps: 0 };
        source.set.set_physics(gpu, &physics(gas, scene));
        source.reset(gpu, scene);
        Ok(source)
    }
}

impl Source for GasSource {
    fn name(&self) -> &'static str {
        "gas"
    }

    fn layer(&self, scene: &Scene) -> Layer {
        scene
            .gas
            .as_ref()
            .map_or(Layer { blend: LayerBlend::Add, amplitude: 0.0 }, |gas| Layer { blend: gas.blend, amplitude: gas.amplitude })
    }

    fn reset(&mut self, gpu: &Gpu, scene: &Scene) {
        if let Some(gas) = &scene.gas {
            self.set.reset(gpu, &start(gas, scene));
        }
    }

    fn set_scene(&mut self, gpu: &Gpu, scene: &Scene) {
        if let Some(gas) = &scene.gas {
            self.set.set_physics(gpu, &physics(gas, scene));
        }
    }

    fn reload(&mut self, gpu: &Gpu) -> Result<(), ShaderError> {
        self.gas = Gas::new(gpu, self.coarsening)?;
        Ok(())
    }

    fn advance(&mut self, recorder: &mut Recorder<'_>, input: &SourceInput<'_>) -> Result<Dirty, BinError> {
        self.steps = input.tick.owed(Simulation::Gas).steps;
        let grid = self.set.buffers.grid;
        let emissions: Vec<_> = input
            .strokes
            .puffs
            .iter()
            .filter_map(|(step, puff)| Some((*step, puff.emission(&grid, self.coarsening, self.cell_metres)?)))
            .collect();
        let shown = self.gas.record(recorder, &mut self.set, self.steps, &emissions)?;
        Ok(if shown { Dirty::All } else { Dirty::Nothing })
    }

    fn contract(&self) -> &'static [(Contract, u32)] {
        CONTRACT
    }

    fn bytes_per_texel(&self) -> f64 {
        let shown = GasDensity::CONTRACT.bytes_per_texel();
        shown + (bytes_per_texel(CONTRACT) - shown) / f64::from(self.coarsening * self.coarsening)
    }

    fn heights(&self) -> Heights<'_> {
        Heights { views: [&self.density.view; 2], current: 0 }
    }

    fn state(&self) -> State<'_> {
        let (buffers, role) = (&self.set.buffers, self.set.role());
        State {
            // What is shown too: a tile that came to rest shows what it was last.
            textures: vec![&self.density.texture, &self.cover],
            buffers: vec![&buffers.velocity[role.start()], &buffers.carried[role.start()], &buffers.activity],
            numbers: vec![self.set.steps()],
        }
    }

    fn restore(&mut self, numbers: &[u64]) {
        self.set.resume(numbers.first().copied().unwrap_or_default());
    }

    fn health(&mut self, _gpu: &Gpu) -> Health {
        self.set.listen();
        let halted = self.set.stopped().map(|step| {
            format!("the gas met a number that is none in step {step} and stopped: reset it (R), with milder settings")
        });
        Health { halted, ..Health::default() }
    }

    fn traffic_bytes(&self) -> u64 {
        self.set.traffic_bytes(self.steps)
    }

    fn memory_bytes(&self) -> u64 {
        self.density.memory_bytes() + self.set.memory_bytes()
    }
}
