// Glass: a clear pane whose relief refracts what is behind it ([PDM] fig. 22, an environment mapped transparent object): light
// is bent once by the relief and once by the flat back of the pane, at height 0, and ends on a table of two woods, or in the sky.

const GLASS_SQUARE_METRES: f32 = 0.0625;  // edge of a square of the table
const GLASS_GAP: f32 = 1.0;               // from the back of the pane to the table, depths of the relief

// What lies under the pane, where a ray from a point of its back meets it.
fn glass_behind(position: vec3f, direction: vec3f) -> vec3f {
    let gap = GLASS_GAP * view.depth_metres;
    let table = view.origin_world.y - view.depth_metres - gap;
    if direction.y > -0.02 || position.y < table {
        return sky(direction) + sky_suns(direction);
    }
    let metres = (position + direction * ((table - position.y) / direction.y)).xz;
    let square = vec2i(floor(metres / GLASS_SQUARE_METRES));
    let grain = noise_over(metres * vec2f(18.0 / 220.0, 1.0), 220.0, 83u);
    let odd = ((square.x + square.y) & 1) == 1;
    let wood = select(vec3f(0.62, 0.44, 0.26), vec3f(0.115, 0.06, 0.035), odd) * mix(0.78, 1.12, grain);
    // Where its light crossed the pane, level as a whole.
    let up_in_plane = vec2f(dot(position - view.origin_world, view.u_world), dot(position - view.origin_world, view.v_world));
    let lattice = (up_in_plane / view.plane_size_metres + 0.5) * vec2f(view.field_size) - 0.5;
    let caustic = transparent_caustic(lattice, gap + 0.5 * view.depth_metres, view.index);
    return wood * (view.light_radiance * max(view.light_world.y, 0.0) * caustic + 0.8 * view.sky);
}

fn matter_at(point: SurfacePoint) -> Matter {
    let normal = point.normal_world;
    let seen = max(dot(normal, point.toward_eye), 0.02);
    let mirror = transparent_mirror(view.index, seen);
    let inside = refract(-point.toward_eye, normal, 1.0 / view.index);

    // To the back, which is level, and out of it; light that meets it too aslant stays inside, and shows the sky.
    let up = frame_normal(point.lattice);
    let falls = max(-dot(inside, up), 0.05);
    let path = point.height * view.depth_metres / falls;
    let back = point.world + inside * path;
    let out = refract(inside, up, view.index);
    let leaves = dot(out, out) > 0.25;
    let behind = glass_behind(back, select(reflect(inside, up), out, leaves));

    // The tint is what a depth of glass lets through.
    let let_through = pow(max(view.tint, vec3f(1e-4)), vec3f(path / view.depth_metres));
    let glow = behind * let_through * (1.0 - mirror) + transparent_mirrored(point) * mirror;
    return Matter(vec3f(0.0), 0.0, view.shininess, glow, 1.0, 0.0, 0.0);
}
