//! Types and methods that users call.

pub(crate) mod counted;
pub(crate) mod groups;
#[cfg(all(feature = "taps", feature = "apart"))]
pub(crate) mod kernel_taps;
pub(crate) mod one_patch;
pub(crate) mod owned;
#[cfg(feature = "taps")]
pub(crate) mod taps;
pub(crate) mod tessellator;
