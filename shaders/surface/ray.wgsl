// Rays and hits in field space: what every technique and every shadow takes and returns.
//
// Lattice coordinates: texel (i, j) has its centre at (i, j); a ray's parameter t is the height that it has climbed or fallen,
// so the slab is crossed from t = 0 to t = 1 at the latest.

struct Ray {
    lattice: vec2f, // lattice position at t = 0, counted from `cell`
    travel: vec2f,  // lattice displacement while t grows by 1
    height: f32,    // height at t = 0
    rise: f32,      // −1: a view ray, which falls; +1: a shadow ray, which climbs
    cell: vec2i,    // a lattice position near the start: what is counted from it keeps the bits that its own size would cost
}

// The lattice position at t.
fn ray_at(ray: Ray, t: f32) -> vec2f {
    return vec2f(ray.cell) + (ray.lattice + t * ray.travel);
}

// A shadow ray from a lattice position.
fn shadow_ray(lattice: vec2f, travel: vec2f, height: f32) -> Ray {
    let cell = floor(lattice);
    return Ray(lattice - cell, travel, height, 1.0, vec2i(cell));
}

// What became of a ray.
const HIT: u32 = 0u;     // it met the surface
const MISS: u32 = 1u;    // it left the slab upward
const CAPPED: u32 = 2u;  // it visited as many nodes as it may and gave up

struct Hit {
    lattice: vec2f, // lattice position of the hit, on the ray; not wrapped
    height: f32,    // height of the ray there
    t: f32,
    steps: u32,     // height samples or nodes visited, a leaf counts one
    status: u32,    // HIT, MISS or CAPPED
}
