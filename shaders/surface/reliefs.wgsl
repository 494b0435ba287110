// Reliefs: the shadows that flat reliefs cast on one another, and on balls.
//
// Whatever enters the rectangle of a flat relief, h = 1, ends in it, since its field goes on sideways. So for a point outside of its
// slab the rectangle's shadow is the relief's own, exactly. Within the slab, between h = 1 and h = 0, whatever its field holds there
// is not asked: a point there is dark to lights that stand on the other side, and lit by those in front.
//
// Where the scene's shadow is soft, a border falls off as the light's disc sets behind it, and at a corner as the product of two, as if the
// place in the rectangle were linear in the direction: off by 0.01 to 0.03 behind one border, by 0.02 to 0.09 at a corner, and by up to a
// fifth where the disc all but stands in the rectangle's own plane.
//
// Specification: src/reference/reliefs.rs. Composed after common/view, surface/frame and surface/level_of_detail. The slabs are read where
// they lie, as balls are.

// Whether there are any. Fixed when the pipeline is built: a software adapter runs a loop's body once, whatever its condition.
override RELIEFS: bool = true;

// Half the width of a border without extent, metres: less than f32 tells apart at a metre.
const RELIEFS_BORDER: f32 = 1e-7;

// Share of a disc of radius 1 that a straight border leaves, where its middle lies so far within what hides it.
fn reliefs_ramp(within: f32) -> f32 {
    let x = clamp(within, -1.0, 1.0);
    return 0.5 - (x * sqrt(max(1.0 - x * x, 0.0)) + asin(x)) * 0.31830989;
}

// Share of a directional light that a slab lets through.
fn slab_visibility(slab: Slab, position: vec3f, toward: vec3f) -> f32 {
    let up = cross(slab.along_v, slab.along_u);
    let from_middle = position - slab.middle;
    let above = dot(from_middle, up);
    let rise = dot(toward, up);
    // A way that falls ends in whatever lies above the floor; one that climbs left the rectangle behind unless it began below.
    let meets = select(above <= -slab.depth, above > -slab.depth, rise < 0.0);
    if !meets || rise == 0.0 {
        return 1.0;
    }
    // From within the slab the rectangle is met at once.
    let way = max(-above / rise, 0.0);
    let at = from_middle + way * toward;
    let inside = vec2f(
        slab.half_extent_u - abs(dot(at, slab.along_u)),
        slab.half_extent_v - abs(dot(at, slab.along_v)),
    );
    // How fast the place in the rectangle moves with the position, along u and v: as fast as it moves with the light's direction, over
    // the way.
    let moves_u = slab.along_u - up * (dot(toward, slab.along_u) / rise);
    let moves_v = slab.along_v - up * (dot(toward, slab.along_v) / rise);
    var width = max(view.slab_penumbra * way * vec2f(length(moves_u), length(moves_v)), vec2f(RELIEFS_BORDER));
    if DETAIL && view.detail.filters == 1u {
        width += 0.5 * vec2f(footprint_along(moves_u), footprint_along(moves_v));
    }
    return 1.0 - (1.0 - reliefs_ramp(inside.x / width.x)) * (1.0 - reliefs_ramp(inside.y / width.y));
}

// What the pixel sees of the surface, as far as it goes along a world vector, metres times its length.
fn footprint_along(world: vec3f) -> f32 {
    return abs(dot(world, frame.along_u)) * footprint.texels.x + abs(dot(world, frame.along_v)) * footprint.texels.y;
}

// Share of a directional light that the reliefs let through beside the one that is drawn, whose own shadow is the technique's.
fn reliefs_visibility(position: vec3f, toward: vec3f) -> f32 {
    if !RELIEFS {
        return 1.0;
    }
    var visible = 1.0;
    for (var i = 0u; i < view.slab_count; i++) {
        if i != view.own_slab {
            visible *= slab_visibility(view_buffer.slabs[i], position, toward);
        }
    }
    return visible;
}
