//! The tests that need more than one module: proofs of what the kernels compute, against their references.

mod field;
mod support;
mod surface;
