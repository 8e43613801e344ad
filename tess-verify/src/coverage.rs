//! Functional coverage: which of the specification's cases a set of vectors hits.
//!
//! The bins are described in `docs/verification.md`. All of them are declared beforehand, so what
//! was not hit can be named; none of them can be out of reach, as level 1 hits every one.

mod bins;
mod observe;

use crate::case::Case;
use std::collections::BTreeMap;

/// How often each bin was hit. A bin is a path such as `middle/oddxeven`; the part before the
/// first `/` is its group.
#[derive(Clone, Debug)]
pub struct Coverage {
    hits: BTreeMap<String, u64>,
}

/// How many bins of a group were hit.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Group {
    /// Name of the group.
    pub name: String,
    /// Bins hit at least once.
    pub hit: usize,
    /// Bins there are.
    pub bins: usize,
}

impl Default for Coverage {
    fn default() -> Self {
        Self::new()
    }
}

impl Coverage {
    /// All bins, none of them hit.
    #[must_use]
    pub fn new() -> Self {
        Self { hits: bins::all().into_iter().map(|bin| (bin, 0)).collect() }
    }

    /// Counts the bins that a case hits.
    ///
    /// # Panics
    /// In debug builds, if a case hits a bin that was not declared: a fault of this module.
    pub fn record(&mut self, case: &Case) {
        observe::observe(case, |bin| match self.hits.get_mut(&bin) {
            Some(hits) => *hits += 1,
            None => debug_assert!(false, "bin {bin} is not declared ({case})"),
        });
    }

    /// The bins that were never hit, in alphabetical order.
    pub fn missed(&self) -> impl Iterator<Item = &str> {
        self.hits.iter().filter(|(_, hits)| **hits == 0).map(|(bin, _)| bin.as_str())
    }

    /// Every bin with its hits, in alphabetical order.
    pub fn bins(&self) -> impl Iterator<Item = (&str, u64)> {
        self.hits.iter().map(|(bin, hits)| (bin.as_str(), *hits))
    }

    /// The groups, in alphabetical order.
    #[must_use]
    pub fn groups(&self) -> Vec<Group> {
        let mut groups: BTreeMap<&str, Group> = BTreeMap::new();
        for (bin, hits) in self.bins() {
            let name = bin.split('/').next().unwrap_or(bin);
            let group = groups.entry(name).or_insert_with(|| Group {
                name: name.to_owned(),
                hit: 0,
                bins: 0,
            });
            group.bins += 1;
            group.hit += usize::from(hits > 0);
        }
        groups.into_values().collect()
    }
}
