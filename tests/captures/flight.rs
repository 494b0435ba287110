//! A flight over `sidewalk` with level of detail against the same without: it looks the same, costs less, and flickers no more.

use rilievo::camera::Camera;
use rilievo::clock::Tick;
use rilievo::frame::{Frame, FrameInput, Start};
use rilievo::gpu::Gpu;
use rilievo::io::scene_file::{SceneOverrides, load};
use rilievo::modes;
use rilievo::modes::capture::{PICTURE_FORMAT, Picture, read_channels};
use rilievo::scene::{Lod, Scene};
use rilievo::stroke::Strokes;
use rilievo::surface::{Channels, Choice, Display, Shadow, Technique};

use crate::support::gpu::gpu;
use crate::support::tolerances::{FLIGHT_FLICKER, FLIGHT_MEAN, FLIGHT_P99, FLIGHT_SAVED};

/// A flight's pictures, as values of their channels, and the mean of the steps that its pixels took.
struct Flight {
    pictures: Vec<Vec<u8>>,
    steps: f64,
}

impl Flight {
    fn new(gpu: &Gpu, scene: &Scene, start: &Start, image_size: [u32; 2], frames: u32) -> Self {
        let start = Start { scene: scene.clone(), ..start.clone() };
        let mut frame = Frame::new(gpu, &start, image_size, PICTURE_FORMAT).expect("its shaders compile");
        let picture = Picture::new(gpu, image_size);
        let pass = Channels::new(gpu, Choice::of(scene)).expect("its shaders compile");
        let (mut pictures, mut steps) = (Vec::new(), Vec::new());
        for index in 0..frames {
            let tick = Tick { time_seconds: f64::from(index) / 60.0, ..Tick::default() };
            let (strokes, camera) = (Strokes::default(), Camera::at(&scene.camera, tick.time_seconds));
            let input = FrameInput { tick: &tick, strokes: &strokes, camera: &camera, display: Display::default() };
            let mut encoder = gpu.encoder("flight");
            frame.record(gpu, &mut encoder, &input, Some(picture.view())).expect("there are no strokes");
            frame.finish(gpu, encoder);
            let rgba = picture.read(gpu).expect("the device is there");
            pictures.push(rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect());
            let pixels = read_channels(gpu, &frame, &pass, &input).expect("the device is there");
            steps.extend(pixels.iter().map(|pixel| f64::from(pixel.steps)).filter(|steps| *steps >= 0.0));
        }
        Self { pictures, steps: steps.iter().sum::<f64>() / steps.len() as f64 }
    }
}

/// The mean and the 99th percentile of the differences of two lists of pictures.
fn differences(a: &[Vec<u8>], b: &[Vec<u8>]) -> (f64, u8) {
    let mut all: Vec<u8> = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| a.abs_diff(*b)).collect();
    all.sort_unstable();
    (all.iter().map(|value| f64::from(*value)).sum::<f64>() / all.len() as f64, all[all.len() * 99 / 100])
}

/// Flies both ways with a technique, prints the figures and holds them to the bars.
fn compare(gpu: &Gpu, technique: Technique, shadow: Shadow, image_size: [u32; 2], frames: u32) {
    let start = modes::start(&load("sidewalk", &SceneOverrides::default(), image_size).expect("it is listed"))
        .expect("it plays nothing")
        .0;
    let mut on = start.scene.clone();
    on.trace.technique = technique;
    on.trace.shadow = shadow;
    on.lod.keep_exact = false;
    let off = Scene { lod: Lod { threshold: None, ..on.lod.clone() }, ..on.clone() };
    let [with, without] = [&on, &off].map(|scene| Flight::new(gpu, scene, &start, image_size, frames));
    let (mean, p99) = differences(&with.pictures, &without.pictures);
    let saved = 1.0 - with.steps / without.steps;
    let flicker = |flight: &Flight| differences(&flight.pictures[1..], &flight.pictures[..frames as usize - 1]).1;
    let (flickers, before) = (flicker(&with), flicker(&without));
    println!(
        "{}, {}, {image_size:?}: mean {mean:.2}, 99th percentile {p99} of 255, {:.1} steps of {:.1}, {:.0} % saved, frame to frame \
         {flickers} for {before}",
        technique.name(),
        shadow.name(),
        with.steps,
        without.steps,
        100.0 * saved
    );
    assert!(mean <= FLIGHT_MEAN && p99 <= FLIGHT_P99, "{technique:?}: it looks otherwise");
    assert!(saved >= FLIGHT_SAVED, "{technique:?}: it saves {saved}");
    assert!(f64::from(flickers) <= FLIGHT_FLICKER * f64::from(before), "{technique:?}: it flickers");
}

#[test]
fn level_of_detail_looks_the_same_and_costs_less() {
    let Some(gpu) = gpu() else { return };
    compare(gpu, Technique::Pom, Shadow::PomSoft, [240, 150], 4);
    compare(gpu, Technique::Exact, Shadow::Hard, [240, 150], 4);
    compare(gpu, Technique::Pyramid, Shadow::None, [240, 150], 4);
    compare(gpu, Technique::Relief, Shadow::None, [240, 150], 4);
}

#[test]
fn level_of_detail_looks_the_same_at_a_windows_size() {
    let Some(gpu) = gpu() else { return };
    compare(gpu, Technique::Pom, Shadow::PomSoft, [960, 600], 2);
    compare(gpu, Technique::Exact, Shadow::Hard, [960, 600], 2);
}
