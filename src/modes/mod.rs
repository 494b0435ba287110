//! How the frame is run: live, to files, to numbers. The modes differ in who owns the clock and where the picture goes, and in
//! nothing else.

mod gui;
pub mod hand;
pub mod input;
pub mod live;
pub mod panel;
pub mod pick;
pub mod readings;
mod screen;
pub mod session;
