//! Inputs, outputs and the arrays between: no layer's work, used by all of them.

pub(crate) mod batch;
pub(crate) mod chunk;
pub(crate) mod error;
pub(crate) mod format;
pub(crate) mod lanes;
pub(crate) mod output;
pub(crate) mod point_writer;
pub(crate) mod ranges;
pub(crate) mod target;
pub(crate) mod writer;
