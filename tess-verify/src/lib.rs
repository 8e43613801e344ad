#![doc = include_str!("../README.md")]

#[cfg(feature = "arbitrary")]
mod arbitrary;
pub mod backend;
pub mod case;
pub mod checker;
pub mod compare;
pub mod coordinate;
pub mod core_backend;
pub mod coverage;
pub mod digest;
pub mod drawing;
pub mod explanation;
pub mod formats;
pub mod generate;
pub mod names;
pub mod picture;
mod quote;
pub mod random;
pub mod readmemh;
pub mod second;
mod sequences;
pub mod strength;
pub mod vectors;
pub mod verify;
pub mod ways;
pub mod workloads;
