//! Work that is cut into shards for many machines: which shard a command does, what it reports, and
//! which differences are known.
//!
//! `shard` finds the shard on the command line or in the environment. `cases` counts the cases and
//! sums up their hashes. `invocation` describes the run, and `recorder` writes it and its results
//! as a `report` and as `junit`. `known` reads the baseline. `tess merge` (`commands/merge`) proves
//! from the reports that all shards ran, and that they saw every case. docs/campaigns.md describes
//! both formats.

pub(crate) mod cases;
mod invocation;
pub(crate) mod junit;
mod known;
mod recorder;
pub(crate) mod report;
mod shard;

pub(crate) use invocation::Invocation;
pub(crate) use known::KnownArgs;
pub(crate) use recorder::{Recorder, ReportArgs};
pub(crate) use shard::{Placed, ShardArgs, shard};
