#![doc = include_str!("../README.md")]

pub mod batch;
mod boundary;
mod context;
pub mod device;
pub mod dpi;
pub mod fuzz;
pub mod patch;
pub mod prepare;
pub mod probe;
pub mod process;
pub mod rules;
pub mod shortage;
pub mod status;
pub mod surface;
pub mod types;
pub mod version;
