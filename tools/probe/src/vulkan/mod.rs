//! The Vulkan calls of a probe; each object is freed when it is dropped.

mod buffer;
mod commands;
mod compute;
mod gpu;
mod interface;
mod owned;
mod pipeline;

pub(crate) use buffer::DeviceBuffer;
pub(crate) use commands::Commands;
pub(crate) use compute::Compute;
pub use compute::Spirv;
pub(crate) use gpu::Gpu;
pub use gpu::list;
use interface::{Interface, Sets};
use owned::Owned;
pub(crate) use pipeline::{BoundInterface, DrawPass, Pipeline, STAGES, Vertices, pipeline};
