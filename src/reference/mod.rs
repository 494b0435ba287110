//! The same mathematics on the CPU in f64: the specification, the tests' oracle, the ground truth.

pub mod stamp;
pub mod wave;
