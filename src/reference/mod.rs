//! The same mathematics on the CPU, in f64: the specification of each kernel, the oracle of the tests and the ground truth.
//!
//! Plain and readable comes first: nothing here shares a trick with the shaders, so that an error has to be made twice, in two
//! ways, to go unnoticed. Heights are f32, as the textures hold them; everything computed from them is f64.

pub mod balls;
pub mod bounds;
pub mod compose;
pub mod cool;
pub mod gas;
pub mod gas_activity;
pub mod gas_advect;
pub mod gas_emit;
pub mod gas_force;
pub mod gas_project;
pub mod gas_show;
pub mod heal;
pub mod level_of_detail;
pub mod light_disc;
pub mod light_ggx;
pub mod light_phong;
pub mod march;
pub mod noise;
pub mod noise_columns;
pub mod noise_dunes;
pub mod noise_fractal;
pub mod noise_gears;
pub mod noise_scales;
pub mod normal_mips;
pub mod normals;
pub mod pyramid;
pub mod ray_map;
pub mod reliefs;
pub mod shadow_area;
pub mod shadow_cone;
pub mod shadow_hard;
pub mod shadow_none;
pub mod shadow_pom_soft;
pub mod shadow_steep;
pub mod shallow_water;
pub mod shell;
pub mod sky;
pub mod stamp;
pub mod trace_exact;
pub mod trace_mesh;
pub mod trace_normal;
pub mod trace_parallax;
pub mod trace_parallax_limited;
pub mod trace_pom;
pub mod trace_pom_linear;
pub mod trace_pyramid;
pub mod trace_relief;
pub mod trace_steep;
pub mod traversal;
pub mod wave;

pub use crate::scene::Addressing;
use crate::surface::probe;
pub use crate::surface::probe::Ray;

/// A height field: the bilinear surface between texel centres at the integer lattice positions.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    /// Width and height, texels.
    pub size: [u32; 2],
    /// What lies beyond the border.
    pub addressing: Addressing,
    /// Heights row by row, 0 to 1.
    pub heights: Vec<f32>,
    /// The smallest and the largest height.
    pub range: [f64; 2],
}

impl HeightField {
    /// A field of heights row by row, as many as the size says.
    pub fn new(size: [u32; 2], addressing: Addressing, heights: Vec<f32>) -> Self {
        assert_eq!(heights.len(), size[0] as usize * size[1] as usize, "one height a texel");
        let (low, high) = heights.iter().fold((f32::MAX, f32::MIN), |(low, high), h| (low.min(*h), high.max(*h)));
        Self { size, addressing, heights, range: [low.into(), high.into()] }
    }

    /// A field from a function of the texel.
    pub fn from_fn(size: [u32; 2], addressing: Addressing, mut height: impl FnMut(u32, u32) -> f32) -> Self {
        let mut heights = Vec::with_capacity(size[0] as usize * size[1] as usize);
        for y in 0..size[1] {
            heights.extend((0..size[0]).map(|x| height(x, y)));
        }
        Self::new(size, addressing, heights)
    }

    /// The height of a texel, wherever it lies.
    pub fn texel(&self, x: i64, y: i64) -> f64 {
        let [x, y] = [address(x, self.size[0], self.addressing), address(y, self.size[1], self.addressing)];
        f64::from(self.heights[y * self.size[0] as usize + x])
    }

    /// The corners of a cell: (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1).
    pub fn corners(&self, x: i64, y: i64) -> [f64; 4] {
        [self.texel(x, y), self.texel(x + 1, y), self.texel(x, y + 1), self.texel(x + 1, y + 1)]
    }

    /// The surface at a lattice position.
    pub fn bilinear(&self, lattice: [f64; 2]) -> f64 {
        let cell = lattice.map(f64::floor);
        let [u, v] = [lattice[0] - cell[0], lattice[1] - cell[1]];
        let [z00, z10, z01, z11] = self.corners(cell[0] as i64, cell[1] as i64);
        (1.0 - v) * ((1.0 - u) * z00 + u * z10) + v * ((1.0 - u) * z01 + u * z11)
    }
}

/// The texel of an axis that a coordinate means.
pub fn address(texel: i64, size: u32, addressing: Addressing) -> usize {
    let size = i64::from(size);
    let texel = match addressing {
        Addressing::Wrap => texel.rem_euclid(size),
        Addressing::Clamp => texel.clamp(0, size - 1),
    };
    // Both arms land in 0..size.
    texel as usize
}

impl Ray {
    /// A view ray, from the reference surface down.
    pub fn view(lattice: [f32; 2], travel: [f32; 2]) -> Self {
        Self { lattice, travel, height: 1.0, rise: -1.0, cell: [0, 0], t_end: 1.0, ends: probe::Hit::HIT }
    }

    /// A shadow ray, from a point of the surface up.
    pub fn shadow(lattice: [f32; 2], travel: [f32; 2], height: f32) -> Self {
        Self { lattice, travel, height, rise: 1.0, cell: [0, 0], t_end: 1.0 - height, ends: probe::Hit::MISS }
    }

    /// Lattice position at t.
    pub fn lattice_at(&self, t: f64) -> [f64; 2] {
        [0, 1].map(|axis| f64::from(self.cell[axis]) + f64::from(self.lattice[axis]) + t * f64::from(self.travel[axis]))
    }

    /// Height at t.
    pub fn height_at(&self, t: f64) -> f64 {
        f64::from(self.height) + t * f64::from(self.rise)
    }
}

/// What became of a ray: where it meets the surface, or where it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Its parameter.
    pub t: f64,
    /// Lattice position, not wrapped.
    pub lattice: [f64; 2],
    /// Height of the ray there.
    pub height: f64,
    /// Samples or cells that it took to find.
    pub steps: u32,
    /// [`probe::Hit::HIT`], or what [`Ray::ends`] says of a ray that met nothing.
    pub status: u32,
}

impl Hit {
    /// The point of a ray at t.
    pub fn on(ray: &Ray, t: f64, steps: u32) -> Self {
        Self { t, lattice: ray.lattice_at(t), height: ray.height_at(t), steps, status: probe::Hit::HIT }
    }

    /// The end of a ray that met nothing before.
    pub fn end(ray: &Ray, steps: u32) -> Self {
        Self { status: ray.ends, ..Self::on(ray, ray.t_end.into(), steps) }
    }
}
