//! Shared parts of the project's own tests. Without features it has no dependencies, so that the
//! development commands can use it: lists of faults in sources, and options crossed by pairs. The
//! features are in `Cargo.toml`.

#[cfg(feature = "kit")]
pub mod faults;
#[cfg(feature = "kit")]
pub mod invariants;
#[cfg(feature = "kernels")]
pub mod kernels;
#[cfg(feature = "levels")]
pub mod levels;
pub mod listed;
pub mod pairs;
#[cfg(feature = "strategies")]
pub mod strategies;
pub mod wgsl_faults;
