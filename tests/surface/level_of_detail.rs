//! Level of detail: the level that the shader gives a pixel is geometry's, and what follows from it is the reference's.

use glam::{DVec2, DVec3};
use rilievo::camera::Camera;
use rilievo::field::normal_mips::NormalMips;
use rilievo::field::normals::Normals;
use rilievo::field::{Field, Region};
use rilievo::gpu::Gpu;
use rilievo::reference::level_of_detail::{flattened, level, plane, samples, shininess, trace_level};
use rilievo::reference::{Addressing, HeightField};
use rilievo::scene::{Lod, Scene};
use rilievo::surface::channels::{Channel, Channels};
use rilievo::surface::ray_map::{Placement, Target};
use rilievo::surface::{Choice, Shadow, Shows, Technique, View};

use crate::support::fields::Kind;
use crate::support::gpu::{gpu, run, wait_for};
use crate::support::rays::upload;
use crate::support::tolerances::{DETAIL_STEP, MEAN_PLANE, MIP_LEVEL};

const IMAGE_SIZE: [u32; 2] = [160, 120];

/// A wrapping field that its plane shows eight times either way.
fn scene(technique: Technique, lod: Lod) -> Scene {
    let mut scene = Scene { lod, ..Scene::default() };
    scene.field.size = [128, 64];
    scene.field.addressing = Addressing::Wrap;
    scene.plane.repeat = [9, 9];
    scene.trace.technique = technique;
    scene.trace.shadow = Shadow::None;
    scene
}

/// The field of the scene, with everything that is derived from it.
fn derived(gpu: &Gpu, scene: &Scene, kind: Kind) -> (HeightField, Field) {
    let heights = kind.field(scene.field.size, scene.field.addressing);
    let field = upload(gpu, &heights);
    let (normals, mips) = (Normals::new(gpu).expect("the shader compiles"), NormalMips::new(gpu).expect("the shader compiles"));
    let (normals_set, mips_set) = (normals.bind(gpu, &field), mips.bind(gpu, &field));
    let all = [Region::all(field.size)];
    run(gpu, |recorder| {
        normals.record(recorder, &normals_set, &all, [12.8, 12.8]);
        mips.record(recorder, &mips_set, &all);
    });
    (heights, field)
}

fn channels(gpu: &Gpu, scene: &Scene, field: &Field, camera: &Camera) -> Vec<Channel> {
    let pass = Channels::new(gpu, Choice::of(scene)).expect("it compiles");
    let view = View::new(scene, camera, 0.0, IMAGE_SIZE, Shows::Picture);
    let readback = pass.request(gpu, field, &view, 0, IMAGE_SIZE[1]);
    bytemuck::pod_collect_to_vec(&wait_for(gpu, &readback))
}

fn cameras() -> [Camera; 3] {
    [([0.0, 1.2, 0.9], [0.0, 0.0, 0.0]), ([0.3, 0.7, -0.2], [0.1, 0.0, 0.05]), ([-0.6, 0.05, 1.35], [0.2, -0.1, -0.1])]
        .map(|(eye, aim): ([f64; 3], [f64; 3])| Camera::look_at(eye.into(), DVec3::from(aim), 45f64.to_radians(), 0.01))
}

fn target(scene: &Scene) -> Target {
    Target {
        placement: Placement::default(),
        field_size: scene.field.size,
        plane_size_metres: scene.plane_size_metres(),
        depth_metres: f64::from(scene.plane.depth_metres),
    }
}

/// The pixels that show the plane, and the level that geometry gives them.
fn levels<'a>(scene: &Scene, camera: &Camera, pixels: &'a [Channel]) -> Vec<(&'a Channel, f64)> {
    let target = target(scene);
    let centre = |index: usize| [index % IMAGE_SIZE[0] as usize, index / IMAGE_SIZE[0] as usize].map(|pixel| pixel as f64 + 0.5);
    pixels
        .iter()
        .enumerate()
        .filter(|(_, pixel)| pixel.steps >= 0.0)
        .map(|(index, pixel)| (pixel, level(camera, IMAGE_SIZE, &target, centre(index)).expect("it shows the plane")))
        .collect()
}

#[test]
fn a_pixels_level_is_the_geometrys() {
    let Some(gpu) = gpu() else { return };
    let scene = scene(Technique::Normal, Lod { threshold: Some(4.0), ..Lod::default() });
    let (_, field) = derived(gpu, &scene, Kind::Constant);
    let (mut worst, mut highest) = (0.0_f64, 0.0_f64);
    for camera in cameras() {
        let pixels = channels(gpu, &scene, &field, &camera);
        let levels = levels(&scene, &camera, &pixels);
        assert!(levels.len() > 5000, "{} pixels show the plane", levels.len());
        for (pixel, expected) in levels {
            worst = worst.max((f64::from(pixel.lod) - expected).abs());
            highest = highest.max(expected);
        }
    }
    println!("levels up to {highest:.1}, off by at most {worst:.1e}");
    assert!(worst <= MIP_LEVEL && highest > 4.0, "{worst}, {highest}");
}

#[test]
fn without_a_threshold_the_level_is_0_and_nothing_is_simplified() {
    let Some(gpu) = gpu() else { return };
    for technique in [Technique::Pom, Technique::Exact] {
        // Light that is filtered changes no trace; and exact stays exact, whatever the threshold, unless it is asked not to.
        let mut lods = vec![Lod { filter: true, ..Lod::default() }];
        if technique == Technique::Exact {
            lods.push(Lod { threshold: Some(2.0), ..Lod::default() });
        }
        let plain = scene(technique, Lod::default());
        let (_, field) = derived(gpu, &plain, Kind::Waves);
        let camera = cameras()[2];
        let expected = channels(gpu, &plain, &field, &camera);
        for lod in lods {
            let pixels = channels(gpu, &scene(technique, lod.clone()), &field, &camera);
            for (pixel, expected) in pixels.iter().zip(&expected) {
                assert_eq!((pixel.position, pixel.steps, pixel.lod), (expected.position, expected.steps, 0.0), "{lod:?}");
            }
        }
    }
}

/// Beyond the threshold the surface is a plane and costs one step, whatever the technique.
#[test]
fn beyond_the_threshold_normal_mapping_alone_is_left() {
    let Some(gpu) = gpu() else { return };
    const THRESHOLD: f64 = 3.0;
    // Micropolygons are no trace.
    for technique in Technique::ALL.iter().copied().filter(|technique| *technique != Technique::Mesh) {
        let lod = Lod { threshold: Some(THRESHOLD as f32), keep_exact: false, ..Lod::default() };
        let detailed = scene(technique, lod);
        let (heights, field) = derived(gpu, &detailed, Kind::Waves);
        let camera = cameras()[2];
        let pixels = channels(gpu, &detailed, &field, &camera);
        let expected = (1.0 - plane(&heights)) * f64::from(detailed.plane.depth_metres);
        let mut beyond = 0;
        for (pixel, _) in levels(&detailed, &camera, &pixels).iter().filter(|(_, level)| *level > THRESHOLD + MIP_LEVEL) {
            let below = -f64::from(pixel.position[1]);
            assert!((below - expected).abs() <= MEAN_PLANE * expected, "{technique:?}: {below} below for {expected}");
            assert_eq!(pixel.steps, 1.0, "{technique:?}");
            beyond += 1;
        }
        assert!(beyond > 500, "{technique:?}: {beyond} beyond");
    }
}

/// Over the level before the threshold each point of the surface goes along its ray to the plane, by the fractional part.
#[test]
fn before_the_threshold_the_surface_flattens_by_the_fractional_part() {
    let Some(gpu) = gpu() else { return };
    const THRESHOLD: f64 = 2.0;
    // Low enough a threshold that the traversal does not yet stop early.
    assert_eq!(trace_level(THRESHOLD), 0.0);
    let on = scene(Technique::Exact, Lod { threshold: Some(THRESHOLD as f32), keep_exact: false, ..Lod::default() });
    let off = scene(Technique::Exact, Lod::default());
    let (heights, field) = derived(gpu, &on, Kind::Waves);
    let depth = f64::from(on.plane.depth_metres);
    let flat = (1.0 - plane(&heights)) * depth;
    let mut between = 0;
    for camera in cameras() {
        let (with, without) = (channels(gpu, &on, &field, &camera), channels(gpu, &off, &field, &camera));
        for ((pixel, level), (full, _)) in levels(&on, &camera, &with).iter().zip(levels(&off, &camera, &without)) {
            let share = flattened(*level, THRESHOLD);
            let full = -f64::from(full.position[1]);
            let expected = full + share * (flat - full);
            let below = -f64::from(pixel.position[1]);
            assert!((below - expected).abs() <= (MEAN_PLANE + MIP_LEVEL) * depth, "{below} for {expected} at level {level}");
            between += u32::from(share > 0.0 && share < 1.0);
        }
    }
    assert!(between > 2000, "{between} pixels between");
}

/// Nearer pixels get more samples, and no pixel more than without.
#[test]
fn counts_grow_toward_the_viewer() {
    assert_eq!(samples(32.0, 0.0), 32.0);
    assert_eq!(samples(32.0, 2.0), 16.0);
    assert_eq!(samples(3.0, 5.0), 3.0);
    let Some(gpu) = gpu() else { return };
    let on = scene(Technique::Pom, Lod { threshold: Some(6.0), ..Lod::default() });
    let off = scene(Technique::Pom, Lod::default());
    let (_, field) = derived(gpu, &on, Kind::Constant);
    let camera = cameras()[2];
    let (with, without) = (channels(gpu, &on, &field, &camera), channels(gpu, &off, &field, &camera));
    for ((pixel, level), full) in levels(&on, &camera, &with).iter().zip(levels(&off, &camera, &without)) {
        if flattened(*level, 6.0) == 0.0 {
            // A flat field is met at the same share of the way: a sample before it, and one more at its start.
            let expected = samples(f64::from(full.0.steps), *level);
            assert!((f64::from(pixel.steps) - expected).abs() <= 2.0, "{} for {expected} at level {level}", pixel.steps);
        }
    }
}

/// A coarse surface moves with the level as smoothly as the levels of a mip chain do: nothing pops.
#[test]
fn the_surface_moves_smoothly_with_the_level() {
    let Some(gpu) = gpu() else { return };
    let coarse = scene(Technique::Exact, Lod { threshold: Some(9.0), keep_exact: false, ..Lod::default() });
    let (_, field) = derived(gpu, &coarse, Kind::Waves);
    let depth = f64::from(coarse.plane.depth_metres);
    // Seen straight from above, and with the centre of a pixel in the middle of the picture, what that pixel sees stays where it is.
    let at = |eye: f64| Camera {
        lens_shift: DVec2::splat(0.5 / f64::from(IMAGE_SIZE[1])),
        ..Camera::look_at(DVec3::new(0.003, eye, 0.002), DVec3::new(0.003, 0.0, 0.002), 45f64.to_radians(), 0.01)
    };
    let pixels = |eye: f64| channels(gpu, &coarse, &field, &at(eye));
    let middle = (IMAGE_SIZE[1] / 2 * IMAGE_SIZE[0] + IMAGE_SIZE[0] / 2) as usize;
    let mut before: Option<f64> = None;
    let (mut most, mut all) = (0.0_f64, 0.0_f64);
    for step in 0..200 {
        let pixel = pixels(3.0 * 1.01_f64.powi(step))[middle];
        let height = 1.0 + f64::from(pixel.position[1]) / depth;
        if let Some(before) = before {
            most = most.max((height - before).abs());
            all += (height - before).abs();
        }
        before = Some(height);
    }
    println!("height of one point over 200 steps of a hundredth: at most {most:.4} a step, {all:.3} in all");
    assert!(most <= DETAIL_STEP && all > 0.01, "{most} of {all}");
}

/// Toksvig's exponent belongs to the sum of the lobe's own variance and the normals'.
#[test]
fn roughness_grows_by_the_variance_that_is_averaged_away() {
    assert_eq!(shininess(40.0, 1.0), 40.0);
    let (own, of_normals) = (1.0 / 40.0, (1.0 - 0.9) / 0.9);
    assert!((1.0 / shininess(40.0, 0.9) - own - of_normals).abs() < 1e-12);
}
