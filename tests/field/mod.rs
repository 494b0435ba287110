//! How the height field comes to be.

mod stamp;
mod wave;
