//! The modes, from outside.

mod panel;
