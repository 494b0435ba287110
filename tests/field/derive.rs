//! What is derived from the heights, and when.

use rilievo::camera::Camera;
use rilievo::clock::Tick;
use rilievo::field::stamp::Stamp;
use rilievo::frame::{Frame, FrameInput, Start};
use rilievo::gpu::Gpu;
use rilievo::scene::{Base, Scene};
use rilievo::stroke::Strokes;
use rilievo::surface::{Display, Shadow, Shows, Split, Technique};

use crate::support::gpu::{gpu, read};

/// A frame over a small terrain, and what it is shown in.
struct Watched<'a> {
    gpu: &'a Gpu,
    frame: Frame,
    target: wgpu::TextureView,
}

impl<'a> Watched<'a> {
    fn new(gpu: &'a Gpu, technique: Technique) -> Self {
        let mut scene = Scene { base: Base::Terrain {}, ..Scene::default() };
        scene.field.size = [100, 70];
        scene.trace.technique = technique;
        let heights = rilievo::field::base::heights(&scene).expect("it is procedural");
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let frame = Frame::new(gpu, &Start::new(&scene, heights, None), [16, 16], format).expect("its shaders compile");
        let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: 16, height: 16, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        Self { gpu, frame, target: target.create_view(&wgpu::TextureViewDescriptor::default()) }
    }

    /// Records a frame, and reads the pyramid's finest level.
    fn show(&mut self, strokes: &Strokes, display: Display) -> Vec<f32> {
        let (tick, camera) = (Tick::default(), Camera::at(&self.frame.scene().camera, 0.0));
        let input = FrameInput { tick: &tick, strokes, camera: &camera, display };
        let mut encoder = self.gpu.encoder("test");
        self.frame.record(self.gpu, &mut encoder, &input, Some(&self.target)).expect("it fits");
        self.frame.finish(self.gpu, encoder);
        read(self.gpu, &self.frame.field.pyramid)
    }

    fn choose(&mut self, technique: Technique) {
        let mut scene = self.frame.scene().clone();
        scene.trace.technique = technique;
        self.frame.set_scene(self.gpu, &scene).expect("its shaders compile");
    }
}

/// The pyramid is left alone while nothing reads it, and is the whole field's as soon as something does, however little changed last.
#[test]
fn a_pyramid_that_nothing_read_is_whole_once_something_does() {
    let Some(gpu) = gpu() else { return };
    let stroke = |number: u64| Strokes {
        hand: vec![Stamp { centre: [20.0 * number as f32, 35.0], radius: 9.0, height: -0.3, ..Stamp::default() }],
        stroke_number: number,
        ..Strokes::default()
    };
    let (none, picture) = (Strokes::default(), Display::default());
    let split = Split { technique: Technique::Pyramid, shadow: Shadow::None, shows: Shows::Picture, fraction: 0.5 };
    for wanted in ["technique", "side", "view"] {
        let mut always = Watched::new(gpu, Technique::Pyramid);
        let mut late = Watched::new(gpu, Technique::Exact);
        for number in 1..=2 {
            always.show(&stroke(number), picture);
            assert!(late.show(&stroke(number), picture).iter().all(|bound| *bound == 0.0), "nothing reads it");
        }
        let display = match wanted {
            "side" => Display { split: Some(split), ..picture },
            "view" => Shows::LevelCap.into(),
            _ => picture,
        };
        if wanted == "technique" {
            late.choose(Technique::Pyramid);
        }
        let whole = always.show(&none, picture);
        assert!(whole.iter().any(|bound| *bound > 0.0));
        assert!(late.show(&none, display) == whole, "by {wanted}, nothing having changed");
        // What changes now is built alone, …
        assert!(late.show(&stroke(3), display) == always.show(&stroke(3), picture), "by {wanted}, after a stroke");
        // … and what changed while nobody looked is caught up with.
        late.choose(Technique::Exact);
        let unseen = late.show(&stroke(4), picture);
        let pressed = always.show(&stroke(4), picture);
        assert!(unseen != pressed);
        late.choose(Technique::Pyramid);
        assert!(late.show(&none, picture) == pressed, "by {wanted}, again");
    }
}
