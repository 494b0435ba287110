//! The specification of the traversal against dense sampling, and what the traversal does at its limits.

use rilievo::reference::traversal::Line;
use rilievo::reference::{Addressing, HeightField, Ray};
use rilievo::surface::probe::Hit;
use rilievo::surface::{Shadow, Technique, View};

use crate::support::fields::{ADDRESSINGS, Kind, Random};
use crate::support::gpu::gpu;
use crate::support::rays;

/// The reference is the truth of everything else: here it is held against the surface itself, sampled.
#[test]
fn the_reference_meets_the_surface_first_where_samples_say() {
    let mut random = Random::new(11);
    for (kind, addressing) in Kind::ALL.into_iter().flat_map(|kind| ADDRESSINGS.map(|addressing| (kind, addressing))) {
        let field = kind.field([19, 14], addressing);
        for _ in 0..100 {
            let (lattice, travel) = rays::random_ray(&mut random, field.size);
            let line = Line::from(&Ray::view(lattice, travel));
            let hit = line.meets(&field, 0.0, 1.0).expect("a view ray always ends");
            assert!(line.gap(&field, hit).abs() < 1e-9, "{line:?} is {:e} off at {hit}", line.gap(&field, hit));
            // Nowhere before is it under the surface, and its least height is the least of the samples or a little less.
            let samples = (0..=2_000).map(|i| line.gap(&field, hit * f64::from(i) / 2_000.0));
            let least = samples.fold(f64::INFINITY, f64::min);
            let (closest, _) = line.closest(&field, 0.0, hit);
            assert!(least > -1e-9, "{line:?} is {least:e} under the surface before {hit}");
            assert!(closest <= least + 1e-9, "{closest} of {least}");
        }
    }
}

#[test]
fn the_reference_crosses_every_cell_once_and_without_gaps() {
    let field = Kind::Noise.field([7, 5], Addressing::Wrap);
    for (lattice, travel) in
        [([0.0, 0.0], [5.0, 5.0]), ([3.0, 2.5], [-20.0, 0.0]), ([0.3, 0.7], [8.1, -3.3]), ([2.0, 2.0], [0.0, 0.0])]
    {
        let line = Line::from(&Ray::view(lattice, travel));
        let stretches: Vec<_> = line.stretches(&field, 0.0, 1.0).collect();
        assert_eq!(stretches[0].t, 0.0);
        for (one, next) in stretches.iter().zip(&stretches[1..]) {
            assert!((one.t + one.length - next.t).abs() < 1e-15);
        }
        let last = stretches[stretches.len() - 1];
        assert!((last.t + last.length - 1.0).abs() < 1e-15);
    }
}

#[test]
fn a_ray_that_reaches_the_cap_says_so_with_its_count() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Noise.field([256, 256], Addressing::Wrap);
    let textures = rays::upload(gpu, &field);
    let mut random = Random::new(12);
    let list: Vec<_> = (0..4_000)
        .map(|_| {
            let (lattice, travel) = rays::random_ray(&mut random, field.size);
            Ray::view(lattice, travel)
        })
        .collect();
    let free = rays::trace(gpu, Technique::Exact, &textures, &rays::view(&field), &list);
    assert!(free.iter().all(|hit| hit.status == Hit::HIT));
    for cap in [1, 3, 8] {
        let view = View { step_cap: cap, ..rays::view(&field) };
        let capped = rays::trace(gpu, Technique::Exact, &textures, &view, &list);
        for (free, capped) in free.iter().zip(&capped) {
            if free.steps <= cap {
                assert_eq!(free, capped);
            } else {
                assert_eq!((capped.status, capped.steps), (Hit::CAPPED, cap));
            }
        }
        // A shadow ray that gave up did not find the light.
        let seen = |view: &View| {
            let list: Vec<_> = list.iter().map(|ray| Ray::shadow(ray.lattice, ray.travel, 0.0)).collect();
            rays::shadow(gpu, Shadow::Hard, &textures, view, &list)
        };
        for (free, capped) in seen(&rays::view(&field)).iter().zip(seen(&view)) {
            assert!(capped <= *free);
        }
    }
}

/// The cost is that of the neighbourhood of the hit, not of the way to it.
#[test]
fn a_long_way_over_low_ground_takes_few_steps() {
    let Some(gpu) = gpu() else { return };
    // One wall in 1024 columns.
    let field = HeightField::from_fn([1024, 1024], Addressing::Clamp, |x, _| if x == 1000 { 1.0 } else { 0.01 });
    let list: Vec<_> = (0..500).map(|i| Ray::view([3.3, 2.0 * i as f32 + 0.1], [1_250.0, 0.0])).collect();
    let hits = rays::trace(gpu, Technique::Exact, &rays::upload(gpu, &field), &rays::view(&field), &list);
    for hit in hits {
        assert!(hit.steps <= 64 && (hit.lattice[0] - 999.2).abs() < 0.1, "{hit:?}");
    }
}

/// Beyond a clamped border the outermost texels go on for ever, further than integers count.
#[test]
fn a_ray_without_end_leaves_a_clamped_field_and_hits_what_goes_on_there() {
    let Some(gpu) = gpu() else { return };
    let field = HeightField::from_fn([33, 20], Addressing::Clamp, |x, y| if x % 32 == 0 || y % 19 == 0 { 0.25 } else { 0.0 });
    let list: Vec<_> = [1e5, 1e9, 1e12, 1e30]
        .into_iter()
        .flat_map(|far: f32| [[far, 0.0], [-far, 0.0], [0.0, far], [0.0, -far], [far, far], [-far, far]])
        .map(|travel| Ray::view([5.5, 7.5], travel))
        .collect();
    for hit in rays::trace(gpu, Technique::Exact, &rays::upload(gpu, &field), &rays::view(&field), &list) {
        assert_eq!(hit.status, Hit::HIT);
        assert!((hit.t - 0.75).abs() < 1e-4 || hit.lattice[0].abs() < 40.0 && hit.lattice[1].abs() < 40.0, "{hit:?}");
    }
}
