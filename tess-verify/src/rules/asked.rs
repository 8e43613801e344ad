//! The levels about which a rule was asked, and those about which it was not.

use super::rule::{Row, Rule};
use super::scope::{Kind, Pair};
use super::standard::Specification;
use crate::case::Case;
use crate::names::Named;
use std::fmt;
use std::sync::Arc;
use tess_core::{Domain, Partitioning, SplitOrder};

/// The number of roles of all domains.
const ROLES: usize = 12;

/// A place among the counters: where a level is asked.
#[derive(Clone, Copy, Debug)]
struct Place {
    split: SplitOrder,
    domain: Domain,
    spacing: Partitioning,
    position: usize,
}

impl Place {
    /// Every place, split order by split order.
    fn all() -> impl Iterator<Item = Self> {
        SplitOrder::ALL.into_iter().flat_map(|split| {
            Domain::ALL.into_iter().flat_map(move |domain| {
                Partitioning::ALL.into_iter().flat_map(move |spacing| {
                    let place = move |position| Self { split, domain, spacing, position };
                    (0..domain.factors()).map(place)
                })
            })
        })
    }

    /// Where its counters begin.
    fn index(self) -> usize {
        let role = match self.domain {
            Domain::Isoline => 0,
            Domain::Triangle => 2,
            Domain::Quad => 6,
        } + self.position;
        let spacing = Partitioning::ALL.iter().position(|own| *own == self.spacing);
        let split = usize::from(self.split == SplitOrder::Centre);
        ((split * ROLES + role) * 4 + spacing.unwrap_or_default()) * Kind::COUNT
    }
}

/// The domains whose edges have triangles.
const SURFACES: [Domain; 2] = [Domain::Triangle, Domain::Quad];

/// How often a rule was asked about each number of segments and each class of value, in each role
/// of each domain and spacing, and about which pairs of numbers on an edge and inside.
#[derive(Clone, PartialEq, Eq)]
pub struct Asked {
    rule: Rule,
    specification: Specification,
    counts: Arc<Vec<u32>>,
    /// For each split order, domain of [`SURFACES`] and number on an edge: the numbers inside, as
    /// bits.
    pairs: Arc<Vec<u128>>,
}

impl Asked {
    pub(super) fn new(rule: Rule, specification: Specification) -> Self {
        let counts = Arc::new(vec![0; 2 * ROLES * 4 * Kind::COUNT]);
        let pairs = Arc::new(vec![0; 2 * SURFACES.len() * EDGE_NUMBERS]);
        Self { rule, specification, counts, pairs }
    }

    /// Counts a judgement about the levels of a case in these positions, as bits.
    pub(super) fn add(&mut self, case: &Case, positions: u8) {
        let (domain, scope) = (case.domain(), Row::of(self.rule).scope);
        let counts = Arc::make_mut(&mut self.counts);
        let (split, spacing) = (case.config.split, case.config.partitioning);
        for position in 0..domain.factors() {
            if positions >> position & 1 == 1 && scope.has(domain, position) {
                let first = Place { split, domain, spacing, position }.index();
                Kind::of(case, position).for_each(|kind| counts[first + kind.index()] += 1);
            }
        }
        if scope.wants_pairs() {
            let edges = (0..domain.outer_factors()).filter(|edge| positions >> edge & 1 == 1);
            for pair in edges.filter_map(|edge| Pair::of(case, edge)) {
                Arc::make_mut(&mut self.pairs)[pair_row(split, domain, pair)] |= 1 << pair.inside;
            }
        }
    }

    /// The pairs that the rule must be asked about in a split order and domain and was not; all
    /// that it must be asked about are [`Pair::all`].
    fn missing_pairs(&self, split: SplitOrder, domain: Domain) -> Vec<Pair> {
        let is_missing =
            |pair: &Pair| self.pairs[pair_row(split, domain, *pair)] >> pair.inside & 1 == 0;
        Pair::all().filter(is_missing).collect()
    }

    /// The split orders and domains in which the rule must be asked about pairs.
    fn places_of_pairs(&self) -> Vec<(SplitOrder, Domain)> {
        let wants = Row::of(self.rule).scope.wants_pairs();
        let splits = SplitOrder::ALL.into_iter().filter(|split| wants && self.has(*split));
        splits.flat_map(|split| SURFACES.map(|domain| (split, domain))).collect()
    }

    /// The kinds that are wanted at a place, each with whether it was asked.
    fn wanted(&self, place: Place) -> Vec<(Kind, bool)> {
        let Place { domain, spacing, position, .. } = place;
        let (scope, first) = (Row::of(self.rule).scope, place.index());
        let role = (domain, spacing, position);
        let wants = |kind: &Kind| scope.wants(self.specification, role, *kind);
        Kind::all()
            .filter(wants)
            .map(|kind| (kind, self.counts[first + kind.index()] > 0))
            .collect()
    }

    /// Whether anything was asked in a split order. A device need not have both.
    fn has(&self, split: SplitOrder) -> bool {
        let half = self.counts.len() / 2;
        let counts = self.counts.split_at(half);
        let own = if split == SplitOrder::Centre { counts.1 } else { counts.0 };
        own.iter().any(|count| *count > 0)
    }

    fn places(&self) -> Vec<Place> {
        let seen = SplitOrder::ALL.map(|split| self.has(split));
        let is_seen = |place: &Place| seen[usize::from(place.split == SplitOrder::ALL[1])];
        Place::all().filter(is_seen).collect()
    }

    /// How many levels were asked of those that must be asked before the rule counts as held, and
    /// how many these are. A level is a number of segments or a class of value in a role, domain,
    /// spacing, and split order if anything was asked in that order; or a pair of numbers, on an
    /// edge and inside, in a domain and such a split order.
    #[must_use]
    pub fn levels(&self) -> [usize; 2] {
        let all = self.places().into_iter().flat_map(|place| self.wanted(place));
        let levels =
            all.fold([0, 0], |[asked, wanted], (_, is)| [asked + usize::from(is), wanted + 1]);
        self.places_of_pairs().into_iter().fold(levels, |[asked, wanted], (split, domain)| {
            let all = Pair::all().count();
            [asked + all - self.missing_pairs(split, domain).len(), wanted + all]
        })
    }

    /// Whether all of these were asked.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        let [asked, wanted] = self.levels();
        asked == wanted
    }

    /// The levels that were not asked, largest groups first: whole domains, their spacings and
    /// roles, then single numbers and classes, then pairs of numbers.
    #[must_use]
    pub fn missing(&self) -> Vec<String> {
        let places: Vec<_> = self.places().into_iter().map(|p| (p, self.wanted(p))).collect();
        let has_both = SplitOrder::ALL.into_iter().all(|split| self.has(split));
        let mut texts: [Vec<String>; 5] = Default::default();
        for (place, kinds) in &places {
            if kinds.iter().all(|(_, is_asked)| *is_asked) {
                continue;
            }
            // The largest group of places without any question that has this one.
            let same = [
                |a: &Place, b: &Place| a.domain == b.domain,
                |a: &Place, b: &Place| a.domain == b.domain && a.spacing == b.spacing,
                |a: &Place, b: &Place| {
                    a.domain == b.domain && a.spacing == b.spacing && a.position == b.position
                },
            ];
            let is_empty = |same: &fn(&Place, &Place) -> bool| {
                let own = places.iter().filter(|(p, _)| p.split == place.split && same(p, place));
                own.flat_map(|(_, kinds)| kinds).all(|(_, is_asked)| !is_asked)
            };
            let same: [fn(&Place, &Place) -> bool; 3] = same;
            let group = same.iter().position(is_empty).unwrap_or(3);
            let split = if has_both { format!("{} ", place.split.name()) } else { String::new() };
            let words = [
                place.domain.name().to_owned(),
                place.spacing.name().to_owned(),
                place.domain.factor_names()[place.position].to_owned(),
            ];
            let name = split + &words[..(group + 1).min(3)].join(" ");
            let text = if group < 3 { name } else { format!("{name}: {}", listed(kinds)) };
            if !texts[group].contains(&text) {
                texts[group].push(text);
            }
        }
        for (split, domain) in self.places_of_pairs() {
            let order = if has_both { format!("{} ", split.name()) } else { String::new() };
            let (name, missing) = (order + domain.name(), self.missing_pairs(split, domain));
            let first = missing.first().filter(|_| !texts[0].contains(&name));
            texts[4].extend(first.map(|Pair { outer, inside }| {
                let pairs = format!("{} pairs of an edge and the inside", missing.len());
                format!("{name}: {pairs}, such as {outer} and {inside} segments")
            }));
        }
        texts.concat()
    }
}

/// The numbers of segments of an edge, and 0, which none has.
const EDGE_NUMBERS: usize = 65;

/// The place of a pair's number on the edge among the rows of bits.
fn pair_row(split: SplitOrder, domain: Domain, pair: Pair) -> usize {
    let split = usize::from(split == SplitOrder::Centre);
    let domain = usize::from(domain == Domain::Quad);
    (split * SURFACES.len() + domain) * EDGE_NUMBERS + usize::from(pair.outer)
}

/// The kinds that were not asked: numbers in ranges, then the first class.
fn listed(kinds: &[(Kind, bool)]) -> String {
    let is_number = |kind: &Kind| matches!(kind, Kind::Number(_));
    let numbers: Vec<_> = kinds.iter().filter(|(kind, _)| is_number(kind)).collect();
    let mut parts = Vec::new();
    for run in numbers.chunk_by(|a, b| a.1 == b.1).filter(|run| !run[0].1) {
        let [first, last] = [&run[0].0, &run[run.len() - 1].0].map(|kind| kind.name());
        parts.push(if run.len() > 1 { format!("{first} to {last}") } else { first });
    }
    if !parts.is_empty() {
        parts = vec![format!("{} segments", parts.join(", "))];
    }
    let classes: Vec<_> = kinds.iter().filter(|(kind, is)| !is_number(kind) && !is).collect();
    if let [(first, _), others @ ..] = &classes[..] {
        let more = if others.is_empty() {
            String::new()
        } else {
            format!(" and {} classes more", others.len())
        };
        parts.push(first.name() + &more);
    }
    parts.join(", ")
}

impl fmt::Debug for Asked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [asked, wanted] = self.levels();
        write!(f, "{}: {asked} of {wanted} levels", self.rule.name())
    }
}

/// The levels that were not asked, in one line: the first three groups.
impl fmt::Display for Asked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN: usize = 3;
        let missing = self.missing();
        f.write_str(&missing[..missing.len().min(SHOWN)].join("; "))?;
        match missing.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            more => write!(f, "; and {more} more"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{GenLevel, Selection};

    /// Of triangles of integer spacing, with and without edges of 24 segments around 18.
    fn missing(is_left_out: bool) -> Vec<String> {
        let split = Some(SplitOrder::Ruler);
        let domain = Some(Domain::Triangle);
        let cases = Selection { split, domain, ..Selection::level(GenLevel::Rules, 1) }.cases();
        let mut asked = Asked::new(Rule::Cover, Specification::D3d11);
        let is_pair = |case: &Case| {
            let pairs = (0..3).filter_map(|edge| Pair::of(case, edge));
            pairs.into_iter().any(|pair| pair == Pair { outer: 24, inside: 18 })
        };
        let cases = cases.filter(|case| !(is_left_out && is_pair(case)));
        cases.for_each(|case| asked.add(&case, u8::MAX));
        asked.missing()
    }

    /// A rule is held only if every pair was asked, and a verdict names what was not.
    #[test]
    fn a_pair_that_was_not_asked_is_named() {
        assert_eq!(missing(false), ["quad"], "all of triangles");
        // The patch has 22 and 23 segments on its other edges.
        let pairs = "tri: 3 pairs of an edge and the inside, such as 22 and 18 segments";
        assert_eq!(missing(true), ["quad", pairs]);
    }

    /// A pair is asked in its own split order and domain only.
    #[test]
    fn pairs_are_counted_apart() {
        for split in SplitOrder::ALL {
            for (domain, inside) in
                [(Domain::Triangle, "40c00000"), (Domain::Quad, "40c00000 40c00000")]
            {
                let edges = if domain == Domain::Quad {
                    "40800000 40800000 40800000 40800000"
                } else {
                    "40800000 40800000 40800000"
                };
                let line = format!(
                    "case {} integer triangle_cw {} {edges} {inside}",
                    domain.name(),
                    split.name()
                );
                let mut asked = Asked::new(Rule::Cover, Specification::D3d11);
                asked.add(&line.parse().expect("a case"), u8::MAX);
                for own in SplitOrder::ALL {
                    for surface in SURFACES {
                        let is_it = (own, surface) == (split, domain);
                        let missing = asked.missing_pairs(own, surface).len();
                        let all = Pair::all().count();
                        assert_eq!(
                            missing,
                            all - usize::from(is_it),
                            "{line}: {own:?} {surface:?}"
                        );
                    }
                }
            }
        }
    }
}
