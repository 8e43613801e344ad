//! Bit-exact batch tessellation on CPUs: the same points and indices as `tess-core`, at the speed
//! of memory.
//!
//! ```
//! use tess_core::{Config, OutputPrimitive, Partitioning, QuadFactors};
//! use tess_simd::{Numbering, Output, Tessellator};
//!
//! let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
//! let quad = |f| QuadFactors { u0: f, v0: f, u1: f, v1: f, inside_u: f, inside_v: f };
//! let patches: Vec<_> = (1..=100).map(|i| quad(i as f32 / 2.0)).collect();
//!
//! let mut tessellator = Tessellator::new(config);
//! let mut output: Output<[f32; 2], u32> = Output::new();
//! tessellator.tessellate(&patches[..], Numbering::PerPatch, &mut output)?;
//! let (points, indices) = output.patch(5).unwrap();
//! assert_eq!((points.len(), indices.len()), (16, 54));
//! # Ok::<(), tess_simd::Error>(())
//! ```
//!
//! The modules have the names of the core's: a block of sixteen patches goes through `factors`,
//! `factor_context` and `counts` side by side, lane by lane; then each patch is emitted by
//! `points` (runs copied from tables of locations, `place`) and `connect` (stitches copied from
//! tables, `stitch`). Small patches of a topology seen before are copied whole (`template`).
//! `dispatch` compiles all of it once for each CPU level.
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

mod batch;
mod block;
mod connect;
mod counts;
mod dispatch;
mod emit;
mod error;
mod factor_context;
mod factors;
mod format;
mod lanes;
mod level;
mod output;
mod part;
mod place;
mod points;
mod probe;
mod reciprocal;
mod share;
mod stitch;
mod template;
mod tessellator;
mod threads;

pub use batch::Batch;
pub use error::{Buffer, Error, LevelUnavailable};
pub use format::{IndexFormat, PointFormat};
pub use level::Level;
pub use output::{BatchCounts, Buffers, ExactOutput, Numbering, Output, PatchRange};
pub use probe::{contexts, fixed_factors, locations};
pub use tess_core;
pub use tessellator::Tessellator;
