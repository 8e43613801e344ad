//! The same output by formula, without walking: its size, and any element from its number.
//!
//! Backends use these formulas to size buffers and to make elements in parallel. Tests compare them
//! with `model` on every topology.

pub(crate) mod counts;
pub(crate) mod locate;
