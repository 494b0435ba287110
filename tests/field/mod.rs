//! How the height field comes to be.

mod compose;
mod cool;
mod heal;
mod normal_mips;
mod normals;
mod pyramid;
mod stamp;
mod wave;
