//! What a camera sees of a scene, through the passes that make pictures.

use rilievo::camera::Camera;
use rilievo::clock::Tick;
use rilievo::frame::{Frame, FrameInput, Start};
use rilievo::gpu::Gpu;
use rilievo::mesh::Mesh;
use rilievo::modes::capture::{PICTURE_FORMAT, Picture, read_channels};
use rilievo::reference::HeightField;
use rilievo::scene::Scene;
use rilievo::stroke::Strokes;
use rilievo::surface::channels::Channel;
use rilievo::surface::{Channels, Choice, Display};

/// What every pixel shows, row by row, and the picture, RGBA.
pub fn seen(
    gpu: &Gpu,
    scene: &Scene,
    heights: &HeightField,
    mesh: Option<Mesh>,
    camera: &Camera,
    size: [u32; 2],
) -> (Vec<Channel>, Vec<u8>) {
    seen_from_start(gpu, &Start::new(scene, heights.heights.clone(), mesh), camera, size)
}

/// The same of whatever a frame starts from.
pub fn seen_from_start(gpu: &Gpu, start: &Start, camera: &Camera, size: [u32; 2]) -> (Vec<Channel>, Vec<u8>) {
    let scene = &start.scene;
    let mut frame = Frame::new(gpu, start, size, PICTURE_FORMAT).expect("it is small, and its shaders compile");
    let picture = Picture::new(gpu, size);
    let pass = Channels::new(gpu, Choice::of(scene)).expect("its shaders compile");
    let (tick, strokes) = (Tick::default(), Strokes::default());
    let input = FrameInput { tick: &tick, strokes: &strokes, camera, display: Display::default() };
    let mut encoder = gpu.encoder("seen");
    frame.record(gpu, &mut encoder, &input, Some(picture.view())).expect("there are no strokes");
    frame.finish(gpu, encoder);
    let channels = read_channels(gpu, &frame, &pass, &input).expect("the device is there");
    (channels, picture.read(gpu).expect("the device is there"))
}

/// A scene of this field, with the exact technique and no shadow.
pub fn scene_of(heights: &HeightField) -> Scene {
    let mut scene = Scene::default();
    scene.field.size = heights.size;
    scene.field.addressing = heights.addressing;
    scene.trace.shadow = rilievo::surface::Shadow::None;
    scene
}
