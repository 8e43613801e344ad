//! Every backend against the model: over generated levels, or over everything that is finite.
//!
//! The work is cut into units that are compared independently, so that threads, and shards on
//! different machines, can take disjoint parts of it.

mod run;
mod subject;
mod topologies;
mod units;

pub use run::{SubjectRow, verify};
pub use subject::Subject;
use units::{Unit, Units};

use crate::generate::Shard;

/// What to compare.
#[derive(Clone, Debug)]
pub struct VerifyPlan {
    /// The subjects, in order.
    pub subjects: Vec<Subject>,
    /// The part of each subject's units to do.
    pub shard: Shard,
}

#[cfg(test)]
mod tests;
