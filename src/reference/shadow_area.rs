//! A light that is a disc: the share of its points that nothing hides. Specification of `shaders/surface/shadow_area.wgsl`.

use super::light_disc::{LightDisc, point};
use super::shadow_hard::{escapes, way_to_light};
use super::{HeightField, Ray};

/// The share of `count` points of the light's disc that are visible.
pub fn shadow(field: &HeightField, ray: &Ray, disc: &LightDisc, count: u32) -> f64 {
    let (start, _) = way_to_light(field, ray);
    let sees = |point| {
        disc.shines(point) && {
            let line = disc.line(start.lattice, start.height, disc.direction(point));
            escapes(field, &line, field.range[1] - start.height)
        }
    };
    let seen = (0..count).filter(|&index| sees(point(index, count))).count();
    seen as f64 / f64::from(count)
}
