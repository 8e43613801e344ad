#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "std")]
extern crate std;

mod instructions;
mod level;

pub use level::{Level, LevelUnavailableError};
