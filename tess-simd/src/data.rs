//! Inputs, outputs and the arrays between them, used by all layers.

pub(crate) mod batch;
pub(crate) mod chunk;
pub(crate) mod error;
pub(crate) mod format;
pub(crate) mod lanes;
pub(crate) mod numbers;
pub(crate) mod output;
pub(crate) mod point_writer;
pub(crate) mod ranges;
pub(crate) mod target;
pub(crate) mod writer;
