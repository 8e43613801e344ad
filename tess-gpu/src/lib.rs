#![doc = include_str!("../README.md")]

pub mod bindings;
pub mod layout;
pub mod plan;
pub mod setup;
pub mod shaders;
pub mod sizes;
pub mod tables;

pub use bindings::{Access, Binding, Resource};
pub use plan::{Dispatch, Plan, Workgroups, Written};
pub use setup::{Copies, IndexType, Numbering, PointFormat, Setup};
pub use shaders::{Counting, Probe, Pull, Stage};
pub use sizes::{Capacity, Limits, Span};
pub use tess_core::Order;
