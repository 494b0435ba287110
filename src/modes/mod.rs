//! The ways to run a frame: they differ in who owns the clock and where the picture goes, and in nothing else.

pub mod input;
pub mod panel;
pub mod readings;
