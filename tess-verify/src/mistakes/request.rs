//! What a device is asked, with the other patches on which a mistaken answer may depend.

use crate::case::Case;

/// The settings that a cache may leave out: six levels, the spacing and the output.
pub(super) const SETTINGS: usize = 8;
pub(super) const SPACING: usize = 6;
pub(super) const OUTPUT: usize = 7;

/// A case, and what a device with a memory may confuse with it.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Request {
    /// The case that is asked.
    pub case: Case,
    /// Its number in the sequence, from 0.
    pub number: u64,
    /// The first case of the sequence.
    pub first: Case,
    /// The case before; the case itself if it is the first.
    pub before: Case,
    /// The case after; the case itself if it is the last, or if the next one is not known.
    pub after: Case,
    /// For each setting, the first of the cases in a row that differ in no other one.
    pub(super) stale: [Case; SETTINGS],
}

impl Request {
    /// The case with the value of a setting that the first of a row of cases had which differ in
    /// this setting alone. Setting 0 to 5 is a level, then come spacing and output.
    pub(super) const fn stale(&self, setting: usize) -> Case {
        self.stale[setting]
    }

    /// The same request for another case.
    pub(crate) const fn with_case(self, case: Case) -> Self {
        Self { case, ..self }
    }
}

/// The requests of a sequence of cases, one after another.
#[derive(Clone, Debug, Default)]
pub struct Sequence {
    last: Option<Request>,
}

impl Sequence {
    /// The request of the next case. `after` is the case that follows it, if it is known.
    pub fn next(&mut self, case: Case, after: Option<Case>) -> Request {
        let after = after.unwrap_or(case);
        let request = self.last.map_or_else(
            || Request {
                case,
                number: 0,
                first: case,
                before: case,
                after,
                stale: [case; SETTINGS],
            },
            |last| {
                let stale = |setting| {
                    let is_same = differ_only_in(&last.case, &case, setting);
                    if is_same { last.stale[setting] } else { case }
                };
                let stale = std::array::from_fn(stale);
                let (number, before) = (last.number + 1, last.case);
                Request { case, number, first: last.first, before, after, stale }
            },
        );
        self.last = Some(request);
        request
    }
}

/// The requests of cases that are asked in this order.
pub fn requests(cases: impl IntoIterator<Item = Case>) -> impl Iterator<Item = Request> {
    let (mut cases, mut sequence) = (cases.into_iter().peekable(), Sequence::default());
    std::iter::from_fn(move || {
        let case = cases.next()?;
        Some(sequence.next(case, cases.peek().copied()))
    })
}

/// Whether two cases are equal apart from one setting.
fn differ_only_in(a: &Case, b: &Case, setting: usize) -> bool {
    let like_b = match setting {
        SPACING => {
            let mut config = a.config;
            config.partitioning = b.config.partitioning;
            Case { config, ..*a }
        }
        OUTPUT => {
            let mut config = a.config;
            config.output = b.config.output;
            Case { config, ..*a }
        }
        level if a.domain() == b.domain() => {
            let own = b.factors.iter().nth(level);
            own.map_or(*a, |own| a.with_factor(level, own))
        }
        _ => return false,
    };
    like_b == *b
}

#[cfg(test)]
mod tests {
    use super::*;

    fn isoline(detail: f32) -> Case {
        let line = format!("case isoline integer line ruler 3f800000 {:08x}", detail.to_bits());
        line.parse().expect("a case")
    }

    #[test]
    fn requests_know_their_neighbours() {
        let cases = [1.0, 2.0, 3.0].map(isoline);
        let all: Vec<Request> = requests(cases).collect();
        let around = |request: &Request| [request.before, request.case, request.after];
        assert_eq!(around(&all[0]), [cases[0], cases[0], cases[1]], "the first");
        assert_eq!(around(&all[1]), cases, "the middle one");
        assert_eq!(around(&all[2]), [cases[1], cases[2], cases[2]], "the last");
        let numbers: Vec<u64> = all.iter().map(|request| request.number).collect();
        assert_eq!(numbers, [0, 1, 2]);
        assert!(all.iter().all(|request| request.first == cases[0]), "the first of all");
    }

    /// A row ends where anything else changes.
    #[test]
    fn a_cache_without_a_setting_answers_with_the_first_of_a_row() {
        let mut other = isoline(4.0);
        other.config.output = tess_core::OutputPrimitive::Point;
        let cases = [isoline(1.0), isoline(2.0), isoline(3.0), other];
        let all: Vec<Request> = requests(cases).collect();
        let stale = |setting: usize| -> Vec<Case> {
            all.iter().map(|request| request.stale(setting)).collect()
        };
        assert_eq!(stale(1), [cases[0], cases[0], cases[0], other], "the detail");
        assert_eq!(stale(0), cases, "the density");
        assert_eq!(stale(OUTPUT), cases, "detail and output change");
    }
}
