// Shell: the relief as a solid between a mesh's surface, h = 1, and the same surface moved inward along its normals by the depth,
// h = 0, with its own silhouette. Each triangle's prism is split into three tetrahedra: in each the map to field space is affine, so
// a straight ray stays straight there, and a trace that is exact over a plane is exact in the whole of this piecewise affine shell.
//
//   radiance  rgba16float   write
//   depth     depth32float  write  the relief's
//
// The far sides of every tetrahedron are drawn, so that one that holds the eye is seen too; a pixel's way through the tetrahedron is
// computed, traced as a ray that may fall, climb or stay level, and discarded where it finds nothing. The depth buffer keeps the
// first hit of all.
//
// Specification: src/reference/shell.rs. Needs surface/raster.

// A triangle's vertices, in an order that both triangles of an edge agree on, since the diagonal of a prism's side runs from the
// earlier's upper end to the later's lower end; and which of its edges are borders of the mesh: 1 the first two vertices', 2 the last
// two's, 4 the first's and the last's.
struct ShellTriangle {
    vertices: vec3u,
    borders: u32,
}

@group(2) @binding(1) var<storage, read> shell_triangles: array<ShellTriangle>;

struct ShellVaryings {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) piece: u32,
}

// A tetrahedron with less volume than this share of the product of its edges is flat.
override SHELL_FLAT: f32;

// One tetrahedron: its corners, their heights, and their lattice positions counted from `cell`.
struct ShellPiece {
    corners: array<vec3f, 4>,
    heights: vec4f,
    lattice: array<vec2f, 4>,
    cell: vec2f,
    base: array<u32, 3>,
    borders: u32,
}

// Corner 0…5 of a prism: the upper ends of its three edges, then the lower ends.
fn shell_corner(base: array<u32, 3>, corner: u32) -> vec4f {
    var vertices = base;
    let vertex = raster_vertices[vertices[corner % 3u]];
    if corner < 3u {
        return vec4f(vertex.position, 1.0);
    }
    return vec4f(vertex.position + vertex.inward * view.depth_metres, 0.0);
}

fn shell_lattice(vertex: u32) -> vec2f {
    return vec2f(raster_vertices[vertex].u, raster_vertices[vertex].v) * vec2f(view.field_size) - 0.5;
}

// The corners of the prism that each of its tetrahedra has.
const SHELL_CORNERS = array<vec4u, 3>(vec4u(0u, 3u, 4u, 5u), vec4u(0u, 1u, 4u, 5u), vec4u(0u, 1u, 2u, 5u));
// The corners of each of a tetrahedron's sides: side k lies opposite corner k.
const SHELL_SIDES = array<vec3u, 4>(vec3u(1u, 2u, 3u), vec3u(0u, 3u, 2u), vec3u(0u, 1u, 3u), vec3u(0u, 2u, 1u));

// The edge of the triangle over which each of those sides stands, as a bit of `borders`; 0 within the prism, on top and below.
const SHELL_EDGES = array<vec4u, 3>(vec4u(0u, 0u, 4u, 1u), vec4u(2u, 0u, 0u, 1u), vec4u(2u, 4u, 0u, 0u));

fn shell_piece(piece: u32) -> ShellPiece {
    let triangle = shell_triangles[piece / 3u];
    let base = array<u32, 3>(triangle.vertices.x, triangle.vertices.y, triangle.vertices.z);
    let cell = floor(shell_lattice(base[0]));
    var prism = SHELL_CORNERS;
    var vertices = base;
    let corners = prism[piece % 3u];
    var result: ShellPiece;
    for (var i = 0u; i < 4u; i++) {
        let corner = shell_corner(base, corners[i]);
        result.corners[i] = corner.xyz;
        result.heights[i] = corner.w;
        result.lattice[i] = shell_lattice(vertices[corners[i] % 3u]) - cell;
    }
    result.cell = cell;
    result.base = base;
    result.borders = triangle.borders;
    return result;
}

@vertex
fn shell_vertex(@builtin(vertex_index) index: u32) -> ShellVaryings {
    view = view_buffer;
    let piece = index / 12u;
    var tetrahedron = shell_piece(piece);
    var sides = SHELL_SIDES;
    var side = sides[(index / 3u) % 4u];
    let edges = mat3x3f(
        tetrahedron.corners[1] - tetrahedron.corners[0],
        tetrahedron.corners[2] - tetrahedron.corners[0],
        tetrahedron.corners[3] - tetrahedron.corners[0],
    );
    // The sides above wind outward where the volume is positive. A flat tetrahedron, as where the ways inward of two edges end in the
    // same place, holds nothing and has no frame: it is not drawn.
    let volume = determinant(edges);
    if abs(volume) < SHELL_FLAT * length(edges[0]) * length(edges[1]) * length(edges[2]) {
        return ShellVaryings(vec4f(0.0, 0.0, 0.0, 1.0), piece);
    }
    let turned = volume < 0.0;
    var corner = index % 3u;
    if turned && corner != 0u {
        corner = 3u - corner;
    }
    return ShellVaryings(raster_clip(tetrahedron.corners[side[corner]]), piece);
}

struct ShellWay {
    ray: Ray,
    is_empty: bool,
}

// The pixel's way through its tetrahedron; sets the frame.
fn shell_way(varyings: ShellVaryings) -> ShellWay {
    var piece = shell_piece(varyings.piece);
    let a = piece.corners[1] - piece.corners[0];
    let b = piece.corners[2] - piece.corners[0];
    let c = piece.corners[3] - piece.corners[0];
    let per_volume = 1.0 / dot(a, cross(b, c));
    // Gradients of the barycentric coordinates.
    let towards = mat3x3f(cross(b, c) * per_volume, cross(c, a) * per_volume, cross(a, b) * per_volume);
    var gradients = array<vec3f, 4>(-(towards[0] + towards[1] + towards[2]), towards[0], towards[1], towards[2]);

    // The ray, re-based from the eye to about where it is nearest to the tetrahedron's first corner: what is counted from there is
    // small.
    let direction = normalize(raster_direction(varyings.position.xy));
    let from_eye = raster_from_eye(piece.corners[0]);
    let base = dot(from_eye, direction);
    let offset = base * direction - from_eye;
    let near = view.near_metres / dot(direction, view.forward_world) - base;
    let inner = offset * towards;
    let weights = vec4f(1.0 - inner.x - inner.y - inner.z, inner);
    let inner_slopes = direction * towards;
    let slopes = vec4f(-(inner_slopes.x + inner_slopes.y + inner_slopes.z), inner_slopes);
    var enter = near;
    var leave = 1e30;
    var entered = 4u;
    var left = 4u;
    for (var i = 0u; i < 4u; i++) {
        let s = -weights[i] / slopes[i];
        if slopes[i] > 0.0 && s > enter {
            enter = s;
            entered = i;
        }
        if slopes[i] < 0.0 && s < leave {
            leave = s;
            left = i;
        }
    }
    // By rounding a ray along an edge may leave before it enters: a way of no length, which may still begin under the surface.
    leave = max(leave, enter);
    let begin = weights + enter * slopes;
    let way = (leave - enter) * slopes;
    let lattices = mat4x2f(piece.lattice[0], piece.lattice[1], piece.lattice[2], piece.lattice[3]);
    let start = lattices * begin;
    let whole = floor(start);
    let floor_is_left = varyings.piece % 3u == 0u && left == 0u;
    let ray = Ray(
        start - whole, lattices * way, clamp(dot(piece.heights, begin), 0.0, 1.0), dot(piece.heights, way),
        vec2i(piece.cell + whole), 1.0, select(MISS, HIT, floor_is_left),
    );

    // The frame: field space is affine in the barycentric coordinates, and they in the world.
    let per_u = gradients[0] * piece.lattice[0].x + gradients[1] * piece.lattice[1].x + gradients[2] * piece.lattice[2].x
        + gradients[3] * piece.lattice[3].x;
    let per_v = gradients[0] * piece.lattice[0].y + gradients[1] * piece.lattice[1].y + gradients[2] * piece.lattice[2].y
        + gradients[3] * piece.lattice[3].y;
    let per_height = gradients[0] * piece.heights[0] + gradients[1] * piece.heights[1] + gradients[2] * piece.heights[2]
        + gradients[3] * piece.heights[3];
    let per_cells = 1.0 / dot(per_u, cross(per_v, per_height));
    let up = cross(per_u, per_v) * per_cells;
    let anchor = piece.cell + piece.lattice[0];
    frame = Frame(
        anchor, piece.corners[0] + up * (1.0 - piece.heights[0]), cross(per_v, per_height) * per_cells,
        cross(per_height, per_u) * per_cells, up, per_u, per_v, per_height, vec3f(0.0), vec3f(0.0), vec3f(0.0), vec3f(0.0),
    );
    shell_normals(piece, anchor);
    raster_footprint(varyings.position.xy, view.eye_world + view.eye_rest + (base + enter) * direction, frame_normal(anchor));
    // Sides between prisms are open; a ray comes in under the surface only through a border of the mesh.
    var edges = SHELL_EDGES;
    if entered < 4u && (edges[varyings.piece % 3u][entered] & piece.borders) != 0u {
        frame.cut = -normalize(gradients[entered]);
    }
    return ShellWay(ray, leave == enter && any(begin < vec4f(-1e-3)));
}

// The normals of the mesh's vertices, linear over the triangle.
fn shell_normals(piece: ShellPiece, anchor: vec2f) {
    let first = shell_lattice(piece.base[0]);
    let b = shell_lattice(piece.base[1]) - first;
    let c = shell_lattice(piece.base[2]) - first;
    let per_area = 1.0 / (b.x * c.y - b.y * c.x);
    let normal = raster_vertices[piece.base[0]].normal;
    let to_b = raster_vertices[piece.base[1]].normal - normal;
    let to_c = raster_vertices[piece.base[2]].normal - normal;
    frame.normal_per_u = (to_b * c.y - to_c * b.y) * per_area;
    frame.normal_per_v = (to_c * b.x - to_b * c.x) * per_area;
    let cells = anchor - first;
    frame.normal = normal + frame.normal_per_u * cells.x + frame.normal_per_v * cells.y;
}

@fragment
fn shell(varyings: ShellVaryings) -> ColourAndDepth {
    view = view_buffer;
    let way = shell_way(varyings);
    let hit = trace(way.ray);
    if way.is_empty || hit.status == MISS {
        discard;
    }
    let shaded = shade_hit(way.ray, hit);
    return ColourAndDepth(vec4f(shown(shaded), 1.0), raster_depth(world_of(shaded.hit.lattice, shaded.hit.height)));
}

@fragment
fn shell_channel(varyings: ShellVaryings) -> ColourAndDepth {
    view = view_buffer;
    let way = shell_way(varyings);
    let hit = trace(way.ray);
    if way.is_empty || hit.status == MISS {
        discard;
    }
    let shaded = shade_hit(way.ray, hit);
    return ColourAndDepth(channel_part(channel_of(shaded)), raster_depth(world_of(shaded.hit.lattice, shaded.hit.height)));
}
