//! Compares every backend with the model, over generated levels or over everything that is finite.
//!
//! The work is cut into units that are compared independently. Threads, and shards on different
//! machines, can take disjoint parts of it.

mod run;
mod subject;
mod topologies;
mod units;

pub use run::{Progress, SubjectRow, verify};
pub use subject::Subject;
pub use units::{Unit, units};
use units::{Units, Work};

#[cfg(test)]
mod tests;
