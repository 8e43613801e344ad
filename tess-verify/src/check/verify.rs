//! Every backend against the model: over generated levels, or over everything that is finite.
//!
//! The work is cut into units that are compared independently, so that threads, and shards on
//! different machines, can take disjoint parts of it.

mod run;
mod subject;
mod topologies;
mod units;

pub use run::{Row, verify, verify_known};
pub use subject::{Random, Subject};
pub use units::{RandomUnit, Unit, Units};

use crate::generate::Shard;

/// What to compare.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The subjects, in order.
    pub subjects: Vec<Subject>,
    /// The part of each subject's units to do.
    pub shard: Shard,
}

impl Plan {
    /// Levels 1 and 2, what they have in common once.
    #[must_use]
    pub fn levels() -> Self {
        Self { subjects: vec![Subject::Level1, Subject::Level2], shard: Shard::WHOLE }
    }

    /// Random patches of every configuration, and nothing else.
    #[must_use]
    pub fn random(random: Random) -> Self {
        Self { subjects: vec![Subject::Random(random)], shard: Shard::WHOLE }
    }

    /// Everything that is finite.
    #[must_use]
    pub fn exhaustive() -> Self {
        Self { subjects: Subject::ALL.to_vec(), shard: Shard::WHOLE }
    }
}
