//! The one test binary, so that everything is linked once.
//!
//! - `house`, `shaders`: the house's rules, without a GPU.

mod house;
mod shaders;
