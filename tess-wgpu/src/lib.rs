#![doc = include_str!("../README.md")]

mod batch;
mod device;
mod error;
pub mod stage;

pub use {tess_core, tess_gpu, wgpu};

pub use batch::Batch;
pub use batch::outputs::Outputs;
pub use batch::read_back::ReadBack;
pub use batch::tessellator::Tessellator;
pub use device::gpu::Gpu;
pub use device::open::DeviceLimits;
#[cfg(feature = "measure")]
pub use device::stopwatch::Stopwatch;
pub use error::Error;
pub use stage::TessellationStage;
