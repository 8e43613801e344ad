//! The same output by formula, without walking: how much there is, and any element from its number.
//!
//! Backends size buffers and make elements in parallel by these. Tests compare them with `model` on
//! every topology.

pub(crate) mod counts;
pub(crate) mod locate;
