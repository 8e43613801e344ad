//! The test kit: what every test, fuzz target, bench and the program `tess` compare with.

pub mod backend;
pub mod case;
pub mod checker;
pub mod compare;
pub mod core_backend;
pub mod coverage;
pub mod digest;
pub mod faults;
pub mod generate;
pub mod invariants;
pub mod names;
pub mod random;
pub mod readmemh;
pub mod second;
pub mod sequences;
pub mod strength;
pub mod vectors;
pub mod verify;
pub mod workloads;
