//! How the height field comes to be.

mod bounds;
mod compose;
mod cool;
mod derive;
mod endurance;
mod gas;
mod gas_activity;
mod gas_advect;
mod gas_emit;
mod gas_force;
mod gas_project;
mod gas_show;
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
mod shallow_water;
mod stamp;
mod wave;
