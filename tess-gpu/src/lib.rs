#![doc = include_str!("../README.md")]

mod bindings;
pub mod layout;
mod plan;
mod room;
mod setup;
mod shaders;
pub mod sizes;
pub mod surfaces;
mod tables;

pub use bindings::{Access, Binding, Resource};
pub use plan::{Dispatch, Plan, Workgroups, Written};
pub use room::{Capacity, Limits, Span};
pub use setup::{Copies, IndexType, Numbering, PointFormat, Setup};
#[cfg(feature = "taps")]
pub use shaders::Tap;
pub use shaders::{Counting, Pull, Stage};
pub use tables::tables;
pub use tess_core::Order;
