//! The test kit: what every test, fuzz target, bench and the program `tess` compare with.

pub mod backend;
pub mod case;
pub mod digest;
pub mod names;
pub mod random;
pub mod workloads;
