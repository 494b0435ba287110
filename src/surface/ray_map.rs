//! From the pixel to its ray in field space, exact to a few units in the last place even at grazing angles.
//!
//! A ray through a pixel meets the plane at a quotient of linear forms of the pixel. Near the horizon the denominator is a small
//! difference of large numbers: in plain f32 the error of 6e-8 that each term carries is magnified there to whole texels. So each
//! coefficient is split in two: an `exact` part on a grid so coarse that, pixels being multiples of ½, neither product nor sum
//! ever rounds, and a `rest` some 2²² times smaller. Only the result rounds.
//!
//! Shader: `shaders/surface/ray_map.wgsl`. Specification: [`crate::reference::ray_map`].

use glam::{DMat3, DVec3, Vec3};

use super::probe::{Hit, Ray};
use crate::camera::Camera;

/// A linear form of the pixel, a·x + b·y + c, split in two. Twin of the WGSL struct in `shaders/common/view.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LinearForm {
    /// Coefficients whose products and sums do not round.
    pub exact: [f32; 4],
    /// What they lack.
    pub rest: [f32; 4],
}

impl LinearForm {
    /// Splits coefficients for pixels up to `image_size`.
    pub fn new(coefficients: DVec3, image_size: [u32; 2]) -> Self {
        let largest = coefficients.x.abs() * f64::from(image_size[0])
            + coefficients.y.abs() * f64::from(image_size[1])
            + coefficients.z.abs();
        if largest == 0.0 {
            return Self::default();
        }
        // Every partial sum is at most `largest` and a multiple of half the grid: 23 bits, one less than f32 has.
        let grid = (largest.log2().ceil() - 22.0).exp2();
        let exact = (coefficients / grid).round() * grid;
        let pad = |vector: Vec3| vector.extend(0.0).to_array();
        Self { exact: pad(exact.as_vec3()), rest: pad((coefficients - exact).as_vec3()) }
    }
}

/// Where a flat relief lies in the world: its middle, and unit vectors along u, along v and out of it. Its middle is where the texture
/// coordinates are ½.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The middle, metres.
    pub origin: DVec3,
    /// Along u.
    pub u: DVec3,
    /// Along v, perpendicular to it.
    pub v: DVec3,
    /// Out of the reference surface, perpendicular to both.
    pub up: DVec3,
}

impl Default for Placement {
    /// In the world's y = 0, u along +x, v along +z.
    fn default() -> Self {
        Self { origin: DVec3::ZERO, u: DVec3::X, v: DVec3::Z, up: DVec3::Y }
    }
}

impl Placement {
    /// A point of the world counted from the middle, along u, out, and along v.
    pub fn local(&self, world: DVec3) -> DVec3 {
        self.turned(world - self.origin)
    }

    /// A direction of the world along u, out, and along v.
    pub fn turned(&self, world: DVec3) -> DVec3 {
        DVec3::new(world.dot(self.u), world.dot(self.up), world.dot(self.v))
    }

    /// The point of the world that is so far from the middle along u, out, and along v.
    pub fn world(&self, local: DVec3) -> DVec3 {
        self.origin + local.x * self.u + local.y * self.up + local.z * self.v
    }
}

/// The plane and the field that rays are mapped into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Where the plane lies.
    pub placement: Placement,
    /// Width and height of the field, texels.
    pub field_size: [u32; 2],
    /// Extent of the plane along u and v, metres.
    pub plane_size_metres: [f64; 2],
    /// Depth of h = 0, metres.
    pub depth_metres: f64,
}

/// The rays of all pixels of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayMap {
    /// Numerators of the lattice position where the ray meets the plane.
    pub lattice: [LinearForm; 2],
    /// Numerators of the ray's lattice travel while it falls from height 1 to 0.
    pub travel: [LinearForm; 2],
    /// Their denominator: the downward part of the ray's direction for a unit along the view axis.
    pub denominator: LinearForm,
    /// The largest denominator of a point beyond the near distance.
    pub nearest: f32,
}

impl RayMap {
    /// The rays of a camera's picture of `image_size` pixels.
    pub fn new(camera: &Camera, image_size: [u32; 2], target: &Target) -> Self {
        let form = |coefficients| LinearForm::new(coefficients, image_size);
        let exact = exact_forms(camera, image_size, target);
        Self {
            lattice: exact.lattice.map(form),
            travel: exact.travel.map(form),
            denominator: form(exact.denominator),
            nearest: (target.placement.local(camera.eye()).y / camera.near_metres) as f32,
        }
    }
}

/// The ray in field space through a point of the picture, for a pointer; none where it does not look down upon the plane.
pub fn pixel_ray(camera: &Camera, image_size: [u32; 2], target: &Target, pixel: [f64; 2]) -> Option<Ray> {
    let forms = exact_forms(camera, image_size, target);
    let pixel = DVec3::new(pixel[0], pixel[1], 1.0);
    let denominator = forms.denominator.dot(pixel);
    let at = |form: DVec3| form.dot(pixel) / denominator;
    let lattice = forms.lattice.map(at);
    (denominator > 0.0 && target.placement.local(camera.eye()).y > 0.0).then(|| Ray {
        lattice: lattice.map(|lattice| (lattice - lattice.floor()) as f32),
        travel: forms.travel.map(|travel| at(travel) as f32),
        height: 1.0,
        rise: -1.0,
        cell: lattice.map(|lattice| lattice.floor() as i32),
        t_end: 1.0,
        ends: Hit::HIT,
    })
}

/// The coefficients of a [`RayMap`], in f64: each a vector that is multiplied with (x, y, 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactForms {
    /// As [`RayMap::lattice`].
    pub lattice: [DVec3; 2],
    /// As [`RayMap::travel`].
    pub travel: [DVec3; 2],
    /// As [`RayMap::denominator`].
    pub denominator: DVec3,
}

/// The coefficients of the rays of a camera's picture.
pub fn exact_forms(camera: &Camera, image_size: [u32; 2], target: &Target) -> ExactForms {
    let direction = direction_forms(camera, image_size);
    let along = |axis: DVec3| direction[0] * axis.x + direction[1] * axis.y + direction[2] * axis.z;
    let placement = &target.placement;
    let (x, y, z) = (along(placement.u), along(placement.up), along(placement.v));
    let denominator = -y;
    let eye = placement.local(camera.eye());
    let axis = |axis: usize, eye_along: f64, direction: DVec3| {
        let (size, texels) = (target.plane_size_metres[axis], f64::from(target.field_size[axis]));
        // The ray meets the plane at eye + (eye.y / denominator) · direction; u = x / size + ½, lattice = u · texels − ½.
        let lattice = (denominator * eye_along + direction * eye.y) * (texels / size) + denominator * (0.5 * texels - 0.5);
        (lattice, direction * (target.depth_metres * texels / size))
    };
    let ((lattice_x, travel_x), (lattice_y, travel_y)) = (axis(0, eye.x, x), axis(1, eye.z, z));
    ExactForms { lattice: [lattice_x, lattice_y], travel: [travel_x, travel_y], denominator }
}

/// The coefficients of the direction of a pixel's ray along the world's axes, with unit length along the view axis.
pub fn direction_forms(camera: &Camera, image_size: [u32; 2]) -> [DVec3; 3] {
    let [width, height] = image_size.map(f64::from);
    let half_height = (0.5 * camera.vertical_fov_radians).tan();
    // View direction of a pixel, with unit length along the view axis; columns are its coefficients of x, y and 1.
    let view_from_pixel = DMat3::from_cols(
        DVec3::new(2.0 * half_height / height, 0.0, 0.0),
        DVec3::new(0.0, -2.0 * half_height / height, 0.0),
        DVec3::new(
            -half_height * width / height - 2.0 * half_height * camera.lens_shift.x,
            half_height + 2.0 * half_height * camera.lens_shift.y,
            -1.0,
        ),
    );
    let world_from_pixel = (DMat3::from_mat4(camera.world_from_view) * view_from_pixel).transpose();
    [world_from_pixel.x_axis, world_from_pixel.y_axis, world_from_pixel.z_axis]
}
