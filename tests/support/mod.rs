//! What many tests need.

#[cfg(target_os = "linux")]
pub mod desktop;
pub mod extremes;
pub mod fields;
pub mod gas;
pub mod gpu;
pub mod lights;
pub mod lit;
pub mod rays;
pub mod seen;
pub mod techniques;
pub mod tolerances;
pub mod water;
