//! Reliefs: whether a flat relief hides a light from a point outside of its slab. Specification of `shaders/surface/reliefs.wgsl`.

use glam::DVec3;

use crate::surface::ray_map::Placement;

/// Whether a flat relief whose rectangle has these half extents, metres, hides the light in a unit direction from a position: light on
/// its way there has entered through the rectangle, from outside, and so ended in the relief; or the position lies in the slab, and the
/// light is on the slab's other side. What the relief itself hides within its slab from light in front of it is not asked.
pub fn hides(placement: &Placement, half_extent: [f64; 2], depth: f64, position: DVec3, toward: DVec3) -> bool {
    let (here, way) = (placement.local(position), placement.turned(toward));
    let within = |at: DVec3| at.x.abs() <= half_extent[0] && at.z.abs() <= half_extent[1];
    let in_slab = here.y <= 0.0 && here.y > -depth;
    if in_slab {
        return way.y < 0.0 && within(here);
    }
    let t = -here.y / way.y;
    t > 0.0 && within(here + t * way)
}
