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

// What a pixel needs of its tetrahedron comes along from the vertices, where it is the same: three vertices read by every pixel of every
// tetrahedron were a quarter of the picture's time on a software adapter (`planet`: 73 ms, now 54).
struct ShellVaryings {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) tetrahedron: u32,    // which of its prism's
    @location(1) @interpolate(flat) borders: u32,        // the sides that are borders of the mesh, a bit each
    @location(2) @interpolate(flat) corner: vec3f,       // the first
    @location(3) @interpolate(flat) toward_1: vec3f,     // gradients of the other three's barycentric coordinates
    @location(4) @interpolate(flat) toward_2: vec3f,
    @location(5) @interpolate(flat) toward_3: vec3f,
    @location(6) @interpolate(flat) lattice_01: vec4f,   // of the corners, counted from `cell`
    @location(7) @interpolate(flat) lattice_23: vec4f,
    @location(8) @interpolate(flat) cell: vec2f,
    @location(9) @interpolate(flat) normal: vec3f,       // of the mesh at the first corner, and how it changes by the texel
    @location(10) @interpolate(flat) normal_per_u: vec3f,
    @location(11) @interpolate(flat) normal_per_v: vec3f,
}

// A tetrahedron with less volume than this share of the product of its edges is flat.
override SHELL_FLAT: f32;

// One tetrahedron: its corners, and their lattice positions counted from `cell`.
struct ShellPiece {
    corners: array<vec3f, 4>,
    lattice: array<vec2f, 4>,
    cell: vec2f,
    base: array<u32, 3>,
    borders: u32,
}

// Corner 0…5 of a prism: the upper ends of its three edges, then the lower ends.
fn shell_corner(base: array<u32, 3>, corner: u32) -> vec3f {
    var vertices = base;
    let vertex = raster_vertices[vertices[corner % 3u]];
    return vertex.position + select(vec3f(0.0), vertex.inward * view.depth_metres, corner >= 3u);
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

// The heights of the corners of each of a prism's tetrahedra.
fn shell_heights(tetrahedron: u32) -> vec4f {
    return select(vec4f(0.0), vec4f(1.0), vec4u(0u, 1u, 2u, 3u) <= vec4u(tetrahedron));
}

fn shell_piece(piece: u32) -> ShellPiece {
    let triangle = shell_triangles[piece / 3u];
    let base = array<u32, 3>(triangle.vertices.x, triangle.vertices.y, triangle.vertices.z);
    let cell = floor(shell_lattice(base[0]));
    var prism = SHELL_CORNERS;
    var vertices = base;
    let corners = prism[piece % 3u];
    var result: ShellPiece;
    for (var i = 0u; i < 4u; i++) {
        result.corners[i] = shell_corner(base, corners[i]);
        result.lattice[i] = shell_lattice(vertices[corners[i] % 3u]) - cell;
    }
    result.cell = cell;
    result.base = base;
    result.borders = triangle.borders;
    return result;
}

// What a pixel needs of it, at a point of the picture.
fn shell_varyings(number: u32, piece: ShellPiece, position: vec4f) -> ShellVaryings {
    let a = piece.corners[1] - piece.corners[0];
    let b = piece.corners[2] - piece.corners[0];
    let c = piece.corners[3] - piece.corners[0];
    let per_volume = 1.0 / dot(a, cross(b, c));
    var edges = SHELL_EDGES;
    let borders = (edges[number % 3u] & vec4u(piece.borders)) != vec4u(0u);
    // The normals of the mesh's vertices are linear over the triangle.
    let first = shell_lattice(piece.base[0]);
    let along_b = shell_lattice(piece.base[1]) - first;
    let along_c = shell_lattice(piece.base[2]) - first;
    let per_area = 1.0 / (along_b.x * along_c.y - along_b.y * along_c.x);
    let normal = raster_vertices[piece.base[0]].normal;
    let to_b = raster_vertices[piece.base[1]].normal - normal;
    let to_c = raster_vertices[piece.base[2]].normal - normal;
    let normal_per_u = (to_b * along_c.y - to_c * along_b.y) * per_area;
    let normal_per_v = (to_c * along_b.x - to_b * along_c.x) * per_area;
    let cells = piece.cell + piece.lattice[0] - first;
    return ShellVaryings(
        position, number % 3u, dot(select(vec4u(0u), vec4u(1u, 2u, 4u, 8u), borders), vec4u(1u)), piece.corners[0],
        cross(b, c) * per_volume, cross(c, a) * per_volume, cross(a, b) * per_volume,
        vec4f(piece.lattice[0], piece.lattice[1]), vec4f(piece.lattice[2], piece.lattice[3]), piece.cell,
        normal + normal_per_u * cells.x + normal_per_v * cells.y, normal_per_u, normal_per_v,
    );
}

// Whether the way from the eye to a point leads through the shell's core. What lies behind a ball is convex: a tetrahedron is hidden
// where its corners are.
fn shell_is_behind(point: vec3f) -> bool {
    let to_point = raster_from_eye(point);
    let to_core = raster_from_eye(view.core_centre);
    let radius_squared = view.core_radius * view.core_radius;
    // The share of the way at which it is nearest to the core's middle, and how far that is. Squares of distances are not subtracted:
    // from 2,400 radii away 40 pixels of a limb were lost by that.
    let length_squared = dot(to_point, to_point);
    let share = dot(to_core, to_point) / length_squared;
    let miss = to_core - share * to_point;
    let inside = radius_squared - dot(miss, miss);
    let enters = share - sqrt(max(inside, 0.0) / length_squared);
    return dot(to_core, to_core) > radius_squared && share > 0.0 && inside >= 0.0 && enters <= 1.0;
}

@vertex
fn shell_vertex(@builtin(vertex_index) index: u32) -> ShellVaryings {
    view = view_buffer;
    let number = index / 12u;
    var piece = shell_piece(number);
    var sides = SHELL_SIDES;
    var side = sides[(index / 3u) % 4u];
    let edges = mat3x3f(
        piece.corners[1] - piece.corners[0],
        piece.corners[2] - piece.corners[0],
        piece.corners[3] - piece.corners[0],
    );
    // The sides above wind outward where the volume is positive. A flat tetrahedron, as where the ways inward of two edges end in the
    // same place, holds nothing and has no frame: it is not drawn.
    let volume = determinant(edges);
    let is_flat = abs(volume) < SHELL_FLAT * length(edges[0]) * length(edges[1]) * length(edges[2]);
    var corner = index % 3u;
    if volume < 0.0 && corner != 0u {
        corner = 3u - corner;
    }
    // Half of a planet is: without it `gas-planet` takes 55 ms in place of 90 on lavapipe.
    var is_hidden = view.core_radius > 0.0;
    for (var i = 0u; i < 4u; i++) {
        is_hidden = is_hidden && shell_is_behind(piece.corners[i]);
    }
    let position = select(raster_clip(piece.corners[side[corner]]), vec4f(0.0, 0.0, 0.0, 1.0), is_flat || is_hidden);
    return shell_varyings(number, piece, position);
}

struct ShellWay {
    ray: Ray,
    is_empty: bool,
}

// The pixel's way through its tetrahedron; sets the frame.
fn shell_way(varyings: ShellVaryings) -> ShellWay {
    let towards = mat3x3f(varyings.toward_1, varyings.toward_2, varyings.toward_3);
    let toward_0 = -(towards[0] + towards[1] + towards[2]);
    let lattices = mat4x2f(varyings.lattice_01.xy, varyings.lattice_01.zw, varyings.lattice_23.xy, varyings.lattice_23.zw);
    let heights = shell_heights(varyings.tetrahedron);

    // The ray, re-based from the eye to about where it is nearest to the tetrahedron's first corner: what is counted from there is
    // small.
    let direction = normalize(raster_direction(varyings.position.xy));
    let from_eye = raster_from_eye(varyings.corner);
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
    let start = lattices * begin;
    let whole = floor(start);
    let floor_is_left = varyings.tetrahedron == 0u && left == 0u;
    let ray = Ray(
        start - whole, lattices * way, clamp(dot(heights, begin), 0.0, 1.0), dot(heights, way),
        vec2i(varyings.cell + whole), 1.0, select(MISS, HIT, floor_is_left),
    );

    // The frame: field space is affine in the barycentric coordinates, and they in the world.
    let gradients = mat4x3f(toward_0, towards[0], towards[1], towards[2]);
    let per_u = gradients * vec4f(varyings.lattice_01.xz, varyings.lattice_23.xz);
    let per_v = gradients * vec4f(varyings.lattice_01.yw, varyings.lattice_23.yw);
    let per_height = gradients * heights;
    let per_cells = 1.0 / dot(per_u, cross(per_v, per_height));
    let up = cross(per_u, per_v) * per_cells;
    let anchor = varyings.cell + lattices[0];
    frame = Frame(
        anchor, varyings.corner + up * (1.0 - heights.x), cross(per_v, per_height) * per_cells,
        cross(per_height, per_u) * per_cells, up, per_u, per_v, per_height,
        varyings.normal, varyings.normal_per_u, varyings.normal_per_v, vec3f(0.0),
    );
    raster_footprint(varyings.position.xy, view.eye_world + view.eye_rest + (base + enter) * direction, frame_normal(anchor));
    // Sides between prisms are open; a ray comes in under the surface only through a border of the mesh.
    if entered < 4u && ((varyings.borders >> entered) & 1u) != 0u {
        frame.cut = -normalize(select(select(select(toward_0, towards[0], entered == 1u), towards[1], entered == 2u), towards[2], entered == 3u));
    }
    return ShellWay(ray, leave == enter && any(begin < vec4f(-1e-3)));
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
