//! What many tests need.

pub mod gpu;
pub mod tolerances;
