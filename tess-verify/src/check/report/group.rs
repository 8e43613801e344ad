//! Differences by stage and configuration.

use super::Difference;
use crate::case::Case;
use crate::check::compare::SpecStage;
use crate::names::Named;
use std::fmt;
use tess_core::{Config, Domain};

/// The differences of one stage in one configuration.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct MismatchGroup {
    /// The stage that they point to.
    pub stage: SpecStage,
    /// The domain and configuration; `None` for records that are not single patches.
    pub config: Option<(Domain, Config)>,
    /// The number of differences.
    pub mismatches: u64,
    /// The difference whose case has the fewest indices in the model; the first one, if several
    /// have as few.
    pub smallest: Difference,
}

/// The number, stage and configuration.
impl fmt::Display for MismatchGroup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { stage, config, mismatches, .. } = self;
        write!(f, "{mismatches:>8}  {:<12}", stage.to_string())?;
        let Some((domain, Config { partitioning, output, split })) = config else { return Ok(()) };
        let (domain, partitioning) = (domain.name(), partitioning.name());
        write!(f, " {domain} {partitioning} {} {}", output.name(), split.name())
    }
}

impl MismatchGroup {
    fn of(difference: &Difference) -> Self {
        let config = difference.case.map(|case| (case.domain(), case.config));
        let stage = difference.mismatch.stage;
        Self { stage, config, mismatches: 1, smallest: difference.clone() }
    }

    fn key(&self) -> (SpecStage, Option<(Domain, Config)>) {
        (self.stage, self.config)
    }

    /// The number of indices of the smallest case, then the number of its record.
    fn size(&self) -> (u32, u64) {
        let indices = |case: Case| case.patch().counts().indices;
        (self.smallest.case.map_or(0, indices), self.smallest.number)
    }
}

/// All groups, in any order. There is at most one per stage and configuration.
#[derive(Clone, Debug, Default)]
pub(super) struct Groups(Vec<MismatchGroup>);

impl Groups {
    pub(super) fn add(&mut self, difference: &Difference) {
        self.insert(MismatchGroup::of(difference));
    }

    /// Whether a difference would be the smallest of its group.
    pub(super) fn has_smallest(&self, difference: &Difference) -> bool {
        let group = MismatchGroup::of(difference);
        let known = self.0.iter().find(|known| known.key() == group.key());
        known.is_none_or(|known| group.size() < known.size())
    }

    pub(super) fn join(&mut self, other: Self) {
        other.0.into_iter().for_each(|group| self.insert(group));
    }

    fn insert(&mut self, group: MismatchGroup) {
        match self.0.iter_mut().find(|known| known.key() == group.key()) {
            None => self.0.push(group),
            Some(known) => {
                known.mismatches += group.mismatches;
                if group.size() < known.size() {
                    known.smallest = group.smallest;
                }
            }
        }
    }

    /// The groups; the one with the smallest case comes first.
    pub(super) fn sorted(&self) -> Vec<MismatchGroup> {
        let mut groups = self.0.clone();
        groups.sort_by_key(MismatchGroup::size);
        groups
    }
}
