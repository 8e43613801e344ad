//! The kernels: functions over many patches, compiled once for each CPU level.
//!
//! The layer `levels` calls them; they call the stages. Functions in this layer and below are
//! `#[inline(always)]`, because only inlined code gets the instructions of a level's function.

pub(crate) mod emit;
pub(crate) mod front_end;
#[cfg(all(feature = "taps", feature = "apart"))]
pub(crate) mod kernel_taps;
pub(crate) mod repeat;
#[cfg(feature = "taps")]
pub(crate) mod taps;
