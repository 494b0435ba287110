//! Curves as a picture: axes, ticks, lines, a legend. egui, which the panel has anyway, sets the type and smooths the lines; no font
//! of the system is needed.

use egui::{Align2, Color32, FontId, Pos2, Rect, Stroke, pos2, vec2};
use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};

use crate::gpu::Gpu;
use crate::modes::ModeError;
use crate::modes::capture::Picture;

/// Width and height of the picture, pixels.
pub const SIZE: [u32; 2] = [1200, 760];

/// How an axis maps numbers to places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// From 0, evenly.
    Linear,
    /// Every factor of ten alike. A number that is not positive stands at the low end.
    Logarithmic,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it counts, and in what unit.
    pub label: &'static str,
    /// How.
    pub scale: Scale,
    /// Whether its ticks are the points' own numbers; else round ones.
    pub ticks_at_points: bool,
}

/// A line with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What the legend calls it.
    pub name: String,
    /// Which of the colours it has.
    pub colour: usize,
    /// Its points, and what stands beside each.
    pub points: Vec<([f64; 2], String)>,
}

/// A picture of curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// Of what.
    pub subtitle: String,
    /// To the right.
    pub x: Axis,
    /// Up.
    pub y: Axis,
    /// A height to compare with, and its name.
    pub mark: Option<(f64, &'static str)>,
    /// The lines.
    pub curves: Vec<Curve>,
}

/// Colours that differ for every eye, after M. Okabe and K. Ito, *Color Universal Design*, and darker ones of them for more curves.
const COLOURS: [Color32; 10] = [
    Color32::from_rgb(0, 114, 178),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(0, 60, 110),
    Color32::from_rgb(120, 50, 0),
    Color32::from_rgb(0, 90, 60),
    Color32::from_rgb(60, 60, 60),
];

const INK: Color32 = Color32::from_rgb(30, 34, 40);
const PALE_INK: Color32 = Color32::from_rgb(105, 112, 120);
const GRID: Color32 = Color32::from_rgb(226, 229, 233);
const PAPER: wgpu::Color = wgpu::Color::WHITE;

/// The numbers that an axis spans, and those that have a tick.
#[derive(Clone, Debug, PartialEq)]
struct Span {
    scale: Scale,
    low: f64,
    high: f64,
    ticks: Vec<f64>,
}

impl Span {
    /// An axis for these numbers.
    fn over(axis: &Axis, numbers: impl Iterator<Item = f64> + Clone) -> Self {
        let mut span = Self::with_round_ticks(axis.scale, numbers.clone());
        if axis.ticks_at_points {
            span.ticks = numbers.collect();
            span.ticks.sort_by(f64::total_cmp);
            span.ticks.dedup();
        }
        span
    }

    fn with_round_ticks(scale: Scale, numbers: impl Iterator<Item = f64> + Clone) -> Self {
        let most = numbers.clone().filter(|number| number.is_finite()).fold(0.0, f64::max);
        match scale {
            Scale::Linear => {
                let most = if most > 0.0 { most } else { 1.0 };
                let step = [1.0, 2.0, 5.0, 10.0]
                    .map(|step| step * 10_f64.powf((most / 5.0).log10().floor()))
                    .into_iter()
                    .find(|step| most / step <= 5.5)
                    .unwrap_or(most);
                let count = (most / step * 1.05).ceil() as u32;
                Self { scale, low: 0.0, high: f64::from(count) * step, ticks: (0..=count).map(|i| f64::from(i) * step).collect() }
            }
            Scale::Logarithmic => {
                let least = numbers.filter(|number| number.is_finite() && *number > 0.0).fold(f64::INFINITY, f64::min);
                let (least, most) = if least.is_finite() { (least, most) } else { (0.1, 1.0) };
                let (low, high) = (least / 1.3, most * 1.3);
                let decades = low.log10().floor() as i32..=high.log10().ceil() as i32;
                let factors: &[f64] = match (high / low).log10() {
                    span if span > 3.0 => &[1.0],
                    span if span > 1.0 => &[1.0, 2.0, 5.0],
                    _ => &[1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0],
                };
                let ticks = decades.flat_map(|decade| factors.iter().map(move |factor| factor * 10_f64.powi(decade)));
                Self { scale, low, high, ticks: ticks.filter(|tick| (low..=high).contains(tick)).collect() }
            }
        }
    }

    /// Where a number stands, from 0 to 1.
    fn place(&self, number: f64) -> f32 {
        let place = match self.scale {
            Scale::Linear => (number - self.low) / (self.high - self.low),
            Scale::Logarithmic => (number.max(self.low) / self.low).ln() / (self.high / self.low).ln(),
        };
        place.clamp(0.0, 1.0) as f32
    }
}

/// A number as a tick has it: 0.002, 5, 20, 1000.
fn tick_text(number: f64) -> String {
    let text = format!("{number:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Draws the curves: RGBA in sRGB, of [`SIZE`].
///
/// # Errors
///
/// The device was lost.
pub fn draw(gpu: &Gpu, plot: &Plot) -> Result<Vec<u8>, ModeError> {
    let screen = vec2(SIZE[0] as f32, SIZE[1] as f32);
    let context = egui::Context::default();
    let input = egui::RawInput { screen_rect: Some(Rect::from_min_size(Pos2::ZERO, screen)), ..Default::default() };
    let mut output = context.run_ui(input, |ui| paint(&ui.ctx().layer_painter(egui::LayerId::background()), plot));
    let jobs = context.tessellate(output.shapes, 1.0);

    let picture = Picture::new(gpu, SIZE);
    let mut renderer = Renderer::new(&gpu.device, crate::modes::capture::PICTURE_FORMAT, RendererOptions::default());
    for (id, deltas) in output.textures_delta.set.drain() {
        for delta in &deltas {
            renderer.update_texture(&gpu.device, &gpu.queue, id, delta);
        }
    }
    // The context goes with all its textures.
    output.textures_delta.free.clear();
    let mut encoder = gpu.encoder("plot");
    let screen = ScreenDescriptor { size_in_pixels: SIZE, pixels_per_point: 1.0 };
    // Command buffers come from paint callbacks, of which there are none.
    renderer.update_buffers(&gpu.device, &gpu.queue, &mut encoder, &jobs, &screen);
    let mut pass = encoder
        .begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("plot"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: picture.view(),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(PAPER), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        })
        .forget_lifetime();
    renderer.render(&mut pass, &jobs, &screen);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    picture.read(gpu)
}

fn paint(painter: &egui::Painter, plot: &Plot) {
    let font = FontId::proportional;
    let frame = Rect::from_min_max(pos2(110.0, 100.0), pos2(SIZE[0] as f32 - 250.0, SIZE[1] as f32 - 90.0));
    let numbers = |axis: usize| plot.curves.iter().flat_map(move |curve| curve.points.iter().map(move |(at, _)| at[axis]));
    let across = Span::over(&plot.x, numbers(0));
    let up = Span::over(&plot.y, numbers(1).chain(plot.mark.map(|(height, _)| height)));
    let x = |number: f64| frame.left() + frame.width() * across.place(number);
    let y = |number: f64| frame.bottom() - frame.height() * up.place(number);

    painter.text(pos2(frame.left(), 34.0), Align2::LEFT_CENTER, &plot.title, font(27.0), INK);
    painter.text(pos2(frame.left(), 68.0), Align2::LEFT_CENTER, &plot.subtitle, font(17.0), PALE_INK);
    for &tick in &across.ticks {
        painter.vline(x(tick), frame.y_range(), Stroke::new(1.0, GRID));
        painter.text(pos2(x(tick), frame.bottom() + 10.0), Align2::CENTER_TOP, tick_text(tick), font(17.0), INK);
    }
    for &tick in &up.ticks {
        painter.hline(frame.x_range(), y(tick), Stroke::new(1.0, GRID));
        painter.text(pos2(frame.left() - 10.0, y(tick)), Align2::RIGHT_CENTER, tick_text(tick), font(17.0), INK);
    }
    painter.hline(frame.x_range(), frame.bottom(), Stroke::new(1.5, INK));
    painter.vline(frame.left(), frame.y_range(), Stroke::new(1.5, INK));
    painter.text(pos2(frame.center().x, frame.bottom() + 58.0), Align2::CENTER_CENTER, plot.x.label, font(19.0), INK);
    let label = painter.layout_no_wrap(plot.y.label.to_owned(), font(19.0), INK);
    // Turned to the left about its upper left corner.
    let corner = pos2(26.0, frame.center().y + 0.5 * label.size().x);
    painter.add(egui::epaint::TextShape::new(corner, label, INK).with_angle(-std::f32::consts::FRAC_PI_2));
    if let Some((height, name)) = plot.mark {
        let ends = [pos2(frame.left(), y(height)), pos2(frame.right(), y(height))];
        painter.extend(egui::Shape::dashed_line(&ends, Stroke::new(1.5, PALE_INK), 8.0, 6.0));
        painter.text(ends[1] + vec2(-4.0, -4.0), Align2::RIGHT_BOTTOM, name, font(16.0), PALE_INK);
    }

    for (number, curve) in plot.curves.iter().enumerate() {
        let colour = COLOURS[curve.colour % COLOURS.len()];
        let places: Vec<Pos2> = curve.points.iter().map(|([across, up], _)| pos2(x(*across), y(*up))).collect();
        painter.add(egui::Shape::line(places.clone(), Stroke::new(2.5, colour)));
        for (place, ([_, height], text)) in places.iter().zip(&curve.points) {
            let at_nothing = plot.y.scale == Scale::Logarithmic && *height <= 0.0;
            // What is 0 has no place on such an axis: it points down to where it would be.
            if at_nothing {
                let tip = vec2(0.0, 2.0);
                let shape = [tip, vec2(-7.0, -12.0), vec2(7.0, -12.0)].map(|corner| *place + corner).to_vec();
                painter.add(egui::Shape::convex_polygon(shape, colour, Stroke::NONE));
            } else {
                painter.circle_filled(*place, 5.0, colour);
            }
            let text = if at_nothing { format!("{text} 0").trim().to_owned() } else { text.clone() };
            painter.text(*place + vec2(7.0, -7.0), Align2::LEFT_BOTTOM, text, font(14.0), colour);
        }
        let row = pos2(frame.right() + 24.0, frame.top() + 12.0 + 28.0 * number as f32);
        painter.hline(row.x..=row.x + 26.0, row.y, Stroke::new(2.5, colour));
        painter.circle_filled(row + vec2(13.0, 0.0), 5.0, colour);
        painter.text(row + vec2(36.0, 0.0), Align2::LEFT_CENTER, &curve.name, font(17.0), INK);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_lie_on_the_axis() {
        let span = Span::with_round_ticks(Scale::Linear, [3.0, 17.3].into_iter());
        assert_eq!((span.low, span.high), (0.0, 20.0));
        assert_eq!(span.ticks, [0.0, 5.0, 10.0, 15.0, 20.0]);
        assert_eq!((span.place(0.0), span.place(20.0), span.place(5.0)), (0.0, 1.0, 0.25));

        let span = Span::with_round_ticks(Scale::Logarithmic, [0.04, 2.0, 0.0].into_iter());
        assert_eq!(span.ticks, [0.05, 0.1, 0.2, 0.5, 1.0, 2.0]);
        assert_eq!((span.place(0.0), span.place(span.low), span.place(span.high)), (0.0, 0.0, 1.0));
        let (a, b, c) = (span.place(0.1), span.place(0.4), span.place(1.6));
        assert!((b - a - (c - b)).abs() < 1e-6, "equal factors take equal room");
    }

    #[test]
    fn ticks_may_be_the_points_own() {
        let axis = Axis { label: "", scale: Scale::Logarithmic, ticks_at_points: true };
        assert_eq!(Span::over(&axis, [512.0, 256.0, 512.0].into_iter()).ticks, [256.0, 512.0]);
    }

    #[test]
    fn nothing_to_span_is_no_trouble() {
        for numbers in [vec![], vec![0.0], vec![5.0], vec![f64::INFINITY]] {
            for scale in [Scale::Linear, Scale::Logarithmic] {
                let span = Span::with_round_ticks(scale, numbers.iter().copied());
                assert!(span.high > span.low && (2..30).contains(&span.ticks.len()), "{numbers:?} {span:?}");
                assert!(numbers.iter().all(|number| (0.0..=1.0).contains(&span.place(*number))));
            }
        }
    }

    #[test]
    fn ticks_are_short() {
        assert_eq!([0.0, 0.002, 0.5, 5.0, 20.0, 1000.0].map(tick_text), ["0", "0.002", "0.5", "5", "20", "1000"]);
    }
}
