//! The factors that a conforming device may process instead of the given ones.
//!
//! A factor has two legal fixed-point numbers if, in units of 2^-16, its fraction is from 0.4 to
//! 0.6. Edges of the same value must get the same number, or neighbouring patches would not meet.
//! So the choice is per *value*, not per factor.
//!
//! ```text
//! factors    u0 = a   v0 = b   u1 = a   v1 = 3   inside_u = b   inside_v = 5      a and b are ambiguous
//! values     [a, b]                                              in the order of the factors
//! value_of   0        1        0        -        1              -
//!
//! choice     bit 1 bit 0      bit i: value i takes its second number (the one farther away)
//!      0       0     0        the model's own conversion
//!      1       0     1        a is converted the other way, on both of its edges
//!      2       1     0        b is
//!      3       1     1        both are
//!
//! accepted   bit n: choice n explains the output; 0b1010 = "a is the second number, b shows in nothing"
//! ```
//!
//! - Six factors have at most six values, so `accepted` has at most 64 bits.
//! - Choice 0 is the model's own. A patch without ambiguous values has no other.
//! - A value that does not show in an output is accepted either way. `check::consistency` therefore
//!   takes a number as known only if every accepted choice agrees on it.

use super::{Conversion, Denormals, Strength};
use crate::case::Case;
use crate::generate::from_fixed;
use tess_core::{PatchFactors, ProcessedFactor, Tessellation};

/// A value, after rounding and clamping, that has two legal fixed-point numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Ambiguous {
    /// The bits of the binary32.
    pub(crate) value: u32,
    /// The two 15.16 numbers: first the nearest, which is the model's, then the other one.
    pub(crate) numbers: [u32; 2],
}

/// The choices that explain one output. Bit `n` of `accepted` is set if choice `n` does. Bit `i` of
/// a choice is set if value `i` became the second of its numbers.
///
/// A patch has at most six values, so there are at most 64 choices.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Conversions {
    pub(crate) values: Vec<Ambiguous>,
    pub(crate) accepted: u64,
}

/// A case whose factors may be converted in several ways.
pub(crate) struct Alternatives {
    case: Case,
    pub(crate) values: Vec<Ambiguous>,
    /// For each factor, the index of its value in `values`, if that is ambiguous.
    value_of: PatchFactors<Option<usize>>,
}

impl Alternatives {
    pub(crate) fn new(case: &Case, conversion: Conversion) -> Self {
        let mut values: Vec<Ambiguous> = Vec::new();
        let none = PatchFactors::uniform(case.domain(), None);
        let patch = case.patch();
        let factors = match (conversion, patch.processed().factors()) {
            (Conversion::Within06Ulp, Some(factors)) => factors,
            _ => return Self { case: *case, values, value_of: none },
        };
        let value_of = factors.map(|factor| {
            let ambiguous = ambiguous(&factor)?;
            let known = values.iter().position(|value| *value == ambiguous);
            Some(known.unwrap_or_else(|| {
                values.push(ambiguous);
                values.len() - 1
            }))
        });
        Self { case: *case, values, value_of }
    }

    /// All choices; choice 0 takes the model's number for each value.
    pub(crate) fn choices(&self) -> std::ops::Range<u64> {
        0..1 << self.values.len()
    }

    /// The case whose exact output is legal if the device made this choice.
    pub(crate) fn case(&self, choice: u64) -> Case {
        let (mut raw, mut value_of) = (self.case.factors.iter(), self.value_of.iter());
        let factors = PatchFactors::from_fn(self.case.domain(), |_| {
            let (raw, value) = (raw.next().unwrap_or_default(), value_of.next().flatten());
            let other = value.filter(|value| choice >> value & 1 == 1);
            other.map_or(raw, |value| from_fixed(self.values[value].numbers[1]))
        });
        Case { factors, ..self.case }
    }
}

/// The two legal numbers of a factor that is 0.4 to 0.6 units away from both. The nearest is at
/// most 0.5 units away; if it is at least 0.4 away, the other one is at most 0.6 away. A density,
/// or a factor of an integer partitioning, has been rounded up to an integer, so it has one number.
#[expect(clippy::float_arithmetic, reason = "exact: a binary32 scaled by 2^16 in binary64")]
fn ambiguous(factor: &ProcessedFactor) -> Option<Ambiguous> {
    let scaled = f64::from(f32::from_bits(factor.rounded)) * 65536.0;
    let nearest = factor.fixed.to_bits();
    let error = scaled - f64::from(nearest);
    let other = if error > 0.0 { nearest + 1 } else { nearest - 1 };
    let both_legal = error.abs() >= 0.4;
    both_legal.then_some(Ambiguous { value: factor.rounded, numbers: [nearest, other] })
}

/// The case with its denormal outer factors flushed to zero, which culls it; `None` if it has no
/// such factors.
#[must_use]
pub fn flushed(case: &Case) -> Option<Case> {
    let is_denormal = |factor: f32| factor.is_subnormal() && factor > 0.0;
    let flush = case.factors.outer().any(is_denormal);
    flush.then(|| {
        let outer = case.domain().outer_factors();
        let mut position = 0;
        let factors = case.factors.map(|factor| {
            position += 1;
            if position <= outer && is_denormal(factor) { 0.0 } else { factor }
        });
        Case { factors, ..*case }
    })
}

impl Strength {
    /// The conversions of the case's factors that explain an output; `None` if none does.
    pub(crate) fn explain(self, case: &Case, observed: &Tessellation) -> Option<Conversions> {
        self.explain_as(case, observed, |case| case.patch().tessellate())
    }

    /// The same for a device whose outputs are not the model's but those of `answer`.
    pub(crate) fn explain_as(
        self,
        case: &Case,
        observed: &Tessellation,
        answer: impl Fn(&Case) -> Tessellation,
    ) -> Option<Conversions> {
        let equals = |case: &Case| self.equal(case, observed, &answer(case));
        let alternatives = Alternatives::new(case, self.conversion);
        let explaining =
            alternatives.choices().filter(|&choice| equals(&alternatives.case(choice)));
        let accepted = explaining.fold(0, |accepted, choice| accepted | 1 << choice);
        if accepted != 0 {
            return Some(Conversions { values: alternatives.values, accepted });
        }
        // A culled patch does not show how its factors were converted.
        let may_flush = self.denormals == Denormals::Flush;
        let culled = may_flush.then(|| flushed(case)).flatten();
        culled.filter(equals).map(|_| Conversions::default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(line: &str) -> usize {
        let case: Case = line.parse().expect("a case");
        Alternatives::new(&case, Conversion::Within06Ulp).values.len()
    }

    /// From 1 to 2, binary32 numbers have steps of 2^-23, which is 1/128 of 2^-16. So 51 steps are
    /// 0.398 units and 52 are 0.406; 76 are 0.594 and 77 are 0.602.
    #[test]
    fn values_are_ambiguous_from_four_tenths_on() {
        let line = "case tri fractional_odd point ruler 40200000 40a00000 3fa00000 40900000";
        let with =
            |steps: u32| values(&line.replace("3fa00000", &format!("{:08x}", 0x3FA0_0000 + steps)));
        assert_eq!([51, 52, 76, 77].map(with), [0, 1, 1, 0], "0.4 to 0.6");
    }

    /// 3 + 2^-17 is halfway between two numbers; 3 + 0.3125 * 2^-16 is near one of them.
    #[test]
    fn values_between_two_numbers_are_ambiguous() {
        let line = "case tri fractional_odd point ruler 40200000 40a00000 40400014 40900000";
        assert_eq!(values(line), 0, "near one");
        let tie = line.replace("40400014", "40400020");
        assert_eq!(values(&tie), 1, "a tie");
        assert_eq!(values(&tie.replace("40a00000", "40400020")), 1, "one value on two edges");
        assert_eq!(values(&tie.replace("40a00000", "40800010")), 2, "two values");
        assert_eq!(values(&tie.replace("fractional_odd", "integer")), 0, "rounded up");
        let line = "case isoline fractional_odd line ruler 40400020 40400020";
        assert_eq!(values(line), 1, "the detail; the density is rounded up");
    }
}
