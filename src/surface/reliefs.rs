//! Reliefs: the flat ones of a scene as they cast shadows on one another. Shader: `shaders/surface/reliefs.wgsl`; specification:
//! [`crate::reference::reliefs`].

use super::Shadow;
use super::ray_map::Placement;
use crate::scene::{Plane, RELIEFS_MAX, Relief, Scene};

/// The most slabs of a scene: its own relief's, and those beside it.
pub const SLABS_MAX: usize = 1 + RELIEFS_MAX;

/// A flat relief: a rectangle that its field lies under. Twin of the WGSL struct in `shaders/common/view.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "the WGSL twin documents the fields, and one place is enough")]
pub struct Slab {
    pub middle: [f32; 3],
    pub depth: f32,
    pub along_u: [f32; 3],
    pub half_extent_u: f32,
    pub along_v: [f32; 3],
    pub half_extent_v: f32,
}

/// A half extent that hides nothing, however soft its border.
const NOWHERE: f32 = -1e9;

/// The slabs of a scene, its own relief's first: one on a mesh casts no shadow on others, and its slab hides nothing.
pub fn slabs(scene: &Scene) -> Vec<Slab> {
    if scene.reliefs.is_empty() {
        return Vec::new();
    }
    let own = slab(&scene.plane, scene.field.size, scene.mesh.is_none(), &Placement::default());
    let further = scene.reliefs.iter().map(|relief| {
        let Relief { plane, field, mesh, .. } = relief;
        slab(plane, field.size, mesh.is_none(), &relief.placement())
    });
    std::iter::once(own).chain(further).collect()
}

fn slab(plane: &Plane, field_size: [u32; 2], is_flat: bool, placement: &Placement) -> Slab {
    let size = plane.size_metres(field_size);
    let half_extent = |axis: usize| match is_flat {
        true => (0.5 * size[axis] * f64::from(plane.repeat[axis])) as f32,
        false => NOWHERE,
    };
    Slab {
        middle: placement.origin.as_vec3().to_array(),
        depth: plane.depth_metres,
        along_u: placement.u.as_vec3().to_array(),
        half_extent_u: half_extent(0),
        along_v: placement.v.as_vec3().to_array(),
        half_extent_v: half_extent(1),
    }
}

/// Tangent of half the angle of the light's disc, as far as slabs know it: 0 where the scene's shadow has hard borders.
pub fn penumbra(scene: &Scene) -> f32 {
    match scene.trace.shadow {
        Shadow::None | Shadow::Steep | Shadow::Hard => 0.0,
        Shadow::PomSoft | Shadow::Cone | Shadow::Area => scene.light.half_angle_degrees.to_radians().tan(),
    }
}

/// Whether the reliefs of a scene cast shadows on one another.
pub fn are_seen(scene: &Scene) -> bool {
    !scene.reliefs.is_empty() && scene.trace.shadow != Shadow::None
}
