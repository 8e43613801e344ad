//! Cases made from a fuzzer's bytes.

use super::random::Draw;
use crate::case::Case;
use crate::generate::{
    exceptional_factors, factor_up_to, from_fixed, ordinary_factors, patch_of, pick,
};
use arbitrary::{Arbitrary, Result, Unstructured};
use std::sync::LazyLock;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};

/// Any configuration, with the factors of [`crate::generate::random_patch`]; a quarter of the
/// factors are boundaries of level 1. Most patches are small. No bytes are refused: when none are
/// left, zeros take their place.
impl<'a> Arbitrary<'a> for Case {
    fn arbitrary(bytes: &mut Unstructured<'a>) -> Result<Self> {
        let draw = &mut Bytes(bytes);
        let config = Config {
            partitioning: pick(draw, &Partitioning::ALL),
            output: pick(draw, &OutputPrimitive::ALL),
            split: pick(draw, &SplitOrder::ALL),
        };
        let domain = pick(draw, &Domain::ALL);
        let factors = patch_of(domain, draw, |top, draw| match draw.below(4) {
            0 => boundary_up_to(top, draw),
            _ => factor_up_to(top, draw),
        });
        Ok(Self { config, factors })
    }

    fn size_hint(_: usize) -> (usize, Option<usize>) {
        // Four bytes choose the configuration, two the shape, and up to ten each of six factors.
        (0, Some(4 + 2 + 6 * 10))
    }
}

/// Every finite boundary of level 1, ascending, without the special ones, which [`factor_up_to`]
/// draws itself.
static BOUNDARIES: LazyLock<Vec<f32>> = LazyLock::new(|| {
    let mut factors = [ordinary_factors(), exceptional_factors()].concat();
    factors.sort_by(f32::total_cmp);
    factors
});

fn boundary_up_to(top: u16, draw: &mut impl Draw) -> f32 {
    let top = from_fixed(u32::from(top) << 16);
    let few = BOUNDARIES.partition_point(|&factor| factor <= top);
    pick(draw, &BOUNDARIES[..few])
}

struct Bytes<'a, 'b>(&'b mut Unstructured<'a>);

impl Draw for Bytes<'_, '_> {
    fn bits(&mut self) -> u32 {
        self.0.arbitrary().unwrap_or_default()
    }

    fn below(&mut self, bound: u32) -> u32 {
        let last = bound.saturating_sub(1);
        self.0.int_in_range(0..=last).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cover::Coverage;
    use crate::generate::SplitMix64;
    use crate::generate::special_factors;
    use std::collections::BTreeSet;

    fn cases(number: usize) -> impl Iterator<Item = Case> {
        let mut random = SplitMix64::new(1);
        (0..number).map(move |_| {
            let bytes: Vec<u8> = (0..9).flat_map(|_| random.next_u64().to_le_bytes()).collect();
            Case::arbitrary(&mut Unstructured::new(&bytes)).expect("no bytes are refused")
        })
    }

    #[test]
    fn every_boundary_comes() {
        let mut missing: BTreeSet<u32> =
            BOUNDARIES.iter().chain(&special_factors()).map(|factor| factor.to_bits()).collect();
        assert!(missing.len() > 1000, "{} boundaries", missing.len());
        for case in cases(400_000) {
            case.factors.iter().for_each(|factor| {
                missing.remove(&factor.to_bits());
            });
        }
        assert!(missing.is_empty(), "{} do not come, such as {:?}", missing.len(), missing.first());
    }

    #[test]
    fn coverage_is_whole_but_for_what_large_patches_have() {
        let mut coverage = Coverage::default();
        coverage.record_stream(None, cases(100_000));
        let is_rare = |bin: &&str| {
            ["transition/", "rings/", "boundary/", "sequence/"]
                .iter()
                .any(|group| bin.starts_with(group))
        };
        let missed: Vec<_> = coverage.missed().filter(|bin| !is_rare(bin)).collect();
        assert!(missed.is_empty(), "{} bins, such as {}", missed.len(), missed[0]);
    }

    #[test]
    fn few_bytes_are_enough() {
        for length in 0..70 {
            let bytes = vec![0xA5; length];
            let mut bytes = Unstructured::new(&bytes);
            assert!(Case::arbitrary(&mut bytes).is_ok(), "{length} bytes");
        }
        let (_, most) = Case::size_hint(0);
        let bytes = [0xFF; 200];
        let mut bytes = Unstructured::new(&bytes);
        Case::arbitrary(&mut bytes).expect("a case");
        let taken = 200 - bytes.len();
        assert!(most.is_some_and(|most| taken <= most), "{taken} bytes were taken");
    }

    /// Raw bits are among the factors: every sign with every exponent.
    #[test]
    fn any_bits_come() {
        let factors = cases(200_000).flat_map(|case| case.factors.iter().collect::<Vec<_>>());
        let high: BTreeSet<u32> = factors.map(|factor| factor.to_bits() >> 23).collect();
        assert_eq!(high.len(), 512, "signs and exponents");
    }
}
