//! A brick wall in parts: bare brick, plaster that has come off in places, a steel plate with rivets, a door of planks. The layout is
//! shared with the albedo that colours it (`shaders/surface/albedo_facade.wgsl`), which repeats [`plastered`] line by line.

use super::masonry::bricks_depth_metres;
use super::noise::{fractal_noise, hash_cell, smoothstep};
use crate::scene::Struck;

/// After how many metres the wall repeats.
pub const FACADE_METRES: [f32; 2] = [1.8, 0.9];

/// Left, upper, right and lower edge of the steel plate, metres.
pub const PLATE_METRES: [f32; 4] = [1.16, 0.20, 1.52, 0.52];

/// Left, upper, right and lower edge of the door, metres; its lower edge lies beyond the wall's.
pub const DOOR_METRES: [f32; 4] = [0.10, 0.13, 0.46, 1.0];

/// Width of a plank, metres.
pub const PLANK_METRES: f32 = 0.09;

/// From the reference surface to what is under the plaster, metres.
pub const PLASTER_METRES: f64 = 0.0175;

/// From the reference surface to the face of the plaster, metres.
const FACE_METRES: f64 = 0.006;

/// From rivet to rivet along the plate's edge, metres, and their distance from the edge.
const RIVET_METRES: [f64; 2] = [0.08, 0.022];

/// What a shot at a point of the wall hits, metres along u and v.
pub fn struck(metres: [f64; 2]) -> Struck {
    let [x, y] = home(metres);
    if inside(DOOR_METRES, x, y) > 0.0 {
        Struck::Wood
    } else if inside(PLATE_METRES, x, y) > 0.0 {
        Struck::Metal
    } else if plastered(x, y) > 0.0 {
        Struck::Plaster
    } else {
        Struck::Brick
    }
}

/// Depth below the reference surface, metres.
pub(super) fn depth_metres(x: f64, y: f64) -> f64 {
    let brick = PLASTER_METRES - 0.002 + bricks_depth_metres(x, y, None);
    let [x, y] = home([x, y]);
    let plaster =
        FACE_METRES + 0.0012 * fractal_noise(x * 14.0, y * 14.0, 81, 5) + 0.0005 * fractal_noise(x * 160.0, y * 160.0, 82, 3);
    let wall = brick + (plaster.min(brick) - brick) * smoothstep(0.0, 0.010, plastered(x, y));

    let in_plate = inside(PLATE_METRES, x, y);
    let plate = 0.0030 - rivet(x, y) + 0.0004 * fractal_noise(x * 30.0, y * 30.0, 83, 3);
    let wall = wall + (plate - wall) * smoothstep(-0.0015, 0.0015, in_plate);

    // Planks behind a frame as wide as a hand.
    let in_door = inside(DOOR_METRES, x, y);
    let plank = x / f64::from(PLANK_METRES);
    let from_gap = (0.5 - (plank - plank.floor() - 0.5).abs()) * f64::from(PLANK_METRES);
    let grain = 0.0014 * fractal_noise(x * 220.0, y * 9.0, 84, 4);
    let set = 0.0020 * hash_cell([plank.floor() as i32, 0], 85);
    let planks = 0.020 + set + grain + 0.007 * (1.0 - smoothstep(0.0008, 0.0035, from_gap));
    let frame = 0.004 + 0.0010 * fractal_noise(x * 150.0, y * 150.0, 86, 2);
    let door = frame + (planks - frame) * smoothstep(0.030, 0.034, in_door);
    wall + (door - wall) * smoothstep(-0.0015, 0.0015, in_door)
}

/// How far within the plaster a point is, metres: not above 0 where it has come off. A hand's breadth of ragged edge.
pub fn plastered(x: f64, y: f64) -> f64 {
    let ragged = 0.30 * (soft_noise(x * 3.7, y * 3.7, 87) - 0.5)
        + 0.12 * (soft_noise(x * 13.0, y * 13.0, 88) - 0.5)
        + 0.04 * (soft_noise(x * 47.0, y * 47.0, 89) - 0.5);
    let hole = 0.5 * (soft_noise(x * 5.1, y * 5.1, 90) - 0.16);
    (x - 0.74).min(0.80 - y).min(hole) + 0.6 * ragged
}

/// Value noise in [0, 1), as the shader has it.
fn soft_noise(x: f64, y: f64, salt: u32) -> f64 {
    let (i, j) = (x.floor(), y.floor());
    let fade = |t: f64| t * t * (3.0 - 2.0 * t);
    let corner = |dx: i32, dy: i32| hash_cell([i as i32 + dx, j as i32 + dy], salt);
    let mix = |low: f64, high: f64, share: f64| low + (high - low) * share;
    let s = fade(x - i);
    mix(mix(corner(0, 0), corner(1, 0), s), mix(corner(0, 1), corner(1, 1), s), fade(y - j))
}

/// How far a dome of a rivet stands out of the plate, metres.
fn rivet(x: f64, y: f64) -> f64 {
    let [left, upper, right, lower] = PLATE_METRES.map(f64::from);
    let [spacing, margin] = RIVET_METRES;
    // The nearest place of one along a side, and how far the nearest side with rivets is.
    let nearest = |at: f64, low: f64, high: f64| {
        let count = ((high - low - 2.0 * margin) / spacing).round();
        let step = (high - low - 2.0 * margin) / count;
        let place = ((at - low - margin) / step).round().clamp(0.0, count);
        at - (low + margin + place * step)
    };
    let beside = |at: f64, low: f64, high: f64| (at - low - margin).abs().min((high - margin - at).abs());
    let along_u = nearest(x, left, right).hypot(beside(y, upper, lower));
    let along_v = nearest(y, upper, lower).hypot(beside(x, left, right));
    let away = along_u.min(along_v) / 0.007;
    0.0030 * (1.0 - away * away).max(0.0).sqrt()
}

/// How far within a rectangle a point is, metres.
fn inside(rectangle: [f32; 4], x: f64, y: f64) -> f64 {
    let [left, upper, right, lower] = rectangle.map(f64::from);
    (x - left).min(right - x).min(y - upper).min(lower - y)
}

/// A point in the wall's first copy.
fn home([x, y]: [f64; 2]) -> [f64; 2] {
    [x.rem_euclid(f64::from(FACADE_METRES[0])), y.rem_euclid(f64::from(FACADE_METRES[1]))]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_is_there_and_hit_as_what_it_is() {
        assert_eq!(struck([0.3, 0.5]), Struck::Wood);
        assert_eq!(struck([1.3, 0.4]), Struck::Metal);
        let mut of = [0; 2];
        for i in 0..180 {
            for j in 0..90 {
                match struck([f64::from(i) * 0.01, f64::from(j) * 0.01]) {
                    Struck::Plaster => of[0] += 1,
                    Struck::Brick => of[1] += 1,
                    _ => {}
                }
            }
        }
        assert!(of[0] > 3000 && of[1] > 3000, "{of:?}");
    }

    #[test]
    fn it_lies_between_the_reference_surface_and_the_depth_of_its_scene() {
        for i in 0..400 {
            for j in 0..200 {
                let depth = depth_metres(f64::from(i) * 0.0045, f64::from(j) * 0.0045);
                assert!((0.0..0.05).contains(&depth), "{i}, {j}: {depth}");
            }
        }
    }
}
