//! The patches on which a device makes a mistake, if these are not all.

use super::request::Request;
use crate::case::Case;
use crate::names::Named;
use std::fmt;
use tess_core::{Domain, OutputPrimitive, Partitioning};

/// Conditions on patches, all of which must hold. The default has none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Scope {
    /// Only this domain.
    pub domain: Option<Domain>,
    /// Only this partitioning.
    pub partitioning: Option<Partitioning>,
    /// Only this output primitive.
    pub output: Option<OutputPrimitive>,
    /// Only patches whose largest level is at least this.
    pub at_least: Option<f32>,
    /// Only patches whose largest level is at most this.
    pub at_most: Option<f32>,
    /// Only every n-th patch: n, and the number of one such patch, from 0.
    pub every: Option<[u64; 2]>,
}

impl Scope {
    /// Whether a patch meets the conditions.
    #[must_use]
    pub fn has(&self, request: &Request) -> bool {
        let (case, largest) = (&request.case, largest(&request.case));
        self.domain.is_none_or(|own| own == case.domain())
            && self.partitioning.is_none_or(|own| own == case.config.partitioning)
            && self.output.is_none_or(|own| own == case.config.output)
            && self.at_least.is_none_or(|least| largest >= least)
            && self.at_most.is_none_or(|most| largest <= most)
            && self.every.is_none_or(|[n, one]| request.number.abs_diff(one).is_multiple_of(n))
    }

    /// The number of conditions.
    #[must_use]
    pub fn conditions(&self) -> usize {
        [
            self.domain.is_some(),
            self.partitioning.is_some(),
            self.output.is_some(),
            self.at_least.is_some(),
            self.at_most.is_some(),
            self.every.is_some(),
        ]
        .into_iter()
        .filter(|is_given| *is_given)
        .count()
    }
}

/// The conditions, each after a comma; nothing if there are none.
impl fmt::Display for Scope {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { domain, partitioning, output, at_least, at_most, every } = self;
        domain.map_or(Ok(()), |domain| write!(f, ", on {} patches", domain.name()))?;
        partitioning.map_or(Ok(()), |own| write!(f, ", under {}", own.name()))?;
        output.map_or(Ok(()), |own| write!(f, ", with output {}", own.name()))?;
        at_least.map_or(Ok(()), |x| write!(f, ", where the largest level is at least {x}"))?;
        at_most.map_or(Ok(()), |x| write!(f, ", where the largest level is at most {x}"))?;
        every.map_or(Ok(()), |[n, one]| {
            write!(f, ", in every {n} patches, such as number {}", one + 1)
        })
    }
}

/// The largest level of a case; negative infinity if all are NaN.
fn largest(case: &Case) -> f32 {
    case.factors.iter().fold(f32::NEG_INFINITY, f32::max)
}

/// The properties that all patches of a set have in common.
#[derive(Clone, Debug, Default)]
pub(crate) struct Common {
    pub(crate) count: u64,
    domain: Same<Domain>,
    partitioning: Same<Partitioning>,
    output: Same<OutputPrimitive>,
    /// The smallest and the largest of their largest levels.
    levels: Option<[f32; 2]>,
    /// The smallest number, and the greatest common divisor of the distances from it.
    numbers: Option<[u64; 2]>,
}

/// The only value so far.
#[derive(Clone, Copy, Debug, Default)]
enum Same<T> {
    #[default]
    None,
    One(T),
    Several,
}

impl<T: Copy + PartialEq> Same<T> {
    fn join(&mut self, other: Self) {
        *self = match (*self, other) {
            (Self::None, any) | (any, Self::None) => any,
            (Self::One(a), Self::One(b)) if a == b => Self::One(a),
            _ => Self::Several,
        };
    }

    const fn value(self) -> Option<T> {
        if let Self::One(value) = self { Some(value) } else { None }
    }
}

impl Common {
    fn of(request: &Request) -> Self {
        let (case, largest) = (&request.case, largest(&request.case));
        Self {
            count: 1,
            domain: Same::One(case.domain()),
            partitioning: Same::One(case.config.partitioning),
            output: Same::One(case.config.output),
            levels: Some([largest; 2]),
            numbers: Some([request.number, 0]),
        }
    }

    pub(crate) fn add(&mut self, request: &Request) {
        self.join(&Self::of(request));
    }

    pub(crate) fn join(&mut self, other: &Self) {
        self.count += other.count;
        self.domain.join(other.domain);
        self.partitioning.join(other.partitioning);
        self.output.join(other.output);
        let levels = |[a, b]: [f32; 2], [c, d]: [f32; 2]| [a.min(c), b.max(d)];
        let numbers =
            |[a, n]: [u64; 2], [b, m]: [u64; 2]| [a.min(b), gcd(a.abs_diff(b), gcd(n, m))];
        self.levels = both(self.levels, other.levels, levels);
        self.numbers = both(self.numbers, other.numbers, numbers);
    }

    /// Every scope that has all of these patches; those with few conditions come first. A condition
    /// needs evidence: there are at most as many as half of the patches but one.
    pub(crate) fn scopes(&self) -> Vec<Scope> {
        let [least, most] = [0, 1].map(|i| self.levels.map(|levels| levels[i]));
        let every = self.numbers.filter(|[_, n]| *n > 1).map(|[one, n]| [n, one]);
        let mut scopes = Vec::new();
        for number in 0..8 {
            let has = |bit: usize| number >> bit & 1 == 1;
            let scope = Scope {
                domain: self.domain.value().filter(|_| has(0)),
                partitioning: self.partitioning.value().filter(|_| has(1)),
                output: self.output.value().filter(|_| has(2)),
                ..Scope::default()
            };
            scopes.extend([
                scope,
                Scope { at_least: least, ..scope },
                Scope { at_most: most, ..scope },
                Scope { every, ..scope },
            ]);
        }
        let most = usize::try_from(self.count.saturating_sub(1) / 2).unwrap_or(usize::MAX);
        scopes.retain(|scope| scope.conditions() <= most);
        scopes.sort_by_key(Scope::conditions);
        scopes
    }
}

fn both<T>(a: Option<T>, b: Option<T>, join: impl Fn(T, T) -> T) -> Option<T> {
    match (a, b) {
        (Some(a), Some(b)) => Some(join(a, b)),
        (one, other) => one.or(other),
    }
}

const fn gcd(mut a: u64, mut b: u64) -> u64 {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mistakes::requests;

    fn common(details: &[(u64, f32)]) -> Common {
        let mut common = Common::default();
        for &(number, detail) in details {
            let line = format!("case isoline integer line ruler 3f800000 {:08x}", detail.to_bits());
            let request = requests([line.parse().expect("a case")]).next().expect("one");
            common.add(&Request { number, ..request });
        }
        common
    }

    /// Five patches may have two conditions. Each scope has all of them.
    #[test]
    fn scopes_have_what_they_come_from() {
        let patches = [(3, 7.0), (13, 9.0), (8, 30.5), (23, 7.5), (28, 12.0)];
        let scopes = common(&patches).scopes();
        let texts: Vec<String> = scopes.iter().map(ToString::to_string).collect();
        assert_eq!(texts[0], "", "no condition comes first");
        for expected in [
            ", on isoline patches",
            ", under integer",
            ", with output line",
            ", where the largest level is at least 7",
            ", where the largest level is at most 30.5",
            ", in every 5 patches, such as number 4",
            ", on isoline patches, under integer",
        ] {
            assert!(texts.iter().any(|text| text == expected), "{expected}: {texts:?}");
        }
        assert!(scopes.iter().all(|scope| scope.conditions() <= 2), "{texts:?}");
        for (number, detail) in patches {
            let line = format!("case isoline integer line ruler 3f800000 {:08x}", detail.to_bits());
            let request = requests([line.parse().expect("a case")]).next().expect("one");
            let request = Request { number, ..request };
            assert!(scopes.iter().all(|scope| scope.has(&request)), "{number}");
        }
        let other = |number, line: &str| {
            let request = requests([line.parse().expect("a case")]).next().expect("one");
            let request = Request { number, ..request };
            scopes.iter().filter(|scope| !scope.has(&request)).count()
        };
        assert_ne!(other(4, "case isoline integer line ruler 3f800000 41000000"), 0, "number");
        assert_ne!(other(3, "case isoline integer line ruler 3f800000 40c00000"), 0, "level 6");
        assert_ne!(other(3, "case isoline integer line ruler 3f800000 42000000"), 0, "level 32");
        assert_ne!(other(3, "case isoline integer point ruler 3f800000 41000000"), 0, "output");
        assert_ne!(other(3, "case isoline pow2 line ruler 3f800000 41000000"), 0, "spacing");
        assert_eq!(other(3, "case isoline integer line ruler 3f800000 41000000"), 0, "level 8");
    }

    #[test]
    fn one_patch_or_two_have_no_conditions() {
        for count in 1..=2 {
            let scopes = common(&[(3, 7.0), (13, 9.0)][..count]).scopes();
            assert_eq!(scopes.iter().map(Scope::conditions).max(), Some(0), "{count}");
        }
    }
}
