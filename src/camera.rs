//! Cameras: where the surface is seen from, as matrices in f64.
//!
//! [`Camera`] is what a frame takes. [`Camera::at`] makes it from a scene as a pure function of time, for files and numbers;
//! [`Rig`] makes it under a hand, for a window: it follows the scene until the hand takes hold, then orbits a target or flies.
//!
//! View space is right-handed and looks down −z: x to the right of the picture, y to its top. Directions round the vertical are
//! counted as the light's are: from +x toward +z. Lengths are metres, angles radians.

mod rig;

use glam::{DMat4, DVec2, DVec3, DVec4};

pub use rig::Rig;

use crate::scene;

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Takes points of view space to the world, metres: a rotation and the eye.
    pub world_from_view: DMat4,
    /// Vertical field of view, radians.
    pub vertical_fov_radians: f64,
    /// Nearest visible distance along −z, metres.
    pub near_metres: f64,
    /// By how much the whole picture is shifted, picture heights, right and down. Only a window shifts it, to make room for a panel.
    pub lens_shift: DVec2,
}

impl Camera {
    /// Looks from `eye` at `target`, both in metres; `vertical_fov_radians` and `near_metres` as in [`Camera`].
    ///
    /// The top of the picture leans toward +y. Straight down and straight up, where that says nothing, +x stays on the right;
    /// from the target itself it looks down −z.
    pub fn look_at(eye: DVec3, target: DVec3, vertical_fov_radians: f64, near_metres: f64) -> Self {
        let back = (eye - target).try_normalize().unwrap_or(DVec3::Z);
        let right = DVec3::new(back.z, 0.0, -back.x).try_normalize().unwrap_or(DVec3::X);
        let world_from_view = world_from_view(eye, right, back);
        Self { world_from_view, vertical_fov_radians, near_metres, lens_shift: DVec2::ZERO }
    }

    /// The camera of a scene, `time_seconds` after its start.
    pub fn at(scene: &scene::Camera, time_seconds: f64) -> Self {
        let flown = DVec3::from(scene.fly_metres_per_second) * time_seconds;
        let (eye, target) = (DVec3::from(scene.eye) + flown, DVec3::from(scene.target) + flown);
        let swung = scene.swing.as_ref().map_or(0.0, |swing| swing.at(time_seconds));
        let angle = (scene.orbit_degrees_per_second * time_seconds + swung).rem_euclid(360.0).to_radians();
        Self::look_at(turn_about(eye, target, angle), target, scene.vertical_fov_degrees.to_radians(), scene.near_metres)
    }

    /// Where it stands, metres.
    pub fn eye(&self) -> DVec3 {
        self.world_from_view.w_axis.truncate()
    }

    /// The unit direction that it looks in.
    pub fn forward(&self) -> DVec3 {
        -self.world_from_view.z_axis.truncate()
    }

    /// The unit direction in the world through `pixel`, counted from the upper left corner of an image of `image_size`. The
    /// centre of the first pixel is (½, ½).
    pub fn direction(&self, pixel: DVec2, image_size: [u32; 2]) -> DVec3 {
        let size = DVec2::new(f64::from(image_size[0]), f64::from(image_size[1]));
        let half_height = (0.5 * self.vertical_fov_radians).tan();
        let x = ((2.0 * pixel.x - size.x) / size.y - 2.0 * self.lens_shift.x) * half_height;
        let y = ((size.y - 2.0 * pixel.y) / size.y + 2.0 * self.lens_shift.y) * half_height;
        (self.world_from_view * DVec4::new(x, y, -1.0, 0.0)).truncate().normalize()
    }
}

/// `eye`, turned by `radians` about the vertical through `target`. Without a turn it keeps its very bits.
fn turn_about(eye: DVec3, target: DVec3, radians: f64) -> DVec3 {
    if radians == 0.0 {
        return eye;
    }
    let (sin, cos) = radians.sin_cos();
    let arm = eye - target;
    DVec3::new(target.x + arm.x * cos - arm.z * sin, eye.y, target.z + arm.x * sin + arm.z * cos)
}

/// The matrix of unit axes: `right` level and perpendicular to `back`.
fn world_from_view(eye: DVec3, right: DVec3, back: DVec3) -> DMat4 {
    DMat4::from_cols(right.extend(0.0), back.cross(right).extend(0.0), back.extend(0.0), eye.extend(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEAR: f64 = 1e-12;

    fn tilted() -> scene::Camera {
        scene::Camera { eye: [0.3, 1.2, 0.9], target: [0.1, -0.05, 0.2], orbit_degrees_per_second: 30.0, ..Default::default() }
    }

    fn assert_close(a: &Camera, b: &Camera) {
        assert!(a.world_from_view.abs_diff_eq(b.world_from_view, NEAR), "{:?}\n{:?}", a.world_from_view, b.world_from_view);
    }

    #[test]
    fn is_a_right_handed_rotation_that_looks_at_its_target() {
        for eye in [[0.3, 1.2, 0.9], [-2.0, 0.1, 0.0], [0.1, -3.0, 0.2], [0.1, 4.0, 0.2]] {
            let camera = Camera::at(&scene::Camera { eye, ..tilted() }, 0.0);
            let rotation = glam::DMat3::from_mat4(camera.world_from_view);
            assert!((rotation.determinant() - 1.0).abs() < NEAR);
            assert!((rotation * rotation.transpose()).abs_diff_eq(glam::DMat3::IDENTITY, NEAR));
            let in_view = camera.world_from_view.inverse().transform_point3(DVec3::from(tilted().target));
            assert!(in_view.x.abs() < NEAR && in_view.y.abs() < NEAR && in_view.z < 0.0, "{in_view}");
            assert_eq!(camera.eye(), DVec3::from(eye));
        }
    }

    #[test]
    fn keeps_the_fields_right_and_top_when_it_looks_straight_down() {
        let camera = Camera::look_at(DVec3::Y, DVec3::ZERO, 1.0, 0.01);
        assert_eq!(camera.world_from_view.x_axis.truncate(), DVec3::X);
        assert_eq!(camera.world_from_view.y_axis.truncate(), -DVec3::Z);
        let nowhere = Camera::look_at(DVec3::Y, DVec3::Y, 1.0, 0.01);
        assert!(nowhere.world_from_view.is_finite());
        assert_eq!(nowhere.forward(), -DVec3::Z);
    }

    #[test]
    fn goes_round_from_x_toward_z() {
        let scene =
            scene::Camera { eye: [1.0, 1.0, 0.0], target: [0.0; 3], orbit_degrees_per_second: 90.0, ..Default::default() };
        assert_eq!(Camera::at(&scene, 0.0).eye(), DVec3::new(1.0, 1.0, 0.0));
        assert!(Camera::at(&scene, 1.0).eye().abs_diff_eq(DVec3::new(0.0, 1.0, 1.0), NEAR));
        assert_close(&Camera::at(&scene, 4.0), &Camera::at(&scene, 0.0));
    }

    #[test]
    fn swings_to_either_side_and_back() {
        let swing = Some(scene::Swing { degrees: 30.0, period_seconds: 8.0 });
        let scene = scene::Camera { eye: [1.0, 1.0, 0.0], target: [0.0; 3], swing, ..Default::default() };
        let azimuth = |time| {
            let eye = Camera::at(&scene, time).eye();
            eye.z.atan2(eye.x).to_degrees()
        };
        for (time, expected) in [(0.0, 0.0), (2.0, 30.0), (4.0, 0.0), (6.0, -30.0), (8.0, 0.0), (1.0, 30.0 * 0.5_f64.sqrt())] {
            assert!((azimuth(time) - expected).abs() < 1e-9, "{time} s: {}", azimuth(time));
        }
    }

    #[test]
    fn sends_the_middle_pixel_to_the_target_and_the_top_one_by_half_the_field_of_view() {
        let camera = Camera::at(&tilted(), 0.0);
        let middle = camera.direction(DVec2::new(320.0, 240.0), [640, 480]);
        assert!(middle.abs_diff_eq(camera.forward(), NEAR));
        let top = camera.direction(DVec2::new(320.0, 0.0), [640, 480]);
        assert!((top.angle_between(middle) - 0.5 * camera.vertical_fov_radians).abs() < 1e-9);
        assert!(top.dot(camera.world_from_view.y_axis.truncate()) > 0.0);
    }
}
