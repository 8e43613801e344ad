#![doc = include_str!("../README.md")]

mod batch;
mod buffers;
mod dispatches;
mod error;
mod gpu;
mod limits;
mod open;
mod outputs;
mod pipeline;
mod pipelines;
pub mod stage;
#[cfg(feature = "measure")]
mod stopwatch;
#[cfg(feature = "measure")]
mod taps;
mod tessellator;
mod whole;

pub use {tess_core, tess_gpu, wgpu};

pub use batch::Batch;
pub use error::Error;
pub use gpu::Gpu;
pub use open::Wanted;
pub use outputs::Outputs;
pub use stage::TessellationStage;
#[cfg(feature = "measure")]
pub use stopwatch::Stopwatch;
pub use tessellator::Tessellator;
pub use whole::ReadBack;
