//! The modes, from outside.

mod compare;
mod panel;
#[cfg(target_os = "linux")]
mod window;
