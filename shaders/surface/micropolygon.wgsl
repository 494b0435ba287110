// Micropolygons: a mesh's triangles subdivided, displaced by the field in the vertex stage, and rasterised: the geometry that relief
// mapping saves ([POM] §4, [PDM] fig. 20).
//
//   height    r32float      read   four texels a vertex
//   vertices  56 bytes a vertex, indices 12 bytes a triangle, from buffers of their own
//   radiance  rgba16float   write
//   depth     depth32float  write  the relief's: there is no other polygon
//
// A mesh moves inward along the same directions as its shell and so has the shell's silhouette; over the borders of an open one stand
// walls, down to the floor. The plane alone is drawn beyond its
// border, as the field goes on there, and clipped to the pixels that show the plane, as every other technique shows it.
//
// Needs surface/raster. The surface that it shows over a plane is that of surface/trace_mesh.

struct Micropolygon {
    @builtin(position) position: vec4f,
    @location(0) world: vec3f,
    @location(1) height: f32,
    @location(2) lattice: vec2f,
    @location(3) inward: vec3f,
    @location(4) normal: vec3f,
    @location(5) tangent: vec4f,
    @location(6) metres_per_uv: vec2f,
}

@vertex
fn micropolygon_vertex(
    @builtin(instance_index) instance: u32,
    @location(0) base: vec3f,            // world, metres, where h = 1
    @location(1) uv: vec2f,
    @location(2) inward: vec3f,          // from the surface to the floor of the shell, in units of the depth
    @location(3) metres_per_uv: vec2f,
    @location(4) normal: vec4f,          // unit; w is the sign of the bitangent
    @location(5) tangent: vec4f,         // unit; w is 1 at the foot of a wall
) -> Micropolygon {
    view = view_buffer;
    // The first instance is the tile itself, the others the eight around it.
    let place = (instance + 4u) % 9u;
    let tile = vec2f(f32(place % 3u), f32(place / 3u)) - 1.0;
    let lattice = (uv + tile) * vec2f(view.field_size) - 0.5;
    // Heights of the tile itself, to the bit.
    let height = select(load_surface(uv * vec2f(view.field_size) - 0.5), 0.0, tangent.w > 0.5);
    let offset = tile.x * view.plane_size_metres.x * view.u_world + tile.y * view.plane_size_metres.y * view.v_world;
    let world = base + offset + inward * ((1.0 - height) * view.depth_metres);
    return Micropolygon(
        raster_clip(world), world, height, lattice, inward, normal.xyz, vec4f(tangent.xyz, normal.w), metres_per_uv,
    );
}

// From the point that interpolation gives, good to the rasteriser's grid of some 1/256 pixel, to the pixel's own ray.
fn micropolygon_aside(shown: Micropolygon) -> vec3f {
    let from_eye = raster_from_eye(shown.world);
    return dot(from_eye, view.forward_world) * raster_direction(shown.position.xy) - from_eye;
}

// The point that a fragment shows; sets the frame.
fn micropolygon_hit(shown: Micropolygon) -> Hit {
    if view.planar != 0u {
        frame = plane_frame();
        let ray = pixel_ray(shown.position.xy).ray;
        let t = 1.0 - shown.height;
        return Hit(ray_at(ray, t), shown.height, t, 0u, HIT);
    }
    let aside = micropolygon_aside(shown);
    let normal = normalize(shown.normal);
    let tangent = normalize(shown.tangent.xyz - normal * dot(normal, shown.tangent.xyz));
    let bitangent = cross(normal, tangent) * shown.tangent.w;
    let cell = shown.metres_per_uv / vec2f(view.field_size);
    let reference = shown.world + aside - shown.inward * ((1.0 - shown.height) * view.depth_metres);
    let up = shown.inward * -view.depth_metres;
    frame = frame_of(shown.lattice, reference, tangent * cell.x, bitangent * cell.y, up);
    let lattice = shown.lattice + vec2f(dot(frame.per_u, aside), dot(frame.per_v, aside));
    frame.anchor = lattice;
    frame.normal = normal;
    return Hit(lattice, shown.height, 1.0 - shown.height, 0u, HIT);
}

// The pixel's ray, over the polygon that the micropolygons stand for.
fn micropolygon_ray(shown: Micropolygon, hit: Hit) -> Ray {
    if view.planar != 0u {
        return pixel_ray(shown.position.xy).ray;
    }
    let way = field_displacement(normalize(raster_direction(shown.position.xy)));
    let travel = way.xy / max(-way.z, 1e-3 / view.depth_metres);
    let start = hit.lattice - (1.0 - hit.height) * travel;
    let cell = floor(start);
    return view_ray(start - cell, travel, vec2i(cell));
}

fn micropolygon_outcome(shown: Micropolygon) -> Shaded {
    let hit = micropolygon_hit(shown);
    return shade_hit(micropolygon_ray(shown, hit), hit);
}

fn micropolygon_wall_outcome(shown: Micropolygon) -> Shaded {
    let hit = micropolygon_wall_hit(shown);
    return shade_hit(micropolygon_ray(shown, hit), hit);
}

// The same of a wall: a cut through the relief, under its surface.
fn micropolygon_wall_hit(shown: Micropolygon) -> Hit {
    let normal = normalize(shown.normal);
    let reference = shown.world + micropolygon_aside(shown) - shown.inward * ((1.0 - shown.height) * view.depth_metres);
    // Any cells do: it is the wall itself that is seen.
    frame = frame_of(shown.lattice, reference, normalize(shown.tangent.xyz), -normal, shown.inward * -view.depth_metres);
    frame.normal = normalize(-shown.inward);
    frame.cut = normal;
    return Hit(shown.lattice, shown.height, 0.0, 0u, HIT);
}

// How much of the pixel it may show.
fn micropolygon_coverage(shown: Micropolygon) -> f32 {
    if view.planar == 2u {
        return plane_coverage(pixel_ray(shown.position.xy));
    }
    return 1.0;
}

@fragment
fn micropolygon(varyings: Micropolygon) -> @location(0) vec4f {
    view = view_buffer;
    let coverage = micropolygon_coverage(varyings);
    if coverage == 0.0 {
        discard;
    }
    return vec4f(shown(micropolygon_outcome(varyings)), coverage);
}

@fragment
fn micropolygon_channel(varyings: Micropolygon) -> @location(0) vec4f {
    view = view_buffer;
    if view.planar == 2u && !shows_plane(pixel_ray(varyings.position.xy)) {
        discard;
    }
    return channel_part(channel_of(micropolygon_outcome(varyings)));
}

@fragment
fn micropolygon_wall(varyings: Micropolygon) -> @location(0) vec4f {
    view = view_buffer;
    return vec4f(shown(micropolygon_wall_outcome(varyings)), 1.0);
}

@fragment
fn micropolygon_wall_channel(varyings: Micropolygon) -> @location(0) vec4f {
    view = view_buffer;
    return channel_part(channel_of(micropolygon_wall_outcome(varyings)));
}
