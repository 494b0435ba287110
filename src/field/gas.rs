//! Gas: an incompressible fluid in two dimensions, on a staggered grid of cells that cover the field.
//!
//! A step emits (`gas_emit`), finds the tiles with work in them (`gas_activity`), carries
//! everything along the flow (`gas_advect`), lets forces act (`gas_force`), takes the
//! divergence (`gas_project`) and shows what has come of it (`gas_show`).
//!
//! # What a step moves, bytes a cell by design
//!
//! | part | read | written |
//! |---|---|---|
//! | emit, in touched tiles | 24 | 24 |
//! | advect: ahead | 24 | 16 |
//! | advect: correct and limit | 40 | 16 |
//! | force | 16 | 24 |
//! | project: three V-cycles | 93 | 65 |
//! | show, where a cell is a texel | 24 | 12 |
//!
//! Together 378 if puffs touch every tile, 330 if none: [`CELL_BYTES`]. Halos are not counted.
//!
//! # What it holds, bytes a cell
//!
//! Three velocities (8 each) and three sets of what is carried (16 each), which change roles from step to step; p (4), and a third of
//! 12 for the coarser levels: 80. The field's texels hold height (4) and cover (8) beside that.
//!
//! # Where it stops
//!
//! A number that is none, found after the forces, ends the step before anything of its start is overwritten. The state then stays the
//! last good one; [`GasSet::stopped`] says so when the word has come back from the GPU, for which nobody waits.

use bytemuck::{Pod, Zeroable};

use super::bins::BinError;
use super::gas_activity::{self, GasActivity, GasActivitySet};
use super::gas_advect::{self, GasAdvect, GasAdvectSet};
use super::gas_emit::{self, GasEmit, GasEmitSet};
use super::gas_force::{self, GasForce, GasRow};
use super::gas_project::{self, GasLevel, GasProject, GasProjectFinest, GasProjectSet};
use super::gas_show::{self, GasShow, GasShowSet};
use crate::gpu::{Gpu, List, Readback, Recorder, ShaderError, Uniform};
use crate::reference::gas::{Grid, State};
use crate::reference::gas_emit::Emission;
use crate::reference::gas_force::Forces;
use crate::reference::gas_project::{COARSEST_CELLS, Level};

/// Side of a tile, cells: one workgroup, and the unit of activity.
pub const TILE: u32 = 16;

/// Bytes a cell of a step without emission by design, where a cell is a texel.
pub const CELL_BYTES: u64 =
    gas_advect::CELL_BYTES + gas_force::CELL_BYTES + gas_project::CELL_BYTES + gas_show::CELL_BYTES + gas_show::TEXEL_BYTES;

/// The same where a cell covers so many texels along each axis.
pub const fn step_bytes(coarsening: u32) -> u64 {
    CELL_BYTES - gas_show::TEXEL_BYTES + gas_show::TEXEL_BYTES * (coarsening * coarsening) as u64
}

/// What every kernel of the gas is told of its tiles.
pub(super) fn tile_constants() -> [(&'static str, f64); 1] {
    [("GAS_TILE", f64::from(TILE))]
}

/// Which of the three states is current.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Role(usize);

impl Role {
    /// Each of them.
    pub const ALL: [Self; 3] = [Self(0), Self(1), Self(2)];

    /// The role after so many steps more.
    #[must_use]
    pub const fn after(self, steps: u64) -> Self {
        Self((self.0 + 2 * (steps % 3) as usize) % 3)
    }

    /// The role so many steps ago.
    #[must_use]
    pub const fn before(self, steps: u64) -> Self {
        Self((self.0 + (steps % 3) as usize) % 3)
    }

    /// Where the state stands.
    pub const fn start(self) -> usize {
        self.0
    }

    /// Where the velocity to be projected and the limited state stand for a while.
    pub const fn between(self) -> usize {
        (self.0 + 1) % 3
    }

    /// Where the next state will stand; until then, what is ahead.
    pub const fn last(self) -> usize {
        (self.0 + 2) % 3
    }
}

/// Uniforms that the kernels share.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct GasParams {
    /// Cells along each axis.
    pub size: [i32; 2],
    /// Tiles along each axis.
    pub tiles: [i32; 2],
    /// 1 where an axis repeats, 0 where it is closed.
    pub periodic: [i32; 2],
    /// Cells of the projection's second level.
    pub coarse: [i32; 2],
    /// Cells that 1 m/s crosses in a step.
    pub courant: f32,
    /// [`Forces::viscosity`].
    pub viscosity: f32,
    /// [`Forces::confinement`].
    pub confinement: f32,
    /// [`Forces::buoyancy`].
    pub buoyancy: f32,
    /// [`Forces::speed_limit`].
    pub speed_limit: f32,
    /// [`Forces::confinement_floor`].
    pub confinement_floor: f32,
    /// Speed up to which a tile is still, cells a step; below 0 none is.
    pub stillness: f32,
    /// One over the side of a cell, 1/m.
    pub turning_per_speed: f32,
}

/// The physics of a step: what the kernels are told.
#[derive(Clone, Debug, PartialEq)]
pub struct Physics {
    /// Side of a cell, metres.
    pub cell_metres: f64,
    /// Duration of a step, seconds.
    pub step_seconds: f64,
    /// What acts in a step.
    pub forces: Forces,
    /// Speed up to which a tile is still, cells a step; below 0 none is.
    pub stillness: f64,
}

impl Physics {
    /// Cells that 1 m/s crosses in a step.
    pub fn courant(&self) -> f64 {
        self.step_seconds / self.cell_metres
    }

    fn params(&self, grid: &Grid) -> GasParams {
        let size = grid.size.map(|side| side as i32);
        let second = Level::finest(grid).coarser();
        GasParams {
            size,
            tiles: size.map(|side| (side as u32).div_ceil(TILE) as i32),
            periodic: grid.periodic.map(i32::from),
            coarse: second.size.map(|side| side as i32),
            courant: self.courant() as f32,
            viscosity: self.forces.viscosity as f32,
            confinement: self.forces.confinement as f32,
            buoyancy: self.forces.buoyancy as f32,
            speed_limit: self.forces.speed_limit as f32,
            confinement_floor: self.forces.confinement_floor as f32,
            stillness: self.stillness as f32,
            turning_per_speed: (1.0 / self.cell_metres) as f32,
        }
    }
}

/// Everything that a gas holds on the GPU, but for what it shows.
pub struct Buffers {
    /// The cells.
    pub grid: Grid,
    /// Tiles along each axis.
    pub tiles: [u32; 2],
    /// [`GasParams`].
    pub params: Uniform<GasParams>,
    /// What each row tends to.
    pub rows: List<GasRow>,
    /// Velocities, m/s: a pair a cell.
    pub velocity: [wgpu::Buffer; 3],
    /// Leading velocity, density and dye: four numbers a cell.
    pub carried: [wgpu::Buffer; 3],
    /// See `shaders/field/gas_activity.wgsl`.
    pub activity: wgpu::Buffer,
    /// The active tiles.
    pub active: wgpu::Buffer,
    /// Those that settle.
    pub settling: wgpu::Buffer,
    /// All of them.
    pub everything: wgpu::Buffer,
    /// What is dispatched indirectly.
    pub dispatches: wgpu::Buffer,
    /// Workgroups of each coarser level.
    pub level_workgroups: wgpu::Buffer,
    /// Uniforms of each level.
    pub levels: Vec<Uniform<GasLevel>>,
    /// p of each level but the coarsest.
    pub p: Vec<wgpu::Buffer>,
    /// b of each level but the finest.
    pub b: Vec<wgpu::Buffer>,
    /// q of each level but the finest.
    pub q: Vec<wgpu::Buffer>,
    /// The coarsest level's inverse.
    pub inverse: wgpu::Buffer,
}

impl Buffers {
    /// Makes them for a grid.
    pub fn new(gpu: &Gpu, grid: &Grid) -> Self {
        let usages = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        let buffer = |label, size, more| {
            let usage = usages | more;
            gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let plain = |label, size: u64| buffer(label, size, wgpu::BufferUsages::empty());
        let cells = grid.count() as u64;
        let tiles = gas_activity::tiles(grid.size.map(|side| side as u32));
        let tile_count = tiles[0] * tiles[1];
        let list = || plain("gas tiles", 4 * u64::from(tile_count + 1));
        let levels = Level::all(grid);
        let coarser: Vec<u64> = levels[1..].iter().map(|level| (level.size[0] * level.size[1]) as u64).collect();
        let each = |label, of: &[u64]| of.iter().map(|cells| plain(label, 4 * cells)).collect::<Vec<_>>();
        let p: Vec<u64> = std::iter::once(cells).chain(coarser[..coarser.len() - 1].iter().copied()).collect();
        let coarsest = levels[levels.len() - 1];
        let inverse: Vec<f32> = coarsest.pseudo_inverse().into_iter().map(|value| value as f32).collect();
        debug_assert!(inverse.len() <= COARSEST_CELLS * COARSEST_CELLS, "the coarsest level has few cells");
        let workgroups = levels[1..].iter().map(|level| level.size.map(|side| (side as u32).div_ceil(TILE)));
        let workgroups: Vec<[u32; 2]> =
            workgroups.enumerate().map(|(index, of)| if index + 2 == levels.len() { [1, 1] } else { of }).collect();
        let everything: Vec<u32> =
            std::iter::once(tile_count).chain((0..tiles[1]).flat_map(|y| (0..tiles[0]).map(move |x| x | (y << 16)))).collect();
        let buffers = Self {
            grid: *grid,
            tiles,
            params: Uniform::new(gpu, "gas"),
            rows: List::new(gpu, "gas rows", grid.size[1]),
            velocity: [(); 3].map(|()| plain("gas velocity", 8 * cells)),
            carried: [(); 3].map(|()| plain("gas carried", 16 * cells)),
            activity: plain("gas activity", 4 * u64::from(gas_activity::HEADER + 3 * tile_count)),
            active: list(),
            settling: list(),
            everything: list(),
            dispatches: buffer("gas dispatches", gas_activity::level(coarser.len()), wgpu::BufferUsages::INDIRECT),
            level_workgroups: plain("gas level workgroups", 8 * workgroups.len() as u64),
            levels: levels.iter().map(|_| Uniform::new(gpu, "gas level")).collect(),
            p: each("gas p", &p),
            b: each("gas b", &coarser),
            q: each("gas q", &coarser),
            inverse: plain("gas inverse", 4 * inverse.len() as u64),
        };
        gpu.queue.write_buffer(&buffers.everything, 0, bytemuck::cast_slice(&everything));
        gpu.queue.write_buffer(&buffers.level_workgroups, 0, bytemuck::cast_slice(&workgroups));
        gpu.queue.write_buffer(&buffers.inverse, 0, bytemuck::cast_slice(&inverse));
        buffers
    }

    /// Sets what the kernels are told of a step.
    pub fn set_physics(&self, gpu: &Gpu, physics: &Physics) {
        self.params.write(gpu, &physics.params(&self.grid));
        for (uniform, level) in self.levels.iter().zip(GasLevel::all(&self.grid, physics.courant() as f32)) {
            uniform.write(gpu, &level);
        }
        let rows: Vec<GasRow> = physics.forces.rows.iter().map(GasRow::from).collect();
        self.rows.write(gpu, &rows);
    }

    /// Puts every buffer into one state, all tiles awake.
    pub fn write(&self, gpu: &Gpu, state: &State) {
        let velocity: Vec<[f32; 2]> = state.velocity.iter().map(|pair| pair.map(|speed| speed as f32)).collect();
        let carried: Vec<[f32; 4]> = state
            .leading
            .iter()
            .zip(&state.scalars)
            .map(|([u, v], [density, dye])| [*u, *v, *density, *dye].map(|value| value as f32))
            .collect();
        self.write_raw(gpu, bytemuck::cast_slice(&velocity), bytemuck::cast_slice(&carried));
        let awake = gas_activity::awake(self.tiles[0] * self.tiles[1]);
        gpu.queue.write_buffer(&self.activity, 0, bytemuck::cast_slice(&awake));
    }

    /// The same from bytes; pressures start at none.
    fn write_raw(&self, gpu: &Gpu, velocity: &[u8], carried: &[u8]) {
        self.velocity.iter().for_each(|buffer| gpu.queue.write_buffer(buffer, 0, velocity));
        self.carried.iter().for_each(|buffer| gpu.queue.write_buffer(buffer, 0, carried));
        for buffer in [&self.p[0], &self.b[0]] {
            gpu.queue.write_buffer(buffer, 0, &vec![0; buffer.size() as usize]);
        }
    }

    /// Bytes of GPU memory that they take.
    pub fn memory_bytes(&self) -> u64 {
        let single = [
            &self.params.buffer,
            &self.rows.buffer,
            &self.activity,
            &self.active,
            &self.settling,
            &self.everything,
            &self.dispatches,
            &self.level_workgroups,
            &self.inverse,
        ];
        let levels = self.levels.iter().map(|level| &level.buffer);
        let many = self.velocity.iter().chain(&self.carried).chain(&self.p).chain(&self.b).chain(&self.q);
        single.into_iter().chain(levels).chain(many).map(wgpu::Buffer::size).sum()
    }
}

/// The kernels of a gas.
pub struct Gas {
    /// Emission.
    pub emit: GasEmit,
    /// Activity.
    pub activity: GasActivity,
    /// Advection.
    pub advect: GasAdvect,
    /// Forces.
    pub force: GasForce,
    /// Projection.
    pub project: GasProject,
    /// Showing.
    pub show: GasShow,
}

/// One gas: its buffers, its bindings, and what is known of it.
pub struct GasSet {
    /// Its buffers.
    pub buffers: Buffers,
    emit: GasEmitSet,
    activity: GasActivitySet,
    project: GasProjectSet,
    of_role: Vec<RoleSet>,
    coarsening: u32,
    role: Role,
    /// Steps that were recorded since the start.
    steps: u64,
    /// Whether the states but the current one are out of date: it was read from a file.
    resumes: bool,
    /// Whether everything is to be shown, not active tiles alone.
    show_everything: bool,
    word: Word,
}

/// The bindings of one role.
struct RoleSet {
    carried: wgpu::BindGroup,
    advect: GasAdvectSet,
    force: wgpu::BindGroup,
    project: GasProjectFinest,
    show: GasShowSet,
}

/// What the GPU said last about the gas, and what it is being asked.
#[derive(Default)]
struct Word {
    asked: Option<(Readback, bool)>,
    active: Option<u32>,
    /// Whether nothing moved after so many steps, and nothing touched it since.
    still_after: Option<u64>,
    touched_at: u64,
    stopped_at: Option<u64>,
}

impl Gas {
    /// Builds every pipeline, for cells that cover so many texels of the field along each axis.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn new(gpu: &Gpu, coarsening: u32) -> Result<Self, ShaderError> {
        Ok(Self {
            emit: GasEmit::new(gpu)?,
            activity: GasActivity::new(gpu, coarsening)?,
            advect: GasAdvect::new(gpu)?,
            force: GasForce::new(gpu)?,
            project: GasProject::new(gpu)?,
            show: GasShow::new(gpu, coarsening)?,
        })
    }

    /// Binds a gas to the textures that it shows itself in. It must be written before its first step.
    pub fn bind(
        &self,
        gpu: &Gpu,
        buffers: Buffers,
        coarsening: u32,
        heights: &wgpu::TextureView,
        cover: &wgpu::TextureView,
    ) -> GasSet {
        let of_role = Role::ALL.map(|role| RoleSet {
            carried: self.activity.bind_carried(gpu, &buffers, role),
            advect: self.advect.bind(gpu, &buffers, role),
            force: self.force.bind(gpu, &buffers, role),
            project: self.project.bind_finest(gpu, &buffers, role),
            show: self.show.bind(gpu, &buffers, role, heights, cover),
        });
        GasSet {
            emit: self.emit.bind(gpu, &buffers),
            activity: self.activity.bind(gpu, &buffers),
            project: self.project.bind(gpu, &buffers),
            of_role: of_role.into(),
            coarsening,
            role: Role(0),
            steps: 0,
            resumes: false,
            show_everything: true,
            word: Word::default(),
            buffers,
        }
    }

    /// Advances by `steps`, with the emissions that fall before each (sorted by step), and says whether what is shown can have changed.
    /// While no step is owed, those of step 0 fall all the same.
    ///
    /// # Errors
    ///
    /// The emissions are too many for this adapter's buffers; then nothing is recorded.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        set: &mut GasSet,
        steps: u32,
        emissions: &[(u32, Emission)],
    ) -> Result<bool, BinError> {
        set.listen();
        if set.word.stopped_at.is_some() {
            return Ok(false);
        }
        if set.resumes {
            set.spread(recorder.encoder);
        }
        let falls = self.emit.prepare(recorder.gpu, &set.buffers, &mut set.emit, emissions)?;
        if !falls.is_empty() {
            set.word.touched_at = set.steps;
            set.word.still_after = None;
        }
        // Where nothing moves and nothing is emitted, steps change nothing: none needs to be recorded.
        let steps = if set.word.still_after.is_some() { 0 } else { steps };
        let mut batch = 0;
        for step in 0..steps.max(1) {
            if falls.get(batch) == Some(&step) {
                let role = set.role();
                recorder.compute("gas emit", |pass| self.emit.record(pass, &set.emit, batch, role));
                batch += 1;
                set.show_everything |= steps == 0;
            }
            if step < steps {
                self.step(recorder, set);
            }
        }
        let shows = set.show_everything;
        if shows {
            let now = &set.of_role[set.role().start()].show;
            recorder.compute("gas show", |pass| self.show.record_everything(pass, now));
            set.show_everything = false;
        }
        if steps > 0 {
            set.ask(recorder);
        }
        Ok(shows || steps > 0)
    }

    fn step(&self, recorder: &mut Recorder<'_>, set: &mut GasSet) {
        let (of_role, dispatches) = (&set.of_role[set.role().start()], &set.buffers.dispatches);
        recorder.compute("gas activity", |pass| self.activity.record(pass, &set.activity, &of_role.carried, dispatches));
        recorder.compute("gas advect", |pass| self.advect.record(pass, &of_role.advect, dispatches));
        recorder.compute("gas force", |pass| {
            self.force.record(pass, &of_role.force, dispatches);
            self.activity.record_judgement(pass, &set.activity);
        });
        recorder.compute("gas project", |pass| self.project.record(pass, &set.project, &of_role.project, dispatches));
        set.steps += 1;
        set.role = set.role.after(1);
        let next = &set.of_role[set.role().start()].show;
        recorder.compute("gas show", |pass| self.show.record(pass, next, dispatches));
    }
}

impl GasSet {
    /// Bytes of GPU memory of its buffers, and of the lists of puffs.
    pub fn memory_bytes(&self) -> u64 {
        self.buffers.memory_bytes() + self.emit.memory_bytes()
    }

    /// Which of the states is current.
    pub fn role(&self) -> Role {
        self.role
    }

    /// Steps that were recorded since the start.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Starts anew from a state.
    pub fn reset(&mut self, gpu: &Gpu, state: &State) {
        self.buffers.write(gpu, state);
        (self.steps, self.resumes, self.show_everything) = (0, false, true);
        self.word = Word::default();
    }

    /// Goes on, after so many steps, from the state that was written over the current one.
    pub fn resume(&mut self, steps: u64) {
        (self.steps, self.resumes, self.show_everything) = (steps, true, false);
        self.word = Word { touched_at: steps, ..Word::default() };
    }

    /// Puts the states that wait for their role into the current one, as they are wherever the gas is at rest.
    fn spread(&mut self, encoder: &mut wgpu::CommandEncoder) {
        let (buffers, start) = (&self.buffers, self.role.start());
        for other in [self.role.between(), self.role.last()] {
            for of in [&buffers.velocity, &buffers.carried] {
                encoder.copy_buffer_to_buffer(&of[start], 0, &of[other], 0, of[start].size());
            }
        }
        encoder.clear_buffer(&buffers.p[0], 0, None);
        encoder.clear_buffer(&buffers.b[0], 0, None);
        self.resumes = false;
    }

    /// Takes over other physics: the gas goes on as it is, and none of it is still any more.
    pub fn set_physics(&mut self, gpu: &Gpu, physics: &Physics) {
        self.buffers.set_physics(gpu, physics);
        let tiles = self.buffers.tiles[0] * self.buffers.tiles[1];
        // Touched all over: other forces may move what was at rest.
        let offset = 4 * u64::from(gas_activity::HEADER + tiles);
        gpu.queue.write_buffer(&self.buffers.activity, offset, bytemuck::cast_slice(&vec![1_u32; tiles as usize]));
        self.word.still_after = None;
        self.word.touched_at = self.steps;
    }

    /// Tiles that were active, as far as is known.
    pub fn active_tiles(&self) -> Option<u32> {
        self.word.active
    }

    /// The step that met a number which is none, if one did: the gas stays as it was before it.
    pub fn stopped(&self) -> Option<u64> {
        self.word.stopped_at
    }

    /// Bytes that so many steps moved by design, as far as it is known how many tiles were active, and the emissions of this frame.
    pub fn traffic_bytes(&self, steps: u32) -> u64 {
        let tiles = u64::from(self.buffers.tiles[0] * self.buffers.tiles[1]);
        let active = self.word.active.map_or(tiles, u64::from);
        let cells = self.buffers.grid.count() as u64;
        u64::from(steps) * cells * step_bytes(self.coarsening) * active / tiles + self.emit.touched_cells() * gas_emit::CELL_BYTES
    }

    /// Asks the GPU, without waiting, how it went.
    fn ask(&mut self, recorder: &mut Recorder<'_>) {
        if self.word.asked.is_none() {
            let bytes = 4 * u64::from(gas_activity::HEADER);
            let readback = Readback::record_buffer(recorder.gpu, recorder.encoder, &self.buffers.activity, bytes);
            self.word.asked = Some((readback, false));
        }
    }

    /// Hears what it said, if the answer is here. The copy was submitted by the time that the next frame is recorded.
    pub fn listen(&mut self) {
        let Some((readback, started)) = &mut self.word.asked else { return };
        if !std::mem::replace(started, true) {
            readback.start();
        }
        let Some(answer) = readback.take() else { return };
        self.word.asked = None;
        // A readback fails where the device is lost, which others report.
        let Ok(bytes) = answer else { return };
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
        let word = |index: u32| words[index as usize];
        let steps = u64::from(word(gas_activity::STEPS));
        self.word.active = Some(word(gas_activity::ACTIVE));
        if word(gas_activity::ACTIVE) == 0 && steps > self.word.touched_at {
            self.word.still_after = Some(steps);
        }
        if word(gas_activity::STOPPED) > 0 {
            // Its start is the last good state.
            let stopped = u64::from(word(gas_activity::STOPPED));
            self.word.stopped_at = Some(stopped);
            self.role = self.role.before(self.steps + 1 - stopped);
            self.steps = stopped - 1;
        }
    }
}
