//! How the height field comes to be.

mod compose;
mod normal_mips;
mod normals;
mod pyramid;
mod shallow_water;
mod stamp;
mod wave;
