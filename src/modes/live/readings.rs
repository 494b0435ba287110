//! What a frame costs: measured numbers, and how the panel shows them.

use std::collections::VecDeque;

use egui::{Color32, RichText, Ui};
use egui_plot::{Line, Plot, PlotPoints};

use crate::gpu::PassTime;

/// How many frames the graph shows.
const HISTORY: usize = 120;

/// How much of a new measurement enters the shown number: steady enough to read, quick enough to follow.
const SMOOTHING: f64 = 0.1;

/// One pass.
#[derive(Clone, Debug, PartialEq)]
struct Pass {
    name: String,
    /// Smoothed.
    milliseconds: f64,
    history: VecDeque<f64>,
}

/// What was measured and what is known about the frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Readings {
    /// Adapter, backend and driver.
    pub adapter: String,
    /// Whether GPU times can come.
    pub is_timed: bool,
    /// Time in the scene, seconds.
    pub time_seconds: f64,
    /// Size of the height field, texels.
    pub field_size: [u32; 2],
    /// Size of the picture, pixels.
    pub image_size: [u32; 2],
    /// What the frame's textures cost, bytes a texel of the field.
    pub field_bytes_per_texel: f64,
    /// What the frame's textures and buffers cost altogether, bytes.
    pub gpu_memory_bytes: u64,
    /// Texels whose height composition had to clamp.
    pub clipped_texels: Option<u64>,
    /// Simulation steps in the last frame.
    pub steps: u32,
    /// Simulated time that sources gave up since their start, the most of any, seconds.
    pub behind_seconds: f64,
    frame_seconds: Option<f64>,
    passes: Vec<Pass>,
}

impl Readings {
    /// Nothing measured yet, on this adapter.
    pub fn new(adapter: String, is_timed: bool) -> Self {
        Self { adapter, is_timed, ..Self::default() }
    }

    /// Notes a frame that took this long by the wall clock.
    pub fn note_frame(&mut self, seconds: f64) {
        let before = self.frame_seconds.unwrap_or(seconds);
        self.frame_seconds = Some(before + SMOOTHING * (seconds - before));
    }

    /// Notes the GPU times of one frame. A pass that ran more than once counts with its sum.
    pub fn note_passes(&mut self, times: &[PassTime]) {
        let mut sums: Vec<(&str, f64)> = Vec::new();
        for (name, milliseconds) in times.iter().filter_map(|time| Some((time.name.as_str(), time.milliseconds?))) {
            match sums.iter_mut().find(|(other, _)| *other == name) {
                Some((_, sum)) => *sum += milliseconds,
                None => sums.push((name, milliseconds)),
            }
        }
        let order: Vec<&str> = sums.iter().map(|&(name, _)| name).collect();
        for pass in &mut self.passes {
            let sum = sums.iter().position(|(name, _)| *name == pass.name).map_or(0.0, |index| sums.remove(index).1);
            pass.milliseconds += SMOOTHING * (sum - pass.milliseconds);
            pass.history.push_back(sum);
            if pass.history.len() > HISTORY {
                pass.history.pop_front();
            }
        }
        // What did not run for as long as the graph shows is no pass of this frame any more.
        self.passes.retain(|pass| pass.history.len() < HISTORY || pass.history.iter().any(|&time| time > 0.0));
        for (name, milliseconds) in sums {
            // Where it stands in the frame: before the first known pass that runs after it.
            let later = order.iter().skip_while(|&&other| other != name);
            let place = later.filter_map(|&other| self.passes.iter().position(|pass| pass.name == other)).next();
            let pass = Pass { name: name.to_owned(), milliseconds, history: VecDeque::from([milliseconds]) };
            self.passes.insert(place.unwrap_or(self.passes.len()), pass);
        }
    }

    /// Forgets every time: another frame is measured from now on.
    pub fn forget_passes(&mut self) {
        self.passes.clear();
        self.frame_seconds = None;
    }

    /// GPU time of a pass, smoothed; none where it was not measured.
    pub fn milliseconds(&self, name: &str) -> Option<f64> {
        self.passes.iter().find(|pass| pass.name == name).map(|pass| pass.milliseconds)
    }

    /// Frames a second, smoothed; 0 before the first.
    pub fn frames_per_second(&self) -> f64 {
        self.frame_seconds.map_or(0.0, |seconds| 1.0 / seconds.max(1e-6))
    }
}

const COLOURS: [Color32; 8] = [
    Color32::from_rgb(102, 163, 210),
    Color32::from_rgb(222, 143, 86),
    Color32::from_rgb(124, 184, 118),
    Color32::from_rgb(214, 106, 106),
    Color32::from_rgb(168, 140, 204),
    Color32::from_rgb(206, 186, 92),
    Color32::from_rgb(96, 184, 178),
    Color32::from_rgb(206, 140, 176),
];

/// Lays the numbers out.
pub fn show(ui: &mut Ui, readings: &Readings) {
    if readings.passes.is_empty() {
        let reason = if readings.is_timed { "No frame was measured yet." } else { "This adapter cannot time its passes." };
        ui.label(RichText::new(reason).weak());
    } else {
        passes(ui, readings);
        graph(ui, readings);
    }
    ui.add_space(4.0);
    let [width, height] = readings.field_size;
    let clipped = readings.clipped_texels.map_or_else(|| "…".to_owned(), |count| count.to_string());
    egui::Grid::new("figures").num_columns(2).spacing([12.0, 2.0]).show(ui, |ui| {
        figure(ui, "Frame", format!("{:.1} ms", readings.frame_seconds.unwrap_or(0.0) * 1e3), "From one picture to the next");
        figure(ui, "Steps", format!("{} a frame", readings.steps), "Simulation steps in the last frame");
        if readings.behind_seconds > 0.0 {
            let tip = "Simulated time that was given up, because a frame would have taken too many substeps";
            figure(ui, "Behind", format!("{:.2} s", readings.behind_seconds), tip);
        }
        figure(ui, "Picture", format!("{} × {} pixels", readings.image_size[0], readings.image_size[1]), "Size of the window");
        figure(ui, "Field", format!("{width} × {height} texels"), "Size of the height field");
        let bytes = format!("{:.1} B a texel", readings.field_bytes_per_texel);
        figure(ui, "Textures", bytes, "What the height field and what follows from it cost on the GPU");
        let mebibytes = readings.gpu_memory_bytes as f64 / f64::from(1 << 20);
        figure(ui, "GPU memory", format!("{mebibytes:.1} MiB"), "What this program holds on the GPU");
        figure(ui, "Clipped", format!("{clipped} texels"), "Heights outside 0 to 1, cut off by the composition");
    });
    ui.add_space(4.0);
    ui.label(RichText::new(&readings.adapter).weak().small()).on_hover_text("Adapter, backend and driver");
}

fn figure(ui: &mut Ui, name: &str, value: String, tip: &str) {
    ui.label(RichText::new(name).weak()).on_hover_text(tip);
    ui.label(RichText::new(value).monospace()).on_hover_text(tip);
    ui.end_row();
}

fn passes(ui: &mut Ui, readings: &Readings) {
    let total: f64 = readings.passes.iter().map(|pass| pass.milliseconds).sum();
    egui::Grid::new("passes").num_columns(3).spacing([10.0, 2.0]).show(ui, |ui| {
        for (pass, colour) in readings.passes.iter().zip(COLOURS.into_iter().cycle()) {
            ui.label(RichText::new(format!("■ {}", pass.name)).color(colour));
            ui.label(RichText::new(format!("{:8.3} ms", pass.milliseconds)).monospace());
            ui.label(RichText::new(format!("{:3.0} %", 100.0 * pass.milliseconds / total.max(1e-9))).monospace().weak());
            ui.end_row();
        }
        ui.label(RichText::new("Together").strong());
        ui.label(RichText::new(format!("{total:8.3} ms")).monospace().strong());
        ui.end_row();
    });
}

fn graph(ui: &mut Ui, readings: &Readings) {
    let lines: Vec<Line<'_>> = readings
        .passes
        .iter()
        .zip(COLOURS.into_iter().cycle())
        .map(|(pass, colour)| {
            // Aligned at the right end, which is now, however long ago a pass was first seen.
            let start = HISTORY - pass.history.len();
            let points = pass.history.iter().enumerate().map(|(index, &time)| [(start + index) as f64, time]);
            Line::new(&pass.name, PlotPoints::from_iter(points)).color(colour)
        })
        .collect();
    let plot = Plot::new("GPU times")
        .height(84.0)
        .show_x(false)
        .show_axes([false, true])
        .y_axis_formatter(|mark, _| format!("{} ms", mark.value))
        .include_x(0.0)
        .include_x(HISTORY as f64)
        .include_y(0.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(false)
        .grid_spacing(16.0..=120.0)
        .show_grid([false, true]);
    plot.show(ui, |plot| lines.into_iter().for_each(|line| plot.line(line)))
        .response
        .on_hover_text("GPU time of each pass, the last 120 frames");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn time(name: &str, milliseconds: f64) -> PassTime {
        PassTime { name: name.to_owned(), milliseconds: Some(milliseconds) }
    }

    #[test]
    fn adds_up_a_pass_that_ran_twice_and_counts_one_that_did_not_run_as_zero() {
        let mut readings = Readings::default();
        readings.note_passes(&[time("wave", 1.0), time("wave", 2.0), time("surface", 5.0)]);
        readings.note_passes(&[time("stamp", 1.0), time("surface", 5.0), time("present", 0.5)]);
        let histories: Vec<(&str, Vec<f64>)> =
            readings.passes.iter().map(|pass| (pass.name.as_str(), pass.history.iter().copied().collect())).collect();
        // In the order of the frame, whenever each was first seen.
        let expected = [("wave", vec![3.0, 0.0]), ("stamp", vec![1.0]), ("surface", vec![5.0, 5.0]), ("present", vec![0.5])];
        assert_eq!(histories, expected);
        assert!(readings.passes[0].milliseconds < 3.0);
    }

    #[test]
    fn an_adapter_without_timestamps_shows_no_times_rather_than_zeros() {
        let mut readings = Readings::default();
        readings.note_passes(&[PassTime { name: "wave".to_owned(), milliseconds: None }]);
        assert!(readings.passes.is_empty());
    }

    #[test]
    fn keeps_only_what_the_graph_shows() {
        let mut readings = Readings::default();
        (0..3 * HISTORY).for_each(|_| readings.note_passes(&[time("wave", 1.0)]));
        assert_eq!(readings.passes[0].history.len(), HISTORY);
    }

    #[test]
    fn smooths_the_frame_rate() {
        let mut readings = Readings::default();
        assert_eq!(readings.frames_per_second(), 0.0);
        readings.note_frame(0.02);
        assert!((readings.frames_per_second() - 50.0).abs() < 1e-9);
        readings.note_frame(0.04);
        assert!(readings.frames_per_second() > 40.0);
    }
}
