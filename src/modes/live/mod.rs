//! Live: a window. The clock is the wall's, the picture goes to the screen.
//!
//! Here are the window, its events and its frames; what they mean is in [`input`], what they change in [`session`].

mod gui;
pub mod hand;
pub mod input;
pub mod panel;
pub mod pick;
pub mod readings;
mod screen;
pub mod session;

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DVec2;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::error::EventLoopError;
use winit::event::{ElementState, KeyEvent, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::keyboard::{ModifiersState, PhysicalKey};
use winit::window::{Fullscreen, Window, WindowAttributes, WindowId};

use self::gui::Gui;
use self::input::{Action, Grip};
use self::panel::PANEL_WIDTH;
use self::screen::{Acquired, Screen};
use self::session::{DT_SECONDS, Pacing, Session};
use super::{ModeError, capture, script, start};
use crate::cli::LiveOptions;
use crate::frame::{FrameInput, check_limits};
use crate::interruption;
use crate::io::atomic;
use crate::io::journal::Journal;
use crate::io::scene_file::{self, LoadedScene, SceneOverrides};
use crate::stroke::Strokes;

/// Runs the mode: opens a window and runs it until it is closed, or has shown the frames that a script wants.
///
/// # Errors
///
/// The scene or its image is unfit, there is no display, no adapter that can draw to it, the device fails, the window is closed
/// before a script's last frame, or that frame cannot be written.
pub fn run(options: &LiveOptions) -> Result<(), ModeError> {
    let journal = script::journal(&options.resume)?;
    if let (Some(journal), Some(frames), Some(path)) = (&journal, options.frames, &options.resume.replay) {
        script::check_length(journal.entries.len() as u64, u64::from(frames), path)?;
    }
    let overrides = options.common.overrides();
    let loaded = match &journal {
        Some(journal) => scene_file::load_whole(journal.scene.clone(), &overrides, framed_size(options))?,
        None => scene_file::load(&options.common.scene, &overrides, framed_size(options))?,
    };
    let no_display = |error: EventLoopError| {
        log::debug!("{error}");
        let remedy = "set DISPLAY or WAYLAND_DISPLAY, or use `rilievo capture --out DIR`, which needs none";
        ModeError::Window(format!("there is no display to open a window on: {remedy}"))
    };
    let event_loop = EventLoop::new().map_err(no_display)?;
    let waker = event_loop.create_proxy();
    std::thread::spawn(move || {
        interruption::wait();
        // Any event will do: the loop asks for itself. One that has ended is told nothing.
        let _ = waker.send_event(());
    });
    let mut live = Live { options, loaded: Some((loaded, journal)), shown: 0, open: None, interrupted: false, outcome: Ok(()) };
    event_loop.run_app(&mut live).map_err(no_display)?;
    live.outcome?;
    if let Some(open) = &mut live.open {
        open.session.close(options.save_state.as_deref())?;
    }
    let complete = options.frames.is_some_and(|wanted| live.shown >= wanted);
    if live.interrupted && !complete {
        let left = match options.frames {
            None => "the window was closed, and what it was to record or to save is whole",
            Some(_) => {
                "the window was closed before its last frame, which is not written; what it was to record or to save is whole"
            }
        };
        return Err(ModeError::Interrupted { left });
    }
    match (options.frames, &options.out, live.open) {
        (Some(wanted), Some(out), Some(open)) if live.shown >= wanted => write_last_frame(open.session, options, wanted, out),
        (Some(wanted), ..) => Err(ModeError::Window(format!(
            "the window was closed after {} of {wanted} frames, so nothing was written: leave it open until they are shown",
            live.shown
        ))),
        _ => Ok(()),
    }
}

/// The part of the picture that scenes are framed for: what the panel leaves free, where it is shown at first.
fn framed_size(options: &LiveOptions) -> [u32; 2] {
    let [width, height] = options.common.image_size;
    let panel = if options.frames.is_none() { PANEL_WIDTH as u32 } else { 0 };
    [if width > 2 * panel { width - panel } else { width }, height]
}

/// Writes the last frame as a capture would: of the size that was asked for, whatever became of the window's.
fn write_last_frame(mut session: Session, options: &LiveOptions, frames: u32, out: &Path) -> Result<(), ModeError> {
    session.frame.resize(&session.gpu, options.common.image_size)?;
    let (camera, tick) = session.last();
    let input = FrameInput { tick: &tick, strokes: &Strokes::default(), camera: &camera, display: session.panel.display };
    capture::write_last_frame(&session.gpu, &mut session.frame, &input, DT_SECONDS, frames - 1, out)
}

/// The program in a window.
struct Live<'a> {
    options: &'a LiveOptions,
    /// Until the window is open.
    loaded: Option<(LoadedScene, Option<Journal>)>,
    /// How many frames there were.
    shown: u32,
    open: Option<Open>,
    /// Whether something else than the window ended it.
    interrupted: bool,
    outcome: Result<(), ModeError>,
}

/// The open window.
struct Open {
    session: Session,
    gui: Gui,
    screen: Screen,
    window: Arc<Window>,
    modifiers: ModifiersState,
    last_frame: Instant,
    /// When the next frame is due without an event; none: there is nothing new to show.
    due: Option<Instant>,
    /// Whether the last frame was to be followed by another at once.
    continuous: bool,
    visible: bool,
    title: String,
}

impl ApplicationHandler for Live<'_> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if let Some((loaded, journal)) = self.loaded.take() {
            match Open::new(event_loop, self.options, &loaded, journal) {
                Ok(open) => self.open = Some(open),
                Err(error) => self.end(event_loop, Err(error)),
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.open else { return };
        match event {
            // Destroyed: by someone else, with nothing left to ask or tell.
            WindowEvent::CloseRequested | WindowEvent::Destroyed => event_loop.exit(),
            WindowEvent::RedrawRequested if !event_loop.exiting() => match open.draw(self.options.frames.is_some()) {
                Ok(drawn) => {
                    self.shown += u32::from(drawn);
                    if self.options.frames.is_some_and(|frames| self.shown >= frames) {
                        event_loop.exit();
                    }
                }
                Err(error) => self.end(event_loop, Err(error)),
            },
            event => open.note(&event),
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        if interruption::is_asked() {
            self.interrupted = true;
            return event_loop.exit();
        }
        let Some(open) = &self.open else { return };
        let now = Instant::now();
        match open.due {
            Some(due) if due <= now => {
                open.window.request_redraw();
                event_loop.set_control_flow(ControlFlow::Wait);
            }
            Some(due) => event_loop.set_control_flow(ControlFlow::WaitUntil(due)),
            None => event_loop.set_control_flow(ControlFlow::Wait),
        }
    }
}

impl Live<'_> {
    fn end(&mut self, event_loop: &ActiveEventLoop, outcome: Result<(), ModeError>) {
        self.outcome = outcome;
        event_loop.exit();
    }
}

impl Open {
    fn new(
        event_loop: &ActiveEventLoop,
        options: &LiveOptions,
        loaded: &LoadedScene,
        journal: Option<Journal>,
    ) -> Result<Self, ModeError> {
        let [width, height] = options.common.image_size;
        let attributes = WindowAttributes::default().with_title("Rilievo").with_inner_size(PhysicalSize::new(width, height));
        let window = event_loop.create_window(attributes).map_err(|error| {
            ModeError::Window(format!("the window system refuses a window ({error}): use `rilievo capture --out DIR`"))
        })?;
        let window = Arc::new(window);
        let (screen, gpu) = Screen::open(event_loop, window.clone(), &options.common.machine.preference())?;
        check_limits(&gpu, &loaded.scene, options.common.image_size)?;
        let gui = Gui::new(&gpu, window.clone(), screen.format(), panel::set_style);
        let pacing = if options.frames.is_some() { Pacing::Fixed } else { Pacing::Realtime };
        let (start, player) = start(loaded)?;
        let overrides = options.common.overrides();
        let resumed = script::resumed(&options.resume, journal, overrides, &start)?;
        for path in options.record.iter().chain(&options.save_state) {
            atomic::check(path)?;
        }
        let session = Session::new(gpu, start, pacing, screen.size(), screen.format())?.with_player(player);
        let mut session = session.with_scenes(scenes(&options.common.scene, loaded), scene_loader(options));
        session.resume(resumed)?;
        if let Some(path) = &options.record {
            session.record_to(path)?;
        }
        session.panel.display = options.common.display.display(&loaded.scene);
        let now = Instant::now();
        Ok(Self {
            session,
            gui,
            screen,
            window,
            modifiers: ModifiersState::empty(),
            last_frame: now,
            due: Some(now),
            continuous: false,
            visible: true,
            title: String::new(),
        })
    }

    /// Passes an event on to whom it concerns.
    fn note(&mut self, event: &WindowEvent) {
        let keeps_keys = self.gui.is_typing();
        let action = match event {
            WindowEvent::KeyboardInput { event, is_synthetic, .. } if !keeps_keys => self.key(event, *is_synthetic),
            _ => None,
        };
        // A key that has a meaning here has none for the panel: Tab would also move its focus, Space also press its button.
        if action.is_none() && self.gui.note(event) {
            self.due = Some(Instant::now());
        }
        if let Some(action) = action {
            self.act(action);
        }
        self.pointer(event);
        match event {
            WindowEvent::ModifiersChanged(modifiers) => self.modifiers = modifiers.state(),
            // A changed scale factor brings a new size of its own.
            WindowEvent::Resized(size) => self.screen.resize(*size),
            WindowEvent::Occluded(occluded) => self.visible = !occluded,
            WindowEvent::Focused(false) => {
                self.session.flight.release();
                self.session.pointer.let_go();
                self.modifiers = ModifiersState::empty();
            }
            _ => {}
        }
    }

    fn key(&mut self, event: &KeyEvent, is_synthetic: bool) -> Option<Action> {
        let pressed = event.state == ElementState::Pressed;
        // Keys that were down when the window got the keyboard were not meant for it.
        if is_synthetic && pressed || self.modifiers.intersects(ModifiersState::ALT | ModifiersState::SUPER) {
            return None;
        }
        let control = self.modifiers.control_key();
        if let PhysicalKey::Code(code) = event.physical_key
            && !(control && pressed)
        {
            self.session.flight.note(code, pressed);
        }
        // A held key repeats where that is useful: stepping.
        let action = input::action(&event.logical_key, self.modifiers.shift_key(), control).filter(|_| pressed);
        action.filter(|&action| !event.repeat || matches!(action, Action::Step | Action::Undo))
    }

    fn act(&mut self, action: Action) {
        self.due = Some(Instant::now());
        if action == Action::ToggleFullscreen {
            let fullscreen = self.window.fullscreen().is_none().then_some(Fullscreen::Borderless(None));
            self.window.set_fullscreen(fullscreen);
        }
        self.session.act(action);
    }

    fn pointer(&mut self, event: &WindowEvent) {
        let session = &mut self.session;
        match *event {
            WindowEvent::CursorMoved { position, .. } => {
                if let Some((grip, pixels)) = session.pointer.moved(DVec2::new(position.x, position.y)) {
                    session.drag(grip, pixels);
                }
            }
            WindowEvent::CursorLeft { .. } => session.pointer.left(),
            WindowEvent::MouseInput { state: ElementState::Pressed, button, .. } => {
                let Some(position) = session.pointer.position() else { return };
                let held = session.pointer.grip().is_some();
                let grip = session.pointer.press(button, self.gui.covers(position), self.modifiers.shift_key());
                if grip == Some(Grip::Brush) && !held {
                    session.tap(position);
                }
            }
            WindowEvent::MouseInput { state: ElementState::Released, button, .. } => session.pointer.release(button),
            WindowEvent::MouseWheel { delta, .. } => {
                let over_panel = session.pointer.position().is_some_and(|position| self.gui.covers(position));
                let notches = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
                    // As many pixels as a wheel's notch scrolls in most programs.
                    MouseScrollDelta::PixelDelta(pixels) => pixels.y / 50.0,
                };
                if !over_panel {
                    session.wheel(notches, self.modifiers.control_key());
                }
            }
            WindowEvent::PinchGesture { delta, .. } if delta.is_finite() => session.wheel(10.0 * delta, false),
            _ => {}
        }
    }

    /// One frame. Returns whether there was one: a script's frames go on while the window is hidden, a user's do not.
    fn draw(&mut self, scripted: bool) -> Result<bool, ModeError> {
        let now = Instant::now();
        let elapsed_seconds = now.duration_since(self.last_frame).as_secs_f64();
        let mut actions = Vec::new();
        let Session { gpu, panel, readings, .. } = &mut self.session;
        let delay = self.gui.run(gpu, |ui| actions.extend(panel.show(ui, readings)));
        for action in actions {
            self.act(action);
        }
        let session = &mut self.session;
        session.apply_scene();

        let texture = match self.screen.acquire(&session.gpu) {
            Acquired::Texture(texture) => Some(texture),
            Acquired::Skip if scripted => None,
            Acquired::Skip => {
                // Not at once: a hidden window would keep a processor busy.
                self.due = Some(now + Duration::from_millis(50));
                return self.check().map(|()| false);
            }
        };
        let target = texture.as_ref().map(|texture| texture.texture.create_view(&wgpu::TextureViewDescriptor::default()));
        self.last_frame = now;
        let size = self.screen.size();
        if session.frame.image_size() != size {
            session.frame.resize(&session.gpu, size)?;
        }

        let mut encoder = session.gpu.encoder("frame");
        session.record(&mut encoder, target.as_ref(), elapsed_seconds, self.gui.covered_pixels())?;
        if let Some(target) = &target {
            self.gui.record(&session.gpu, &mut encoder, size, target);
        }
        session.finish(encoder, self.continuous.then_some(elapsed_seconds));
        if let Some(texture) = texture {
            self.window.pre_present_notify();
            session.gpu.queue.present(texture);
        }
        self.gui.end_frame();

        let title = session.title();
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
        self.continuous = session.moves() && (self.visible || scripted);
        self.due = if self.continuous { Some(now) } else { now.checked_add(session.panel.stir(delay)) };
        self.check().map(|()| true)
    }

    fn check(&self) -> Result<(), ModeError> {
        self.session.gpu.take_error().map_or(Ok(()), |error| Err(ModeError::Device(error)))
    }
}

/// Name and description of every scene that can be chosen: those that come with the program, and the file it was started with.
fn scenes(started_with: &str, loaded: &LoadedScene) -> Vec<(String, String)> {
    let mut scenes: Vec<_> = scene_file::list().into_iter().map(|(name, description)| (name.to_owned(), description)).collect();
    if scenes.iter().all(|(name, _)| name != started_with) {
        scenes.push((started_with.to_owned(), loaded.scene.description.clone()));
    }
    scenes
}

/// What makes the start of another scene. Of the command line, what suits every scene goes for it too: the field's size.
fn scene_loader(options: &LiveOptions) -> session::Load {
    let overrides = SceneOverrides { field: options.common.overrides().field, ..SceneOverrides::default() };
    let framed_size = framed_size(options);
    Box::new(move |name| start(&scene_file::load(name, &overrides, framed_size)?))
}
