//! How the field is seen: techniques, shadows, shading.

pub mod choice;

pub use choice::{Albedo, Shadow, Technique};
