//! How long each pass takes on the GPU. The names are those of the passes, in tables, labels and captures alike.

use std::cell::RefCell;
use std::collections::VecDeque;

use wgpu_profiler::{GpuProfiler, GpuProfilerQuery, GpuProfilerSettings, GpuTimerQueryResult};

use super::Gpu;

/// Waits until the GPU is idle and returns the time, milliseconds since whenever.
pub type TimeWhenIdle = fn(&Gpu) -> f64;

/// Times passes, where the adapter can; elsewhere it only names them for debuggers, and yields no times rather than zeros.
pub struct Timer {
    profiler: GpuProfiler,
    period_nanoseconds: f32,
    timed: bool,
    alone: Option<TimeWhenIdle>,
    /// Times of passes that ran alone in the frame being recorded, and in the frames before it.
    alone_now: RefCell<Vec<PassTime>>,
    alone_frames: VecDeque<Vec<PassTime>>,
}

/// What passes record into: an encoder, and the timer that names and times them.
pub struct Recorder<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// The encoder of this submission.
    pub encoder: &'a mut wgpu::CommandEncoder,
    /// The timer.
    pub timer: &'a Timer,
}

impl Recorder<'_> {
    /// Runs `record` in a compute pass of this name.
    pub fn compute(&mut self, name: &str, record: impl FnOnce(&mut wgpu::ComputePass<'_>)) {
        self.pass(name, |encoder, query| {
            let timestamp_writes = query.compute_pass_timestamp_writes();
            record(&mut encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some(name), timestamp_writes }));
        });
    }

    /// Runs `record` in a render pass of this name, which overwrites the whole target.
    pub fn render(&mut self, name: &str, target: &wgpu::TextureView, record: impl FnOnce(&mut wgpu::RenderPass<'_>)) {
        self.render_onto(name, target, None, false, record);
    }

    /// The same with a depth buffer, which begins at 0, infinitely far, if there is one; `keeps` says that it adds to what the
    /// target holds.
    pub fn render_onto(
        &mut self,
        name: &str,
        target: &wgpu::TextureView,
        depth: Option<&wgpu::TextureView>,
        keeps: bool,
        record: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let load = if keeps { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(wgpu::Color::BLACK) };
        self.pass(name, |encoder, query| {
            record(&mut encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(name),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: target,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
                })],
                depth_stencil_attachment: depth.map(depth_attachment),
                timestamp_writes: query.render_pass_timestamp_writes(),
                ..Default::default()
            }));
        });
    }

    fn pass(&mut self, name: &str, record: impl FnOnce(&mut wgpu::CommandEncoder, &GpuProfilerQuery)) {
        let begin = self.timer.alone.map(|time| self.submit_and(time));
        let query = self.timer.profiler.begin_pass_query(name, self.encoder);
        record(self.encoder, &query);
        self.timer.profiler.end_query(self.encoder, query);
        if let (Some(time), Some(begin)) = (self.timer.alone, begin) {
            let milliseconds = Some(self.submit_and(time) - begin);
            self.timer.alone_now.borrow_mut().push(PassTime { name: name.to_owned(), milliseconds });
        }
    }

    /// Submits what is recorded so far, goes on in a new encoder, and asks for the time when it is done.
    fn submit_and(&mut self, time: TimeWhenIdle) -> f64 {
        let recorded = std::mem::replace(self.encoder, self.gpu.encoder("alone"));
        self.gpu.queue.submit([recorded.finish()]);
        time(self.gpu)
    }
}

/// A depth buffer that begins at 0, infinitely far, and is not kept.
pub fn depth_attachment(view: &wgpu::TextureView) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
        stencil_ops: None,
    }
}

/// The GPU time of one pass in one frame.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// The pass's name.
    pub name: String,
    /// Milliseconds; none where the adapter has no timestamps.
    pub milliseconds: Option<f64>,
}

impl Timer {
    /// Makes one.
    pub fn new(gpu: &Gpu) -> Self {
        Self::with(gpu, gpu.has_timestamps(), None)
    }

    /// Makes one that submits every pass alone and waits for it, for adapters whose timestamps cannot be trusted: lavapipe (Mesa
    /// 22.3) executes dispatches at once but timestamps when the next picture is rasterised, and so books a simulation's 5 ms
    /// as 0.05 ms and the rest on the picture's account.
    pub fn alone(gpu: &Gpu, time: TimeWhenIdle) -> Self {
        Self::with(gpu, false, Some(time))
    }

    fn with(gpu: &Gpu, timestamps: bool, alone: Option<TimeWhenIdle>) -> Self {
        let settings =
            GpuProfilerSettings { enable_timer_queries: timestamps, enable_debug_groups: true, max_num_pending_frames: 8 };
        let profiler = GpuProfiler::new(&gpu.device, settings).unwrap_or_else(|error| {
            // The settings' only possible fault is a limit of zero pending frames.
            unreachable!("eight pending frames are a valid setting: {error}")
        });
        Self {
            profiler,
            period_nanoseconds: gpu.queue.get_timestamp_period(),
            timed: timestamps || alone.is_some(),
            alone,
            alone_now: RefCell::default(),
            alone_frames: VecDeque::new(),
        }
    }

    /// Whether times will come.
    pub fn is_timed(&self) -> bool {
        self.timed
    }

    /// Whether recording a pass also runs it.
    pub fn submits_passes_alone(&self) -> bool {
        self.alone.is_some()
    }

    /// Records the resolution of this frame's queries: the last thing in the frame's encoder.
    pub fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder) {
        self.profiler.resolve_queries(encoder);
    }

    /// Ends the frame, after its submission.
    pub fn end_frame(&mut self) {
        if let Err(error) = self.profiler.end_frame() {
            log::warn!("GPU times of a frame are lost: {error}");
        }
        if self.alone.is_some() {
            self.alone_frames.push_back(self.alone_now.take());
        }
    }

    /// The times of the oldest frame that is finished and was not asked for yet, in the order of its passes.
    pub fn finished_frame(&mut self) -> Option<Vec<PassTime>> {
        let results = self.profiler.process_finished_frame(self.period_nanoseconds);
        if self.alone.is_some() {
            return self.alone_frames.pop_front();
        }
        Some(results?.iter().map(pass_time).collect())
    }
}

fn pass_time(result: &GpuTimerQueryResult) -> PassTime {
    let milliseconds = result.time.as_ref().map(|time| (time.end - time.start) * 1e3);
    PassTime { name: result.label.clone(), milliseconds }
}
