//! The position channel against the truth: rays from the manifest's matrices, the surface from the field's own file, all in f64.

use glam::{DMat4, DVec3, DVec4};
use rilievo::reference::HeightField;
use rilievo::reference::traversal::Line;
use rilievo::scene::Addressing;

use super::{capture, channels, manifest};
use crate::support::gpu::gpu;
use crate::support::tolerances::{hit_height, lattice_bound};

/// What the manifest says of one frame.
struct Seen {
    world_from_view: DMat4,
    vertical_fov: f64,
    image_size: [f64; 2],
    plane_size: [f64; 2],
    depth: f64,
    field: HeightField,
}

impl Seen {
    /// The ray of a pixel in field space: t runs from 0 at the polygon to 1 at the floor.
    fn ray(&self, x: usize, y: usize) -> Option<Line> {
        let [width, height] = self.image_size;
        let half = (0.5 * self.vertical_fov).tan();
        let view = DVec4::new(
            (2.0 * (x as f64 + 0.5) / width - 1.0) * half * width / height,
            (1.0 - 2.0 * (y as f64 + 0.5) / height) * half,
            -1.0,
            0.0,
        );
        let direction = (self.world_from_view * view).truncate();
        let eye = self.world_from_view.w_axis.truncate();
        let meets = eye - eye.y / direction.y * direction;
        let fall = direction * (-self.depth / direction.y);
        let start = self.lattice(meets);
        let inside = (0..2).all(|axis| (-0.5..=f64::from(self.field.size[axis]) - 0.5).contains(&start[axis]));
        let end = self.lattice(meets + fall);
        (direction.y < 0.0 && inside).then_some(Line {
            lattice: start,
            travel: [end[0] - start[0], end[1] - start[1]],
            height: 1.0,
            rise: -1.0,
        })
    }

    fn lattice(&self, world: DVec3) -> [f64; 2] {
        let axis = |axis: usize, at: f64| (at / self.plane_size[axis] + 0.5) * f64::from(self.field.size[axis]) - 0.5;
        [axis(0, world.x), axis(1, world.z)]
    }
}

fn pair(value: &serde_json::Value) -> [f64; 2] {
    [0, 1].map(|index| value[index].as_f64().expect("it is a number"))
}

/// Three cameras, one of them two degrees above the plane.
const CAMERAS: [&str; 3] = ["0,1.0,0.8,0,-0.04,0.02", "-0.75,0.45,-0.35,0.1,-0.05,0.05", "0.2,0.035,0.95,0,0,0"];

#[test]
fn positions_are_where_the_ray_first_meets_the_surface() {
    if gpu().is_none() {
        return;
    }
    for (camera, field_name) in CAMERAS.iter().flat_map(|camera| [(camera, "512"), (camera, "257x193")]) {
        let directory = tempfile::tempdir().expect("there is a temporary directory");
        let out = directory.path();
        let arguments = ["--scene", "relief", "--technique", "exact", "--shadow", "none", "--size", "320x200"];
        capture(out, &[&arguments[..], &["--channels", "position,height", "--camera", camera, "--field", field_name]].concat());

        let manifest = manifest(out);
        let frame = &manifest["frames"][0];
        let (field_size, mut field) = channels(out, "field_00000.exr");
        assert_eq!(manifest["addressing"], "clamp");
        let matrix: Vec<f64> = frame["world_from_view"]
            .as_array()
            .expect("16 numbers")
            .iter()
            .map(|value| value.as_f64().expect("a number"))
            .collect();
        let seen = Seen {
            world_from_view: DMat4::from_cols_slice(&matrix),
            vertical_fov: frame["vertical_fov"].as_f64().expect("radians"),
            image_size: pair(&manifest["image_size"]),
            plane_size: pair(&manifest["plane_size"]),
            depth: manifest["depth"].as_f64().expect("metres"),
            field: HeightField::new(field_size, Addressing::Clamp, field.remove("H").expect("the field's channel")),
        };
        let ([width, height], position) = channels(out, "frame_00000.exr");
        let axis = |name: &str| &position[&format!("position.{name}")];
        let (xs, ys, zs) = (axis("X"), axis("Y"), axis("Z"));

        let (mut shown, mut tangent) = (0_usize, 0_usize);
        for y in 0..height as usize {
            for x in 0..width as usize {
                let index = y * width as usize + x;
                let ray = seen.ray(x, y);
                if !xs[index].is_finite() {
                    // A centre within a rounding of the plane's border may fall on either side.
                    let near = ray.is_some_and(|ray| {
                        (0..2).all(|axis| {
                            let size = f64::from(seen.field.size[axis]);
                            let bound = lattice_bound(size);
                            (ray.lattice[axis] + 0.5).abs() > bound && (ray.lattice[axis] + 0.5 - size).abs() > bound
                        })
                    });
                    assert!(!near, "camera {camera}, pixel {x}, {y}: the plane is missing");
                    continue;
                }
                let Some(ray) = ray else { continue };
                shown += 1;
                let found = seen.lattice(DVec3::new(xs[index].into(), ys[index].into(), zs[index].into()));
                let largest = ray.lattice_at(1.0).into_iter().chain(ray.lattice).fold(0.0, |most: f64, at| most.max(at.abs()));
                let bound = lattice_bound(largest);
                let t = ray.meets(&seen.field, 0.0, 1.0).expect("a ray that enters the slab ends in it");
                let truth = ray.lattice_at(t);
                let error = (truth[0] - found[0]).hypot(truth[1] - found[1]);
                if error <= bound {
                    continue;
                }
                // Another place along the ray: right only if the ray touches the surface there within rounding, and did not
                // dive under it before by more than that.
                tangent += 1;
                let t_found = 1.0 - (f64::from(ys[index]) / seen.depth + 1.0);
                let (lowest, steepness) = ray.closest(&seen.field, 0.0, t_found.clamp(0.0, 1.0));
                let slack = hit_height(bound, steepness);
                assert!(
                    lowest >= -slack && ray.gap(&seen.field, t_found).abs() <= slack,
                    "camera {camera}, field {field_name}, pixel {x}, {y}: {error:e} cells of {bound:e} allowed, t {t_found} for {t}, \
                     penetration {lowest:e}"
                );
            }
        }
        println!("camera {camera}, field {field_name}: {shown} pixels, {tangent} of them tangent");
        assert!(shown > 2000, "camera {camera} shows {shown} pixels");
        assert!(tangent * 10_000 <= shown, "camera {camera}: {tangent} of {shown} pixels are tangent");
    }
}
