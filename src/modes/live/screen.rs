//! The surface of a window: made, configured, lost and made again.

use std::sync::Arc;

use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

use crate::gpu::{AdapterError, Gpu, Preference, adapter};
use crate::modes::ModeError;

/// What became of a request for the next picture of the window.
pub enum Acquired {
    /// Draw to it.
    Texture(wgpu::SurfaceTexture),
    /// Skip this frame: the window is hidden, without size, or busy; if it had to be set up anew, the next frame will do.
    Skip,
}

/// A window's surface.
pub struct Screen {
    window: Arc<Window>,
    window_size: PhysicalSize<u32>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    /// Whether the configuration is in force: not while the window has no size.
    configured: bool,
    /// Whether to configure once no picture of it is alive.
    stale: bool,
}

impl Screen {
    /// Makes the surface and opens the best adapter that can draw to it.
    ///
    /// # Errors
    ///
    /// There is no surface, no adapter for it, or no format.
    pub fn open(event_loop: &ActiveEventLoop, window: Arc<Window>, preference: &Preference) -> Result<(Self, Gpu), ModeError> {
        let mut last: Option<ModeError> = None;
        for backends in preference.backend_sets() {
            let instance = adapter::instance(backends, Some(Box::new(event_loop.owned_display_handle())));
            let surface = match instance.create_surface(window.clone()) {
                Ok(surface) => surface,
                Err(error) => {
                    last = last.or(Some(ModeError::Window(format!(
                        "the window cannot be drawn to ({error}): use `rilievo capture --out DIR`, which needs no window"
                    ))));
                    continue;
                }
            };
            match pollster::block_on(Gpu::for_surface(preference, instance, &surface)) {
                Ok(gpu) => return Ok((Self::new(&gpu, window, surface)?, gpu)),
                // The first set is the one that is wanted: what it lacked says more than what the fallback lacks.
                Err(error) => last = last.or(Some(error.into())),
            }
        }
        Err(last.unwrap_or(ModeError::Adapter(AdapterError::None)))
    }

    fn new(gpu: &Gpu, window: Arc<Window>, surface: wgpu::Surface<'static>) -> Result<Self, ModeError> {
        let formats = surface.get_capabilities(&gpu.adapter).formats;
        // Eight bits that are stored as written: the presentation encodes for itself, and the panel's colours are made for it.
        let plain =
            |format: &&wgpu::TextureFormat| matches!(format, wgpu::TextureFormat::Bgra8Unorm | wgpu::TextureFormat::Rgba8Unorm);
        let format = formats.iter().find(plain).or(formats.first()).copied();
        let config = surface.get_default_config(&gpu.adapter, 1, 1).zip(format);
        let (config, format) = config.ok_or_else(|| {
            let adapter = gpu.describe();
            ModeError::Window(format!("{adapter} has no format for this window: choose another adapter with --adapter"))
        })?;
        let config = wgpu::SurfaceConfiguration { format, present_mode: wgpu::PresentMode::AutoVsync, ..config };
        let window_size = window.inner_size();
        let mut screen = Self { window, window_size, surface, config, configured: false, stale: false };
        screen.fit(gpu);
        Ok(screen)
    }

    /// The format of its pictures.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.config.format
    }

    /// Width and height of its pictures, pixels; the last ones it had while it has none.
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// Notes the window's size. Told, not asked for: winit panics when asked about a window that was destroyed from outside.
    pub fn resize(&mut self, size: PhysicalSize<u32>) {
        if self.window_size != size {
            self.window_size = size;
            self.stale = true;
        }
    }

    /// Takes over the window's size. Call it only while no picture of it is alive.
    fn fit(&mut self, gpu: &Gpu) {
        let size = self.window_size;
        if size.width == 0 || size.height == 0 {
            self.configured = false;
            return;
        }
        let most = gpu.device.limits().max_texture_dimension_2d;
        (self.config.width, self.config.height) = (size.width.min(most), size.height.min(most));
        self.surface.configure(&gpu.device, &self.config);
        (self.configured, self.stale) = (true, false);
    }

    /// The next picture to draw, of [`Screen::size`].
    pub fn acquire(&mut self, gpu: &Gpu) -> Acquired {
        if self.stale || !self.configured {
            self.fit(gpu);
        }
        if !self.configured {
            return Acquired::Skip;
        }
        match self.surface.get_current_texture() {
            wgpu::CurrentSurfaceTexture::Success(texture) => return Acquired::Texture(texture),
            wgpu::CurrentSurfaceTexture::Suboptimal(texture) => {
                // Still good to show; configuring must wait until it was.
                self.stale = true;
                return Acquired::Texture(texture);
            }
            wgpu::CurrentSurfaceTexture::Timeout | wgpu::CurrentSurfaceTexture::Occluded => {}
            wgpu::CurrentSurfaceTexture::Outdated => self.stale = true,
            wgpu::CurrentSurfaceTexture::Lost => self.recreate(gpu),
            // The error itself reached the device's handler.
            wgpu::CurrentSurfaceTexture::Validation => self.stale = true,
        }
        Acquired::Skip
    }

    fn recreate(&mut self, gpu: &Gpu) {
        match gpu.instance.create_surface(self.window.clone()) {
            Ok(surface) => {
                self.surface = surface;
                self.stale = true;
            }
            // It stays lost, and the next frame tries again.
            Err(error) => log::warn!("the window's surface was lost and cannot be made anew yet: {error}"),
        }
    }
}
