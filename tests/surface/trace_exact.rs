//! The exact trace against f64 quadratics of every cell on the way: a million random rays, a hundred thousand adversarial ones.

use rilievo::reference::traversal::Line;
use rilievo::reference::{HeightField, Ray};
use rilievo::surface::Technique;
use rilievo::surface::probe::Hit;

use crate::support::fields::Random;
use crate::support::gpu::gpu;
use crate::support::rays::{self, Adversary};
use crate::support::tolerances;

/// What a comparison of the hits with the reference found.
#[derive(Clone, Debug, Default)]
struct Tally {
    rays: usize,
    /// Rays whose hit is off by more than rounding, as grazing rays' may be.
    tangent: usize,
    /// The largest misplacement of the others, in units of the tolerance.
    largest: f64,
    steps: u64,
    failures: Vec<String>,
}

impl Tally {
    fn of(field: &HeightField, rays: &[Ray], hits: &[Hit]) -> Self {
        let judged = rays::each(rays.len(), |i| judge(field, &rays[i], &hits[i]));
        let mut tally = Self { rays: rays.len(), ..Self::default() };
        for (judgement, (ray, hit)) in judged.into_iter().zip(rays.iter().zip(hits)) {
            tally.steps += u64::from(hit.steps);
            match judgement {
                Judgement::Agrees(misplacement) => tally.largest = tally.largest.max(misplacement),
                Judgement::Tangent => tally.tangent += 1,
                Judgement::Wrong(why) => tally.failures.push(format!("{why}\n    {ray:?}\n    {hit:?}")),
            }
        }
        tally
    }
}

enum Judgement {
    /// The hit is where the reference has it, up to this share of the tolerance.
    Agrees(f64),
    /// It is elsewhere, but the ray grazes the surface at the one that was missed or gained.
    Tangent,
    Wrong(String),
}

/// Holds one hit against the reference.
fn judge(field: &HeightField, ray: &Ray, hit: &Hit) -> Judgement {
    if hit.status != Hit::HIT {
        return Judgement::Wrong(format!("status {}", hit.status));
    }
    let line = Line::from(ray);
    let begin = (line.height - field.range[1]).max(0.0);
    let truth = line.meets(field, begin, line.height).unwrap_or(line.height);
    let there = line.lattice_at(truth);
    let here = hit.lattice.map(f64::from);
    let t = f64::from(hit.t);

    let cells = tolerances::lattice_bound(rays::reach(&[line.lattice, here, there]));
    if rays::distance(here, line.lattice_at(t)) > cells {
        return Judgement::Wrong("the hit is not on its ray".to_owned());
    }
    // Wherever it is, it has to be on the surface.
    let slope = rays::steepness_around(field, here, cells);
    let height = tolerances::hit_height(cells, slope);
    let gap = line.height + line.rise * t - field.bilinear(here);
    if gap.abs() > height || (f64::from(hit.height) - field.bilinear(here)).abs() > height {
        return Judgement::Wrong(format!("{gap:e} off the surface, {height:e} allowed; the reference hits at {truth}"));
    }
    let misplacement = rays::distance(here, there) / cells;
    if misplacement <= 1.0 {
        return Judgement::Agrees(misplacement);
    }
    if t > truth {
        // It went through: how deep?
        let (lowest, slope) = line.closest(field, truth, t);
        let height = tolerances::hit_height(cells, slope);
        if -lowest > height {
            return Judgement::Wrong(format!("passed {:e} under the surface, {height:e} allowed; hit at {truth}", -lowest));
        }
    }
    Judgement::Tangent
}

/// Traces rays made by `make` over every kind of field and reports what does not agree.
fn compare(label: &str, count: usize, make: impl Fn(&mut Random, [u32; 2]) -> ([f32; 2], [f32; 2])) -> Option<Tally> {
    let gpu = gpu()?;
    let mut total = Tally::default();
    rays::over_every_field(count, make, |kind, field, rays| {
        let rays: Vec<_> = rays.iter().map(|(lattice, travel)| Ray::view(*lattice, *travel)).collect();
        let hits = rays::trace(gpu, Technique::Exact, &rays::upload(gpu, field), &rays::view(field), &rays);
        let tally = Tally::of(field, &rays, &hits);
        for failure in tally.failures.iter().take(2) {
            eprintln!("{label}, {kind:?} {:?} {:?}: {failure}", field.size, field.addressing);
        }
        total.rays += tally.rays;
        total.tangent += tally.tangent;
        total.largest = total.largest.max(tally.largest);
        total.steps += tally.steps;
        total.failures.extend(tally.failures);
    });
    println!(
        "{label}: {} rays, {} wrong, {} tangent, misplaced by at most {:.2} of the tolerance, {:.1} steps each",
        total.rays,
        total.failures.len(),
        total.tangent,
        total.largest,
        total.steps as f64 / total.rays as f64
    );
    Some(total)
}

#[test]
fn a_million_random_rays_hit_where_the_reference_does() {
    let Some(tally) = compare("random", rays::RANDOM, rays::random_ray) else { return };
    assert!(tally.rays >= 1_000_000);
    assert_eq!(tally.failures.len(), 0);
    assert!((tally.tangent as f64) < tolerances::TANGENT_SHARE * tally.rays as f64);
}

#[test]
fn a_hundred_thousand_adversarial_rays_hit_where_the_reference_does() {
    let (mut rays, mut tangent, mut wrong) = (0, 0, 0);
    for adversary in Adversary::ALL {
        let make = |random: &mut Random, size: [u32; 2]| adversary.ray(random, size);
        let Some(tally) = compare(&format!("{adversary:?}"), rays::ADVERSARIAL, make) else { return };
        rays += tally.rays;
        tangent += tally.tangent;
        wrong += tally.failures.len();
    }
    assert!(rays >= 100_000);
    assert_eq!(wrong, 0);
    assert!((tangent as f64) < tolerances::ADVERSARIAL_TANGENT_SHARE * rays as f64);
}
