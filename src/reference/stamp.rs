//! Stamps in f64, one after another over every texel: the specification of `shaders/field/stamp.wgsl`.

use super::cool::age;
use crate::field::base::hash_cell;
use crate::field::material::{GLOWING_MOMENTS, MOMENTS, MOMENTS_PER_FALL, Marks, moment};
use crate::field::stamp::{
    Blend, CRATER_GRAIN, CRATER_LIP, CRATER_RIM, ImageForm, Profile, RUT_FLOOR, RUT_RIM, Stamp, StampImage,
};

/// The layers that stamps are pressed into.
#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    /// Width and height, texels.
    pub size: [usize; 2],
    /// Whether the field repeats beyond its border.
    pub wrap: bool,
    /// The images that stamps may have for their form.
    pub images: Vec<StampImage>,
    /// In how many seconds what glows falls to 1/e.
    pub cooling_seconds: f64,
    /// Heights, unclamped, row by row.
    pub relief: Vec<f64>,
    /// What stamps left on the material. It is in whole levels after every stamp.
    pub material: Vec<Marks>,
}

/// Where a stamp's own form sees a texel.
struct Place {
    /// The distance in radii, as its irregular form sees it.
    rho: f64,
    /// The same of the segment before it, if it joins one.
    before: Option<f64>,
    /// Its profile, less what the segment before it has pressed.
    profile: f64,
}

impl Layers {
    /// Layers of one height, clean.
    pub fn flat(size: [usize; 2], wrap: bool, height: f64) -> Self {
        let count = size[0] * size[1];
        let (relief, material) = (vec![height; count], vec![Marks::default(); count]);
        Self { size, wrap, images: Vec::new(), cooling_seconds: 1.0, relief, material }
    }

    /// Presses one stamp: where the field wraps, once for each image of a texel that it covers.
    pub fn press(&mut self, stamp: &Stamp) {
        let reach = |axis: usize| {
            let (start, radius, size) = (f64::from(stamp.centre[axis]), f64::from(stamp.radius), self.size[axis] as f64);
            let end = start + f64::from(stamp.span[axis]);
            let image = |edge: f64| (edge / size).floor() as i64;
            if self.wrap { image(start.min(end) - radius)..=image(start.max(end) + radius) } else { 0..=0 }
        };
        let (columns, rows) = (reach(0), reach(1));
        for image_y in rows {
            for image_x in columns.clone() {
                for y in 0..self.size[1] {
                    for x in 0..self.size[0] {
                        let offset = [
                            (x as i64 + image_x * self.size[0] as i64) as f64 - f64::from(stamp.centre[0]),
                            (y as i64 + image_y * self.size[1] as i64) as f64 - f64::from(stamp.centre[1]),
                        ];
                        let index = y * self.size[0] + x;
                        if let Some(place) = self.place(stamp, index, offset) {
                            self.press_texel(index, stamp, &place);
                        }
                    }
                }
            }
        }
    }

    /// Where a texel at this offset from the stamp's centre lies, if within.
    fn place(&self, stamp: &Stamp, index: usize, offset: [f64; 2]) -> Option<Place> {
        if let Some(form) = stamp.image {
            let profile = image_value(&self.images[form.number as usize], &form, offset)?;
            return Some(Place { rho: (1.0 - profile).max(0.0).sqrt(), before: None, profile });
        }
        let (away, along) = from_segment(offset, stamp.span);
        if away[0].hypot(away[1]) >= f64::from(stamp.radius) {
            return None;
        }
        let rho = stretched(stamp, away);
        let joins = stamp.joins != [0.0; 2] && stamp.blend == Blend::Add;
        let before = joins.then(|| stretched(stamp, from_segment(offset, stamp.joins).0));
        let of = |rho| profile(stamp.profile, rho);
        let mut value = before.map_or_else(|| of(rho), |before| of(rho.min(before)) - of(before));
        if stamp.tread > 0.0 {
            let lugs = (f64::from(stamp.along) + along + 0.5 * f64::from(stamp.radius) * rho) / f64::from(stamp.lug_texels);
            let wave = (2.0 * (lugs - lugs.floor()) - 1.0).abs();
            value *= 1.0 - f64::from(stamp.tread) * wave * wave * (3.0 - 2.0 * wave);
        }
        let texel = [(index % self.size[0]) as i32, (index / self.size[0]) as i32];
        Some(Place { rho, before, profile: value + grain(stamp, texel, rho) })
    }

    fn press_texel(&mut self, index: usize, stamp: &Stamp, place: &Place) {
        let (height, level, alpha) = (f64::from(stamp.height), f64::from(stamp.level), f64::from(stamp.alpha));
        let shape = level + height * place.profile;
        let layer = &mut self.relief[index];
        *layer = match stamp.blend {
            Blend::Add => *layer + height * place.profile,
            Blend::Min => layer.min(shape),
            Blend::Max => layer.max(shape),
            Blend::Replace => *layer + (shape - *layer) * alpha,
        };

        let rim = if stamp.profile == Profile::Crater { CRATER_RIM * CRATER_RIM } else { 1.0 };
        let hard = stamp.profile == Profile::Disc && stamp.image.is_none();
        let core = |rho: f64| if hard { f64::from(u8::from(rho < 1.0)) } else { 1.0 - smoothstep(0.5 * rim, rim, rho * rho) };
        let fall = |rho: f64| {
            let (s, outward) = (rho * rho, (rho * rho / rim).min(1.0));
            ((1.0 - s).max(0.0).powi(2) * (0.25 + 0.75 * outward * outward)).clamp(0.0, 1.0)
        };
        // What must still cover what is left where the segment before has covered a part.
        let rest = |strength: f32, weight: &dyn Fn(f64) -> f64| {
            let of = |rho| f64::from(strength) * weight(rho);
            let (whole, part) = (of(place.rho), place.before.map_or(0.0, of));
            if whole > part { (whole - part) / (1.0 - part) } else { 0.0 }
        };
        let (bared, glossed) = (rest(stamp.bare, &core), rest(stamp.gloss, &core));
        let sooted = match stamp.image {
            Some(_) => f64::from(stamp.soot) * place.profile.clamp(0.0, 1.0),
            None => rest(stamp.soot, &fall),
        };
        let cover = |level: u8, most: f64, bared: f64, share: f64| {
            let left = f64::from(level) * (1.0 - bared);
            (left + (most - left) * share).round() as u8
        };
        let marks = &mut self.material[index];
        *marks = Marks {
            soot: cover(marks.soot, 255.0, bared, sooted),
            bare: cover(marks.bare, 255.0, 0.0, bared),
            gloss: cover(marks.gloss, 31.0, bared, glossed),
            heat: hotter(marks.heat, stamp, (1.0 - place.rho * place.rho).max(0.0).powi(5), self.cooling_seconds),
            post: marks.post,
        };
    }
}

/// The hotter of a heat and of a stamp's, where its glow has this share.
fn hotter(heat: u16, stamp: &Stamp, share: f64, cooling_seconds: f64) -> u16 {
    let now = f64::from(moment(stamp.at_seconds, cooling_seconds));
    let since = -MOMENTS_PER_FALL * (f64::from(stamp.heat) * share).max(1e-9).ln();
    if stamp.heat <= 0.0 || since >= GLOWING_MOMENTS || age(heat, now).is_some_and(|age| since >= age) {
        return heat;
    }
    1 + (now - since).floor().rem_euclid(f64::from(MOMENTS)) as u16
}

/// The way to a point from the nearest point of a segment that begins at the origin, and how far along it that is.
pub fn from_segment(point: [f64; 2], span: [f32; 2]) -> ([f64; 2], f64) {
    let span = span.map(f64::from);
    let squared = span[0] * span[0] + span[1] * span[1];
    let t = if squared > 0.0 { ((point[0] * span[0] + point[1] * span[1]) / squared).clamp(0.0, 1.0) } else { 0.0 };
    ([point[0] - t * span[0], point[1] - t * span[1]], t * squared.sqrt())
}

/// What an image has at an offset from its centre, bilinear between the centres of its texels; nothing beyond its border.
fn image_value(image: &StampImage, form: &ImageForm, [x, y]: [f64; 2]) -> Option<f64> {
    let (sin, cos) = f64::from(form.turn).sin_cos();
    let along = [(x * cos + y * sin) / f64::from(form.half_extent[0]), (y * cos - x * sin) / f64::from(form.half_extent[1])];
    if along.iter().any(|along| along.abs() >= 1.0) {
        return None;
    }
    let [columns, rows] = image.size.map(|side| side as usize);
    let lattice = |axis: usize| {
        let side = f64::from(image.size[axis]);
        ((0.5 * along[axis] + 0.5) * side - 0.5).clamp(0.0, side - 1.0)
    };
    let [u, v] = [lattice(0), lattice(1)];
    let value = |column: usize, row: usize| f64::from(image.values[row.min(rows - 1) * columns + column.min(columns - 1)]);
    let (column, row) = (u.floor() as usize, v.floor() as usize);
    let mix = |low: f64, high: f64, share: f64| low + (high - low) * share;
    let of_row = |row| mix(value(column, row), value(column + 1, row), u - u.floor());
    Some(mix(of_row(row), of_row(row + 1), v - v.floor()))
}

/// The distance from the stamp's centre, or from what it is swept along, in radii, as its irregular form sees it: never less than on
/// a circle.
pub fn stretched(stamp: &Stamp, offset: [f64; 2]) -> f64 {
    let rho = offset[0].hypot(offset[1]) / f64::from(stamp.radius);
    let (angle, phase) = (offset[1].atan2(offset[0]), f64::from(stamp.phase));
    // Each harmonic's phase is a multiple of the stamp's own, so that another phase is another form and not a turn of the same.
    let wave = 0.4 * (3.0 * angle + phase).cos()
        + 0.3 * (5.0 * angle + 2.0 * phase).cos()
        + 0.2 * (8.0 * angle + 3.0 * phase).cos()
        + 0.1 * (13.0 * angle + 5.0 * phase).cos();
    rho * (1.0 + f64::from(stamp.irregularity) * (0.5 + 0.5 * wave))
}

/// The profile at a distance of ρ radii from the centre.
pub fn profile(profile: Profile, rho: f64) -> f64 {
    if rho >= 1.0 {
        return 0.0;
    }
    let s = rho * rho;
    let flank = |rim: f64| {
        let y = (s - rim) / (1.0 - rim);
        CRATER_LIP * (1.0 - y).powi(4) * (1.0 + 4.0 * y)
    };
    match profile {
        Profile::Disc => 1.0,
        Profile::Cone => 1.0 - rho,
        Profile::Bump => (1.0 - s).powi(2),
        Profile::Crater => {
            let rim = CRATER_RIM * CRATER_RIM;
            if s >= rim {
                return flank(rim);
            }
            let x = s / rim;
            let (bowl, bore) = (x * x * (3.0 - 2.0 * x), 1.0 - (1.0 - x).powi(6));
            (1.0 + CRATER_LIP) * (bowl + bore) / 2.0 - 1.0
        }
        Profile::Rut => {
            let (floor, rim) = (RUT_FLOOR * RUT_FLOOR, RUT_RIM * RUT_RIM);
            if s >= rim {
                return flank(rim);
            }
            (1.0 + CRATER_LIP) * smoothstep(floor, rim, s) - 1.0
        }
    }
}

/// What the grains of the broken material add in an irregular crater: nothing from the rim on.
fn grain(stamp: &Stamp, texel: [i32; 2], rho: f64) -> f64 {
    if stamp.profile != Profile::Crater {
        return 0.0;
    }
    let inward = (3.0 * (1.0 - rho * rho / (CRATER_RIM * CRATER_RIM))).clamp(0.0, 1.0);
    f64::from(stamp.irregularity) * CRATER_GRAIN * (2.0 * hash_cell(texel, 0) - 1.0) * inward
}

fn smoothstep(low: f64, high: f64, value: f64) -> f64 {
    let t = ((value - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
