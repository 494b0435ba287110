//! Lights that are discs, and fields that show what their shadows look like.

use rilievo::gpu::Gpu;
use rilievo::reference::light_disc::{LightDisc, Scale};
use rilievo::reference::{Addressing, HeightField, Ray};
use rilievo::surface::{Shadow, View};

use super::fields::{Kind, Random};
use super::rays;

/// Texels of 1 mm and a depth of 100 mm, as [`rays::view`] has them.
pub const SCALE: Scale = Scale { cell_metres: [1e-3, 1e-3], depth_metres: 0.1 };

/// A light: degrees above the plane, from +x toward +z, and half the angle that its disc spans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    pub elevation: f32,
    pub azimuth: f32,
    pub half_angle: f32,
}

impl Light {
    pub fn radius(self) -> f32 {
        self.half_angle.to_radians().tan()
    }

    /// Lattice displacement of the ray to its centre while that climbs by a height of 1.
    pub fn travel(self) -> [f32; 2] {
        let (sine, cosine) = self.azimuth.to_radians().sin_cos();
        [cosine, sine].map(|part| part * 100.0 / self.elevation.to_radians().tan())
    }

    /// The ray from the surface at a lattice position.
    pub fn ray(self, field: &HeightField, lattice: [f32; 2]) -> Ray {
        Ray::shadow(lattice, self.travel(), field.bilinear(lattice.map(f64::from)) as f32)
    }

    pub fn disc(self, ray: &Ray) -> LightDisc {
        LightDisc::new(ray, &SCALE, f64::from(self.radius()))
    }

    /// Receivers all over the field, but for those whose surface faces away from the light: these see none by definition.
    pub fn receivers(self, field: &HeightField, count: usize) -> Vec<Ray> {
        let mut random = Random::new(61);
        let travel = self.travel().map(f64::from);
        let faces = |[x, y]: [f64; 2]| {
            let slope = [
                field.bilinear([x + 0.5, y]) - field.bilinear([x - 0.5, y]),
                field.bilinear([x, y + 0.5]) - field.bilinear([x, y - 0.5]),
            ];
            slope[0] * travel[0] + slope[1] * travel[1] < 1.0
        };
        let anywhere = std::iter::repeat_with(|| field.size.map(|size| random.uniform(0.0, size as f32)));
        anywhere.filter(|at| faces(at.map(f64::from))).take(count).map(|at| self.ray(field, at)).collect()
    }
}

/// The visibility at the start of the rays, of a light whose disc has this radius, with so many points of it where they count.
pub fn seen(gpu: &Gpu, shadow: Shadow, field: &HeightField, radius: f32, points: u32, rays: &[Ray]) -> Vec<f64> {
    let view = View { light_radius: radius, area_samples: points, ..rays::view(field) };
    rays::shadow(gpu, shadow, &rays::upload(gpu, field), &view, rays).into_iter().map(f64::from).collect()
}

/// Root of the mean square of the differences.
pub fn rms(a: &[f64], b: &[f64]) -> f64 {
    (a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / a.len() as f64).sqrt()
}

/// What casts shadows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scenery {
    /// A straight wall along v, eight texels thick.
    Wall,
    /// The same, askew to the lattice.
    Askew,
    /// Low ground, and high ground beyond a straight edge.
    Step,
    /// Smooth hills.
    Hills,
    /// Ridges and valleys of every size.
    Elevation,
    /// Boxes of every height.
    Boxes,
    /// Round posts, two to eight texels thick.
    Posts,
    /// White noise.
    Noise,
}

impl Scenery {
    pub const ALL: [Self; 8] =
        [Self::Wall, Self::Askew, Self::Step, Self::Hills, Self::Elevation, Self::Boxes, Self::Posts, Self::Noise];

    /// Where no feature is thinner than the light's disc is wide.
    pub fn is_plain(self) -> bool {
        matches!(self, Self::Wall | Self::Askew | Self::Step | Self::Hills)
    }

    pub fn field(self) -> HeightField {
        let size = [256, 256];
        let from = |height: &dyn Fn(f32, f32) -> f32| {
            HeightField::from_fn(size, Addressing::Wrap, |x, y| height(x as f32 - 128.0, y as f32 - 128.0))
        };
        let mut random = Random::new(62);
        let mut things = |count: usize, low: f32, high: f32| -> Vec<[f32; 5]> {
            let thing = || {
                let at = [0, 1].map(|_| random.uniform(-128.0, 128.0));
                let extent = [0, 1].map(|_| random.uniform(low, high));
                [at[0], at[1], extent[0], extent[1], random.uniform(0.3, 1.0)]
            };
            std::iter::repeat_with(thing).take(count).collect()
        };
        match self {
            Self::Wall => from(&|x, _| if x.abs() < 4.0 { 0.7 } else { 0.2 }),
            Self::Askew => from(&|x, y| if (0.8 * x + 0.6 * y).abs() < 4.0 { 0.7 } else { 0.2 }),
            Self::Step => from(&|x, _| if x > 0.0 { 0.8 } else { 0.2 }),
            Self::Hills => Kind::Waves.field(size, Addressing::Wrap),
            Self::Elevation => Kind::Elevation.field(size, Addressing::Wrap),
            Self::Boxes => {
                let boxes = things(40, 4.0, 18.0);
                let covers =
                    |x: f32, y: f32, thing: &[f32; 5]| (x - thing[0]).abs() < thing[2] && (y - thing[1]).abs() < thing[3];
                from(&|x, y| boxes.iter().filter(|thing| covers(x, y, thing)).fold(0.1, |top, thing| top.max(thing[4])))
            }
            Self::Posts => {
                let posts = things(100, 1.0, 4.0);
                let covers = |x: f32, y: f32, thing: &[f32; 5]| (x - thing[0]).hypot(y - thing[1]) < thing[2];
                from(&|x, y| posts.iter().filter(|thing| covers(x, y, thing)).fold(0.1, |top, thing| top.max(thing[4])))
            }
            Self::Noise => Kind::Noise.field(size, Addressing::Wrap),
        }
    }
}

/// The visibility behind a straight edge along v, light falling along u: rays across its penumbra, and what the disc's ramp says
/// of each.
pub fn behind_a_step(light: Light) -> (HeightField, Vec<Ray>, Vec<f64>) {
    // The bilinear surface has its edge at x = 200.
    let (low, high) = (0.1, 0.9);
    let field = HeightField::from_fn([256, 16], Addressing::Clamp, |x, _| if x < 200 { low } else { high });
    let light = Light { azimuth: 0.0, ..light };
    let heights = f64::from(high) - f64::from(low);
    let (rays, ramps) = (0..2_000)
        .map(|i| {
            let x = 5.0 + 190.0 * i as f32 / 2_000.0;
            // The edge's elevation below the light's centre, in radii, in the plane that the disc lies in.
            let edge = (heights * 100.0).atan2(200.0 - f64::from(x));
            let above = (f64::from(light.elevation).to_radians() - edge).tan() / f64::from(light.radius());
            (light.ray(&field, [x, 8.0]), rilievo::reference::light_disc::ramp(above))
        })
        .unzip();
    (field, rays, ramps)
}

/// Floors with a round hill that grows, and rays from around it toward lights of every side and height.
pub fn growing_hills() -> (Vec<HeightField>, Vec<Ray>) {
    let hill = |top: f32| {
        HeightField::from_fn([64, 64], Addressing::Clamp, move |x, y| {
            let bump = (1.0 - ((x as f32 - 32.0).hypot(y as f32 - 32.0) / 9.0).powi(2)).max(0.0);
            0.2 + top * bump
        })
    };
    let mut random = Random::new(63);
    let rays = (0..2_000)
        .map(|_| {
            let [x, y] = random.direction().map(|part| 32.0 + 14.0 * part);
            let length = random.logarithmic(20.0, 200.0);
            Ray::shadow([x, y], random.direction().map(|part| part * length), 0.2)
        })
        .collect();
    ((0..=20).map(|step| hill(0.04 * step as f32)).collect(), rays)
}
