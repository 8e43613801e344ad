//! Differences of a device that are known: a baseline, under which a documented deviation is no mismatch.

use crate::case::Case;
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};

/// The cases that may differ, and what became of each. Threads may share it.
///
/// The default has no case, so it excuses nothing.
#[derive(Debug, Default)]
pub struct Known {
    /// Each case once, in the order in which they were given.
    entries: Vec<(Case, Seen)>,
    /// Where each case stands among the entries.
    places: HashMap<Case, usize>,
}

/// What was seen of a case that may differ.
#[derive(Debug, Default)]
struct Seen {
    equal: AtomicBool,
    different: AtomicBool,
}

/// A baseline of these cases; a case that is given twice counts once.
impl FromIterator<Case> for Known {
    fn from_iter<T: IntoIterator<Item = Case>>(cases: T) -> Self {
        let mut known = Self::default();
        for case in cases {
            let next = known.entries.len();
            if *known.places.entry(case).or_insert(next) == next {
                known.entries.push((case, Seen::default()));
            }
        }
        known
    }
}

impl Known {
    /// Notes whether a case differs. True if it does and may.
    pub fn excuses(&self, case: &Case, is_different: bool) -> bool {
        let Some(&place) = self.places.get(case) else { return false };
        let seen = &self.entries[place].1;
        let which = if is_different { &seen.different } else { &seen.equal };
        which.store(true, Ordering::Relaxed);
        is_different
    }

    /// How many cases may differ.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.entries.len()
    }

    /// How many of them were asked and differed, at least once.
    #[must_use]
    pub fn different(&self) -> usize {
        self.entries.iter().filter(|(_, seen)| seen.different.load(Ordering::Relaxed)).count()
    }

    /// The cases that were asked and no longer differ, in the order in which they were given.
    #[must_use]
    pub fn gone(&self) -> Vec<Case> {
        let is_gone = |seen: &Seen| {
            seen.equal.load(Ordering::Relaxed) && !seen.different.load(Ordering::Relaxed)
        };
        let gone = self.entries.iter().filter(|(_, seen)| is_gone(seen));
        gone.map(|(case, _)| *case).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_became_of_each_case() {
        let case = |factor: u32| -> Case {
            let line = format!("case isoline integer line ruler 3f800000 {factor:08x}");
            line.parse().expect("a case")
        };
        let [differs, gone, both, unasked, other] = [1, 2, 3, 4, 5].map(case);
        let known = Known::from_iter([differs, both, gone, unasked, gone]);
        assert!(known.excuses(&differs, true), "it may differ");
        assert!(!known.excuses(&gone, false), "equal needs no excuse");
        assert!(!known.excuses(&both, false) && known.excuses(&both, true), "asked twice");
        assert!(!known.excuses(&other, true), "it may not differ");
        assert_eq!((known.entries(), known.different()), (4, 2), "each case once");
        assert_eq!(known.gone(), [gone], "neither what differed once nor what was not asked");
    }
}
