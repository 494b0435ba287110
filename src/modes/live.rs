//! Live: a window. The clock is the wall's, the picture goes to the screen.
//!
//! Here are the window, its events and its frames; what they mean is in [`super::input`], what they change in [`super::session`].

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DVec2;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::error::{EventLoopError, OsError};
use winit::event::{ElementState, KeyEvent, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::keyboard::{ModifiersState, PhysicalKey};
use winit::window::{Fullscreen, Window, WindowAttributes, WindowId};

use super::gui::Gui;
use super::input::{self, Action, Grip};
use super::panel;
use super::screen::{Acquired, Screen, ScreenError};
use super::session::{Load, Pacing, Session};
use crate::frame::{FrameError, Start};
use crate::gpu::{Gpu, Preference};

/// What a window is to show.
pub struct Options {
    /// Which adapter.
    pub preference: Preference,
    /// The scene that it begins with.
    pub start: Start,
    /// Every scene that can be chosen: name and description.
    pub scenes: Vec<(String, String)>,
    /// Makes the start of another scene, by its name.
    pub load: Load,
    /// Size of the window, pixels.
    pub image_size: [u32; 2],
    /// After how many frames of 1/60 s to close; none: when the user closes it, and time is the wall's.
    pub frames: Option<u32>,
}

/// Why there is no window, or no longer.
#[derive(Debug, thiserror::Error)]
pub enum LiveError {
    /// There is no display.
    #[error("there is no display to open a window on ({0}); set DISPLAY or WAYLAND_DISPLAY, or use `rilievo capture --out DIR`")]
    NoDisplay(EventLoopError),
    /// The window system refused a window.
    #[error("the window system refuses a window: {0}")]
    Window(#[from] OsError),
    /// It cannot be drawn to.
    #[error(transparent)]
    Screen(#[from] ScreenError),
    /// No frame can be made for it.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// The device reported errors.
    #[error("the graphics device reported an error: {0}; update its driver, or choose another adapter with --adapter")]
    Device(String),
    /// The window was closed too early.
    #[error("the window was closed after {shown} of {wanted} frames, so nothing was written")]
    Closed {
        /// Frames shown.
        shown: u32,
        /// Frames asked for.
        wanted: u32,
    },
}

/// Opens the window and runs it until it is closed, or has shown its frames: then returns what it showed last.
///
/// # Errors
///
/// There is no display, no adapter that can draw to it, or the device fails.
pub fn run(options: Options) -> Result<Option<Session>, LiveError> {
    let event_loop = EventLoop::new().map_err(LiveError::NoDisplay)?;
    let frames = options.frames;
    let mut live = Live { options: Some(options), frames, shown: 0, open: None, outcome: Ok(()) };
    event_loop.run_app(&mut live).map_err(LiveError::NoDisplay)?;
    live.outcome?;
    match frames {
        Some(wanted) if live.shown < wanted => Err(LiveError::Closed { shown: live.shown, wanted }),
        Some(_) => Ok(live.open.map(|open| open.session)),
        None => Ok(None),
    }
}

/// The program in a window.
struct Live {
    /// Until the window is open.
    options: Option<Options>,
    frames: Option<u32>,
    shown: u32,
    open: Option<Open>,
    outcome: Result<(), LiveError>,
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
    visible: bool,
    title: String,
    /// Where a script's frames go while the window shows none.
    unseen: Option<wgpu::TextureView>,
}

impl ApplicationHandler for Live {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if let Some(options) = self.options.take() {
            match Open::new(event_loop, options) {
                Ok(open) => self.open = Some(open),
                Err(error) => self.end(event_loop, Err(error)),
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.open else { return };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::RedrawRequested if !event_loop.exiting() => match open.draw(self.frames.is_some()) {
                Ok(drawn) => {
                    self.shown += u32::from(drawn);
                    if self.frames.is_some_and(|frames| self.shown >= frames) {
                        event_loop.exit();
                    }
                }
                Err(error) => self.end(event_loop, Err(error)),
            },
            event => open.note(&event),
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
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

impl Live {
    fn end(&mut self, event_loop: &ActiveEventLoop, outcome: Result<(), LiveError>) {
        self.outcome = outcome;
        event_loop.exit();
    }
}

impl Open {
    fn new(event_loop: &ActiveEventLoop, options: Options) -> Result<Self, LiveError> {
        let [width, height] = options.image_size;
        let attributes = WindowAttributes::default().with_title("Rilievo").with_inner_size(PhysicalSize::new(width, height));
        let window = Arc::new(event_loop.create_window(attributes)?);
        let (screen, gpu) = Screen::open(event_loop, window.clone(), &options.preference)?;
        let gui = Gui::new(&gpu, window.clone(), screen.format(), panel::set_style);
        let pacing = if options.frames.is_some() { Pacing::Fixed } else { Pacing::Realtime };
        let Options { start, scenes, load, .. } = options;
        let session = Session::new(gpu, start, scenes, load, pacing, screen.size(), screen.format())?;
        let now = Instant::now();
        Ok(Self {
            session,
            gui,
            screen,
            window,
            modifiers: ModifiersState::empty(),
            last_frame: now,
            due: Some(now),
            visible: true,
            title: String::new(),
            unseen: None,
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
            WindowEvent::Resized(_) | WindowEvent::ScaleFactorChanged { .. } => self.screen.outdate(),
            WindowEvent::Occluded(occluded) => self.visible = !occluded,
            WindowEvent::Focused(false) => {
                self.session.flight.release();
                self.session.pointer.lost();
                self.modifiers = ModifiersState::empty();
            }
            _ => {}
        }
    }

    fn key(&mut self, event: &KeyEvent, is_synthetic: bool) -> Option<Action> {
        let pressed = event.state == ElementState::Pressed;
        // Keys that were down when the window got the keyboard were not meant for it.
        if is_synthetic && pressed
            || self.modifiers.intersects(ModifiersState::CONTROL | ModifiersState::ALT | ModifiersState::SUPER)
        {
            return None;
        }
        if let PhysicalKey::Code(code) = event.physical_key {
            self.session.flight.note(code, pressed);
        }
        // A held key repeats where that is useful: stepping.
        let action = input::action(&event.logical_key, self.modifiers.shift_key()).filter(|_| pressed);
        action.filter(|&action| !event.repeat || action == Action::Step)
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

    /// One frame. Returns whether one was run: a script's always is, a user's only if the window shows it.
    fn draw(&mut self, scripted: bool) -> Result<bool, LiveError> {
        let now = Instant::now();
        let elapsed_seconds = now.duration_since(self.last_frame).as_secs_f64();
        let acquired = self.screen.acquire(&self.session.gpu);
        let size = self.screen.size();
        let (texture, target) = match acquired {
            Acquired::Texture(texture) => {
                let target = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
                (Some(texture), target)
            }
            Acquired::Skip if scripted => (None, self.unseen(size)),
            Acquired::Skip => {
                // Not at once: a hidden window would keep a processor busy.
                self.due = Some(now + Duration::from_millis(50));
                return self.check().map(|()| false);
            }
        };
        self.last_frame = now;
        if self.session.frame.image_size() != size {
            self.session.frame.resize(&self.session.gpu, size)?;
        }

        let mut actions = Vec::new();
        let Session { gpu, panel, readings, .. } = &mut self.session;
        let delay = self.gui.run(gpu, |ui| actions.extend(panel.show(ui, readings)));
        for action in actions {
            self.act(action);
        }
        let session = &mut self.session;
        session.apply_scene();

        let mut encoder = session.gpu.encoder("frame");
        session.record(&mut encoder, &target, elapsed_seconds, self.gui.covered_pixels());
        self.gui.record(&session.gpu, &mut encoder, size, &target);
        session.gpu.queue.submit([encoder.finish()]);
        if let Some(texture) = texture {
            self.window.pre_present_notify();
            session.gpu.queue.present(texture);
        }
        self.gui.end_frame();
        session.end_frame(elapsed_seconds);

        let title = session.title();
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
        let moves = session.moves() && (self.visible || scripted);
        self.due = if moves { Some(now) } else { now.checked_add(self.session.panel.stir(delay)) };
        self.check().map(|()| true)
    }

    /// A texture in place of the window's, of its size and format.
    fn unseen(&mut self, size: [u32; 2]) -> wgpu::TextureView {
        let gpu = &self.session.gpu;
        let fits = |view: &&wgpu::TextureView| [view.texture().width(), view.texture().height()] == size;
        if let Some(view) = self.unseen.as_ref().filter(fits) {
            return view.clone();
        }
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("unseen"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.screen.format(),
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        self.unseen.insert(texture.create_view(&wgpu::TextureViewDescriptor::default())).clone()
    }

    fn check(&self) -> Result<(), LiveError> {
        let gpu: &Gpu = &self.session.gpu;
        gpu.take_error().map_or(Ok(()), |error| Err(LiveError::Device(error)))
    }
}
