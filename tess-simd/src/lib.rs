#![doc = include_str!("../README.md")]
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

// The layers: interface, threads, levels, kernels, stages, data. Each uses only the later ones.
mod data;
mod interface;
mod kernels;
mod levels;
mod stages;
mod threads;
#[cfg(test)]
mod tour;

pub use data::batch::Batch;
pub use data::error::{BatchBuffer, Error};
pub use data::format::{IndexFormat, OutputPoint};
#[cfg(feature = "apart")]
pub use data::output::ApartBuffers;
pub use data::output::{BatchCounts, Buffers, ExactOutput, Numbering, Output, PatchRange};
pub use interface::counted::Counted;
pub use interface::groups::{BadGroupError, group_ranges};
#[cfg(all(feature = "taps", feature = "apart"))]
#[doc(hidden)]
pub use interface::kernel_taps::{Format, Input, KernelTap};
pub use interface::one_patch::CountedPatch;
pub use interface::owned::OwnedBatch;
#[cfg(feature = "taps")]
pub use interface::taps::{contexts, fixed_factors, locations};
pub use interface::tessellator::Tessellator;
#[cfg(all(feature = "taps", feature = "apart"))]
#[doc(hidden)]
pub use kernels::kernel_taps::Kernel;
pub use tess_core;
pub use tess_core::Order;
pub use tess_level::{Level, LevelUnavailableError};
#[cfg(feature = "rayon")]
pub use threads::process::ThreadsError;
