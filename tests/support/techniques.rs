//! Each technique's specification by its name, and how a hit on the GPU is held to it.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use rilievo::gpu::{Gpu, Preference};
use rilievo::reference::traversal::Line;
use rilievo::reference::{
    Addressing, HeightField, Hit, Ray, march, trace_exact, trace_mesh, trace_normal, trace_parallax, trace_parallax_limited,
    trace_pom, trace_pom_linear, trace_pyramid, trace_relief, trace_steep,
};
use rilievo::scene::{PomCounts, PyramidLeaf};
use rilievo::surface::{Technique, View, probe};

use super::fields::{ADDRESSINGS, Kind, Random};
use super::gpu::gpu;
use super::rays;
use super::tolerances::{self, LATTICE_FLOOR, filtered_height, hit_height, lattice_bound};

/// The adapter that tests share, without the feature that lets it filter heights: four loads a sample, in full precision.
pub fn gpu_that_loads() -> Option<&'static Gpu> {
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    GPU.get_or_init(|| {
        gpu()?;
        let preference =
            Preference { software_first: true, masked_features: wgpu::Features::FLOAT32_FILTERABLE, ..Preference::default() };
        let gpu = pollster::block_on(Gpu::new(&preference.with_environment())).expect("there is an adapter, as gpu() found");
        assert!(!gpu.filters_r32float());
        Some(gpu)
    })
    .as_ref()
}

/// What the specification says of a ray, with the parameters of the view.
pub fn expected(technique: Technique, view: &View, field: &HeightField, ray: &Ray) -> Hit {
    match technique {
        Technique::Normal => trace_normal::trace(ray),
        Technique::Parallax => trace_parallax::trace(field, ray),
        Technique::ParallaxLimited => trace_parallax_limited::trace(field, ray, cosine(view, ray)),
        Technique::Steep => trace_steep::trace(field, ray, view.steep_layers.into()),
        Technique::Relief => {
            let share = if view.relief_depth_bias == 1 { trace_relief::bias(cosine(view, ray)) } else { 1.0 };
            trace_relief::trace(field, ray, view.relief_linear_steps.into(), view.relief_binary_steps, share)
        }
        Technique::PomLinear => trace_pom_linear::trace(field, ray, samples(view, ray)),
        Technique::Pom => trace_pom::trace(field, ray, samples(view, ray)),
        Technique::Pyramid if view.pyramid_leaf == PyramidLeaf::Nearest as u32 => trace_pyramid::trace_nearest(field, ray),
        Technique::Pyramid => trace_pyramid::trace_refined(field, ray),
        Technique::Mesh => {
            let line = Line::from(ray);
            let end = f64::from(ray.t_end);
            Hit::on(ray, trace_mesh::meets(field, view.mesh_quads, &line, end).unwrap_or(end), 1)
        }
        Technique::Exact => trace_exact::trace(field, ray),
    }
}

/// Cosine between a ray and the normal of the view's plane.
pub fn cosine(view: &View, ray: &Ray) -> f64 {
    let metres =
        |axis: usize| f64::from(ray.travel[axis]) * f64::from(view.plane_size_metres[axis]) / f64::from(view.field_size[axis]);
    march::cosine([metres(0), metres(1)], f64::from(ray.rise) * f64::from(view.depth_metres))
}

/// Samples that `pom` takes of a ray.
pub fn samples(view: &View, ray: &Ray) -> f64 {
    let [fewest, most] = [view.pom_samples_min, view.pom_samples_max].map(f64::from);
    if view.pom_counts == PomCounts::Texels as u32 {
        march::samples_by_texels(ray, [fewest, view.step_cap.into()])
    } else {
        march::samples_by_angle(cosine(view, ray), [fewest, most])
    }
}

/// View rays over the field and a little beyond its border.
pub fn view_rays(seed: u64, count: usize, size: [u32; 2]) -> Vec<Ray> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| {
            let (lattice, travel) = rays::random_ray(&mut random, size);
            Ray::view(lattice, travel)
        })
        .collect()
}

/// Rays through pieces of a shell: they begin anywhere in the slab, fall, climb or stay level, and end in it without a hit.
pub fn pieces(seed: u64, count: usize, size: [u32; 2]) -> Vec<Ray> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| {
            let (lattice, travel) = rays::random_ray(&mut random, size);
            let height = random.uniform(0.0, 1.0);
            let rise = match random.below(4) {
                0 => random.uniform(0.0, 1.0 - height),
                1 => 0.0,
                _ => random.uniform(-height, 0.0),
            };
            let cell = lattice.map(|at| at.floor() as i32);
            let within = [0, 1].map(|axis| lattice[axis] - cell[axis] as f32);
            let t_end = random.uniform(0.01, 1.0);
            Ray { lattice: within, travel, height, rise, cell, t_end, ends: probe::Hit::MISS }
        })
        .collect()
}

/// What a comparison of hits with their specification found.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    pub rays: usize,
    /// Rays beyond the bound, where a sample passes the surface by so little that rounding decides on which side: the next one, or the
    /// one before, is the specification's own.
    pub at_border: usize,
    /// Rays beyond the bound that close on what the technique takes for the surface more slowly than the surface rises: what rounding
    /// does to a height moves them the further.
    pub tangent: usize,
    /// Rays beyond the bound without such a reason.
    pub wrong: Vec<String>,
}

impl Tally {
    /// The share of rays beyond the bound.
    pub fn off_share(&self) -> f64 {
        (self.at_border + self.tangent + self.wrong.len()) as f64 / self.rays as f64
    }

    /// Takes over what another one found.
    pub fn add(&mut self, other: Self) {
        self.rays += other.rays;
        self.at_border += other.at_border;
        self.tangent += other.tangent;
        self.wrong.extend(other.wrong);
    }
}

/// How a hit compares with its specification.
enum Verdict {
    Right,
    AtBorder,
    Tangent,
    Wrong(String),
}

/// A field, and what rounding and a filter may make of it for rays that are this precise.
struct Rounded {
    /// Each texel higher and lower by what [`hit_height`] says of the cells around it.
    fields: [HeightField; 2],
}

impl Rounded {
    fn new(field: &HeightField, cells: f64, filters: bool) -> Self {
        let [width, height] = field.size;
        let steepest = |x: u32, y: u32| {
            let around = [[-1.0, -1.0], [0.0, -1.0], [-1.0, 0.0], [0.0, 0.0]];
            around.map(|[dx, dy]| field.steepness([f64::from(x) + dx, f64::from(y) + dy])).into_iter().fold(0.0, f64::max)
        };
        let bands: Vec<f64> = (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| {
                let slope = steepest(x, y);
                hit_height(cells, slope) + if filters { filtered_height(slope) } else { 0.0 }
            })
            .collect();
        let moved = |sign: f64| {
            HeightField::from_fn(field.size, field.addressing, |x, y| {
                (field.texel(x.into(), y.into()) + sign * bands[(y * width + x) as usize]) as f32
            })
        };
        Self { fields: [moved(1.0), moved(-1.0)] }
    }
}

/// Traces the rays and holds each hit to its specification.
///
/// A hit is right where it is within [`lattice_bound`]. Elsewhere it must lie between those of the specification for the field
/// raised and for the field lowered by what rounding, and the filter where there is one, can do to the heights around each texel.
/// Where these take another number of samples, rounding decides whether a sample is under the surface; where they take as many, the ray
/// is tangent to what the technique puts between its samples.
pub fn compare(gpu: &Gpu, technique: Technique, field: &HeightField, view: &View, rays: &[Ray]) -> Tally {
    let hits = rays::trace(gpu, technique, &rays::upload(gpu, field), view, rays);
    // A long ray is less precise: a pair of fields for each doubling.
    let bound_of = |ray: &Ray| lattice_bound(rays::reach(&[ray.lattice_at(0.0), ray.lattice_at(ray.t_end.into())]));
    let class = |bound: f64| (bound / LATTICE_FLOOR).log2().ceil().max(0.0) as i32;
    let mut rounded: BTreeMap<i32, Rounded> = BTreeMap::new();
    for ray in rays {
        let class = class(bound_of(ray));
        let cells = LATTICE_FLOOR * f64::from(class).exp2();
        rounded.entry(class).or_insert_with(|| Rounded::new(field, cells, gpu.filters_r32float()));
    }
    let judge = |index: usize| {
        let (ray, hit) = (&rays[index], &hits[index]);
        let truth = expected(technique, view, field, ray);
        let bound = lattice_bound(rays::reach(&[ray.lattice_at(0.0), truth.lattice, hit.lattice.map(f64::from)]));
        let t = f64::from(hit.t);
        let on_ray = rays::distance(hit.lattice.map(f64::from), ray.lattice_at(t)) <= bound
            && (f64::from(hit.height) - ray.height_at(t)).abs() <= 1e-6;
        let near = rays::distance(truth.lattice, ray.lattice_at(t)) <= bound;
        let level = (truth.height - ray.height_at(t)).abs() <= hit_height(bound, field.steepness(truth.lattice));
        if on_ray && near && level && hit.status == truth.status {
            return Verdict::Right;
        }
        let others = rounded[&class(bound_of(ray))].fields.each_ref().map(|field| expected(technique, view, field, ray));
        let around = [truth, others[0], others[1]];
        let length = rays::distance(ray.lattice_at(0.0), ray.lattice_at(1.0));
        let slack = (bound / length).min(1e-3);
        let first = around.iter().fold(f64::INFINITY, |first, hit| first.min(hit.t)) - slack;
        let last = around.iter().fold(f64::NEG_INFINITY, |last, hit| last.max(hit.t)) + slack;
        let between = (first..=last).contains(&t);
        let known = around.iter().any(|around| around.status == hit.status);
        if !(on_ray && between && known) {
            return Verdict::Wrong(format!("{ray:?}\n    {hit:?}\n    {truth:?}\n    t from {first} to {last}"));
        }
        if around.iter().any(|around| around.steps != truth.steps) { Verdict::AtBorder } else { Verdict::Tangent }
    };
    let mut tally = Tally { rays: rays.len(), ..Tally::default() };
    for verdict in rays::each(rays.len(), judge) {
        match verdict {
            Verdict::Right => {}
            Verdict::AtBorder => tally.at_border += 1,
            Verdict::Tangent => tally.tangent += 1,
            Verdict::Wrong(why) => tally.wrong.push(why),
        }
    }
    tally
}

/// Holds a technique to its specification over fields of every kind, with view rays and through pieces of shells, by loads and
/// through the filter. `adjust` sets what the technique lets one choose.
pub fn hold(technique: Technique, adjust: impl Fn(&mut View)) {
    let Some(loads) = gpu_that_loads() else { return };
    let filters = gpu().filter(|gpu| gpu.filters_r32float());
    for gpu in [Some(loads), filters].into_iter().flatten() {
        let path = if gpu.filters_r32float() { "filtered" } else { "loaded" };
        let (mut smooth, mut rough) = (Tally::default(), Tally::default());
        for (kind, addressing) in Kind::ALL.into_iter().flat_map(|kind| ADDRESSINGS.map(|addressing| (kind, addressing))) {
            let field = kind.field([200, 150], addressing);
            let mut view = rays::view(&field);
            adjust(&mut view);
            let mut rays = view_rays(41, 5_000, field.size);
            rays.extend(pieces(42, 5_000, field.size));
            let tally = compare(gpu, technique, &field, &view, &rays);
            println!(
                "{technique:?}, {path}, {kind:?} {addressing:?}: of {} rays {} at a sample's border, {} tangent, {} wrong",
                tally.rays,
                tally.at_border,
                tally.tangent,
                tally.wrong.len()
            );
            for wrong in tally.wrong.iter().take(2) {
                eprintln!("{technique:?}, {path}, {kind:?} {addressing:?}: {wrong}");
            }
            let is_smooth = matches!(kind, Kind::Constant | Kind::Elevation | Kind::Waves);
            if is_smooth { &mut smooth } else { &mut rough }.add(tally);
        }
        for tally in [&smooth, &rough] {
            assert_eq!(tally.wrong.len(), 0, "{technique:?}, {path}");
        }
        // On white noise, spikes and steps every ray passes samples by little. The filter moves every hit on a slope.
        let is_held = !gpu.filters_r32float();
        let off = smooth.off_share();
        assert!(!is_held || off <= tolerances::TECHNIQUE_OFF_SHARE, "{technique:?}, {path}: {off} off");
    }
}

/// Where the bilinear surface is really met.
pub fn truth(field: &HeightField, ray: &Ray) -> [f64; 2] {
    let line = Line::from(ray);
    line.lattice_at(line.meets(field, 0.0, ray.t_end.into()).expect("a view ray always ends"))
}

/// Mean distance of the hits from where the bilinear surface is really met, cells.
pub fn mean_error(gpu: &Gpu, technique: Technique, field: &HeightField, view: &View, rays: &[Ray], truth: &[[f64; 2]]) -> f64 {
    let hits = rays::trace(gpu, technique, &rays::upload(gpu, field), view, rays);
    let errors = hits.iter().zip(truth).map(|(hit, truth)| rays::distance(hit.lattice.map(f64::from), *truth));
    errors.sum::<f64>() / rays.len() as f64
}

/// A flat field.
pub fn flat(height: f32) -> HeightField {
    HeightField::from_fn([64, 64], Addressing::Wrap, |_, _| height)
}
