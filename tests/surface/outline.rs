//! The outline of the plane: every pixel that shows some of it lies within, and little else.

use glam::{DVec2, DVec3};
use rilievo::camera::Camera;
use rilievo::surface::outline::{self, CORNERS_MAX};
use rilievo::surface::ray_map::{self, Placement, Target};

const IMAGE: [u32; 2] = [96, 64];

/// The field is wider than it is high, and lies aslant.
fn target() -> Target {
    let (u, up) = (DVec3::new(0.8, 0.0, -0.6), DVec3::new(0.36, 0.8, 0.48));
    let placement = Placement { origin: DVec3::new(0.2, -0.1, 0.3), u, v: u.cross(up), up };
    assert!(placement.v.is_normalized());
    Target { placement, field_size: [64, 32], plane_size_metres: [2.0, 1.0], depth_metres: 0.1 }
}

/// The outline's corners in pixels.
fn outline_of(camera: &Camera, repeat: DVec2) -> Vec<DVec2> {
    let target = target();
    let size = DVec2::new(64.0, 32.0);
    let forms = ray_map::exact_forms(camera, IMAGE, &target);
    let corners = outline::corners(&forms, target.placement.local(camera.eye()).y, IMAGE, 0.5 * repeat * size, 0.5 * size - 0.5);
    let image = DVec2::from(IMAGE.map(f64::from));
    let pixel = |[x, y]: [f32; 2]| DVec2::new(0.5 + 0.5 * f64::from(x), 0.5 - 0.5 * f64::from(y)) * image;
    corners.map(pixel).to_vec()
}

/// Whether a point lies in one of the triangles that are drawn.
fn is_inside(corners: &[DVec2], point: DVec2) -> bool {
    (1..corners.len() - 1).any(|k| {
        let [a, b, c] = [corners[0], corners[k], corners[k + 1]];
        let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(point - from));
        (b - a).perp_dot(c - a) != 0.0 && (sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0))
    })
}

/// Whether the ray through a point of the picture meets the plane within its border, from above and before the eye.
fn shows_plane(camera: &Camera, repeat: DVec2, point: DVec2) -> bool {
    let Target { placement, plane_size_metres, .. } = target();
    let (eye, direction) = (placement.local(camera.eye()), placement.turned(camera.direction(point, IMAGE)));
    if direction.y >= 0.0 || eye.y <= 0.0 {
        return false;
    }
    let meets = eye + eye.y / -direction.y * direction;
    (DVec2::new(meets.x, meets.z).abs() - 0.5 * repeat * DVec2::from(plane_size_metres)).max_element() <= 0.0
}

/// From above, from close by, along the plane, from under it, with the plane on all sides of the eye and behind it.
fn cameras() -> Vec<Camera> {
    let placement = target().placement;
    let look = |eye: [f64; 3], aim: [f64; 3]| {
        let [eye, aim] = [eye, aim].map(|[u, up, v]| placement.world(DVec3::new(u, up, v)));
        Camera::look_at(eye, aim, 0.8, 0.01)
    };
    vec![
        look([0.0, 2.5, 2.0], [0.0, 0.0, 0.0]),
        look([0.3, 0.2, 0.1], [0.9, 0.0, -0.4]),
        look([0.0, 0.05, 0.0], [1.0, 0.02, 0.1]),
        look([-0.9, 1e-4, 0.3], [1.0, 0.0, -0.2]),
        look([0.0, 1e-9, 0.0], [1.0, 0.0, 0.3]),
        look([0.0, 0.5, 0.0], [0.2, 1.0, 0.1]),
        look([0.0, 0.5, 0.0], [1e-3, 0.0, 0.0]),
        look([0.0, -0.5, 0.4], [0.0, 0.0, 0.0]),
        look([0.0, -0.5, 0.4], [0.0, -1.0, 0.0]),
        look([5.0, 0.6, 0.0], [9.0, 0.0, 0.0]),
        look([40.0, 9.0, 3.0], [0.0, 0.0, 0.0]),
        look([1.02, 0.3, 0.52], [0.9, 0.0, 0.4]),
        look([0.0, 0.02, 3.0], [0.0, 0.0, 0.0]),
    ]
}

/// Pixels that show some of the plane are drawn, however the plane lies to the eye; of those more than two pixels off no more than
/// two rows are, where borders that meet at an acute angle have their corner farther out.
#[test]
fn what_shows_the_plane_lies_within() {
    let (mut drawn, mut left_out) = (0, 0);
    for (index, camera) in cameras().iter().enumerate() {
        for repeat in [DVec2::ONE, DVec2::new(3.0, 1.0), DVec2::splat(1e4)] {
            let corners = outline_of(camera, repeat);
            assert_eq!(corners.len(), CORNERS_MAX);
            let mut wasted = 0;
            assert!(corners.iter().all(|corner| corner.is_finite()), "camera {index}: {corners:?}");
            for y in 0..IMAGE[1] {
                for x in 0..IMAGE[0] {
                    let centre = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                    let around = |radius: f64, steps: i32| {
                        let offset = move |i: i32| radius * f64::from(i) / f64::from(steps);
                        (-steps..=steps).any(|i| {
                            (-steps..=steps).any(|j| shows_plane(camera, repeat, centre + DVec2::new(offset(i), offset(j))))
                        })
                    };
                    let inside = is_inside(&corners, centre);
                    if around(0.35, 1) {
                        assert!(inside, "camera {index}, repeated {repeat}: {centre} is left out of {corners:?}");
                        drawn += 1;
                    } else if !around(2.0, 4) {
                        wasted += u32::from(inside);
                        left_out += u32::from(!inside);
                    }
                }
            }
            assert!(wasted <= 2 * IMAGE[0], "camera {index}, repeated {repeat}: {wasted} pixels too many within {corners:?}");
        }
    }
    assert!(drawn > 50_000 && left_out > 50_000, "{drawn} drawn, {left_out} left out");
}
