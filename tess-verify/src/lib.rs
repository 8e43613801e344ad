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
#[cfg(feature = "show")]
pub mod show;
mod strength;
pub mod vectors;
#[cfg(feature = "workloads")]
pub mod workloads;

pub use backend::{Answers, Backend, BackendError};
pub use case::{Case, CaseError, factor};
pub use core_backend::CoreBackend;
pub use names::{Named, UnknownNameError};
