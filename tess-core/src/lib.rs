#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod cache_order;
mod closed_form;
mod error;
mod model;
mod patch;
pub mod prepare;

pub use cache_order::Order;
pub use closed_form::counts::{self, Counts, MAX_INDICES, MAX_POINTS};
pub use closed_form::locate::origin::{PointOrigin, PrimitiveOrigin};
pub use error::{Buffer, BufferTooSmall};
pub use fixed;
pub use model::factor_context::{self, FactorContext};
pub use model::factors::{self, ProcessedFactor, ProcessedPatch};
pub use model::fixed_point::{self, FixedFactor};
pub use model::output::{DomainPoint, Primitive};
pub use model::patch_factors::{self, IsolineFactors, PatchFactors, QuadFactors, TriangleFactors};
pub use model::place::{self, place};
#[cfg(feature = "alloc")]
pub use model::sink::Tessellation;
pub use model::sink::{Counter, Sink};
pub use model::state::{self, Config, Domain, OutputPrimitive, Parity, Partitioning, SplitOrder};
pub use model::stitch::{self, Side, Step, Stitch, StitchKind};
pub use model::{reciprocal, row, ruler};
pub use patch::Patch;
