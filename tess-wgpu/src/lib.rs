#![doc = include_str!("../README.md")]

mod batch;
mod buffers;
mod dispatches;
mod error;
mod gpu;
mod limits;
mod open;
mod pipeline;
#[cfg(feature = "measure")]
mod probe;
pub mod stage;
#[cfg(feature = "measure")]
mod stopwatch;
mod tessellator;
mod whole;

pub use batch::{Batch, Outputs};
pub use error::Error;
pub use gpu::{Gpu, Wanted};
pub use stage::TessellationStage;
#[cfg(feature = "measure")]
pub use stopwatch::Stopwatch;
pub use tessellator::Tessellator;
pub use whole::Output;
