//! Bins that a device cannot hit and that therefore are not holes.

use super::{Coverage, bins};
use crate::quote::quoted;
use std::collections::{BTreeSet, HashSet};
use tess_core::{Config, Domain};

/// Bins that a device need not hit. The default is empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Exclusions {
    bins: BTreeSet<&'static str>,
}

impl Exclusions {
    /// Excludes every bin that no patch of these configurations can hit, for a device that has only
    /// these.
    #[must_use]
    pub fn outside(configurations: impl IntoIterator<Item = (Domain, Config)>) -> Self {
        let within = bins::of(configurations);
        let is_outside = |bin: &&String| within.binary_search(bin).is_err();
        Self { bins: bins::all().iter().filter(is_outside).map(String::as_str).collect() }
    }

    /// Adds the bins of a pattern: a bin's path, or its first parts, where each part may be `*` for
    /// any. So `transition` is a whole group, and `configuration/*/pow2` is all of the bins of
    /// `configuration` with that partitioning.
    ///
    /// # Errors
    /// No bin fits the pattern.
    pub(super) fn add(&mut self, pattern: &str) -> Result<(), UnknownBinError> {
        let fits = |bin: &str| {
            let mut found = bin.split('/');
            pattern
                .split('/')
                .all(|part| found.next().is_some_and(|own| part == "*" || own == part))
        };
        // The bins are sorted, so those that begin like the pattern, up to its first `*`, are
        // adjacent.
        let literal = pattern.split('*').next().unwrap_or_default();
        let from = bins::all().partition_point(|bin| bin.as_str() < literal);
        let near = bins::all()[from..].iter().take_while(|bin| bin.starts_with(literal));
        let mut fitting = near.map(String::as_str).filter(|bin| fits(bin)).peekable();
        if fitting.peek().is_none() {
            return Err(UnknownBinError { line: None, pattern: pattern.to_owned() });
        }
        self.bins.extend(fitting);
        Ok(())
    }

    /// Reads patterns, one per line: a bin's path, or its first parts, where each part may be `*`
    /// for any. Empty lines are ignored, as is anything after a `#`.
    ///
    /// # Errors
    /// A pattern that fits no bin; the error has its line.
    pub fn read(text: &str) -> Result<Self, UnknownBinError> {
        let mut exclusions = Self::default();
        let mut read = HashSet::new();
        for (number, line) in (1..).zip(text.lines()) {
            let pattern = line.split('#').next().unwrap_or_default().trim();
            if !pattern.is_empty() && read.insert(pattern) {
                let added = exclusions.add(pattern);
                added.map_err(|error| UnknownBinError { line: Some(number), ..error })?;
            }
        }
        Ok(exclusions)
    }

    /// Adds the exclusions of `other`.
    pub fn merge(&mut self, other: &Self) {
        self.bins.extend(&other.bins);
    }

    /// The exclusions without the bins that were hit, for vectors that are merged with those of
    /// other configurations.
    #[must_use]
    pub fn not_hit(&self, coverage: &Coverage) -> Self {
        let is_hit = |bin: &str| coverage.hits(bin).is_some_and(|hits| hits > 0);
        Self { bins: self.bins.iter().copied().filter(|bin| !is_hit(bin)).collect() }
    }

    /// Whether a bin is excluded.
    pub(super) fn has(&self, bin: &str) -> bool {
        self.bins.contains(bin)
    }

    /// The bins that are excluded, in alphabetical order.
    pub fn bins(&self) -> impl Iterator<Item = &str> {
        self.bins.iter().copied()
    }
}

/// A pattern that fits no bin.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{}no bin begins with {}; a bin is a path such as middle/ruler/oddxeven, and * is any part of one",
    line.map(|line| format!("line {line}: ")).unwrap_or_default(),
    quoted(pattern)
)]
#[non_exhaustive]
pub struct UnknownBinError {
    /// The line of the text, from 1, if the pattern was read from one.
    pub line: Option<usize>,
    /// The pattern.
    pub pattern: String,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{GenLevel, Selection, configurations};
    use tess_core::{OutputPrimitive, Partitioning, SplitOrder};

    /// The device has quads, integer, clockwise, ruler; without exclusions, 1789 of its bins would
    /// be holes.
    #[test]
    fn a_device_with_one_configuration_has_no_holes() {
        let partitioning = Partitioning::Integer;
        let (output, split) = (OutputPrimitive::TriangleCw, SplitOrder::Ruler);
        let one = Selection {
            domain: Some(Domain::Quad),
            partitioning: Some(partitioning),
            output: Some(output),
            split: Some(split),
            ..Selection::level(GenLevel::One, 1)
        };
        let mut coverage = Coverage::default();
        coverage.record_stream(None, one.cases());
        let has = [(Domain::Quad, Config { partitioning, output, split })];
        let exclusions = Exclusions::outside(has);
        for (bin, hits) in coverage.bins().filter(|(bin, _)| exclusions.has(bin)) {
            assert_eq!(hits, 0, "{bin} is excluded");
        }
        assert!(exclusions.bins().count() > 300, "{exclusions:?}");
    }

    #[test]
    fn all_configurations_exclude_nothing_and_none_exclude_all() {
        assert_eq!(Exclusions::outside(configurations()), Exclusions::default());
        let all = Exclusions::outside([]);
        assert_eq!(all.bins().count(), Coverage::default().bins().count());
    }

    #[test]
    fn patterns() {
        let count = |text: &str| Exclusions::read(text).map(|found| found.bins().count());
        assert_eq!(count(""), Ok(0), "nothing");
        assert_eq!(
            count("# all\n\n  middle # a group\nmiddle/ruler/oddxodd\n"),
            Ok(8),
            "each once"
        );
        assert_eq!(count("configuration/*/pow2"), Ok(24), "the first parts");
        assert_eq!(count("*"), Ok(Coverage::default().bins().count()), "every group");
        for (text, line) in
            [("middle\nmidle", 2), ("middle/", 1), ("middle/ruler/oddxodd/x", 1), ("mid", 1)]
        {
            let error = Exclusions::read(text).expect_err(text);
            assert_eq!(error.line, Some(line), "{error}");
        }
    }
}
