//! The threads that count and write: those of a pool, or only the calling thread.
//!
//! Each variant defines [`Workspaces`], which is kept from batch to batch.

#[cfg(not(feature = "rayon"))]
mod one;
pub(crate) mod part;
#[cfg(feature = "rayon")]
mod pool;
#[cfg(feature = "rayon")]
pub(crate) mod process;
pub(crate) mod sizes;
pub(crate) mod slices;

#[cfg(not(feature = "rayon"))]
pub(crate) use one::Workspaces;
#[cfg(feature = "rayon")]
pub(crate) use pool::{MAX_THREADS, Workspaces};
