//! How the height field comes to be.

mod compose;
mod cool;
mod heal;
mod noise;
mod noise_columns;
mod noise_dunes;
mod noise_fractal;
mod noise_gears;
mod noise_scales;
mod normal_mips;
mod normals;
mod pyramid;
mod stamp;
mod wave;
