//! The golden model of the Direct3D 11 class fixed-function tessellator, exact to the bit.
//!
//! The executable form of `docs/specification.md`; section numbers in the sources refer to it.
//! `no_std`, without allocation unless the `alloc` feature (on by default) asks for vectors,
//! and total: every bit pattern of every factor has a defined result.
//!
//! ```
//! use tess_core::{Config, OutputPrimitive, Partitioning, Patch, PatchFactors, TriangleFactors};
//!
//! let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
//! let factors = TriangleFactors { u0: 2.5, v0: 3.0, w0: 1.0, inside: 3.25 };
//! let patch = Patch::new(config, PatchFactors::Triangle(factors));
//! assert_eq!(patch.counts().points, 19);
//!
//! // The whole patch, walked in the specification's order ...
//! let whole = patch.tessellate();
//! // ... and any element of it on its own.
//! assert_eq!(patch.point(7), Some(whole.points[7]));
//! assert_eq!(patch.primitive(4).unwrap().indices(), &whole.indices[12..15]);
//! ```
//!
//! The modules follow a patch on its way: [`state`] and [`factors`] (what goes in),
//! [`fixed_point`], [`factor_context`], [`mod@place`] (one dimension), `points` (two dimensions), `row`,
//! `stitch`, `connect` (triangles), with `locate` for random access; [`prepare`] is what a hull
//! shader does in front of the tessellator.
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

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
pub mod place;
mod points;
pub mod prepare;
pub mod reciprocal;
pub mod row;
pub mod ruler;
mod sink;
pub mod state;
pub mod stitch;

pub use counts::{Counts, MAX_INDICES, MAX_POINTS};
pub use error::{Buffer, BufferTooSmall};
pub use factor_context::FactorContext;
pub use factors::{IsolineFactors, PatchFactors, QuadFactors, TriangleFactors};
pub use factors::{ProcessedFactor, ProcessedPatch};
pub use fixed;
pub use fixed_point::FixedFactor;
pub use locate::point::PointLocation;
pub use locate::primitive::PrimitiveLocation;
pub use output::{DomainPoint, Primitive};
pub use patch::Patch;
pub use place::place;
#[cfg(feature = "alloc")]
pub use sink::Tessellation;
pub use sink::{Counter, Sink};
pub use state::{Config, Domain, OutputPrimitive, Parity, Partitioning, SplitOrder};
