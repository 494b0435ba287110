//! What the program may cost, measured A against B in one run, so that a busy machine slows both.

use std::time::{Duration, Instant};

use rilievo::camera::Camera;
use rilievo::clock::Tick;
use rilievo::field::base;
use rilievo::frame::{Frame, FrameInput, Start};
use rilievo::gpu::{Gpu, Timer};
use rilievo::io::height_image::HeightImage;
use rilievo::modes::capture::{PICTURE_FORMAT, Picture};
use rilievo::modes::headless::milliseconds_when_idle;
use rilievo::scene::{Addressing, Base, Scene};
use rilievo::stroke::Strokes;
use rilievo::surface::{Shadow, Shows, Technique};

use crate::captures::capture;
use crate::support::gpu::gpu;
use crate::support::tolerances::{CONE_BUDGET, EXACT_BUDGET, FIRST_PICTURE};

/// `relief` at 640×480 without shadows, and its frame.
struct Relief {
    frame: Frame,
    picture: Picture,
    camera: Camera,
}

impl Relief {
    fn new(gpu: &Gpu, technique: Technique, size: u32) -> Self {
        let mut scene = Scene { base: Base::Terrain {}, ..Scene::default() };
        scene.field.size = [1024, 1024];
        scene.trace.technique = technique;
        scene.trace.shadow = Shadow::None;
        // The same content at every size: one terrain, resampled.
        let heights = base::heights(&scene).expect("a terrain is procedural");
        let image = HeightImage { size: scene.field.size, heights }.resampled([size, size], Addressing::Clamp);
        scene.field.size = [size, size];
        Self::of(gpu, &scene, image.heights)
    }

    /// A still scene that starts from these heights.
    fn of(gpu: &Gpu, scene: &Scene, heights: Vec<f32>) -> Self {
        let image_size = [640, 480];
        let mut frame =
            Frame::new(gpu, &Start::new(scene, heights, None), image_size, PICTURE_FORMAT).expect("its shaders compile");
        frame.timer = Timer::alone(gpu, milliseconds_when_idle);
        Self { frame, picture: Picture::new(gpu, image_size), camera: Camera::at(&scene.camera, 0.0) }
    }

    /// Milliseconds of the surface pass of one more frame.
    fn surface_ms(&mut self, gpu: &Gpu) -> f64 {
        let (tick, strokes) = (Tick::default(), Strokes::default());
        let input = FrameInput { tick: &tick, strokes: &strokes, camera: &self.camera, display: Shows::Picture.into() };
        let mut encoder = gpu.encoder("speed");
        self.frame.record(gpu, &mut encoder, &input, Some(self.picture.view())).expect("there are no strokes");
        self.frame.finish(gpu, encoder);
        let times = self.frame.timer.finished_frame().expect("every pass was waited for");
        let surface = times.iter().find(|time| time.name == "surface").expect("a frame has a surface");
        surface.milliseconds.expect("passes that run alone are timed")
    }
}

/// Medians of the surface pass of each, taken in turn.
fn medians(gpu: &Gpu, reliefs: &mut [Relief], frames: usize) -> Vec<f64> {
    let mut times = vec![Vec::new(); reliefs.len()];
    for frame in 0..frames + 2 {
        for (relief, times) in reliefs.iter_mut().zip(&mut times) {
            let milliseconds = relief.surface_ms(gpu);
            // The first frames compile.
            if frame >= 2 {
                times.push(milliseconds);
            }
        }
    }
    times
        .into_iter()
        .map(|mut times| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        })
        .collect()
}

#[test]
fn exact_costs_at_most_four_times_normal() {
    let Some(gpu) = gpu() else { return };
    let mut reliefs = [Technique::Normal, Technique::Exact].map(|technique| Relief::new(gpu, technique, 1024));
    let [normal, exact] = medians(gpu, &mut reliefs, 50)[..] else { unreachable!("two reliefs have two medians") };
    println!("relief 640×480 over 1024²: normal {normal:.1} ms, exact {exact:.1} ms, {:.2} times", exact / normal);
    assert!(exact <= EXACT_BUDGET * normal, "{exact} ms of {normal} ms");
}

/// The project's bar, on the terrain, of the whole surface pass; what the shadows alone cost is printed.
#[test]
fn a_cone_shadow_costs_at_most_twice_a_hard_one() {
    let Some(gpu) = gpu() else { return };
    for half_angle_degrees in [1.0, 3.0, 5.0] {
        let mut reliefs = [Shadow::None, Shadow::Hard, Shadow::Cone].map(|shadow| {
            let mut scene = Scene { base: Base::Terrain {}, ..Scene::default() };
            scene.trace.shadow = shadow;
            scene.light.half_angle_degrees = half_angle_degrees;
            let heights = base::heights(&scene).expect("a terrain is procedural");
            Relief::of(gpu, &scene, heights)
        });
        let [none, hard, cone] = medians(gpu, &mut reliefs, 15)[..] else { unreachable!("three reliefs have three medians") };
        let (pass, alone) = (cone / hard, (cone - none) / (hard - none));
        println!(
            "relief 640×480, {half_angle_degrees}°: none {none:.1} ms, hard {hard:.1} ms, cone {cone:.1} ms, {pass:.2} times hard, \
             the shadow alone {alone:.2} times"
        );
        assert!(pass <= CONE_BUDGET, "{cone} ms of {hard} ms");
    }
}

/// Printed, not held: [PDM] fig. 21 has a whole frame grow by 1.28 from 256² to 2048².
#[test]
fn how_exact_grows_with_the_field() {
    let Some(gpu) = gpu() else { return };
    let sizes = [256, 512, 1024, 2048];
    let mut reliefs = sizes.map(|size| Relief::new(gpu, Technique::Exact, size));
    let medians = medians(gpu, &mut reliefs, 15);
    for (size, median) in sizes.iter().zip(&medians) {
        println!("exact over {size}²: {median:.1} ms, {:.2} times 256²", median / medians[0]);
    }
}

#[test]
fn the_first_picture_takes_at_most_two_seconds() {
    if gpu().is_none() {
        return;
    }
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    // The least of five: other tests run beside.
    let least = (0..5)
        .map(|_| {
            let start = Instant::now();
            capture(directory.path(), &[]);
            start.elapsed()
        })
        .min()
        .unwrap_or(Duration::MAX);
    println!("first picture after {least:?}");
    assert!(least <= FIRST_PICTURE, "{least:?}");
}
