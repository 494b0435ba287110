//! Hard shadows against f64 quadratics of every cell on the way to the light, for a million random rays and a hundred thousand
//! adversarial ones.

use rilievo::reference::shadow_hard::{shadow, way_to_light};
use rilievo::reference::traversal::Stretch;
use rilievo::reference::{Addressing, HeightField, Ray};
use rilievo::surface::Shadow;

use crate::support::fields::{Kind, Random};
use crate::support::gpu::gpu;
use crate::support::rays::{self, Adversary};
use crate::support::tolerances;

/// How one visibility compares with the reference.
enum Judgement {
    Agrees,
    /// It differs, but the ray grazes what it should have met or missed.
    Tangent,
    Wrong(String),
}

fn judge(field: &HeightField, ray: &Ray, seen: f32) -> Judgement {
    let truth = shadow(field, ray);
    if f64::from(seen) == truth {
        return Judgement::Agrees;
    }
    let (line, end) = way_to_light(field, ray);
    let cells = tolerances::lattice_bound(rays::reach(&[line.lattice, line.lattice_at(end)]));
    let (lowest, slope) = line.closest(field, 0.0, end);
    let height = tolerances::hit_height(cells, slope);
    if truth == 0.0 && -lowest > height {
        return Judgement::Wrong(format!("lit, but {:e} under the surface on its way, {height:e} allowed", -lowest));
    }
    let clearance = clearance(line.stretches(field, 0.0, end));
    if truth == 1.0 && clearance > height {
        return Judgement::Wrong(format!("dark, but never nearer to the surface than {clearance:e}, {height:e} allowed"));
    }
    Judgement::Tangent
}

/// The least height above the surface at which a ray that left it stops nearing it again.
fn clearance(stretches: impl Iterator<Item = Stretch>) -> f64 {
    let mut least = f64::INFINITY;
    let mut nears = false;
    let mut end = f64::INFINITY;
    for stretch in stretches {
        let [start, slope, bend] = stretch.gap;
        let at = |s: f64| start + s * (slope + s * bend);
        if nears && slope >= 0.0 {
            least = least.min(start);
        }
        if let Some(valley) = stretch.valley() {
            least = least.min(at(valley));
        }
        nears = slope + 2.0 * bend * stretch.length < 0.0;
        end = at(stretch.length);
    }
    if nears { least.min(end) } else { least }
}

/// How many rays made by `make` were judged, how many of them are tangent and how many wrong.
fn compare(
    label: &str,
    count: usize,
    make: impl Fn(&mut Random, [u32; 2]) -> ([f32; 2], [f32; 2]),
) -> Option<(usize, usize, usize)> {
    let gpu = gpu()?;
    let (mut judged, mut lit, mut tangent, mut wrong) = (0, 0, 0, 0);
    rays::over_every_field(count, make, |kind, field, rays| {
        let rays: Vec<_> = rays
            .iter()
            .map(|(lattice, travel)| Ray::shadow(*lattice, *travel, field.bilinear(lattice.map(f64::from)) as f32))
            .collect();
        let seen = rays::shadow(gpu, Shadow::Hard, &rays::upload(gpu, field), &rays::view(field), &rays);
        let judgements = rays::each(rays.len(), |i| judge(field, &rays[i], seen[i]));
        judged += rays.len();
        lit += seen.iter().filter(|seen| **seen == 1.0).count();
        let mut told = 0;
        for (judgement, ray) in judgements.iter().zip(&rays) {
            match judgement {
                Judgement::Agrees => {}
                Judgement::Tangent => tangent += 1,
                Judgement::Wrong(why) => {
                    wrong += 1;
                    told += 1;
                    if told <= 2 {
                        eprintln!("{label}, {kind:?} {:?} {:?}: {why}\n    {ray:?}", field.size, field.addressing);
                    }
                }
            }
        }
    });
    println!("{label}: {judged} shadow rays, {lit} lit, {wrong} wrong, {tangent} tangent");
    Some((judged, tangent, wrong))
}

#[test]
fn a_million_random_rays_see_the_light_where_the_reference_does() {
    let Some((judged, tangent, wrong)) = compare("random", rays::RANDOM, rays::random_ray) else { return };
    assert!(judged >= 1_000_000);
    assert_eq!(wrong, 0);
    assert!((tangent as f64) < tolerances::TANGENT_SHARE * judged as f64);
}

#[test]
fn a_hundred_thousand_adversarial_rays_see_the_light_where_the_reference_does() {
    let (mut judged, mut tangent, mut wrong) = (0, 0, 0);
    for adversary in Adversary::ALL {
        let make = |random: &mut Random, size: [u32; 2]| adversary.ray(random, size);
        let Some(tally) = compare(&format!("{adversary:?}"), rays::ADVERSARIAL, make) else { return };
        judged += tally.0;
        tangent += tally.1;
        wrong += tally.2;
    }
    assert!(judged >= 100_000);
    assert_eq!(wrong, 0);
    assert!((tangent as f64) < tolerances::ADVERSARIAL_TANGENT_SHARE * judged as f64);
}

#[test]
fn a_flat_field_is_lit_at_any_height() {
    let Some(gpu) = gpu() else { return };
    let mut random = Random::new(7);
    for height in [0.0, 1e-30, 0.1, 0.5, 0.999_999_94, 1.0] {
        let field = HeightField::from_fn([37, 53], Addressing::Wrap, |_, _| height);
        let rays: Vec<_> = (0..2_000)
            .map(|_| {
                let (lattice, travel) = rays::random_ray(&mut random, field.size);
                Ray::shadow(lattice, travel, height)
            })
            .collect();
        let seen = rays::shadow(gpu, Shadow::Hard, &rays::upload(gpu, &field), &rays::view(&field), &rays);
        assert!(seen.iter().all(|seen| *seen == 1.0), "at {height}");
    }
}

#[test]
fn the_start_is_the_surface_whatever_the_ray_says() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Elevation.field([128, 128], Addressing::Clamp);
    let mut random = Random::new(8);
    let rays: Vec<_> = (0..4_000).map(|_| rays::random_ray(&mut random, field.size)).collect();
    let seen_from = |offset: f64| {
        let rays: Vec<_> = rays
            .iter()
            .map(|(lattice, travel)| Ray::shadow(*lattice, *travel, (field.bilinear(lattice.map(f64::from)) + offset) as f32))
            .collect();
        rays::shadow(gpu, Shadow::Hard, &rays::upload(gpu, &field), &rays::view(&field), &rays)
    };
    assert_eq!(seen_from(0.0), seen_from(-0.01));
    assert_eq!(seen_from(0.0), seen_from(0.01));
}
