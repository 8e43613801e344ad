#![doc = include_str!("../README.md")]

mod backend;
mod case;
pub mod check;
mod core_backend;
pub mod cover;
pub mod generate;
pub mod mistakes;
mod names;
mod quote;
pub mod rules;
mod strength;
pub mod vectors;

pub use backend::{Answers, Backend, BackendError};
pub use case::{Case, CaseError, factor};
pub use core_backend::CoreBackend;
pub use names::{Named, UnknownNameError, way_of};
pub use quote::quoted;
