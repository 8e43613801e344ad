//! A device: opening it, its limits, its pipelines, and transfers.

pub(crate) mod gpu;
pub(crate) mod limits;
pub(crate) mod open;
pub(crate) mod pipeline;
pub(crate) mod pipelines;
#[cfg(feature = "measure")]
pub(crate) mod stopwatch;
