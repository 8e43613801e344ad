//! The specification's stages in sequence, and nothing else: start here.
//!
//! No stage after `factors` uses floats. Counts and random access are in `closed_form`, another
//! order of triangles in `cache_order`, and HLSL's factor preparation in `prepare`. Read in this
//! order; each line names its sections of the specification.
//!
//! ```text
//! raw factors -> factors -> factor_context -> place -> points   -> sink
//!                                          -> row, stitch, connect -> sink
//! ```
//!
//! 1. `state`, `patch_factors`: the input. `output`, `sink`: the output.
//! 2. `factors`, on `d3d_float` and `fixed_point`: cull, clamp, round, convert (sections 1 to 3).
//! 3. `factor_context`, on `reciprocal`: six numbers from each factor (section 4).
//! 4. `place`: a point along one dimension (section 5). `points`: in two (section 6).
//! 5. `row`, `stitch` on `ruler`, `connect`: the primitives (sections 7 and 8).

pub(crate) mod connect;
pub(crate) mod d3d_float;
pub(crate) mod factor_context;
pub(crate) mod factors;
pub(crate) mod fixed_point;
pub(crate) mod output;
pub(crate) mod patch_factors;
pub(crate) mod place;
pub(crate) mod points;
pub mod reciprocal;
pub mod row;
pub mod ruler;
pub(crate) mod sink;
pub(crate) mod state;
pub(crate) mod stitch;
