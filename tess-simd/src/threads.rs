//! Who counts and writes: the threads of a rayon pool, or the calling thread alone.
//!
//! Both define [`Workspaces`], what is kept from batch to batch.

#[cfg(not(feature = "rayon"))]
mod one;
#[cfg(feature = "rayon")]
mod pool;

#[cfg(not(feature = "rayon"))]
pub(crate) use one::Workspaces;
#[cfg(feature = "rayon")]
pub(crate) use pool::{MAX_THREADS, Workspaces};
