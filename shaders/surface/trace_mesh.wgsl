// Micropolygon mesh: the field at the vertices of a regular grid, each of its quads cut into two flat triangles, as the papers
// subdivide and displace a plane to compare with ([PDM] fig. 20). This is the ray's walk through that surface, for whoever has a ray;
// pictures show the same triangles through the rasteriser: see surface/micropolygon.
//
//   height  r32float  read  four vertices of four texels at each line of the grid that the ray crosses      256 bytes
//
// The grid has `mesh_quads` quads along either side of a tile; a quad is cut from its right upper corner to its left lower one.
// Between the lines along u, along v and along those cuts the surface below the ray is straight.
//
// Specification: src/reference/trace_mesh.rs. Needs common/view, surface/ray and common/field.

// The field at a vertex of the grid, counted from the upper left corner of the tile; exact where the texels around are alike.
fn trace_mesh_vertex(vertex: vec2i) -> f32 {
    let quads = max(i32(view.mesh_quads), 1);
    let within = select(clamp(vertex, vec2i(0), vec2i(quads)), ((vertex % quads) + quads) % quads, view_wraps());
    let lattice = vec2f(within) * (vec2f(view.field_size) / f32(quads)) - 0.5;
    let cell = floor(lattice);
    let z = load_corners(vec2i(cell));
    let f = lattice - cell;
    let upper = z.x + f.x * (z.y - z.x);
    let lower = z.z + f.x * (z.w - z.z);
    return upper + f.y * (lower - upper);
}

// The surface at a position in quads, counted from the vertex `base`.
fn trace_mesh_surface(base: vec2i, position: vec2f) -> f32 {
    let quad = floor(position);
    let f = position - quad;
    let corner = base + vec2i(quad);
    let right = trace_mesh_vertex(corner + vec2i(1, 0));
    let below = trace_mesh_vertex(corner + vec2i(0, 1));
    if f.x + f.y <= 1.0 {
        let origin = trace_mesh_vertex(corner);
        return origin + f.x * (right - origin) + f.y * (below - origin);
    }
    let origin = trace_mesh_vertex(corner + 1);
    return origin + (1.0 - f.x) * (below - origin) + (1.0 - f.y) * (right - origin);
}

fn trace(ray: Ray) -> Hit {
    // The ray in quads, counted from a vertex near its start.
    let size = vec2f(view.field_size);
    let scale = f32(max(view.mesh_quads, 1u)) / size;
    let tile = select(vec2f(0.0), floor(vec2f(ray.cell) / size), view_wraps());
    let origin = (vec2f(ray.cell - vec2i(tile) * vec2i(view.field_size)) + 0.5 + ray.lattice) * scale;
    let base = floor(origin);
    let start = origin - base;
    let travel = ray.travel * scale;

    // Along u, along v, along the cuts: the position that counts its lines, how it grows, and the line that comes next.
    let counts = vec3f(start, start.x + start.y);
    let grows = vec3f(travel, travel.x + travel.y);
    var lines = floor(counts) + select(vec3f(0.0), vec3f(1.0), grows > vec3f(0.0));
    var t = 0.0;
    var gap = ray_height(ray, 0.0) - trace_mesh_surface(vec2i(base), start);
    var steps = 1u;
    if gap <= 0.0 {
        return Hit(ray_at(ray, 0.0), ray.height, 0.0, steps, HIT);
    }
    while steps < view.step_cap {
        let crossings = select((lines - counts) / grows, vec3f(ray.t_end), grows == vec3f(0.0));
        let next = clamp(min(min(crossings.x, crossings.y), crossings.z), t, ray.t_end);
        lines += select(vec3f(0.0), sign(grows), crossings <= vec3f(next));
        let next_gap = ray_height(ray, next) - trace_mesh_surface(vec2i(base), start + next * travel);
        steps += 1u;
        if next_gap <= 0.0 {
            let hit = mix(t, next, gap / (gap - next_gap));
            return Hit(ray_at(ray, hit), ray_height(ray, hit), hit, steps, HIT);
        }
        if next >= ray.t_end {
            return end_of(ray, steps);
        }
        t = next;
        gap = next_gap;
    }
    return Hit(ray_at(ray, t), ray_height(ray, t), t, steps, CAPPED);
}
