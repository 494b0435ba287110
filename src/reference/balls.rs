//! Balls: where a ray meets one. Specification of `shaders/surface/balls.wgsl`.

use glam::DVec3;

/// Where a ray first meets a ball's surface from outside, in units of its direction: the smaller root of |o + t·d − c|² = r².
pub fn hit(centre: DVec3, radius: f64, origin: DVec3, direction: DVec3) -> Option<f64> {
    let from_centre = origin - centre;
    let (a, b, c) = (direction.length_squared(), from_centre.dot(direction), from_centre.length_squared() - radius * radius);
    let discriminant = b * b - a * c;
    let t = (-b - discriminant.max(0.0).sqrt()) / a;
    (discriminant > 0.0 && t > 0.0).then_some(t)
}
