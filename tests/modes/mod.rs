//! The modes, from outside.

mod panel;
#[cfg(target_os = "linux")]
mod window;
