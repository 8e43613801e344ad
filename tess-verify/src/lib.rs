#![doc = include_str!("../README.md")]

#[cfg(feature = "arbitrary")]
mod arbitrary;
pub mod backend;
pub mod case;
pub mod checker;
pub mod circuit;
pub mod compare;
pub mod coordinate;
pub mod core_backend;
pub mod coverage;
pub mod digest;
pub mod drawing;
pub mod explanation;
pub mod formats;
pub mod generate;
pub mod known;
pub mod names;
pub mod picture;
mod quote;
pub mod random;
pub mod readmemh;
pub mod rules;
pub mod second;
mod sequences;
pub mod stage_vectors;
pub mod strength;
pub mod vectors;
pub mod verify;
pub mod ways;
mod workers;
pub mod workloads;

pub use backend::{Backend, BackendError};
pub use case::{Case, CaseError};
pub use checker::{
    CheckError, Report, Tested, check, check_asked, check_case, check_device, check_known,
};
pub use compare::{Element, Mismatch, Stage};
pub use core_backend::CoreBackend;
pub use coverage::Coverage;
pub use generate::{GenLevel, Selection, Shard};
pub use known::Known;
pub use names::Named;
pub use strength::{Conversion, Denormals, Elements, Order, Strength};
pub use vectors::{Cases, Header, Kind, Listing, Record, VectorError, VectorFile};
pub use verify::{Plan, Row, Subject, verify, verify_known};
pub use ways::Way;
