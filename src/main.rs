//! The program: parse, run one mode, print the error once, set the exit code.

fn main() {}
