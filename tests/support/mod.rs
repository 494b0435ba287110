//! What many tests need.

pub mod fields;
pub mod gpu;
pub mod rays;
pub mod tolerances;
