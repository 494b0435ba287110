//! The one test binary.

mod modes;
