//! Functional coverage: which cases of the specification a set of vectors hits.
//!
//! `docs/verification.md` describes the bins. They are all declared beforehand, so the report can
//! name those that were not hit. Level 1 hits every bin, so none is unreachable. A device that
//! lacks configurations cannot hit all of them; [`Exclusions`] names those that it cannot.

mod bins;
mod boundary;
mod exclusions;
mod observe;
mod report;
mod ucis;

use crate::case::Case;
pub use exclusions::{Exclusions, UnknownBinError};
use std::collections::BTreeMap;
use std::fmt;
use tess_core::{FactorContext, SplitOrder};

/// How often each bin was hit. A bin is a path such as `middle/ruler/oddxeven`; the part before the
/// first `/` is its group.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coverage {
    hits: BTreeMap<String, u64>,
}

/// The bins that a case hits, as indices into [`Coverage::bins`]; a bin that is hit twice is listed
/// twice. Test benches with covergroups of their own use this: the covergroups are generated in the
/// same order.
#[must_use]
pub fn bins_hit(case: &Case) -> Vec<usize> {
    let mut numbers = Vec::new();
    observe::observe(case, |bin| numbers.extend(bins::all().binary_search(&bin)));
    numbers
}

/// How many bins of one group were hit.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BinGroup {
    /// Name of the group.
    pub name: String,
    /// The stage of the specification that its bins cover, such as `context`.
    pub stage: &'static str,
    /// Bins that were hit at least once and are not excluded.
    pub hit: usize,
    /// All bins of the group, excluded ones included.
    pub bins: usize,
    /// Bins that are excluded.
    pub excluded: usize,
}

/// Every bin, with no hits.
impl Default for Coverage {
    fn default() -> Self {
        Self { hits: bins::all().iter().map(|bin| (bin.clone(), 0)).collect() }
    }
}

impl Coverage {
    /// Counts the bins that a case hits, without those of sequences.
    ///
    /// # Panics
    /// In debug builds, if a case hits a bin that was not declared, which is a bug of this module.
    fn record(&mut self, case: &Case) {
        observe::observe(case, |bin| {
            let declared = self.add(&bin, 1);
            debug_assert!(declared, "bin {bin} is not declared ({case})");
        });
    }

    /// Counts the bins that the patches of a stream hit, including those of sequences: each patch
    /// follows the one before it, and the first follows `before`. A part of a stream, such as a
    /// shard, has other sequences than the whole stream.
    pub fn record_stream(&mut self, before: Option<Case>, cases: impl IntoIterator<Item = Case>) {
        let mut before = before.map(|case| observe::sequence_values_of(&case));
        for case in cases {
            self.record(&case);
            let values = observe::sequence_values_of(&case);
            let pairs = before.iter().flatten().zip(&values);
            for ((field, before), (_, value)) in pairs {
                self.add(&format!("sequence/{field}/{before}/{value}"), 1);
            }
            before = Some(values);
        }
    }

    /// Counts the bins that one factor's context hits, those of the groups `context` and
    /// `exceptional`. This is for the test bench of a stage that sees no patches.
    ///
    /// # Panics
    /// In debug builds, if no factor has this context.
    pub fn record_context(&mut self, split: SplitOrder, context: &FactorContext) {
        observe::context(split, context, &mut |bin| {
            let declared = self.add(&bin, 1);
            debug_assert!(declared, "bin {bin} is not declared ({context:?})");
        });
    }

    /// Adds to the hits of a bin, saturating at `u64::MAX`. Returns whether the bin exists.
    pub fn add(&mut self, bin: &str, more: u64) -> bool {
        let Some(hits) = self.hits.get_mut(bin) else { return false };
        *hits = hits.saturating_add(more);
        true
    }

    /// Adds the hits of another set of vectors, such as another shard.
    pub fn merge(&mut self, other: &Self) {
        other.bins().for_each(|(bin, hits)| _ = self.add(bin, hits));
    }

    /// The hits of a bin; `None` if there is no such bin.
    pub(crate) fn hits(&self, bin: &str) -> Option<u64> {
        self.hits.get(bin).copied()
    }

    /// The bins that were never hit, in alphabetical order.
    pub fn missed(&self) -> impl Iterator<Item = &str> {
        self.hits.iter().filter(|(_, hits)| **hits == 0).map(|(bin, _)| bin.as_str())
    }

    /// Every bin with its hits, in alphabetical order.
    pub fn bins(&self) -> impl Iterator<Item = (&str, u64)> {
        self.hits.iter().map(|(bin, hits)| (bin.as_str(), *hits))
    }

    /// The bins that were never hit and are not excluded, in alphabetical order.
    pub fn holes<'a>(&'a self, exclusions: &'a Exclusions) -> impl Iterator<Item = &'a str> {
        self.missed().filter(|bin| !exclusions.has(bin))
    }

    /// The bins that are excluded but were hit, in alphabetical order: their exclusions are wrong.
    pub(crate) fn hit_though_excluded<'a>(
        &'a self,
        exclusions: &'a Exclusions,
    ) -> impl Iterator<Item = &'a str> {
        exclusions.bins().filter(|bin| self.hits(bin).is_some_and(|hits| hits > 0))
    }

    /// The groups, in alphabetical order.
    #[must_use]
    pub fn groups(&self) -> Vec<BinGroup> {
        self.groups_without(&Exclusions::default())
    }

    /// The groups, in alphabetical order, with their excluded bins counted.
    #[must_use]
    pub(crate) fn groups_without(&self, exclusions: &Exclusions) -> Vec<BinGroup> {
        let mut groups: BTreeMap<&str, BinGroup> = BTreeMap::new();
        for (bin, hits) in self.bins() {
            let name = bin.split('/').next().unwrap_or(bin);
            let group = groups.entry(name).or_insert_with(|| BinGroup {
                name: name.to_owned(),
                stage: report::stage(name),
                hit: 0,
                bins: 0,
                excluded: 0,
            });
            let is_excluded = exclusions.has(bin);
            group.bins += 1;
            group.excluded += usize::from(is_excluded);
            group.hit += usize::from(hits > 0 && !is_excluded);
        }
        groups.into_values().collect()
    }
}

/// The report without exclusions.
impl fmt::Display for Coverage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.report(&Exclusions::default()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{FixedFactor, Parity};

    fn case() -> Case {
        "case quad integer line ruler 40400000 40400000 40400000 40400000 40a00000 40400000"
            .parse()
            .expect("a case")
    }

    /// The bins of one case are the same by name, by number and by file.
    #[test]
    fn a_case_hits_its_bins() {
        let mut coverage = Coverage::default();
        coverage.record(&case());
        coverage.record(&case());
        let bins: Vec<&str> = coverage.bins().map(|(bin, _)| bin).collect();
        let mut by_number = Coverage::default();
        for number in bins_hit(&case()) {
            assert!(by_number.add(bins[number], 2), "bin {number}");
        }
        assert_eq!(by_number, coverage, "by number");
        assert_eq!(coverage.hits("middle/ruler/oddxodd"), Some(8), "four edges, twice");
        let read = Coverage::read_ucis(coverage.to_ucis().as_bytes()).expect("its own file");
        assert_eq!(read, coverage, "by file");
        assert_eq!(coverage.to_string(), coverage.report(&Exclusions::default()));
    }

    #[test]
    fn a_context_hits_the_bins_of_contexts() {
        let mut coverage = Coverage::default();
        let factor = FixedFactor::from_bits(0x3_8000);
        let context = FactorContext::new(factor, Parity::Odd, SplitOrder::Ruler);
        coverage.record_context(SplitOrder::Ruler, &context);
        let hit: Vec<_> = coverage.groups().into_iter().filter(|group| group.hit > 0).collect();
        assert_eq!(hit.iter().map(|group| &*group.name).collect::<Vec<_>>(), ["context"]);
    }
}
