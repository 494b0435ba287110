//! Framing: a scene's own camera shows the whole plane, whatever its aspect and that of the picture.

use glam::{DQuat, DVec3};

use super::{Camera, Plane, Scene};

/// How much of the picture's half width and height the plane's corners may take: a little air remains around it.
const MARGIN: f64 = 0.98;

/// No nearer to the middle of what is framed: some times the near plane's distance.
const NEAREST_METRES: f64 = 0.05;

impl Plane {
    /// Extent along x and z under a field of this size, metres: texels are square.
    pub fn size_metres(&self, field_size: [u32; 2]) -> [f64; 2] {
        let [width, height] = field_size.map(f64::from);
        let x = f64::from(self.width_metres);
        [x, x * height / width]
    }
}

impl Scene {
    /// Extent of the plane along x and z, metres: texels are square.
    pub fn plane_size_metres(&self) -> [f64; 2] {
        self.plane.size_metres(self.field.size)
    }

    /// Side of a texel, metres.
    pub fn texel_metres(&self) -> f64 {
        f64::from(self.plane.width_metres) / f64::from(self.field.size[0])
    }

    /// The scene's camera, moved away from its target as far as is needed to see the whole plane, all the way round its orbit.
    ///
    /// `aspect` is the picture's width over its height. A camera that sees the plane stays where it is, and so does one over a plane
    /// that repeats its field: that is there to go on to the horizon.
    pub fn framing(&self, aspect: f64) -> Camera {
        // Balls round what there is to see: the plane's corners, or a mesh whose size is known.
        let [x, z] = self.plane_size_metres().map(|extent| extent / 2.0);
        let corners = [DVec3::new(-x, 0.0, -z), DVec3::new(x, 0.0, -z), DVec3::new(-x, 0.0, z), DVec3::new(x, 0.0, z)];
        let balls = match self.mesh.as_ref().and_then(|mesh| mesh.radius_metres) {
            Some(radius) => vec![(DVec3::ZERO, f64::from(radius))],
            None => corners.map(|corner| (corner, 0.0)).to_vec(),
        };
        self.moved_away(&balls, aspect)
    }

    /// The same, until it sees all of these points instead of the plane: a mesh of the program's own stands where scenes look, but the
    /// plane's distance is too near for some.
    pub fn framing_of_points(&self, points: impl Iterator<Item = DVec3>, aspect: f64) -> Camera {
        self.moved_away(&points.map(|point| (point, 0.0)).collect::<Vec<_>>(), aspect)
    }

    fn moved_away(&self, balls: &[(DVec3, f64)], aspect: f64) -> Camera {
        let camera = &self.camera;
        if self.plane.repeat != [1, 1] {
            return camera.clone();
        }
        let target = DVec3::from(camera.target);
        let from_target = DVec3::from(camera.eye) - target;
        let half_height = (camera.vertical_fov_degrees.to_radians() / 2.0).tan() * MARGIN;
        let half = [half_height * aspect, half_height];

        // A turning camera passes every side of the plane: 5° apart, the corners move by less than the margin.
        let turns = match (&camera.swing, camera.orbit_degrees_per_second == 0.0) {
            (None, true) => vec![0.0],
            (Some(swing), true) => (-18..=18).map(|step| f64::from(step) / 18.0 * swing.degrees).collect(),
            (_, false) => (0..72).map(|step| 5.0 * f64::from(step)).collect(),
        };
        let distance = turns
            .into_iter()
            .map(|degrees: f64| DQuat::from_rotation_y(degrees.to_radians()) * from_target)
            .flat_map(|away| {
                balls.iter().map(move |(middle, radius)| distance_to_see(*middle - target, *radius, away.normalize(), half))
            })
            .fold(from_target.length(), f64::max);
        if distance <= from_target.length() {
            return camera.clone();
        }
        Camera { eye: (target + from_target.normalize() * distance).to_array(), ..camera.clone() }
    }
}

impl Scene {
    /// The scene's camera before a ball, from the direction that it looks from, as near as shows the whole of it: a mesh of a file may lie
    /// anywhere, and be of any size.
    pub fn framing_of(&self, middle: DVec3, radius: f64, aspect: f64) -> Camera {
        let camera = &self.camera;
        let half_height = (camera.vertical_fov_degrees.to_radians() / 2.0).tan() * MARGIN;
        let away = (DVec3::from(camera.eye) - DVec3::from(camera.target)).normalize();
        let distance = distance_to_see(DVec3::ZERO, radius, away, [half_height * aspect, half_height]).max(NEAREST_METRES);
        Camera { eye: (middle + away * distance).to_array(), target: middle.to_array(), ..camera.clone() }
    }
}

/// The least distance from the target, along `away`, from which a ball about `point` (relative to the target) is within the picture.
fn distance_to_see(point: DVec3, radius: f64, away: DVec3, half: [f64; 2]) -> f64 {
    // Straight down or up the picture's upper edge is the far side of the plane, as for every camera of this program.
    let up = if away.y.abs() > 1.0 - 1e-9 { DVec3::NEG_Z } else { DVec3::Y };
    let right = up.cross(away).normalize();
    let above = away.cross(right);
    // The point's depth is the eye's distance less its own share along `away`: |offset| ≤ half · depth on both axes.
    // A ball keeps its radius from the picture's four sides, planes through the eye: over the sine of their angle to the axis.
    let needed = [(right, half[0]), (above, half[1])]
        .map(|(axis, half)| (point.dot(axis).abs() + radius * (1.0 + half * half).sqrt()) / half);
    point.dot(away) + needed[0].max(needed[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dcamera::rh::view::look_at_mat4;

    /// The largest |x| or |y| of a corner in normalised device coordinates; infinite where one lies behind the eye.
    fn reach(scene: &Scene, camera: &Camera, aspect: f64) -> f64 {
        let view = look_at_mat4(camera.eye.into(), camera.target.into(), DVec3::Y);
        let tangent = (camera.vertical_fov_degrees.to_radians() / 2.0).tan();
        let [x, z] = scene.plane_size_metres().map(|extent| extent / 2.0);
        [[-x, -z], [x, -z], [-x, z], [x, z]]
            .map(|[x, z]| {
                let p = view.transform_point3(DVec3::new(x, 0.0, z));
                if p.z >= 0.0 { f64::INFINITY } else { (p.x / -p.z / tangent / aspect).abs().max((p.y / -p.z / tangent).abs()) }
            })
            .into_iter()
            .fold(0.0, f64::max)
    }

    #[test]
    fn every_aspect_shows_the_whole_plane() {
        for size in [[512, 512], [2048, 64], [64, 2048], [1, 1]] {
            for aspect in [0.1, 1.0, 16.0 / 9.0, 10.0] {
                for fov in [5.0, 45.0, 120.0] {
                    let mut scene = Scene::default();
                    scene.field.size = size;
                    scene.camera.vertical_fov_degrees = fov;
                    let framed = scene.framing(aspect);
                    let reach = reach(&scene, &framed, aspect);
                    assert!(reach <= MARGIN + 1e-9, "{size:?} {aspect} {fov}: {reach}");
                }
            }
        }
    }

    #[test]
    fn a_camera_that_sees_the_plane_stays() {
        let mut scene = Scene::default();
        scene.camera.eye = [0.0, 5.0, 5.0];
        assert_eq!(scene.framing(1.5), scene.camera);
    }

    #[test]
    fn a_ball_is_seen_whole() {
        for (aspect, fov) in [(0.4, 45.0), (1.6, 45.0), (1.0, 100.0), (3.0, 20.0)] {
            let mesh = crate::scene::Mesh { radius_metres: Some(0.7), ..Default::default() };
            let mut scene = Scene { mesh: Some(mesh), ..Scene::default() };
            scene.camera.vertical_fov_degrees = fov;
            scene.camera.eye = [0.1, 0.5, 0.5];
            scene.camera.target = [0.1, 0.05, 0.0];
            let camera = scene.framing(aspect);
            let view = look_at_mat4(camera.eye.into(), camera.target.into(), DVec3::Y);
            let tangent = (fov.to_radians() / 2.0).tan();
            let reach = (0..4000)
                .map(|i| {
                    let (z, turn) = (2.0 * (f64::from(i) + 0.5) / 4000.0 - 1.0, 2.399_963 * f64::from(i));
                    let across = (1.0 - z * z).sqrt();
                    let p = view.transform_point3(0.7 * DVec3::new(across * turn.cos(), z, across * turn.sin()));
                    (p.x / -p.z / tangent / aspect).abs().max((p.y / -p.z / tangent).abs())
                })
                .fold(0.0, f64::max);
            assert!(reach <= MARGIN + 1e-9 && reach > 0.9, "{aspect} {fov}: {reach}");
        }
    }

    #[test]
    fn what_lies_elsewhere_is_looked_at() {
        let scene = Scene::default();
        for (middle, radius) in [(DVec3::new(500.0, -3.0, 20.0), 40.0), (DVec3::new(0.0, 1.0, 0.0), 0.1)] {
            let camera = scene.framing_of(middle, radius, 1.6);
            let from_middle = DVec3::from(camera.eye) - middle;
            assert_eq!(DVec3::from(camera.target), middle);
            let away = DVec3::from(scene.camera.eye) - DVec3::from(scene.camera.target);
            assert!(from_middle.normalize().dot(away.normalize()) > 1.0 - 1e-12);
            // The picture's upper and lower side touch the ball, but for the margin.
            let tangent = (camera.vertical_fov_degrees.to_radians() / 2.0).tan() * MARGIN;
            assert!((from_middle.length() * tangent.atan().sin() / radius - 1.0).abs() < 1e-9);
        }
        // A speck is not looked at from within the near plane.
        assert!(scene.framing_of(DVec3::ZERO, 1e-9, 1.6).eye.iter().any(|coordinate| coordinate.abs() > 0.02));
    }

    #[test]
    fn straight_down_works_too() {
        let mut scene = Scene::default();
        scene.camera.eye = [0.0, 0.1, 0.0];
        scene.camera.target = [0.0; 3];
        let framed = scene.framing(1.0);
        assert!(framed.eye.iter().all(|coordinate| coordinate.is_finite()) && framed.eye[1] > 1.0, "{:?}", framed.eye);
    }
}
