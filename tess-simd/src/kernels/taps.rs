//! Single stages of the front end.

use crate::data::lanes::{LANES, Lanes};
use crate::stages::factor_context::PlainContext;
use crate::stages::factors;
use crate::stages::place::{Locations, Spacing};
use alloc::vec::Vec;
use tess_core::fixed_point::ONE;
use tess_core::{Domain, FactorContext, FixedFactor, Parity, Partitioning, SplitOrder};

/// See [`crate::fixed_factors`].
#[inline(always)]
pub(crate) fn fixed_factors(
    partitioning: Partitioning,
    values: &[f32],
    factors: &mut [[FixedFactor; 2]],
) {
    const PLAIN: [Lanes<f32>; Domain::Triangle.factors()] = [[3.0; LANES]; _];
    const INSIDE: usize = Domain::Triangle.outer_factors();
    for (values, factors) in values.chunks(LANES).zip(factors.chunks_mut(LANES)) {
        let (mut outer, mut inside) = (PLAIN, PLAIN);
        outer[0][..values.len()].copy_from_slice(values);
        inside[INSIDE][..values.len()].copy_from_slice(values);
        let outer = factors::process::<i32, _, _>(partitioning, Domain::Triangle, &outer);
        let inside = factors::process::<i32, _, _>(partitioning, Domain::Triangle, &inside);
        for (lane, factors) in factors.iter_mut().enumerate() {
            let bits = [outer.fixed[0][lane] * outer.alive[lane], inside.fixed[INSIDE][lane]];
            *factors = bits.map(FixedFactor::from_bits);
        }
    }
}

/// See [`crate::contexts`].
#[inline(always)]
pub(crate) fn contexts(
    split: SplitOrder,
    parity: Parity,
    factors: &[FixedFactor],
    contexts: &mut [FactorContext],
) {
    let odd = parity.odd();
    let highest = (64 - odd) << 16;
    for (factor, context) in factors.iter().zip(contexts) {
        // Legal even factors are 1 (treated as 2) and 2..=64.
        let lowest = if factor.to_bits() <= ONE { ONE } else { (2 - odd) << 16 };
        let fixed = factor.to_bits().clamp(lowest, highest);
        *context = FactorContext::from(&PlainContext::new(fixed, odd, split));
    }
}

/// See [`crate::locations`].
#[inline(always)]
pub(crate) fn locations(contexts: &[FactorContext], locations: &mut Vec<u32>) {
    let mut table = Locations::EMPTY;
    for context in contexts {
        table.fill(&Spacing::new(&PlainContext::from(context)));
        locations.extend(table.from(0).iter().take(context.points as usize));
    }
}
