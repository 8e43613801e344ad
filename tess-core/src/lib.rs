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

// The input and the output of a patch.
pub use closed_form::counts::{Counts, MAX_INDICES, MAX_POINTS};
pub use closed_form::locate::origin::{PointOrigin, PrimitiveOrigin};
pub use error::{Buffer, BufferTooSmallError};
pub use model::output::{DomainPoint, Primitive};
pub use model::patch_factors::{IsolineFactors, PatchFactors, QuadFactors, TriangleFactors};
#[cfg(feature = "alloc")]
pub use model::sink::Tessellation;
pub use model::sink::{Counter, Sink};
pub use model::state::{Config, Domain, OutputPrimitive, Parity, Partitioning, SplitOrder};
pub use patch::{Order, Patch};

// The stages between them, and the types of their numbers.
pub use model::factor_context::FactorContext;
pub use model::factors::{ProcessedFactor, ProcessedPatch};
pub use model::fixed_point::FixedFactor;
pub use model::stitch::{Side, Step, Stitch, StitchKind};
pub use model::{reciprocal, row, ruler};

pub use fixed;

/// Factor processing: from raw binary32 factors to contexts (spec section 3).
pub mod factors {
    pub use crate::model::factors::process;
}

/// Output sizes by formula (spec section 12.6).
pub mod counts {
    pub use crate::closed_form::counts::counts;
}

/// Constants and roundings of 16.16 numbers (spec section 2).
pub mod fixed_point {
    pub use crate::model::fixed_point::{
        HALF, ONE, ONE_THIRD, TWO_THIRDS, ceil, coordinate_to_f32, floor,
    };
}

/// The location of a point along one dimension, and its intermediate values (spec section 5).
pub mod place {
    pub use crate::model::place::{Blend, Placement, place, placement};
}

/// The steps of each kind of stitch (spec sections 7.2 to 7.4).
pub mod stitch {
    pub use crate::model::stitch::{Diagonals, centre_triangle, ring, strip, transition};
}
