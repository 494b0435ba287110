//! Lists of rays, and what the GPU and the CPU make of them.

use rilievo::field::bounds::BoundsPass;
use rilievo::field::pyramid::Pyramid;
use rilievo::field::{Field, Region};
use rilievo::gpu::Gpu;
use rilievo::reference::{Addressing, HeightField, Ray};
use rilievo::scene::PyramidLeaf;
use rilievo::surface::probe::Hit;
use rilievo::surface::{Probe, Shadow, Technique, View};

use super::fields::{ADDRESSINGS, Kind, Random};
use super::gpu::{run, wait_for};

/// A field on the GPU, heights and bounds.
pub fn upload(gpu: &Gpu, field: &HeightField) -> Field {
    let textures = Field::new(gpu, field.size, field.addressing, false);
    textures.height.write(gpu, &field.heights);
    let pyramid = Pyramid::new(gpu).expect("the shader compiles");
    let set = pyramid.bind(gpu, &textures);
    let bounds = BoundsPass::new(gpu).expect("the shader compiles");
    let bounds_set = bounds.bind(gpu, &textures);
    run(gpu, |recorder| {
        pyramid.record(recorder, &set, &[Region::all(field.size)]);
        bounds.record(recorder, &bounds_set, &[Region::all(field.size)]);
    });
    textures
}

/// A view of a field whose texels are of 1 mm and whose depth is 100 mm; nodes are practically without end.
pub fn view(field: &HeightField) -> View {
    View {
        field_size: field.size,
        wrap: u32::from(field.addressing == Addressing::Wrap),
        step_cap: 1 << 22,
        plane_size_metres: field.size.map(|texels| texels as f32 * 1e-3),
        depth_metres: 0.1,
        texel_metres: 1e-3,
        u_world: [1.0, 0.0, 0.0],
        v_world: [0.0, 0.0, 1.0],
        up_world: [0.0, 1.0, 0.0],
        pom_samples_min: 8.0,
        pom_samples_max: 50.0,
        mesh_quads: 37,
        steep_layers: 50.0,
        relief_linear_steps: 16.0,
        relief_binary_steps: 6,
        pyramid_leaf: PyramidLeaf::Refined as u32,
        shadow_samples: 16.0,
        shadow_strength: 4.0,
        light_radius: 0.05,
        area_samples: 64,
        ..View::default()
    }
}

/// The hits of the rays, through the WGSL that pictures are made with.
pub fn trace(gpu: &Gpu, technique: Technique, field: &Field, view: &View, rays: &[Ray]) -> Vec<Hit> {
    let probe = Probe::new(gpu, technique, Shadow::None).expect("the shader compiles");
    let readback = probe.trace(gpu, field, view, rays);
    bytemuck::pod_collect_to_vec(&wait_for(gpu, &readback))
}

/// The visibility at the start of the rays.
pub fn shadow(gpu: &Gpu, shadow: Shadow, field: &Field, view: &View, rays: &[Ray]) -> Vec<f32> {
    let probe = Probe::new(gpu, Technique::Normal, shadow).expect("the shader compiles");
    let readback = probe.shadow(gpu, field, view, rays);
    bytemuck::pod_collect_to_vec(&wait_for(gpu, &readback))
}

/// A texel, a row, a column, odd and prime sides, a power of two.
const SIZES: [[u32; 2]; 5] = [[1, 1], [1, 61], [64, 1], [255, 257], [1024, 1024]];

const FIELDS: usize = SIZES.len() * ADDRESSINGS.len() * Kind::ALL.len();

/// Random rays of each field, so that they come to a million.
pub const RANDOM: usize = 1_000_000_usize.div_ceil(FIELDS);

/// Adversarial rays of each kind and each field, so that they come to a hundred thousand.
pub const ADVERSARIAL: usize = 100_000_usize.div_ceil(FIELDS * Adversary::ALL.len());

/// Makes `count` rays, lattice position and travel, with `make` over every kind of field, size and addressing.
pub fn over_every_field(
    count: usize,
    make: impl Fn(&mut Random, [u32; 2]) -> ([f32; 2], [f32; 2]),
    mut visit: impl FnMut(Kind, &HeightField, &[([f32; 2], [f32; 2])]),
) {
    for size in SIZES {
        let mut random = Random::new(u64::from(size[0]) << 32 | u64::from(size[1]));
        for (addressing, kind) in ADDRESSINGS.into_iter().flat_map(|addressing| Kind::ALL.map(|kind| (addressing, kind))) {
            let rays: Vec<_> = (0..count).map(|_| make(&mut random, size)).collect();
            visit(kind, &kind.field(size, addressing), &rays);
        }
    }
}

/// Kinds of rays that break what is nearly right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Adversary {
    /// Along an axis, either way.
    AxisParallel,
    /// Diagonally through the corners of cells.
    Diagonal,
    /// Exactly along a border between cells.
    AlongBorder,
    /// Straight down or up.
    Vertical,
    /// 0.1° above the surface.
    Grazing,
    /// From a border, or from a corner, anywhere.
    FromBorder,
    /// Over hundreds of tiles.
    Long,
    /// Nearly along an axis: crossings of the other are far apart and close to those of the first.
    NearlyParallel,
}

impl Adversary {
    /// Every kind.
    pub const ALL: [Self; 8] = [
        Self::AxisParallel,
        Self::Diagonal,
        Self::AlongBorder,
        Self::Vertical,
        Self::Grazing,
        Self::FromBorder,
        Self::Long,
        Self::NearlyParallel,
    ];

    /// Lattice position and travel of a ray of this kind.
    pub fn ray(self, random: &mut Random, size: [u32; 2]) -> ([f32; 2], [f32; 2]) {
        let anywhere = random_position(random, size);
        let corner = anywhere.map(f32::round);
        let length = random.logarithmic(0.3, 300.0);
        let direction = random.direction();
        let sign = random.sign();
        let either = |flip: bool, [a, b]: [f32; 2]| if flip { [b, a] } else { [a, b] };
        let flip = random.below(2) == 0;
        match self {
            Self::AxisParallel => (anywhere, either(flip, [sign * length, 0.0])),
            Self::Diagonal => {
                // An integer travel hits corners on the way exactly.
                let length = length.ceil();
                (corner, [sign * length, random.sign() * length])
            }
            Self::AlongBorder => {
                let on_border = either(flip, [either(flip, anywhere)[0], either(flip, corner)[1]]);
                (on_border, either(flip, [sign * length, 0.0]))
            }
            Self::Vertical => (anywhere, if flip { [0.0, 0.0] } else { [sign * 1e-30, 1e-25] }),
            Self::Grazing => {
                let length = 100.0 / 0.1_f32.to_radians().tan();
                (anywhere, direction.map(|part| part * length))
            }
            Self::FromBorder => {
                let from = either(flip, [corner[0], if sign > 0.0 { corner[1] } else { anywhere[1] }]);
                (from, direction.map(|part| part * length))
            }
            Self::Long => {
                let length = random.uniform(200.0, 400.0) * size[0].max(size[1]) as f32;
                (anywhere, direction.map(|part| part * length))
            }
            Self::NearlyParallel => {
                let across = random.sign() * length * random.logarithmic(1e-7, 1e-2);
                let from = if random.below(2) == 0 { corner } else { anywhere };
                (from, either(flip, [sign * length, across]))
            }
        }
    }
}

/// A position over the field or a little beyond its border.
pub fn random_position(random: &mut Random, size: [u32; 2]) -> [f32; 2] {
    size.map(|size| random.uniform(-2.0, size as f32 + 1.0))
}

/// Lattice position and travel of a ray like those of pictures.
pub fn random_ray(random: &mut Random, size: [u32; 2]) -> ([f32; 2], [f32; 2]) {
    let length = random.logarithmic(0.1, 300.0);
    (random_position(random, size), random.direction().map(|part| part * length))
}

/// Applies `check` to every index of 0..count on all cores, and returns what it says of each, in order.
pub fn each<T: Send>(count: usize, check: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let chunk = count.div_ceil(cores).max(1);
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..count)
            .step_by(chunk)
            .map(|start| {
                let check = &check;
                scope.spawn(move || (start..(start + chunk).min(count)).map(check).collect::<Vec<_>>())
            })
            .collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("a check panicked, and has said why")).collect()
    })
}

/// The steepest slope within `reach` cells of a position, in heights for each cell.
pub fn steepness_around(field: &HeightField, [x, y]: [f64; 2], reach: f64) -> f64 {
    let offsets = [-reach, 0.0, reach];
    offsets.iter().flat_map(|dx| offsets.map(|dy| [x + dx, y + dy])).map(|at| field.steepness(at)).fold(0.0, f64::max)
}

/// The largest lattice coordinate of these points.
pub fn reach(points: &[[f64; 2]]) -> f64 {
    points.iter().flatten().fold(0.0, |reach: f64, x| reach.max(x.abs()))
}

/// The distance of two lattice positions, cells.
pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
