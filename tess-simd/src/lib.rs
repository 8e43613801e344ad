#![doc = include_str!("../README.md")]
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

mod batch;
mod block;
mod chunk;
mod connect;
mod counted;
mod counts;
mod dispatch;
mod engine;
mod error;
mod factor_context;
mod factors;
mod format;
mod groups;
mod kernel;
mod lanes;
mod level;
mod output;
mod owned;
mod part;
mod place;
mod points;
mod probe;
mod reciprocal;
mod setup;
mod slices;
mod stitch;
mod target;
mod template;
mod tessellator;
mod threads;
mod writer;

pub use batch::Batch;
pub use counted::Counted;
pub use error::{Buffer, Error};
pub use format::{IndexFormat, PointFormat};
pub use groups::{BadGroup, group_ranges};
pub use level::{Level, LevelUnavailable};
pub use output::{BatchCounts, Buffers, ExactOutput, Numbering, Output, PatchRange};
pub use owned::OwnedBatch;
pub use probe::{contexts, fixed_factors, locations};
pub use tess_core;
pub use tess_core::Order;
pub use tessellator::Tessellator;
