//! The camera of a window: it follows the scene until a hand takes hold, then orbits a target or flies.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec2, DVec3};

use super::{Camera, world_from_view};
use crate::scene;

/// By how much an eye moves, for each metre of distance, so that what lies at that distance moves by `drag` in the picture: picture
/// heights, right and down.
fn shift(camera: &Camera, drag: DVec2) -> DVec3 {
    let half_height = (0.5 * camera.vertical_fov_radians).tan();
    let (right, up) = (camera.world_from_view.x_axis.truncate(), camera.world_from_view.y_axis.truncate());
    2.0 * half_height * (up * drag.y - right * drag.x)
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
            let flown = DVec3::from(self.scene.fly_metres_per_second) * time_seconds;
            let target = DVec3::from(self.scene.target) + flown;
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
