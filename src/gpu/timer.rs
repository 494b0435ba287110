//! How long each pass takes on the GPU. The names are those of the passes, in tables, labels and captures alike.

use wgpu_profiler::{GpuProfiler, GpuProfilerSettings, GpuTimerQueryResult};

use super::Gpu;

/// Times passes, where the adapter can; elsewhere it only names them for debuggers, and yields no times rather than zeros.
pub struct Timer {
    profiler: GpuProfiler,
    period_nanoseconds: f32,
    timed: bool,
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
        let query = self.timer.profiler.begin_pass_query(name, self.encoder);
        {
            let mut pass = self.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some(name),
                timestamp_writes: query.compute_pass_timestamp_writes(),
            });
            record(&mut pass);
        }
        self.timer.profiler.end_query(self.encoder, query);
    }

    /// Runs `record` in a render pass of this name, which overwrites the whole target.
    pub fn render(&mut self, name: &str, target: &wgpu::TextureView, record: impl FnOnce(&mut wgpu::RenderPass<'_>)) {
        let query = self.timer.profiler.begin_pass_query(name, self.encoder);
        {
            let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(name),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: target,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
                })],
                timestamp_writes: query.render_pass_timestamp_writes(),
                ..Default::default()
            });
            record(&mut pass);
        }
        self.timer.profiler.end_query(self.encoder, query);
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
        let timed = gpu.has_timestamps();
        let settings = GpuProfilerSettings { enable_timer_queries: timed, enable_debug_groups: true, max_num_pending_frames: 8 };
        let profiler = GpuProfiler::new(&gpu.device, settings).unwrap_or_else(|error| {
            // The settings' only possible fault is a limit of zero pending frames.
            unreachable!("eight pending frames are a valid setting: {error}")
        });
        Self { profiler, period_nanoseconds: gpu.queue.get_timestamp_period(), timed }
    }

    /// Whether times will come.
    pub fn is_timed(&self) -> bool {
        self.timed
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
    }

    /// The times of the oldest frame that is finished and was not asked for yet, in the order of its passes.
    pub fn finished_frame(&mut self) -> Option<Vec<PassTime>> {
        let results = self.profiler.process_finished_frame(self.period_nanoseconds)?;
        Some(results.iter().map(pass_time).collect())
    }
}

fn pass_time(result: &GpuTimerQueryResult) -> PassTime {
    let milliseconds = result.time.as_ref().map(|time| (time.end - time.start) * 1e3);
    PassTime { name: result.label.clone(), milliseconds }
}
