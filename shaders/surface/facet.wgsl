// Facets: a mesh's triangles, each pixel's ray traced in the tangent space of the point that it shows, as the papers draw meshes: a
// curved surface counts as flat around each pixel, so the silhouette stays the polygons' own. A plane's and a box's facets take their
// rays from the view's linear forms and are exact.
//
//   radiance  rgba16float   write
//   depth     depth32float  write  the polygon's, or behind a switch the relief's

struct FacetVaryings {
    @builtin(position) position: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) uv: vec2f,
    @location(4) metres_per_uv: vec2f,
}

@vertex
fn facet_vertex(@builtin(vertex_index) index: u32) -> FacetVaryings {
    view = view_buffer;
    let vertex = raster_vertices[index];
    return FacetVaryings(
        raster_clip(vertex.position), vertex.position, vertex.normal, vec4f(vertex.tangent, vertex.handedness),
        vec2f(vertex.u, vertex.v), vertex.metres_per_uv,
    );
}

// A ray's fall is at least this share of its way: where the smooth normal turns away from the eye before the polygon does, the ray
// would never come down.
const FACET_FALL: f32 = 0.03;

// Sets the frame, and returns the pixel's ray.
fn facet_ray(facet: FacetVaryings) -> Ray {
    if view.planar == 1u {
        frame = plane_frame();
        return pixel_ray(facet.position.xy).ray;
    }
    let size = vec2f(view.field_size);
    let normal = normalize(facet.normal);
    let tangent = normalize(facet.tangent.xyz - normal * dot(normal, facet.tangent.xyz));
    let bitangent = cross(normal, tangent) * facet.tangent.w;
    let cell = facet.metres_per_uv / size;
    let lattice = facet.uv * size - 0.5;
    frame = frame_of(lattice, facet.world, tangent * cell.x, bitangent * cell.y, normal * view.depth_metres);

    raster_footprint(facet.position.xy, facet.world, normal);

    let direction = normalize(raster_direction(facet.position.xy));
    let way = vec3f(dot(frame.per_u, direction), dot(frame.per_v, direction), dot(frame.per_height, direction));
    let fall = max(-way.z, FACET_FALL / view.depth_metres);
    let whole = floor(lattice);
    return view_ray(lattice - whole, way.xy / fall, vec2i(whole));
}

fn facet_outcome(facet: FacetVaryings) -> Shaded {
    view = view_buffer;
    return shade(facet_ray(facet));
}

@fragment
fn facet(varyings: FacetVaryings) -> @location(0) vec4f {
    return vec4f(shown(facet_outcome(varyings)), 1.0);
}

@fragment
fn facet_displaced(varyings: FacetVaryings) -> ColourAndDepth {
    let shaded = facet_outcome(varyings);
    return ColourAndDepth(vec4f(shown(shaded), 1.0), raster_depth(world_of(shaded.hit.lattice, shaded.hit.height)));
}

@fragment
fn facet_channel(varyings: FacetVaryings) -> ColourAndDepth {
    let shaded = facet_outcome(varyings);
    let relief = raster_depth(world_of(shaded.hit.lattice, shaded.hit.height));
    return ColourAndDepth(channel_part(channel_of(shaded)), select(varyings.position.z, relief, view.displaced_depth == 1u));
}
