//! Balls: seen where geometry has them, half sunk where the relief covers them, their shadow upon it.

use glam::{DVec2, DVec3};
use rilievo::camera::Camera;
use rilievo::reference::{Addressing, HeightField, balls};
use rilievo::scene::Ball;

use crate::support::gpu::gpu;
use crate::support::seen::{scene_of, seen};

const SIZE: [u32; 2] = [240, 160];

/// The plane of a flat field at half the depth, a ball half sunk into it.
#[test]
fn a_ball_half_sunk_is_seen_above_the_relief_and_casts_its_shadow() {
    let Some(gpu) = gpu() else { return };
    let field = HeightField::from_fn([64, 64], Addressing::Clamp, |_, _| 0.5);
    let mut scene = scene_of(&field);
    scene.trace.displaced_depth = true;
    let floor = -0.5 * f64::from(scene.plane.depth_metres);
    let (centre, radius) = (DVec3::new(0.1, floor, 0.05), 0.2);
    scene.balls = vec![Ball { centre: centre.as_vec3().to_array(), radius_metres: radius as f32, colour: [0.5, 0.1, 0.1] }];
    let camera = Camera::look_at(DVec3::new(0.3, 0.9, 1.0), DVec3::ZERO, 0.9, 0.01);
    let (channels, _) = seen(gpu, &scene, &field, None, &camera, SIZE);
    let light = rilievo::surface::view::light_direction(&scene, 0.0);
    let (mut ball_pixels, mut dark, mut lit) = (0, 0, 0);
    for (index, channel) in channels.iter().enumerate() {
        let pixel = DVec2::new((index as u32 % SIZE[0]) as f64 + 0.5, (index as u32 / SIZE[0]) as f64 + 0.5);
        let (eye, direction) = (camera.eye(), camera.direction(pixel, SIZE));
        let to_floor = (floor - eye.y) / direction.y;
        let to_ball = balls::hit(centre, radius, eye, direction);
        let at = eye + to_floor * direction;
        let entry = eye - eye.y / direction.y * direction;
        // Pixels at an edge, of the plane or of the ball, may be either.
        let edge = (entry.x.abs() - 0.5).abs() < 5e-3 || (entry.z.abs() - 0.5).abs() < 5e-3;
        let rim = balls::hit(centre, 0.98 * radius, eye, direction).is_some()
            != balls::hit(centre, 1.02 * radius, eye, direction).is_some();
        if edge || rim || (at.distance(centre) - radius).abs() < 5e-3 {
            continue;
        }
        let on_plane = entry.x.abs() < 0.5 && entry.z.abs() < 0.5;
        if to_ball.is_some_and(|to_ball| to_ball < to_floor) {
            assert!(channel.steps < 0.0, "pixel {pixel} shows the ball");
            ball_pixels += 1;
        } else if on_plane {
            assert!(channel.steps >= 0.0, "pixel {pixel} shows the relief");
            let shadowed = balls::hit(centre, radius, at, light).is_some();
            let near =
                balls::hit(centre, 0.97 * radius, at, light).is_some() != balls::hit(centre, 1.03 * radius, at, light).is_some();
            if !near {
                assert_eq!(channel.visibility, if shadowed { 0.0 } else { 1.0 }, "pixel {pixel}");
                dark += usize::from(shadowed);
                lit += usize::from(!shadowed);
            }
        }
    }
    assert!(ball_pixels > 500 && dark > 200 && lit > 2_000, "{ball_pixels} {dark} {lit}");
}

/// Behind the switch: with the polygon's depth the sunk half of the relief hides the ball up to the reference surface.
#[test]
fn the_polygons_depth_hides_more_of_the_ball_than_the_reliefs() {
    let Some(gpu) = gpu() else { return };
    let field = HeightField::from_fn([64, 64], Addressing::Clamp, |_, _| 0.2);
    let camera = Camera::look_at(DVec3::new(0.0, 0.9, 1.0), DVec3::ZERO, 0.9, 0.01);
    let hidden = |displaced_depth| {
        let mut scene = scene_of(&field);
        scene.trace.displaced_depth = displaced_depth;
        scene.balls = vec![Ball { centre: [0.0, -0.04, 0.0], radius_metres: 0.1, colour: [0.5; 3] }];
        let (channels, _) = seen(gpu, &scene, &field, None, &camera, SIZE);
        channels.iter().filter(|channel| channel.steps >= 0.0).count()
    };
    let (polygon, relief) = (hidden(false), hidden(true));
    assert!(polygon > relief + 30, "the relief shows in {polygon} pixels by the polygon's depth, in {relief} by its own");
}
