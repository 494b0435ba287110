// Gas, showing: its density as heights, and what its albedo needs, at the size of the field.
//
//   velocity  vec2f        read   m/s at the western and northern face
//   carried   vec4f        read   leading velocity, density, dye
//   heights   r32float     write  density
//   cover     rgba16float  write  density, dye, vorticity (1/s, clockwise on the screen), velocity along u (m/s)
//
// Reads 24 bytes a cell and writes 12 a texel. A cell may cover several texels: then density is Catmull and Rom's interpolant, which
// has no creases for the light to show. Specification: src/reference/gas_show.rs. Composed after common/gas.wgsl.

override GAS_COARSENING: i32;

@group(1) @binding(2) var<storage, read> velocity: array<vec2f>;
@group(1) @binding(3) var<storage, read> carried: array<vec4f>;
@group(1) @binding(4) var heights: texture_storage_2d<r32float, write>;
@group(1) @binding(5) var cover: texture_storage_2d<rgba16float, write>;

// Density, dye, vorticity, velocity along u, all at a cell's centre; a wall turns nothing.
fn shown_of(at: vec2i) -> vec4f {
    let cell = gas_address(at);
    let north_west = velocity[gas_index(cell)] * gas_open(cell);
    let east = cell + vec2i(1, 0);
    let south = cell + vec2i(0, 1);
    let v = vec2f(
        velocity[gas_index(cell - vec2i(1, 0))].y * gas_open(cell).y + velocity[gas_index(south - vec2i(1, 0))].y * gas_open(south).y,
        velocity[gas_index(east)].y * gas_open(cell).y + velocity[gas_index(south + vec2i(1, 0))].y * gas_open(south).y,
    );
    let u = vec2f(
        velocity[gas_index(cell - vec2i(0, 1))].x * gas_open(cell).x + velocity[gas_index(east - vec2i(0, 1))].x * gas_open(east).x,
        velocity[gas_index(south)].x * gas_open(cell).x + velocity[gas_index(south + vec2i(1, 0))].x * gas_open(east).x,
    );
    // Means of two over a distance of two cells.
    let turning = 0.25 * ((v.y - v.x) - (u.y - u.x)) * gas.turning_per_speed;
    let along = 0.5 * (north_west.x + velocity[gas_index(east)].x * gas_open(east).x);
    return vec4f(carried[gas_index(cell)].zw, turning, along);
}

// The weights of Catmull and Rom's spline at a fraction between the second and the third of four.
fn spline(t: f32) -> vec4f {
    return 0.5 * vec4f(t * (-1.0 + t * (2.0 - t)), 2.0 + t * t * (3.0 * t - 5.0), t * (1.0 + t * (4.0 - 3.0 * t)), t * t * (t - 1.0));
}

// The third dimension counts the blocks of a tile's texels.
@compute @workgroup_size(GAS_TILE, GAS_TILE)
fn gas_show(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let place = gas_place(workgroup, workgroups);
    if place >= tile_list[0] {
        return;
    }
    let block = vec2i(i32(workgroup.z) % GAS_COARSENING, i32(workgroup.z) / GAS_COARSENING);
    let texel = (gas_tile(place) * GAS_COARSENING + block) * i32(GAS_TILE) + vec2i(local.xy);
    if any(texel >= gas.size * GAS_COARSENING) {
        return;
    }
    var shown: vec4f;
    if GAS_COARSENING == 1 {
        shown = shown_of(texel);
    } else {
        let at = (vec2f(texel % GAS_COARSENING) + 0.5) / f32(GAS_COARSENING) - 0.5;
        let first = texel / GAS_COARSENING + vec2i(floor(at)) - 1;
        let across = spline(fract(at.x));
        let down = spline(fract(at.y));
        for (var y = 0; y < 4; y++) {
            for (var x = 0; x < 4; x++) {
                shown += across[x] * down[y] * shown_of(first + vec2i(x, y));
            }
        }
    }
    textureStore(heights, texel, vec4f(shown.x, 0.0, 0.0, 0.0));
    // A half holds no more.
    textureStore(cover, texel, clamp(shown, vec4f(-65504.0), vec4f(65504.0)));
}
