//! egui in a window: its events, its pass over the panel, its picture.

use std::sync::Arc;
use std::time::Duration;

use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};
use glam::DVec2;
use winit::event::WindowEvent;
use winit::window::Window;

use crate::gpu::Gpu;

/// egui's side of the window.
pub struct Gui {
    window: Arc<Window>,
    context: egui::Context,
    state: egui_winit::State,
    renderer: Renderer,
    jobs: Vec<egui::ClippedPrimitive>,
    pixels_per_point: f32,
    /// What no panel covers, points.
    uncovered: egui::Rect,
    free: Vec<egui::TextureId>,
}

impl Gui {
    /// Sets egui up for a window whose pictures have this format.
    pub fn new(gpu: &Gpu, window: Arc<Window>, format: wgpu::TextureFormat, set_style: impl FnOnce(&egui::Context)) -> Self {
        let context = egui::Context::default();
        set_style(&context);
        let most = gpu.device.limits().max_texture_dimension_2d as usize;
        let scale = window.scale_factor() as f32;
        let state = egui_winit::State::new(context.clone(), egui::ViewportId::ROOT, &window, Some(scale), None, Some(most));
        let renderer = Renderer::new(&gpu.device, format, RendererOptions::default());
        Self {
            window,
            context,
            state,
            renderer,
            jobs: Vec::new(),
            pixels_per_point: scale,
            uncovered: egui::Rect::NOTHING,
            free: Vec::new(),
        }
    }

    /// Tells egui of an event; returns whether it wants to be drawn anew.
    pub fn note(&mut self, event: &WindowEvent) -> bool {
        self.state.on_window_event(&self.window, event).repaint
    }

    /// Whether a panel, a window or a popup is under this pixel. Asked of the position itself: egui's own idea of the pointer is
    /// that of the last frame, which may have been long ago.
    pub fn covers(&self, pixel: DVec2) -> bool {
        let position = (pixel / f64::from(self.pixels_per_point)).as_vec2();
        let position = egui::pos2(position.x, position.y);
        match self.context.layer_id_at(position) {
            Some(layer) if layer.order != egui::Order::Background => true,
            _ => !self.uncovered.contains(position),
        }
    }

    /// Whether keys belong to a text that is being typed.
    pub fn is_typing(&self) -> bool {
        self.context.text_edit_focused()
    }

    /// Lays the panel out. Returns after what time egui wants to be drawn again without an event.
    pub fn run(&mut self, gpu: &Gpu, mut show: impl FnMut(&mut egui::Ui)) -> Duration {
        let input = self.state.take_egui_input(&self.window);
        let mut uncovered = egui::Rect::NOTHING;
        let mut output = self.context.run_ui(input, |ui| {
            show(ui);
            uncovered = ui.available_rect_before_wrap();
        });
        self.uncovered = uncovered;
        self.state.handle_platform_output(&self.window, output.platform_output);
        // Applied at once, whether or not there will be a picture to paint to: deltas are told only once.
        for (id, deltas) in output.textures_delta.set.drain() {
            for delta in &deltas {
                self.renderer.update_texture(&gpu.device, &gpu.queue, id, delta);
            }
        }
        self.free.extend(output.textures_delta.free.drain());
        self.pixels_per_point = output.pixels_per_point;
        self.jobs = self.context.tessellate(output.shapes, output.pixels_per_point);
        output.viewport_output.get(&egui::ViewportId::ROOT).map_or(Duration::MAX, |viewport| viewport.repaint_delay)
    }

    /// How wide the panel at the left is, pixels; nothing where it leaves too little free to centre a picture in.
    pub fn covered_pixels(&self) -> f64 {
        let covered = self.uncovered.left();
        let worth_it = covered.is_finite() && covered < self.uncovered.width();
        if worth_it { f64::from(covered.max(0.0) * self.pixels_per_point) } else { 0.0 }
    }

    /// Records the picture of the last [`Gui::run`], over what `target` of `size` pixels holds.
    pub fn record(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, size: [u32; 2], target: &wgpu::TextureView) {
        let screen = ScreenDescriptor { size_in_pixels: size, pixels_per_point: self.pixels_per_point };
        // Command buffers come from paint callbacks, of which there are none.
        self.renderer.update_buffers(&gpu.device, &gpu.queue, encoder, &self.jobs, &screen);
        let mut pass = encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("panel"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: target,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
                })],
                ..Default::default()
            })
            .forget_lifetime();
        self.renderer.render(&mut pass, &self.jobs, &screen);
    }

    /// Lets go of what the last picture still needed. Call it after its submission.
    pub fn end_frame(&mut self) {
        for id in self.free.drain(..) {
            self.renderer.free_texture(&id);
        }
    }
}
