//! The true positions in f64, from the specification: every cell that a ray crosses, one after the other, on all cores. It knows
//! the bare plane only.

use glam::{DVec2, DVec3};

use super::metrics::Point;
use crate::camera::Camera;
use crate::reference::{HeightField, ray_map};
use crate::scene::Scene;
use crate::surface::ray_map::{Placement, Target};
use crate::surface::{Stage, Technique};

/// Whether the specification knows what this scene shows: the bare plane.
pub fn knows(scene: &Scene) -> bool {
    if scene.mesh.is_some() {
        return false;
    }
    let mut scene = scene.clone();
    // Depth changes nothing where nothing else is seen.
    (scene.trace.technique, scene.trace.displaced_depth) = (Technique::Exact, false);
    !Stage::is_needed(&scene)
}

/// What every pixel of the picture shows, row by row.
pub fn reference(scene: &Scene, heights: Vec<f32>, camera: &Camera, image_size: [u32; 2]) -> Vec<Option<Point>> {
    let field = HeightField::new(scene.field.size, scene.field.addressing, heights);
    let target = Target {
        placement: Placement::default(),
        field_size: scene.field.size,
        plane_size_metres: scene.plane_size_metres(),
        depth_metres: f64::from(scene.plane.depth_metres),
    };
    let [width, height] = image_size;
    let row = |y: u32| (0..width).map(move |x| (x, y));
    let repeat = scene.plane.repeat.map(f64::from);
    let point = |(x, y): (u32, u32)| pixel(&field, &target, repeat, camera, image_size, [f64::from(x) + 0.5, f64::from(y) + 0.5]);
    // Neighbouring rows cost alike and distant ones do not: deal them out in turn.
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get() as u32);
    let mut rows: Vec<Vec<Option<Point>>> = vec![Vec::new(); height as usize];
    std::thread::scope(|scope| {
        let hands: Vec<_> = (0..cores)
            .map(|core| {
                let (row, point) = (&row, &point);
                let own_rows = (core..height).step_by(cores as usize);
                scope.spawn(move || own_rows.map(|y| (y, row(y).map(point).collect())).collect::<Vec<(u32, Vec<_>)>>())
            })
            .collect();
        for (y, points) in hands.into_iter().flat_map(|hand| hand.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
        {
            rows[y as usize] = points;
        }
    });
    rows.concat()
}

/// What a pixel shows of a plane that shows the field `repeat` times along u and v.
fn pixel(
    field: &HeightField,
    target: &Target,
    repeat: [f64; 2],
    camera: &Camera,
    image_size: [u32; 2],
    pixel: [f64; 2],
) -> Option<Point> {
    let line = ray_map::ray(camera, image_size, target, pixel)?;
    let size = target.field_size.map(f64::from);
    let on_plane = |axis: usize| (line.lattice[axis] + 0.5 - 0.5 * size[axis]).abs() <= 0.5 * repeat[axis] * size[axis];
    if !(on_plane(0) && on_plane(1)) {
        return None;
    }
    // Above the highest texel there is nothing to meet, and below the floor no surface.
    let t = line.meets(field, 1.0 - field.range[1], 1.0).unwrap_or(1.0);
    let lattice = DVec2::from(line.lattice_at(t));
    let [width_metres, height_metres] = target.plane_size_metres;
    let uv = (lattice + 0.5) / DVec2::from(size);
    let position = DVec3::new((uv.x - 0.5) * width_metres, -t * target.depth_metres, (uv.y - 0.5) * height_metres);
    Some(Point { position, lattice })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Addressing;

    #[test]
    fn a_flat_field_is_where_geometry_says() {
        let mut scene = Scene::default();
        scene.field.size = [8, 4];
        scene.field.addressing = Addressing::Clamp;
        let camera = Camera::look_at(DVec3::new(0.0, 2.0, 0.0), DVec3::ZERO, 0.6, 0.01);
        let image_size = [31, 21];
        let points = reference(&scene, vec![0.25; 32], &camera, image_size);
        assert_eq!(points.len(), 31 * 21);
        // Three times as wide, it fills the picture.
        scene.plane.repeat = [3, 9];
        assert!(reference(&scene, vec![0.25; 32], &camera, image_size).iter().all(Option::is_some));
        // Straight down in the middle.
        let middle = points[10 * 31 + 15].unwrap();
        assert!(middle.position.distance(DVec3::new(0.0, -0.075, 0.0)) < 1e-7, "{middle:?}");
        assert!(middle.lattice.distance(DVec2::new(3.5, 1.5)) < 1e-6, "{middle:?}");
        // A plane of 1 m by ½ m from 2 m: as many pixels as its edges enclose at height 0.
        let per_metre = 0.5 * 21.0 / (2.0 * 0.3_f64.tan());
        let expected = per_metre * per_metre * 0.5;
        let shown = points.iter().flatten().count() as f64;
        assert!((shown - expected).abs() < 0.15 * expected, "{shown} for {expected}");
        assert!(points.iter().flatten().all(|point| (point.position.y + 0.075).abs() < 1e-7));
    }
}
