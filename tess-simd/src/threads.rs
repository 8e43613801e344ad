//! Who writes a share: the threads of a rayon pool, or the calling thread alone.
//!
//! Both define [`Workspaces`], what is kept from batch to batch, and [`join`].

#[cfg(not(feature = "rayon"))]
mod one;
#[cfg(feature = "rayon")]
mod pool;

#[cfg(not(feature = "rayon"))]
pub(crate) use one::{Workspaces, join};
#[cfg(feature = "rayon")]
pub(crate) use pool::{Workspaces, join};
