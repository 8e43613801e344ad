//! The verification kit: what tests, fuzz targets, benches and the program `tess` compare with.
//!
//! Cases, vector files, comparison in a strength, generated levels with their coverage, and
//! verification of anything that implements [`backend::Backend`]. The one implementation that it
//! knows itself is the golden model.

pub mod backend;
pub mod case;
pub mod checker;
pub mod compare;
pub mod core_backend;
pub mod coverage;
pub mod digest;
pub mod generate;
pub mod names;
mod quote;
pub mod random;
pub mod readmemh;
pub mod second;
mod sequences;
pub mod strength;
pub mod vectors;
pub mod verify;
pub mod workloads;
