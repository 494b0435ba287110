// Rays and hits in field space: what every technique and every shadow takes and returns.
//
// Lattice coordinates: texel (i, j) has its centre at (i, j). Over a flat polygon a ray's parameter t is the height that it has
// climbed or fallen, so the slab is crossed from t = 0 to t = 1 at the latest; through a piece of a shell it is the share of the
// way through the piece, on which the ray may fall, climb or stay level.

struct Ray {
    lattice: vec2f, // lattice position at t = 0, counted from `cell`
    travel: vec2f,  // lattice displacement while t grows by 1
    height: f32,    // height at t = 0
    rise: f32,      // height gained while t grows by 1: −1 for a view ray over a flat polygon, +1 for a shadow ray
    cell: vec2i,    // a lattice position near the start: what is counted from it keeps the bits that its own size would cost
    t_end: f32,     // where it ends: at the floor, at the top of the slab, or where it leaves its piece of a shell
    ends: u32,      // what it has met there: HIT the floor, MISS nothing
}

// The lattice position at t.
fn ray_at(ray: Ray, t: f32) -> vec2f {
    return vec2f(ray.cell) + (ray.lattice + t * ray.travel);
}

fn ray_height(ray: Ray, t: f32) -> f32 {
    return ray.height + ray.rise * t;
}

// A view ray from the reference surface down to the floor.
fn view_ray(lattice: vec2f, travel: vec2f, cell: vec2i) -> Ray {
    return Ray(lattice, travel, 1.0, -1.0, cell, 1.0, HIT);
}

// A shadow ray from a lattice position up to the top of the slab.
fn shadow_ray(lattice: vec2f, travel: vec2f, height: f32) -> Ray {
    let cell = floor(lattice);
    return Ray(lattice - cell, travel, height, 1.0, vec2i(cell), 1.0 - height, MISS);
}

// What became of the ray if nothing stopped it before t_end.
fn end_of(ray: Ray, steps: u32) -> Hit {
    return Hit(ray_at(ray, ray.t_end), ray_height(ray, ray.t_end), ray.t_end, steps, ray.ends);
}

// A hit at t.
fn hit_at(ray: Ray, t: f32, steps: u32) -> Hit {
    return Hit(ray_at(ray, t), ray_height(ray, t), t, steps, HIT);
}

// What became of a ray.
const HIT: u32 = 0u;     // it met the surface
const MISS: u32 = 1u;    // it left the slab, or its piece of a shell
const CAPPED: u32 = 2u;  // it visited as many nodes as it may and gave up

struct Hit {
    lattice: vec2f, // lattice position of the hit, on the ray; not wrapped
    height: f32,    // height of the ray there
    t: f32,
    steps: u32,     // height samples or nodes visited; a node and the cell in it that is looked at beside it count one
    status: u32,    // HIT, MISS or CAPPED
}

// The level of the pyramid at which the last trace found the surface: 0 is the surface itself.
var<private> hit_level: i32;
