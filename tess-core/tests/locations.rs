//! The known exceptions of spec section 12, counted over every fixed-point factor.

use std::ops::RangeInclusive;
use tess_core::fixed_point::ONE;
use tess_core::place::place;
use tess_core::{FactorContext, FixedFactor, Parity, SplitOrder};

/// A row of the table of spec section 12.
#[derive(Debug, Default, PartialEq, Eq)]
struct Exceptions {
    /// The number of factors.
    factors: u32,
    /// Factors with two equal neighbouring locations.
    equal: u32,
    /// Factors with a location that is less than its predecessor.
    backwards: u32,
    /// The smallest and the largest of those.
    backwards_range: Option<(u32, u32)>,
    /// The largest decrease from a location to the next.
    furthest_back: u32,
    /// The largest excess of any of these factors over an integer of its parity.
    largest_excess: u32,
}

impl Exceptions {
    fn add(&mut self, bits: u32, parity: Parity, locations: &[u32]) {
        self.factors += 1;
        let steps = || locations.windows(2).map(|pair| (pair[0], pair[1]));
        let equal = steps().any(|(before, after)| before == after);
        let back = steps().map(|(before, after)| before.saturating_sub(after)).max().unwrap_or(0);
        self.equal += u32::from(equal);
        if back > 0 {
            self.backwards += 1;
            let (first, _) = self.backwards_range.unwrap_or((bits, bits));
            self.backwards_range = Some((first, bits));
            self.furthest_back = self.furthest_back.max(back);
        }
        if equal || back > 0 {
            let parity_offset = parity.odd() << 16;
            let excess = (bits - parity_offset) % (2 << 16);
            self.largest_excess = self.largest_excess.max(excess);
        }
    }
}

/// Every factor of a parity: 2..=64 even, 1..=63 odd, in steps of 2^-16.
fn every_factor(parity: Parity) -> RangeInclusive<u32> {
    (2 - parity.odd()) << 16..=(64 - parity.odd()) << 16
}

/// Counts the exceptions. Also checks range and symmetry (spec 12.1, 12.2) of each location, and
/// that the ends of an edge are 0 and one.
fn exceptions(split: SplitOrder, parity: Parity) -> Exceptions {
    let mut exceptions = Exceptions::default();
    let mut locations = Vec::with_capacity(65);
    for bits in every_factor(parity) {
        let context = FactorContext::new(FixedFactor::from_bits(bits), parity, split);
        locations.clear();
        locations.extend((0..context.points).map(|p| place(&context, p).to_bits()));
        let mirrored = locations.iter().zip(locations.iter().rev());
        let symmetric = mirrored.clone().all(|(here, there)| here + there == ONE);
        let in_range = locations.iter().all(|&location| location <= ONE);
        let ends = (locations.first(), locations.last()) == (Some(&0), Some(&ONE));
        assert!(symmetric && in_range && ends, "factor {bits:#x}: {locations:x?}");
        exceptions.add(bits, parity, &locations);
    }
    exceptions
}

/// Compares a row of the table; all exceptions exceed an integer by less than 0.02.
fn check(split: SplitOrder, parity: Parity, expected: &Exceptions) {
    let found = exceptions(split, parity);
    let excess = found.largest_excess;
    assert!(excess < 0x51F, "{excess:#x} is less than 0.02 (0x51f rounded up)");
    let expected = Exceptions { largest_excess: excess, ..*expected };
    assert_eq!(found, expected, "{split:?} {parity:?}");
}

const EVERY: Exceptions = Exceptions {
    factors: 4_063_233,
    equal: 0,
    backwards: 0,
    backwards_range: None,
    furthest_back: 0,
    largest_excess: 0,
};

#[test]
fn ruler_even() {
    let expected = Exceptions {
        equal: 1320,
        backwards: 420,
        backwards_range: Some((0x0006_0001, 0x001E_019E)),
        furthest_back: 7,
        ..EVERY
    };
    check(SplitOrder::Ruler, Parity::Even, &expected);
}

#[test]
fn ruler_odd() {
    check(SplitOrder::Ruler, Parity::Odd, &Exceptions { equal: 1358, ..EVERY });
}

#[test]
fn center_even() {
    let expected = Exceptions {
        equal: 1054,
        backwards: 4884,
        backwards_range: Some((0x0006_0001, 0x003A_00B2)),
        furthest_back: 10,
        ..EVERY
    };
    check(SplitOrder::Centre, Parity::Even, &expected);
}

#[test]
fn center_odd() {
    check(SplitOrder::Centre, Parity::Odd, &Exceptions { equal: 1042, ..EVERY });
}

#[test]
fn a_point_behind_the_last_is_the_last() {
    for parity in [Parity::Even, Parity::Odd] {
        let context =
            FactorContext::new(FixedFactor::from_bits(5 * ONE), parity, SplitOrder::Ruler);
        for p in [context.points, context.points + 1, u32::MAX] {
            assert_eq!(place(&context, p).to_bits(), ONE, "{parity:?}, point {p}");
        }
    }
}
