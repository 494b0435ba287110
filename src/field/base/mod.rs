//! Bases: the heights that a field starts from, made on the CPU once.
//!
//! Procedural bases are functions of the position in metres and of the seed, so that another field size is a finer look at the
//! same relief. Their layouts are shared with the albedos that colour them (`shaders/surface/albedo_brick.wgsl`, `…_cobble.wgsl` and
//! `…_grass.wgsl`).

mod beach;
pub mod facade;
mod landscape;
pub mod lettering;
mod masonry;
mod noise;
mod ornament;
mod outline;
mod planet;
mod snow;
pub mod still_life;
mod strands;
mod terrain;
pub mod text;

pub use lettering::{Lettering, LetteringError};
pub use masonry::{BRICK_JOINT_METRES, BRICK_METRES, COBBLE_METRES};
pub(crate) use noise::{gradient_octaves_3, hash_cell};
pub use strands::DAISY_METRES;

use super::wave;
use crate::scene::{Addressing, Base, Boundary, Scene};
use landscape::Landscape;
use masonry::{bricks_depth_metres, cobbles_depth_metres};
use planet::Planet;
use terrain::Terrain;

/// The heights of a procedural base, row by row; `None` for an image and for text, whose files the caller loads.
pub fn heights(scene: &Scene) -> Option<Vec<f32>> {
    let [width, height] = scene.field.size;
    let texel_metres = scene.texel_metres();
    let plane_metres = f64::from(scene.plane.width_metres);
    let depth_metres = f64::from(scene.plane.depth_metres);
    let fill = |function: &dyn Fn(f64, f64) -> f64| {
        let mut heights = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            for x in 0..width {
                let at = |texel: u32| (f64::from(texel) + 0.5) * texel_metres;
                heights.push(function(at(x), at(y)).clamp(0.0, 1.0) as f32);
            }
        }
        heights
    };
    match &scene.base {
        Base::Flat { height: level } => Some(vec![*level; width as usize * height as usize]),
        Base::Bricks {} => {
            let tile = (scene.field.addressing == Addressing::Wrap).then(|| scene.plane_size_metres());
            Some(fill(&|x, y| 1.0 - bricks_depth_metres(x, y, tile) / depth_metres))
        }
        Base::Cobbles {} => {
            // Where the field wraps, so do the stones.
            let tile = (scene.field.addressing == Addressing::Wrap).then(|| scene.plane_size_metres());
            Some(fill(&|x, y| 1.0 - cobbles_depth_metres(x, y, tile) / depth_metres))
        }
        Base::Facade {} => Some(fill(&|x, y| 1.0 - facade::depth_metres(x, y) / depth_metres)),
        Base::Snow {} => {
            let extent = scene.plane_size_metres();
            Some(fill(&|x, y| snow::height([x, y], extent, depth_metres, scene.seed)))
        }
        Base::Terrain {} => {
            let terrain = Terrain::new(scene.seed);
            Some(fill(&|x, y| terrain.height(x / plane_metres, y / plane_metres)))
        }
        Base::Beach {} => {
            let down_metres = scene.plane_size_metres()[1];
            Some(fill(&|x, y| beach::height(x / plane_metres, y / down_metres, scene.seed)))
        }
        Base::Fur {} => Some(strands::fur(scene.field.size, texel_metres, scene.seed)),
        Base::Grass {} => Some(strands::grass(scene.field.size, texel_metres, scene.seed)),
        Base::Landscape {} => Some(Landscape::new(scene.seed).heights(scene.field.size)),
        Base::Planet {} => {
            let planet = Planet::new(scene.seed);
            let down_metres = scene.plane_size_metres()[1];
            Some(fill(&|x, y| planet.height(x / plane_metres, y / down_metres)))
        }
        Base::Ornament {} => {
            let down_metres = scene.plane_size_metres()[1];
            Some(fill(&|x, y| ornament::height(x / plane_metres, y / down_metres)))
        }
        Base::StillLife {} => Some(still_life::photograph(scene.field.size).0),
        Base::Text(_) | Base::Image { .. } => None,
    }
}

/// The height that the undisturbed surface has in most places: the water line of a pool.
pub fn rest_height(base: &Base) -> f32 {
    match base {
        Base::Flat { height } => *height,
        _ => 1.0,
    }
}

/// The texels on which the posts of a scene stand, with the height of their tops.
pub fn posts(scene: &Scene) -> Vec<(usize, f32)> {
    let [width, height] = scene.field.size;
    let plane_metres = scene.plane_size_metres();
    let of_wave = scene.wave.iter().flat_map(|wave| &wave.obstacles);
    let of_water = scene.shallow_water.iter().flat_map(|water| &water.obstacles);
    let periodic = scene.wave.as_ref().is_some_and(|wave| wave.boundary == Boundary::Periodic);
    let mut posts = Vec::new();
    for obstacle in of_wave.chain(of_water) {
        for y in 0..height {
            for x in 0..width {
                let uv = [(f64::from(x) + 0.5) / f64::from(width), (f64::from(y) + 0.5) / f64::from(height)];
                if wave::stands_on(obstacle, uv, plane_metres, periodic) {
                    posts.push((y as usize * width as usize + x as usize, obstacle.top));
                }
            }
        }
    }
    posts
}
