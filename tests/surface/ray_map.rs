//! The rays of pixels: splitting loses nothing, and the shader's rays are the geometry's even at grazing angles.

use glam::DVec3;
use rilievo::camera::Camera;
use rilievo::field::Field;
use rilievo::reference;
use rilievo::scene::{Addressing, Scene};
use rilievo::surface::channels::{Channel, Channels};
use rilievo::surface::ray_map::{LinearForm, Placement, Target};
use rilievo::surface::{Choice, Shadow, Shows, Technique, View};

use crate::support::gpu::{gpu, wait_for};
use crate::support::tolerances::lattice_bound;

/// Products and partial sums of the exact part are exact in f32 for every pixel centre and corner, whatever the coefficients.
#[test]
fn the_exact_part_never_rounds() {
    let size = [4096, 2160];
    for coefficients in
        [DVec3::new(1.0 / 3.0, -0.7, 1234.567), DVec3::new(-1e-3, std::f64::consts::PI, -2000.0), DVec3::new(1e4, 1e-4, 0.1)]
    {
        let form = LinearForm::new(coefficients, size);
        for x in (0..=2 * size[0]).step_by(7) {
            for y in (0..=2 * size[1]).step_by(601) {
                let (px, py) = (0.5 * x as f32, 0.5 * y as f32);
                let [a, b, c, _] = form.exact;
                let exact = f64::from(a) * f64::from(px) + f64::from(b) * f64::from(py) + f64::from(c);
                assert_eq!(f64::from((a * px + b * py) + c), exact, "{coefficients} at {px}, {py}");
                assert_eq!(f64::from(a * px + (b * py + c)), exact, "{coefficients} at {px}, {py}, the other order");
                let whole = coefficients.dot(DVec3::new(f64::from(px), f64::from(py), 1.0));
                let rest = form.rest[0] * px + form.rest[1] * py + form.rest[2];
                let scale = coefficients.abs().dot(DVec3::new(f64::from(size[0]), f64::from(size[1]), 1.0));
                // 2⁻²² of the grid, of which f32 loses 2⁻²² again, with the sum over some 2¹² pixels.
                let error = (exact + f64::from(rest) - whole).abs();
                assert!(error <= scale * 2f64.powi(-22 + 12 - 22), "{coefficients} at {px}, {py}: {error:e}");
            }
        }
    }
}

/// With `normal` a pixel's uv is where its ray meets the plane.
#[test]
fn rays_meet_the_plane_where_geometry_says() {
    let Some(gpu) = gpu() else { return };
    let mut scene = Scene::default();
    scene.field.size = [1024, 512];
    scene.trace.technique = Technique::Normal;
    scene.trace.shadow = Shadow::None;
    let field = Field::new(gpu, scene.field.size, Addressing::Clamp, false);
    let pass = Channels::new(gpu, Choice::of(&scene)).expect("its shaders compile");
    let image_size = [320, 240];
    let target = Target {
        placement: Placement::default(),
        field_size: scene.field.size,
        plane_size_metres: scene.plane_size_metres(),
        depth_metres: f64::from(scene.plane.depth_metres),
    };
    let mut worst = 0.0_f64;
    for (eye, aim) in [
        ([0.0, 1.2, 0.9], [0.0, 0.0, 0.0]),
        ([0.3, 0.7, -0.2], [0.1, 0.0, 0.05]),
        ([-0.6, 0.012, 0.35], [0.2, 0.0, -0.1]),
        ([0.5, 2.0, 0.0], [0.5, 0.0, 0.0]),
    ] {
        let camera = Camera::look_at(eye.into(), DVec3::from(aim), 45f64.to_radians(), 0.01);
        let view = View::new(&scene, &camera, 0.0, image_size, Shows::Picture);
        let readback = pass.request(gpu, &field, &view, 0, image_size[1]);
        let pixels: Vec<Channel> = bytemuck::pod_collect_to_vec(&wait_for(gpu, &readback));
        let mut shown = 0;
        for (index, pixel) in pixels.iter().enumerate().filter(|(_, pixel)| pixel.steps >= 0.0) {
            let [x, y] = [index % image_size[0] as usize, index / image_size[0] as usize];
            let ray = reference::ray_map::ray(&camera, image_size, &target, [x as f64 + 0.5, y as f64 + 0.5])
                .unwrap_or_else(|| panic!("pixel {x}, {y} shows the plane but looks up"));
            for axis in 0..2 {
                let size = f64::from(scene.field.size[axis]);
                let lattice = f64::from(pixel.uv[axis]) * size - 0.5;
                let error = (lattice - ray.lattice[axis]).abs();
                let bound = lattice_bound(size);
                assert!(error <= bound, "camera at {eye:?}, pixel {x}, {y}: {error:e} cells, {bound:e} allowed");
                worst = worst.max(error / bound);
            }
            shown += 1;
        }
        assert!(shown > 500, "camera at {eye:?} shows {shown} pixels of the plane");
    }
    println!("worst error: {:.2} of the bound", worst);
}
