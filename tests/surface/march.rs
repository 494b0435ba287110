//! How many samples a ray takes, and where they lie.

use rilievo::reference::{Ray, march};
use rilievo::scene::PomCounts;
use rilievo::surface::{Technique, View};

use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::techniques::{flat, samples, view_rays};

#[test]
fn samples_grow_from_head_on_to_edge_on_and_need_not_be_whole() {
    let count = |travel_metres| march::samples_by_angle(march::cosine([travel_metres, 0.0], -0.1), [8.0, 50.0]);
    assert_eq!(count(0.0), 8.0);
    assert!((count(1e6) - 50.0).abs() < 1e-4);
    let counts: Vec<_> = (0..100).map(|i| count(0.01 * f64::from(i))).collect();
    assert!(counts.windows(2).all(|pair| pair[0] < pair[1]));
}

#[test]
fn by_texels_there_is_one_for_each_that_the_offset_crosses() {
    // [Zink]'s example: a parallax limit of 0.5 over 256 texels.
    assert_eq!(march::samples_by_texels(&Ray::view([0.0, 0.0], [0.0, 128.0]), [8.0, 4096.0]), 128.0);
    let piece = Ray { t_end: 0.5, ..Ray::view([0.0, 0.0], [30.0, 40.0]) };
    assert_eq!(march::samples_by_texels(&piece, [8.0, 4096.0]), 25.0);
    assert_eq!(march::samples_by_texels(&Ray::view([0.0, 0.0], [3.0, 0.0]), [8.0, 4096.0]), 8.0);
    assert_eq!(march::samples_by_texels(&Ray::view([0.0, 0.0], [1e6, 0.0]), [8.0, 4096.0]), 4096.0);
}

/// On the floor a ray takes all its samples: the shader's counts are the specification's.
#[test]
fn a_ray_to_the_floor_takes_every_sample() {
    let Some(gpu) = gpu() else { return };
    let field = flat(0.0);
    let rays = view_rays(50, 2_000, field.size);
    for pom_counts in [PomCounts::Angle as u32, PomCounts::Texels as u32] {
        let view = View { pom_counts, step_cap: 200, ..rays::view(&field) };
        let hits = rays::trace(gpu, Technique::PomLinear, &rays::upload(gpu, &field), &view, &rays);
        for (ray, hit) in rays.iter().zip(hits) {
            let count = samples(&view, ray);
            // One at the start, one at the end, and rounding where the count is whole.
            let whole = (count - count.round()).abs() < 1e-4;
            let fewest = 1 + if whole { count.round() as u32 } else { count.ceil() as u32 };
            assert!(hit.steps >= fewest && hit.steps <= fewest + u32::from(whole), "{} of {count} samples: {ray:?}", hit.steps);
        }
    }
}
