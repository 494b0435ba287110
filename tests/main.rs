//! The one test binary, so that everything is linked once.
//!
//! - `house`, `shaders`: the house's rules, without a GPU.
//! - `field`, `surface`: proofs of what the kernels compute, on the GPU, against their references in f64.
//! - `modes`: the panel, driven without a GPU, the program in a real window, where there is a display to open one on, and
//!   `compare`, whose tables are read back.
//! - `captures`: what the program writes, read back from its files as a script outside would.
//! - `fallbacks`: adapters that lack what WebGPU's baseline lacks.
//! - `command_line`: exit codes, one sentence for an error, nothing left behind; the program runs as a process.
//! - `io`: files in and out, whole, odd, damaged and hostile.
//! - `mesh`: shapes, files of meshes and what moves them, without a GPU.
//! - `speed`: what it may cost, measured side by side in one run.
//! - `support`: what they share; every tolerance stands once, in `support/tolerances.rs`.
//!
//! Tests run on a software adapter first, since that is what every machine can have. Where there is none they fail in CI and say
//! loudly elsewhere that they skip.

mod captures;
mod command_line;
mod fallbacks;
mod field;
mod house;
mod io;
mod mesh;
mod modes;
mod shaders;
mod speed;
mod support;
mod surface;
