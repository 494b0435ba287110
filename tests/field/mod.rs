//! How the height field comes to be.

mod compose;
mod normals;
mod pyramid;
mod stamp;
mod wave;
