//! Random factors and patches.

use super::random::{Draw, SplitMix64};
use super::{exceptional_factors, from_fixed, pick, special_factors};
use tess_core::{Domain, PatchFactors};

/// The largest factor.
const MAXIMUM: u16 = 64;
/// The upper end of the range of most factors of [`random_patch`].
const SMALL: u16 = 6;
/// Factors that clamp to 1 in every partitioning that includes 1: 1, the number just below it, a
/// half, the smallest normal number and the smallest denormal.
const UP_TO_ONE: [f32; 5] =
    [1.0, f32::from_bits(0x3F7F_FFFF), 0.5, f32::MIN_POSITIVE, f32::from_bits(1)];

/// A factor drawn from kinds that find faults: anywhere in range, small, at and near integers and
/// halves, special, and arbitrary bits.
pub(super) fn random_factor(random: &mut SplitMix64) -> f32 {
    factor_up_to(MAXIMUM, random)
}

/// A random patch whose output is small on average, for comparing many patches.
///
/// Factors of every kind occur in every position. Those in range go up to 6. Exceptions are one
/// position of every eighth patch and all positions of every 64th, which use the whole range. In
/// another 64th nothing is above 1, as in minimum patches.
#[must_use]
pub fn random_patch(domain: Domain, random: &mut SplitMix64) -> PatchFactors {
    patch_of(domain, random, factor_up_to)
}

/// A patch with the shape of [`random_patch`], whose factors come from `factor` with the upper end
/// of their range.
pub(crate) fn patch_of<D: Draw>(
    domain: Domain,
    random: &mut D,
    factor: impl Fn(u16, &mut D) -> f32,
) -> PatchFactors {
    let positions = u32::try_from(domain.factors()).unwrap_or(u32::MAX);
    let (kind, one) = (random.below(128), random.below(positions) as usize);
    PatchFactors::from_fn(domain, |position| match kind {
        0..2 => factor(MAXIMUM, random),
        2..4 => pick(random, &UP_TO_ONE),
        4..20 if position == one => factor(MAXIMUM, random),
        _ => factor(SMALL, random),
    })
}

/// A factor of the kinds of [`random_factor`]; the range goes from 1 to `top`, which is 3 to 64.
pub(crate) fn factor_up_to(top: u16, random: &mut impl Draw) -> f32 {
    let top = u32::from(top);
    match random.below(20) {
        0..8 => from_fixed(random.below((top - 1) << 16) + 0x1_0000),
        8..12 => from_fixed(random.below((top - 1).min(7) << 16) + 0x1_0000),
        12..15 => from_fixed((random.below(top) + 1) << 16),
        15..17 => {
            let near = from_fixed((random.below(2 * top) + 1) << 15);
            let reach = 1 << random.below(12);
            let ulps = random.below(reach);
            f32::from_bits(near.to_bits().wrapping_add(ulps).wrapping_sub(ulps / 2))
        }
        17 => {
            let mut factors = exceptional_factors();
            factors.retain(|&factor| factor < from_fixed(top << 16));
            pick(random, &factors)
        }
        18 => pick(random, &special_factors()),
        _ => f32::from_bits(random.bits()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::SplitMix64;
    use crate::vectors::Fnv1a;

    /// A seed gives the same patches on every machine, and in every release unless its notes say
    /// otherwise.
    #[test]
    fn random_patches_are_the_recorded_ones() {
        let digests = Domain::ALL.map(|domain| {
            let mut random = SplitMix64::new(7);
            let mut digest = Fnv1a::default();
            for _ in 0..5000 {
                digest.words(random_patch(domain, &mut random).iter().map(f32::to_bits));
            }
            format!("{:016x}", digest.finish())
        });
        assert_eq!(digests, ["24b592e0e66855e1", "d5d2bef33afc16d0", "9e52f57eab1a38b7"]);
    }
}
