//! What a window shows, apart from the window: the scene and its frame, the clock, the camera, the hand.

use std::path::{Path, PathBuf};

use glam::DVec2;

use super::hand::Hand;
use super::input::{Action, FlightKeys, Grip, Pointer, Repeat};
use super::panel::Panel;
use super::pick::Picker;
use super::readings::Readings;
use crate::camera::{Camera, Rig};
use crate::clock::{Clock, Pace, Tick};
use crate::field::stack::kinds;
use crate::frame::{Frame, FrameError, FrameInput, Start};
use crate::gpu::{Gpu, Readback};
use crate::io::image_sequence::Player;
use crate::io::{journal, png_file, shader_folder};
use crate::modes::capture::Picture;
use crate::modes::script::{Moment, Replay, Resumed, hand_images};
use crate::modes::{ModeError, state};
use crate::stroke::{Stroke, Strokes};
use crate::surface::Technique;

/// Time from frame to frame where it is fixed, and of a single step, seconds.
pub const DT_SECONDS: f64 = 1.0 / 60.0;

/// The longest that one frame may span in real time, seconds. Where frames take longer the scene runs in slow motion, instead of
/// owing so many steps that the next frame takes longer still; and after a rest it goes on where it was.
const LONGEST_FRAME_SECONDS: f64 = 0.05;

/// How a session's time passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pacing {
    /// With the clock on the wall.
    Realtime,
    /// By [`DT_SECONDS`] a frame, and answers of the GPU are waited for: a script sees the same run every time.
    Fixed,
}

/// Makes the start of a scene, by its name.
pub type Load = Box<dyn Fn(&str) -> Result<(Start, Option<Player>), ModeError>>;

/// See the module's documentation.
pub struct Session {
    /// The device.
    pub gpu: Gpu,
    /// The frame.
    pub frame: Frame,
    /// The panel.
    pub panel: Panel,
    /// The mouse.
    pub pointer: Pointer,
    /// The keys of flight.
    pub flight: FlightKeys,
    rig: Rig,
    start: Start,
    load: Option<Load>,
    /// What plays the scene's series of images, if it has one.
    player: Option<Player>,
    pacing: Pacing,
    format: wgpu::TextureFormat,
    pub(super) readings: Readings,
    clock: Clock,
    repeat: Repeat,
    picker: Picker,
    /// The counts of clipped texels, on their way.
    clipped: Option<Readback>,
    /// Where the brush was pressed since the last frame.
    taps: Vec<DVec2>,
    hand: Hand,
    /// How many of its strokes are to be taken back.
    undo: u32,
    single_step: bool,
    /// Whether the field went back to its start since the last frame.
    restarted: bool,
    /// What is replayed instead of what the clock and the hand say.
    replay: Option<Replay>,
    /// Time that passed since the frame of the journal that is shown, seconds.
    since_replayed_seconds: f64,
    /// Where everything that is done is written down.
    journal: Option<journal::Writer>,
    /// The sentence of the source that has stopped, if one has.
    halted: Option<String>,
    /// Where the last frame was seen from: what a click upon it means.
    shown: Camera,
    /// The same as if no panel had stood before it.
    centred: Camera,
    /// What the last frame spanned.
    tick: Tick,
}

impl Session {
    /// Builds the first frame, for pictures of `image_size` in `format`.
    ///
    /// # Errors
    ///
    /// A size is beyond the adapter's limits, or a shader does not compile.
    pub fn new(
        gpu: Gpu,
        start: Start,
        pacing: Pacing,
        image_size: [u32; 2],
        format: wgpu::TextureFormat,
    ) -> Result<Self, FrameError> {
        let frame = Frame::new(&gpu, &start, image_size, format)?;
        let mut panel = Panel::new(start.scene.clone(), Vec::new());
        // A script knows where the surface is in the picture, not where the panel is.
        panel.shown = pacing == Pacing::Realtime;
        let rig = Rig::new(start.scene.camera.clone());
        let readings = Readings::new(gpu.describe(), frame.timer.is_timed());
        let shown = rig.camera(0.0);
        Ok(Self {
            clock: Clock::new(frame.step_seconds()),
            gpu,
            frame,
            panel,
            pointer: Pointer::default(),
            flight: FlightKeys::default(),
            rig,
            start,
            load: None,
            player: None,
            pacing,
            format,
            readings,
            repeat: Repeat::default(),
            picker: Picker::default(),
            clipped: None,
            taps: Vec::new(),
            hand: Hand::default(),
            undo: 0,
            single_step: false,
            restarted: false,
            replay: None,
            since_replayed_seconds: 0.0,
            journal: None,
            halted: None,
            centred: shown,
            shown,
            tick: Tick::default(),
        })
    }

    /// Goes on from a saved state, or as a journal says.
    ///
    /// # Errors
    ///
    /// The state is unfit.
    pub fn resume(&mut self, resumed: Resumed) -> Result<(), ModeError> {
        match resumed {
            Resumed::No => {}
            Resumed::State(saved, path) => self.clock = state::restore(&self.gpu, &mut self.frame, *saved, &path)?,
            Resumed::Journal(replay, _) => self.replay = Some(*replay),
        }
        Ok(())
    }

    /// Writes down everything that is done from now on.
    ///
    /// # Errors
    ///
    /// No file can be made there.
    pub fn record_to(&mut self, path: &Path) -> Result<(), ModeError> {
        self.journal = Some(journal::Writer::create(path, self.frame.scene(), self.start.sums())?);
        Ok(())
    }

    /// Ends the journal, and saves the state where it is wanted.
    ///
    /// # Errors
    ///
    /// The device was lost, or a file cannot be written.
    pub fn close(&mut self, save_state: Option<&Path>) -> Result<(), ModeError> {
        if let Some(journal) = self.journal.take() {
            journal.finish()?;
        }
        if let Some(path) = save_state {
            state::save(&self.gpu, &self.frame, &self.start, &self.clock, path)?;
        }
        Ok(())
    }

    /// Offers other scenes, and knows how to make their starts.
    pub fn with_scenes(mut self, scenes: Vec<(String, String)>, load: Load) -> Self {
        self.panel.scenes = scenes;
        self.load = Some(load);
        self
    }

    /// Plays the scene's series of images.
    pub fn with_player(self, player: Option<Player>) -> Self {
        Self { player, ..self }
    }

    /// What the window is called.
    pub fn title(&self) -> String {
        let scene = &self.panel.scene;
        format!("{} · {} · Rilievo", scene.name, scene.trace.technique.label())
    }

    /// Camera and time of the last frame, for a picture of it that no panel covers.
    pub fn last(&self) -> (Camera, Tick) {
        (self.centred, self.tick)
    }

    /// Saves what the window shows, without the panel, as a PNG in the working directory, and says where.
    fn save_picture(&mut self) {
        let path = unused_file(&self.panel.scene.name);
        let saved = self.picture().and_then(|pixels| Ok(png_file::write(&path, self.frame.image_size(), &pixels)?));
        match saved {
            Ok(()) => self.panel.say(format!("Saved {}", path.display())),
            Err(error) => self.panel.say_error(&format!("No picture: {error}")),
        }
    }

    /// Builds every pass anew from the shaders in the working directory. What fails leaves everything as it was.
    fn reload_shaders(&mut self) {
        let library = match shader_folder::read(Path::new(shader_folder::FOLDER)) {
            Ok(library) => library,
            Err(error) => return self.panel.say_error(&error.to_string()),
        };
        let before = std::mem::replace(&mut self.gpu.shaders, library);
        match self.frame.reload(&self.gpu) {
            Ok(()) => {
                self.picker = Picker::default();
                self.panel.say("Shaders reloaded");
            }
            Err(error) => {
                self.gpu.shaders = before;
                self.panel.say_error(&error.to_string());
            }
        }
    }

    fn picture(&mut self) -> Result<Vec<u8>, ModeError> {
        let (camera, tick) = self.last();
        let input = FrameInput { tick: &tick, strokes: &Strokes::default(), camera: &camera, display: self.panel.display };
        let picture = Picture::new(&self.gpu, self.frame.image_size());
        picture.draw(&self.gpu, &mut self.frame, &input)?;
        picture.read(&self.gpu)
    }

    /// Does what a key or the panel asks for. What concerns the window alone is not for here.
    pub fn act(&mut self, action: Action) {
        if matches!(action, Action::Reset | Action::NewSeed | Action::Scene(_) | Action::Step) {
            self.replay = None;
        }
        match action {
            Action::TogglePause => self.panel.paused = !self.panel.paused,
            Action::Step => {
                self.panel.paused = true;
                self.single_step = true;
            }
            Action::Reset => self.restart(),
            Action::NewSeed => self.reseed(),
            Action::Undo if self.undo < self.frame.groundwork().undoable() as u32 => {
                self.hand.stop();
                self.undo += 1;
            }
            Action::Undo => self.panel.say("Nothing to take back"),
            Action::Scene(index) => self.choose(index),
            Action::NextView => {
                let shows = next(crate::surface::Shows::ALL, self.panel.display.shows);
                self.panel.show_view(shows);
                self.panel.say(format!("View: {}", shows.label()));
            }
            Action::NextTechnique => {
                let technique = &mut self.panel.scene.trace.technique;
                *technique = next(Technique::ALL, *technique);
                let label = technique.label();
                self.panel.say(format!("Technique: {label}"));
            }
            Action::ToggleSplit => self.panel.toggle_split(),
            Action::TogglePanel => self.panel.shown = !self.panel.shown,
            Action::ToggleKeys => self.panel.keys_shown = !self.panel.keys_shown,
            Action::HideKeys => self.panel.keys_shown = false,
            Action::ToggleFly => {
                self.rig.toggle_fly(self.clock.time_seconds());
                self.panel.say(if self.rig.flies() { "Fly: W A S D, Q E; wheel for speed" } else { "Orbit" });
            }
            Action::ResetCamera => self.rig.reset(),
            Action::Picture => self.save_picture(),
            Action::ReloadShaders => self.reload_shaders(),
            // The window's own.
            Action::ToggleFullscreen => {}
        }
        self.panel.flies = self.rig.flies();
    }

    /// Back to the start of the scene, with what the panel changed.
    fn restart(&mut self) {
        self.apply_scene();
        self.restarted = true;
        self.halted = None;
        self.start.take_scene(&self.panel.scene);
        self.frame.reset(&self.gpu, &self.start);
        self.clock = Clock::new(self.frame.step_seconds());
        self.picker.forget();
        self.hand = Hand::default();
        self.undo = 0;
    }

    fn reseed(&mut self) {
        let seed = self.panel.scene.seed.wrapping_add(1);
        self.panel.scene.seed = seed;
        self.panel.original.seed = seed;
        self.apply_scene();
        self.restart();
        self.panel.say(format!("Seed {seed}"));
    }

    fn choose(&mut self, index: usize) {
        let (Some((name, _)), Some(load)) = (self.panel.scenes.get(index), &self.load) else { return };
        let made = load(name).and_then(|(start, player)| {
            let frame = Frame::new(&self.gpu, &start, self.frame.image_size(), self.format)?;
            Ok((start, player, frame))
        });
        match made {
            Ok((start, player, frame)) => {
                let journal = self.journal.take().map(journal::Writer::finish);
                self.halted = None;
                self.frame = frame;
                self.player = player;
                self.panel.choose(start.scene.clone());
                self.rig = Rig::new(start.scene.camera.clone());
                self.clock = Clock::new(self.frame.step_seconds());
                self.start = start;
                self.picker.forget();
                self.readings.forget_passes();
                self.clipped = None;
                self.hand = Hand::default();
                self.undo = 0;
                let description = self.panel.scene.description.clone();
                match journal {
                    None => self.panel.say(description),
                    Some(Ok(())) => self.panel.say(format!("The journal ends here: it holds one scene. {description}")),
                    Some(Err(error)) => self.panel.say_error(&format!("The journal is lost: {error}")),
                }
            }
            Err(error) => self.panel.say_error(&error.to_string()),
        }
    }

    /// A drag of the mouse, pixels right and down.
    pub fn drag(&mut self, grip: Grip, pixels: DVec2) {
        let drag = pixels / f64::from(self.frame.image_size()[1]);
        match grip {
            Grip::Turn => self.rig.turn(drag, self.clock.time_seconds()),
            Grip::Pan => self.rig.pan(drag, self.clock.time_seconds()),
            Grip::Brush | Grip::Panel => {}
        }
    }

    /// A press of the brush at a pixel.
    pub fn tap(&mut self, pixel: DVec2) {
        self.hand.begin();
        self.taps.push(pixel);
    }

    /// A turn of the wheel.
    pub fn wheel(&mut self, notches: f64, sizes_brush: bool) {
        if sizes_brush {
            self.panel.brush.grow(notches as f32);
            self.panel.say(format!("Brush: {:.0} mm", self.panel.brush.radius_metres * 1e3));
        } else {
            self.rig.zoom(notches, self.clock.time_seconds());
        }
    }

    /// Whether the next frame would show anything new without an event.
    pub fn moves(&self) -> bool {
        let scene = &self.panel.scene;
        let turns = scene.light.turn_degrees_per_second != 0.0
            || (self.rig.follows_scene() && (scene.camera.orbit_degrees_per_second != 0.0 || scene.camera.swing.is_some()));
        let presses =
            scene.shots.is_some() || scene.explosions.is_some() || !scene.tracks.is_empty() || !scene.imprints.is_empty();
        let heals = self.frame.groundwork().heals() || self.hand.waits();
        let lives = !self.panel.paused && (kinds(scene).contains(&true) || presses || heals || turns);
        let hand = self.pointer.grip() == Some(Grip::Brush) || self.flight.movement() != glam::DVec3::ZERO && self.rig.flies();
        lives
            || hand
            || self.replay.is_some()
            || self.picker.waits()
            || self.single_step
            || !self.taps.is_empty()
            || self.undo > 0
            || self.pacing == Pacing::Fixed
    }

    /// Takes over what the panel changed in the scene.
    pub fn apply_scene(&mut self) {
        if self.panel.scene == *self.frame.scene() {
            return;
        }
        if self.replay.is_some() {
            // The journal says what the scene is.
            self.panel.scene = self.frame.scene().clone();
            return;
        }
        // Each control keeps to its range, but what is stable depends on several at once.
        let valid = self.panel.scene.validate().map_err(|error| error.to_string());
        match valid.and_then(|()| self.frame.set_scene(&self.gpu, &self.panel.scene).map_err(|error| error.to_string())) {
            Ok(()) => {
                self.clock.set_steps(self.frame.step_seconds());
                self.rig.set_vertical_fov_degrees(self.panel.scene.camera.vertical_fov_degrees);
            }
            Err(error) => {
                self.panel.say_error(&error);
                self.panel.scene = self.frame.scene().clone();
            }
        }
    }

    /// Records the next frame into `target`, `elapsed_seconds` after the one before by the wall clock. `covered` is how much of the
    /// left of the picture the panel hides, pixels: an orbit keeps its target in the middle of the rest.
    ///
    /// # Errors
    ///
    /// The frame has more strokes than the adapter can take.
    pub fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        target: Option<&wgpu::TextureView>,
        elapsed_seconds: f64,
        covered: f64,
    ) -> Result<(), FrameError> {
        self.panel.pass_time(elapsed_seconds);
        let elapsed_seconds = elapsed_seconds.min(LONGEST_FRAME_SECONDS);
        if let Some(mut moment) = self.replayed(elapsed_seconds)? {
            self.hand_images(&moment.tick, &mut moment.strokes);
            (self.tick, self.shown, self.centred) = (moment.tick, moment.camera, moment.camera);
            return self.frame.record(&self.gpu, encoder, &moment.input(self.panel.display), target);
        }
        let hand_seconds = if self.pacing == Pacing::Fixed { DT_SECONDS } else { elapsed_seconds };
        self.rig.fly(self.flight.movement(), hand_seconds);
        let touched = self.touched(hand_seconds);
        self.tick = self.tick(elapsed_seconds);
        let mut strokes = Strokes::of_scene(&self.panel.scene, self.panel.scene.seed, &self.tick);
        let hand = self.strokes_of_hand(&touched);
        self.centred = self.rig.centred(self.tick.time_seconds);
        self.write_down(&hand);
        strokes.add_hand(&self.panel.scene, &hand);
        let tick = self.tick;
        self.hand_images(&tick, &mut strokes);
        self.rig.set_aside(DVec2::new(0.5 * covered / f64::from(self.frame.image_size()[1]), 0.0));
        self.shown = self.rig.camera(self.tick.time_seconds);
        let input = FrameInput { tick: &self.tick, strokes: &strokes, camera: &self.shown, display: self.panel.display };
        self.frame.record(&self.gpu, encoder, &input, target)
    }

    /// The frame that the journal has next, if one is replayed: the last one still, while it is not yet due.
    fn replayed(&mut self, elapsed_seconds: f64) -> Result<Option<Moment>, FrameError> {
        let Some(replay) = &mut self.replay else { return Ok(None) };
        self.taps.clear();
        let Some(spanned) = replay.next_span_seconds() else {
            self.replay = None;
            self.panel.paused = true;
            self.panel.say("The journal ends here: from now on it is yours");
            return Ok(None);
        };
        self.since_replayed_seconds += elapsed_seconds;
        if self.pacing == Pacing::Realtime && (self.panel.paused || self.since_replayed_seconds < spanned) {
            let tick = Tick { previous_seconds: self.tick.time_seconds, owed: Default::default(), ..self.tick };
            return Ok(Some(Moment { tick, strokes: Strokes::default(), camera: self.shown }));
        }
        self.since_replayed_seconds = (self.since_replayed_seconds - spanned).min(LONGEST_FRAME_SECONDS);
        let moment = replay.next(&self.gpu, &mut self.frame, &mut self.start)?;
        if let Some(moment) = &moment {
            self.clock.follow(&moment.tick);
            self.panel.scene = self.frame.scene().clone();
        }
        Ok(moment)
    }

    /// Writes down what this frame does.
    fn write_down(&mut self, hand: &[Stroke]) {
        let restarted = std::mem::take(&mut self.restarted);
        let Some(journal) = &mut self.journal else { return };
        if let Err(error) = journal.add(&self.tick, hand, restarted, self.frame.scene(), &self.centred) {
            self.journal = None;
            self.panel.say_error(&format!("The journal is lost: {error}"));
        }
    }

    /// Notes how the sources fare; one that has stopped says so once.
    fn note_health(&mut self) {
        let health = self.frame.health(&self.gpu);
        self.readings.behind_seconds = health.iter().map(|(_, health)| health.behind_seconds).fold(0.0, f64::max);
        let halted = health.into_iter().find_map(|(name, health)| Some(format!("{name} has stopped: {}", health.halted?)));
        if halted != self.halted {
            if let Some(sentence) = &halted {
                self.panel.say_error(sentence);
            }
            self.halted = halted;
        }
    }

    /// Hands a frame the images of its moment.
    fn hand_images(&mut self, tick: &Tick, strokes: &mut Strokes) {
        if let Err(error) = hand_images(&mut self.player, &self.panel.scene, tick, strokes) {
            // What was shown last stays.
            self.player = None;
            self.panel.say_error(&error.to_string());
        }
    }

    /// Submits what [`Session::record`] and others recorded, and notes what the frame cost: by the wall clock `frame_seconds`, where
    /// it followed the one before at once.
    pub fn finish(&mut self, encoder: wgpu::CommandEncoder, frame_seconds: Option<f64>) {
        self.frame.finish(&self.gpu, encoder);
        while let Some(times) = self.frame.timer.finished_frame() {
            self.readings.note_passes(&times);
        }
        self.note_clipped();
        self.note_health();
        if let Some(seconds) = frame_seconds {
            self.readings.note_frame(seconds);
        }
        self.panel.undoable = self.frame.groundwork().undoable();
        self.readings.time_seconds = self.tick.time_seconds;
        self.readings.steps = self.tick.owed.iter().map(|owed| owed.steps).sum();
        self.readings.image_size = self.frame.image_size();
        self.readings.field_size = self.frame.field.size;
        self.readings.field_bytes_per_texel = self.frame.field_bytes_per_texel();
        self.readings.gpu_memory_bytes = self.frame.memory_bytes();
    }

    /// Notes the counts of clipped texels that arrived, and asks for the next.
    fn note_clipped(&mut self) {
        match self.clipped.as_ref().map(Readback::take) {
            // On its way.
            Some(None) => return,
            Some(Some(Ok(bytes))) => {
                let counts: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
                self.readings.clipped_texels = Some(counts.into_iter().map(u64::from).sum());
            }
            Some(Some(Err(error))) => log::warn!("{error}"),
            None => {}
        }
        let mut encoder = self.gpu.encoder("clipped");
        let counts = &self.frame.field.clipped;
        let readback = Readback::record_buffer(&self.gpu, &mut encoder, counts, counts.size());
        self.gpu.queue.submit([encoder.finish()]);
        readback.start();
        self.clipped = Some(readback);
    }

    fn tick(&mut self, elapsed_seconds: f64) -> Tick {
        if std::mem::take(&mut self.single_step) {
            return self.clock.single_step(DT_SECONDS);
        }
        self.clock.advance(match (self.panel.paused, self.pacing) {
            (true, _) => Pace::Paused,
            (false, Pacing::Realtime) => Pace::Realtime { elapsed_seconds },
            (false, Pacing::Fixed) => Pace::Fixed { dt_seconds: DT_SECONDS },
        })
    }

    /// What the hand does in this frame, where the brush touched the surface: first of all it takes back.
    fn strokes_of_hand(&mut self, touched: &[[f32; 2]]) -> Vec<Stroke> {
        let now_seconds = self.tick.time_seconds;
        let mut strokes = vec![Stroke::Undo; std::mem::take(&mut self.undo) as usize];
        let mut done: Vec<_> =
            touched.iter().flat_map(|&at| self.hand.act(&self.panel.brush, &self.panel.scene, at, now_seconds)).collect();
        done.extend(self.hand.due(now_seconds));
        if !done.is_empty() {
            strokes.push(Stroke::Number(self.hand.stroke_number()));
            strokes.append(&mut done);
        }
        strokes
    }

    /// Where the brush touched the surface since the last frame. It works while paused too: then its strokes are all that changes.
    fn touched(&mut self, seconds: f64) -> Vec<[f32; 2]> {
        let held = self.pointer.grip() == Some(Grip::Brush);
        let repeats = self.repeat.acts(held, seconds, f64::from(self.panel.brush.per_second));
        let mut pixels = std::mem::take(&mut self.taps);
        // A press that is still held is among the taps already.
        if pixels.is_empty() && repeats {
            pixels.extend(self.pointer.position());
        }
        let asked = self.picker.ask(&self.gpu, &self.frame, &self.shown, self.tick.time_seconds, &pixels);
        if let Err(error) = asked {
            log::error!("{error}");
        }
        let wait = self.pacing == Pacing::Fixed && self.picker.waits();
        let poll = if wait { wgpu::PollType::wait_indefinitely() } else { wgpu::PollType::Poll };
        if let Err(error) = self.gpu.device.poll(poll) {
            log::warn!("the GPU does not answer: {error}");
        }
        self.picker.answers()
    }
}

/// A file in the working directory that is not there yet, named after the scene.
fn unused_file(scene: &str) -> PathBuf {
    let plain = |character: char| if character.is_alphanumeric() || character == '-' { character } else { '_' };
    let scene: String = scene.chars().map(plain).collect();
    let named = |number: u32| PathBuf::from(format!("rilievo-{scene}-{number:03}.png"));
    (1..).map(named).find(|path| !path.exists()).unwrap_or_else(|| named(0))
}

/// The element after this one, and the first after the last.
fn next<T: Copy + PartialEq>(all: &[T], present: T) -> T {
    let index = all.iter().position(|&other| other == present).unwrap_or(0);
    all[(index + 1) % all.len()]
}
