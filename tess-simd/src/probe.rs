//! The stages of the front end on their own, for comparison with other implementations.
//!
//! Each goes through the same code as whole patches do, at a CPU level.

use crate::dispatch;
use crate::error::LevelUnavailable;
use crate::factor_context::Context;
use crate::factors::process;
use crate::lanes::{Column, LANES, MAX_FACTORS};
use crate::level::Level;
use crate::place::{Locations, Spacing};
use alloc::vec::Vec;
use tess_core::fixed_point::ONE;
use tess_core::{
    Config, Domain, FactorContext, FixedFactor, OutputPrimitive, Parity, Partitioning, SplitOrder,
};

/// Factor processing (spec section 3): for each value `x` the u = 0 factor of the triangle patch
/// (x, 3, 3; 3), zero if it is culled, and the inside factor of (3, 3, 3; x).
///
/// # Errors
/// [`LevelUnavailable`] if this machine cannot run the level.
pub fn fixed_factors(
    level: Level,
    partitioning: Partitioning,
    values: &[f32],
) -> Result<Vec<[FixedFactor; 2]>, LevelUnavailable> {
    require(level)?;
    let mut factors = alloc::vec![[FixedFactor::ONE; 2]; values.len()];
    dispatch::fixed_factors(level, partitioning, values, &mut factors);
    Ok(factors)
}

/// Contexts (spec section 4) of fixed-point factors: 1..=63 if odd, 1 and 2..=64 if even; one outside
/// counts as the nearest.
///
/// # Errors
/// [`LevelUnavailable`] if this machine cannot run the level.
pub fn contexts(
    level: Level,
    split: SplitOrder,
    parity: Parity,
    factors: &[FixedFactor],
) -> Result<Vec<FactorContext>, LevelUnavailable> {
    require(level)?;
    let none = FactorContext::new(FixedFactor::ONE, parity, split);
    let mut contexts = alloc::vec![none; factors.len()];
    dispatch::contexts(level, split, parity, factors, &mut contexts);
    Ok(contexts)
}

/// The 16.16 locations (spec section 5) of all points of each context, one after another.
///
/// # Errors
/// [`LevelUnavailable`] if this machine cannot run the level.
pub fn locations(level: Level, contexts: &[FactorContext]) -> Result<Vec<u32>, LevelUnavailable> {
    require(level)?;
    let mut locations = Vec::with_capacity(contexts.iter().map(|c| c.points as usize).sum());
    dispatch::locations(level, contexts, &mut locations);
    Ok(locations)
}

fn require(level: Level) -> Result<(), LevelUnavailable> {
    if level.is_available() { Ok(()) } else { Err(LevelUnavailable(level)) }
}

/// [`fixed_factors`] without its dispatch.
#[inline(always)]
pub(crate) fn fixed_factors_kernel(
    partitioning: Partitioning,
    values: &[f32],
    factors: &mut [[FixedFactor; 2]],
) {
    const PLAIN: Column<f32> = [3.0; LANES * MAX_FACTORS];
    const INSIDE: usize = 3 * LANES;
    let config = Config::new(partitioning, OutputPrimitive::Point);
    for (values, factors) in values.chunks(LANES).zip(factors.chunks_mut(LANES)) {
        let (mut outer, mut inside) = (PLAIN, PLAIN);
        outer[..values.len()].copy_from_slice(values);
        inside[INSIDE..INSIDE + values.len()].copy_from_slice(values);
        let outer = process(config, Domain::Triangle, &outer);
        let inside = process(config, Domain::Triangle, &inside);
        for (lane, factors) in factors.iter_mut().enumerate() {
            let bits = [outer.fixed[lane] * outer.alive[lane], inside.fixed[INSIDE + lane]];
            *factors = bits.map(FixedFactor::from_bits);
        }
    }
}

/// [`contexts`] without its dispatch.
#[inline(always)]
pub(crate) fn contexts_kernel(
    split: SplitOrder,
    parity: Parity,
    factors: &[FixedFactor],
    contexts: &mut [FactorContext],
) {
    let odd = parity.odd();
    let highest = (64 - odd) << 16;
    for (factor, context) in factors.iter().zip(contexts) {
        // Between the even factor 1, which acts as 2, and 2 itself there is none.
        let lowest = if factor.to_bits() <= ONE { ONE } else { (2 - odd) << 16 };
        let fixed = factor.to_bits().clamp(lowest, highest);
        *context = FactorContext::from(&Context::new(fixed, odd, split));
    }
}

/// [`locations`] without its dispatch.
#[inline(always)]
pub(crate) fn locations_kernel(contexts: &[FactorContext], locations: &mut Vec<u32>) {
    let mut table = Locations::EMPTY;
    for context in contexts {
        table.fill(&Spacing::new(&Context::from(context)));
        locations.extend(table.from(0).iter().take(context.points as usize));
    }
}
