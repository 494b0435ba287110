//! What many tests need.

#[cfg(target_os = "linux")]
pub mod desktop;
pub mod gpu;
pub mod tolerances;
