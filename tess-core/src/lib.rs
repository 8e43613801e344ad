#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod cache_order;
mod connect;
pub mod counts;
mod d3d_float;
mod error;
pub mod factor_context;
pub mod factors;
pub mod fixed_point;
mod locate;
mod output;
mod patch;
pub mod patch_factors;
pub mod place;
mod points;
pub mod prepare;
pub mod reciprocal;
pub mod row;
pub mod ruler;
mod sink;
pub mod state;
pub mod stitch;

pub use cache_order::Order;
pub use counts::{Counts, MAX_INDICES, MAX_POINTS};
pub use error::{Buffer, BufferTooSmall};
pub use factor_context::FactorContext;
pub use factors::{ProcessedFactor, ProcessedPatch};
pub use fixed;
pub use fixed_point::FixedFactor;
pub use locate::origin::{PointOrigin, PrimitiveOrigin};
pub use output::{DomainPoint, Primitive};
pub use patch::Patch;
pub use patch_factors::{IsolineFactors, PatchFactors, QuadFactors, TriangleFactors};
pub use place::place;
#[cfg(feature = "alloc")]
pub use sink::Tessellation;
pub use sink::{Counter, Sink};
pub use state::{Config, Domain, OutputPrimitive, Parity, Partitioning, SplitOrder};
pub use stitch::{Side, Step, Stitch, StitchKind};
