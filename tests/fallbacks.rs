//! What WebGPU's baseline lacks has a fallback. Software adapters offer nearly everything, so features are masked here.

use rilievo::camera::Camera;
use rilievo::clock::Tick;
use rilievo::field::base;
use rilievo::frame::{Frame, FrameInput, Start};
use rilievo::gpu::adapter::OPTIONAL_FEATURES;
use rilievo::gpu::{Gpu, Preference};
use rilievo::modes::capture::{PICTURE_FORMAT, Picture, read_channels};
use rilievo::scene::{Base, Scene};
use rilievo::stroke::Strokes;
use rilievo::surface::channels::Channel;
use rilievo::surface::{Channels, Choice, Shadow, Shows, Technique};

use crate::support::gpu::gpu;
use crate::support::tolerances::FILTERED_HEIGHT;

/// A device that does without these features.
fn masked(masked_features: wgpu::Features) -> Gpu {
    let preference = Preference { software_first: true, masked_features, ..Preference::default() }.with_environment();
    pollster::block_on(Gpu::new(&preference)).expect("the shared device was opened with less")
}

/// A still relief through `pom`, which samples by the filter where there is one.
fn pom_channels(gpu: &Gpu) -> (Vec<Channel>, bool) {
    let mut scene = Scene { base: Base::Terrain {}, ..Scene::default() };
    scene.field.size = [128, 128];
    scene.trace.technique = Technique::Pom;
    scene.trace.shadow = Shadow::PomSoft;
    let start = Start::new(&scene, base::heights(&scene).expect("a terrain is procedural"), None);
    let size = [96, 64];
    let mut frame = Frame::new(gpu, &start, size, PICTURE_FORMAT).expect("it is small, and its shaders compile");
    let picture = Picture::new(gpu, size);
    let pass = Channels::new(gpu, Choice::of(&scene)).expect("its shaders compile");
    let camera = Camera::at(&scene.camera, 0.0);
    let (tick, strokes) = (Tick::default(), Strokes::default());
    let input = FrameInput { tick: &tick, strokes: &strokes, camera: &camera, display: Shows::Picture.into() };
    let mut encoder = gpu.encoder("fallback");
    frame.record(gpu, &mut encoder, &input, Some(picture.view())).expect("there are no strokes");
    frame.finish(gpu, encoder);
    let channels = read_channels(gpu, &frame, &pass, &input).expect("the device is there");
    let times = frame.timer.finished_frame().unwrap_or_default();
    assert!(!times.is_empty(), "passes are named, timed or not");
    assert_eq!(gpu.take_error(), None);
    (channels, times.iter().any(|time| time.milliseconds.is_some()))
}

#[test]
fn without_filtering_and_timestamps_the_picture_is_the_same() {
    let Some(shared) = gpu() else { return };
    let bare = masked(OPTIONAL_FEATURES);
    assert!(!bare.filters_r32float() && !bare.has_timestamps());
    let (bare_channels, bare_timed) = pom_channels(&bare);
    assert!(!bare_timed, "no timestamps, no times");
    let (channels, timed) = pom_channels(shared);
    assert_eq!(timed, shared.has_timestamps());
    let shown = channels.iter().filter(|pixel| pixel.steps >= 0.0).count();
    assert!(shown > 1000);
    // A ray that grazes a spike may meet it through one and miss it through the other.
    let apart =
        channels.iter().zip(&bare_channels).filter(|(a, b)| f64::from((a.height - b.height).abs()) > FILTERED_HEIGHT).count();
    println!("{apart} of {shown} pixels differ by more than {FILTERED_HEIGHT} in height");
    assert!(apart * 100 < shown, "{apart} of {shown} pixels differ");
}

#[test]
fn each_feature_can_be_missed_alone() {
    if gpu().is_none() {
        return;
    }
    for feature in OPTIONAL_FEATURES.iter() {
        let device = masked(feature);
        assert!(!device.device.features().contains(feature));
        pom_channels(&device);
    }
}
