//! From the pixel to its ray, in f64: the plain geometry that `shaders/surface/ray_map.wgsl` has as quotients of linear forms.

use glam::DVec2;

use super::traversal::Line;
use crate::camera::Camera;
use crate::surface::ray_map::Target;

/// The ray in field space through a point of the picture, in pixels from its upper left corner; none where it does not look down
/// upon the plane.
pub fn ray(camera: &Camera, image_size: [u32; 2], target: &Target, pixel: [f64; 2]) -> Option<Line> {
    let direction = camera.direction(DVec2::from(pixel), image_size);
    let eye = camera.eye();
    if direction.y >= 0.0 || eye.y <= 0.0 {
        return None;
    }
    let texels = |axis: usize| f64::from(target.field_size[axis]) / target.plane_size_metres[axis];
    let reach = eye.y / -direction.y;
    let meets = eye + reach * direction;
    let lattice = |axis: usize, from_middle: f64| from_middle * texels(axis) + 0.5 * f64::from(target.field_size[axis]) - 0.5;
    let fall = target.depth_metres / -direction.y;
    Some(Line {
        lattice: [lattice(0, meets.x), lattice(1, meets.z)],
        travel: [direction.x * fall * texels(0), direction.z * fall * texels(1)],
        height: 1.0,
        rise: -1.0,
    })
}
