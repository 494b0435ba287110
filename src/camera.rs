//! Cameras: where the surface is seen from, as matrices in f64.
//!
//! [`Camera`] is what a frame takes. [`Camera::at`] makes it from a scene as a pure function of time, for files and numbers;
//! [`Rig`] makes it under a hand, for a window: it follows the scene until the hand takes hold, then orbits a target or flies.
//!
//! View space is right-handed and looks down −z: x to the right of the picture, y to its top. Directions round the vertical are
//! counted as the light's are: from +x toward +z. Lengths are metres, angles radians.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DMat4, DVec2, DVec3, DVec4};

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
        let (eye, target) = (DVec3::from(scene.eye), DVec3::from(scene.target));
        let angle = (scene.orbit_degrees_per_second * time_seconds).rem_euclid(360.0).to_radians();
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

/// By how much an eye moves, for each metre of distance, so that what lies at that distance moves by `drag` in the picture: picture
/// heights, right and down.
fn shift(camera: &Camera, drag: DVec2) -> DVec3 {
    let half_height = (0.5 * camera.vertical_fov_radians).tan();
    let (right, up) = (camera.world_from_view.x_axis.truncate(), camera.world_from_view.y_axis.truncate());
    2.0 * half_height * (up * drag.y - right * drag.x)
}

/// The matrix of unit axes: `right` level and perpendicular to `back`.
fn world_from_view(eye: DVec3, right: DVec3, back: DVec3) -> DMat4 {
    DMat4::from_cols(right.extend(0.0), back.cross(right).extend(0.0), back.extend(0.0), eye.extend(1.0))
}

/// A direction in polar angles.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Heading {
    /// Round the vertical, from +x toward +z.
    azimuth: f64,
    /// Above the horizon.
    elevation: f64,
}

impl Heading {
    /// Of the direction backwards through `camera`. Where that is vertical, the azimuth is the one that keeps the picture's right.
    fn behind(camera: &Camera) -> Self {
        let (right, back) = (camera.world_from_view.x_axis, camera.world_from_view.z_axis);
        // Level and perpendicular to `right` by construction: a better witness than `back`, which may be vertical.
        Self { azimuth: right.x.atan2(-right.z), elevation: back.y.clamp(-1.0, 1.0).asin() }
    }

    /// The unit vector that points this way.
    fn direction(self) -> DVec3 {
        let (sin, cos) = self.azimuth.sin_cos();
        let (rise, level) = self.elevation.sin_cos();
        DVec3::new(level * cos, rise, level * sin)
    }

    /// The unit vector to the right of a camera that has this direction at its back.
    fn right(self) -> DVec3 {
        let (sin, cos) = self.azimuth.sin_cos();
        DVec3::new(sin, 0.0, -cos)
    }

    fn turned(self, azimuth: f64, elevation: f64, lowest: f64) -> Self {
        Self {
            azimuth: (self.azimuth + azimuth).rem_euclid(TAU),
            elevation: (self.elevation + elevation).clamp(lowest, FRAC_PI_2),
        }
    }
}

/// What moves the camera of a window.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Motion {
    /// The scene's own path.
    Scene,
    /// Round a target, at a distance, with a direction from the target to the eye.
    Orbit { target: DVec3, distance: f64, heading: Heading },
    /// Freely, with the direction at its back.
    Fly { eye: DVec3, heading: Heading },
}

/// The camera of a window. See the module's documentation.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    scene: scene::Camera,
    motion: Motion,
    fly_metres_per_second: f64,
    aside: DVec2,
}

impl Rig {
    /// Nearest and farthest that an orbit comes to its target, metres.
    pub const DISTANCE_METRES: [f64; 2] = [0.02, 50.0];
    /// Slowest and fastest flight, metres a second.
    pub const FLY_METRES_PER_SECOND: [f64; 2] = [0.01, 20.0];
    /// The least elevation of an orbit, radians: beneath the plane there is nothing to see.
    pub const LEAST_ELEVATION: f64 = 0.01;
    /// A target may be dragged as far from the origin as this, metres, so that it is not lost.
    const FARTHEST_TARGET_METRES: f64 = 20.0;

    /// Follows the camera of a scene.
    pub fn new(scene: scene::Camera) -> Self {
        Self { scene, motion: Motion::Scene, fly_metres_per_second: 0.5, aside: DVec2::ZERO }
    }

    /// Back to the scene's own camera.
    pub fn reset(&mut self) {
        self.motion = Motion::Scene;
    }

    /// Whether no hand has taken hold since the last reset.
    pub fn follows_scene(&self) -> bool {
        self.motion == Motion::Scene
    }

    /// Whether it flies.
    pub fn flies(&self) -> bool {
        matches!(self.motion, Motion::Fly { .. })
    }

    /// How fast it flies, metres a second.
    pub fn fly_metres_per_second(&self) -> f64 {
        self.fly_metres_per_second
    }

    /// Sets the vertical field of view, degrees.
    pub fn set_vertical_fov_degrees(&mut self, degrees: f64) {
        self.scene.vertical_fov_degrees = degrees;
    }

    /// Keeps what the camera looks at aside from the middle of the picture, as [`Camera::lens_shift`]: in the middle of what a panel
    /// leaves free.
    pub fn set_aside(&mut self, aside: DVec2) {
        self.aside = aside;
    }

    /// The camera, `time_seconds` after the scene's start.
    pub fn camera(&self, time_seconds: f64) -> Camera {
        Camera { lens_shift: self.aside, ..self.centred(time_seconds) }
    }

    /// The camera, with its target in the middle of the picture whatever is aside.
    pub fn centred(&self, time_seconds: f64) -> Camera {
        let (eye, heading) = match self.motion {
            Motion::Scene => return Camera::at(&self.scene, time_seconds),
            Motion::Orbit { target, distance, heading } => (target + distance * heading.direction(), heading),
            Motion::Fly { eye, heading } => (eye, heading),
        };
        Camera {
            world_from_view: world_from_view(eye, heading.right(), heading.direction()),
            vertical_fov_radians: self.scene.vertical_fov_degrees.to_radians(),
            near_metres: self.scene.near_metres,
            lens_shift: DVec2::ZERO,
        }
    }

    /// Takes hold, at `time_seconds`: an orbit that starts where the scene's camera is.
    fn take_hold(&mut self, time_seconds: f64) {
        if self.motion == Motion::Scene {
            let camera = self.centred(time_seconds);
            let target = DVec3::from(self.scene.target);
            let distance = camera.eye().distance(target).max(Self::DISTANCE_METRES[0]);
            self.motion = Motion::Orbit { target, distance, heading: Heading::behind(&camera) };
        }
    }

    /// Turns by a drag: round the target, or in flight the head. `drag` is in picture heights, right and down; the height of the
    /// picture makes half a turn.
    pub fn turn(&mut self, drag: DVec2, time_seconds: f64) {
        self.take_hold(time_seconds);
        let angles = drag * (TAU / 2.0);
        match &mut self.motion {
            Motion::Scene => {}
            // The surface follows the pointer: dragged right it turns right, so the eye goes left; dragged down it tips toward us.
            Motion::Orbit { heading, .. } => {
                *heading = heading.turned(angles.x, angles.y, Self::LEAST_ELEVATION.min(heading.elevation));
            }
            // The world follows the pointer, at half the rate: one looks more finely than one walks round.
            Motion::Fly { heading, .. } => *heading = heading.turned(-0.5 * angles.x, 0.5 * angles.y, -FRAC_PI_2),
        }
    }

    /// Shifts by a drag, so that what lies at the target's distance follows the pointer. `drag` is in picture heights, right and
    /// down.
    pub fn pan(&mut self, drag: DVec2, time_seconds: f64) {
        self.take_hold(time_seconds);
        let shift = shift(&self.centred(time_seconds), drag);
        match &mut self.motion {
            Motion::Scene => {}
            Motion::Orbit { target, distance, .. } => {
                let farthest = DVec3::splat(Self::FARTHEST_TARGET_METRES);
                *target = (*target + *distance * shift).clamp(-farthest, farthest);
            }
            Motion::Fly { eye, .. } => *eye += shift,
        }
    }

    /// Goes nearer by `notches` of a wheel, a tenth of the distance each; in flight it makes the flight faster instead.
    pub fn zoom(&mut self, notches: f64, time_seconds: f64) {
        self.take_hold(time_seconds);
        let factor = 0.9_f64.powf(notches.clamp(-50.0, 50.0));
        match &mut self.motion {
            Motion::Scene => {}
            Motion::Orbit { distance, .. } => {
                *distance = (*distance * factor).clamp(Self::DISTANCE_METRES[0], Self::DISTANCE_METRES[1]);
            }
            Motion::Fly { .. } => {
                let [slowest, fastest] = Self::FLY_METRES_PER_SECOND;
                self.fly_metres_per_second = (self.fly_metres_per_second / factor).clamp(slowest, fastest);
            }
        }
    }

    /// Changes between orbit and flight without a jump. An orbit that follows goes round the point at which the flight looked, as
    /// far away as the plane is along that line, or a metre where it does not meet it.
    pub fn toggle_fly(&mut self, time_seconds: f64) {
        self.take_hold(time_seconds);
        self.motion = match self.motion {
            Motion::Scene => Motion::Scene,
            Motion::Orbit { target, distance, heading } => Motion::Fly { eye: target + distance * heading.direction(), heading },
            Motion::Fly { eye, heading } => {
                let to_plane = eye.y / heading.direction().y;
                let distance = if to_plane > Self::DISTANCE_METRES[0] && to_plane < 5.0 { to_plane } else { 1.0 };
                Motion::Orbit { target: eye - distance * heading.direction(), distance, heading }
            }
        };
    }

    /// Flies for `seconds`, if it flies. `movement` is to the right, up and forward, each −1 to 1.
    pub fn fly(&mut self, movement: DVec3, seconds: f64) {
        if let Motion::Fly { eye, heading } = &mut self.motion {
            let velocity = movement.x * heading.right() + movement.y * DVec3::Y - movement.z * heading.direction();
            *eye += velocity.clamp_length_max(1.0) * self.fly_metres_per_second * seconds;
        }
    }
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
    fn sends_the_middle_pixel_to_the_target_and_the_top_one_by_half_the_field_of_view() {
        let camera = Camera::at(&tilted(), 0.0);
        let middle = camera.direction(DVec2::new(320.0, 240.0), [640, 480]);
        assert!(middle.abs_diff_eq(camera.forward(), NEAR));
        let top = camera.direction(DVec2::new(320.0, 0.0), [640, 480]);
        assert!((top.angle_between(middle) - 0.5 * camera.vertical_fov_radians).abs() < 1e-9);
        assert!(top.dot(camera.world_from_view.y_axis.truncate()) > 0.0);
    }

    #[test]
    fn is_taken_over_without_a_jump() {
        for eye in [[0.3, 1.2, 0.9], [0.1, 2.0, 0.2], [-1.0, 0.0, 0.0]] {
            let scene = scene::Camera { eye, ..tilted() };
            let mut rig = Rig::new(scene.clone());
            assert!(rig.follows_scene());
            rig.turn(DVec2::ZERO, 1.5);
            assert!(!rig.follows_scene());
            assert_close(&rig.camera(99.0), &Camera::at(&scene, 1.5));
            rig.toggle_fly(99.0);
            assert!(rig.flies());
            assert_close(&rig.camera(99.0), &Camera::at(&scene, 1.5));
            rig.toggle_fly(99.0);
            assert!(!rig.flies());
            assert_close(&rig.camera(99.0), &Camera::at(&scene, 1.5));
            rig.reset();
            assert_eq!(rig.camera(1.5), Camera::at(&scene, 1.5));
        }
    }

    #[test]
    fn lets_the_surface_follow_a_pan() {
        let mut rig = Rig::new(tilted());
        let before = rig.camera(0.0);
        rig.pan(DVec2::new(0.25, -0.125), 0.0);
        let camera = rig.camera(0.0);
        let target = camera.world_from_view.inverse().transform_point3(DVec3::from(tilted().target));
        let height = 2.0 * -target.z * (0.5 * camera.vertical_fov_radians).tan();
        assert!((target.x / height - 0.25).abs() < NEAR && (target.y / height - 0.125).abs() < NEAR, "{target}");
        assert!(camera.forward().abs_diff_eq(before.forward(), NEAR));
    }

    #[test]
    fn shifts_the_picture_and_nothing_else() {
        let mut rig = Rig::new(tilted());
        let camera = rig.camera(0.0);
        rig.set_aside(DVec2::new(0.25, -0.125));
        let shifted = rig.camera(0.0);
        let direction = |camera: &Camera, x, y| camera.direction(DVec2::new(x, y), [640, 480]);
        assert!(direction(&shifted, 320.0 + 120.0, 240.0 - 60.0).abs_diff_eq(camera.forward(), NEAR));
        assert!(direction(&shifted, 10.0 + 120.0, 470.0 - 60.0).abs_diff_eq(direction(&camera, 10.0, 470.0), NEAR));
        assert_eq!(rig.centred(0.0), camera);
    }

    #[test]
    fn keeps_its_target_and_its_bounds_while_it_turns_and_zooms() {
        let mut rig = Rig::new(tilted());
        let distance = |rig: &Rig| rig.camera(0.0).eye().distance(DVec3::from(tilted().target));
        let before = distance(&rig);
        rig.zoom(1.0, 0.0);
        assert!((distance(&rig) - 0.9 * before).abs() < NEAR);
        rig.zoom(1e9, 0.0);
        rig.zoom(1e9, 0.0);
        assert!((distance(&rig) - Rig::DISTANCE_METRES[0]).abs() < NEAR);
        rig.turn(DVec2::new(0.7, -9.0), 0.0);
        assert!((distance(&rig) - Rig::DISTANCE_METRES[0]).abs() < NEAR);
        assert!(rig.camera(0.0).eye().y > tilted().target[1]);
        rig.turn(DVec2::new(0.0, 9.0), 0.0);
        assert!(rig.camera(0.0).forward().abs_diff_eq(-DVec3::Y, NEAR));
        assert!(rig.camera(0.0).world_from_view.is_finite());
    }

    #[test]
    fn flies_where_it_looks_and_only_when_it_flies() {
        let mut rig = Rig::new(tilted());
        rig.fly(DVec3::Z, 1.0);
        assert!(rig.follows_scene());
        rig.toggle_fly(0.0);
        let before = rig.camera(0.0);
        rig.fly(DVec3::new(0.0, 0.0, 1.0), 2.0);
        let expected = before.eye() + before.forward() * 2.0 * rig.fly_metres_per_second();
        assert!(rig.camera(0.0).eye().abs_diff_eq(expected, NEAR));
        rig.fly(DVec3::ONE, 1.0);
        assert!(rig.camera(0.0).eye().distance(expected) <= rig.fly_metres_per_second() + NEAR);
    }
}
