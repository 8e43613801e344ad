#![doc = include_str!("../README.md")]

mod backend;
mod case;
pub mod check;
mod core_backend;
pub mod cover;
pub mod generate;
mod names;
mod quote;
pub mod rules;
pub mod show;
pub mod vectors;

pub use backend::{Answers, Backend, BackendError};
pub use case::{Case, CaseError, factor};
pub use core_backend::CoreBackend;
pub use names::{Named, UnknownName};
