//! Stage taps: the values of single stages of the front end, for comparison with other
//! implementations.
//!
//! Each tap runs the code that whole patches go through, at a CPU level.

use crate::levels;
use alloc::vec::Vec;
use tess_core::{FactorContext, FixedFactor, Parity, Partitioning, SplitOrder};
use tess_level::{Level, LevelUnavailableError};

/// Factor processing (spec section 3). For each value `x`, returns the u = 0 factor of the triangle
/// patch (x, 3, 3; 3), or 0 if that patch is culled, and the inside factor of (3, 3, 3; x).
///
/// # Errors
/// [`LevelUnavailableError`] if this machine cannot run the level.
pub fn fixed_factors(
    level: Level,
    partitioning: Partitioning,
    values: &[f32],
) -> Result<Vec<[FixedFactor; 2]>, LevelUnavailableError> {
    level.require()?;
    let mut factors = alloc::vec![[FixedFactor::ONE; 2]; values.len()];
    levels::fixed_factors(level, partitioning, values, &mut factors);
    Ok(factors)
}

/// Contexts (spec section 4) of fixed-point factors. Valid factors are 1..=63 if odd, and 1 and
/// 2..=64 if even. Other factors are clamped to them.
///
/// # Errors
/// [`LevelUnavailableError`] if this machine cannot run the level.
pub fn contexts(
    level: Level,
    split: SplitOrder,
    parity: Parity,
    factors: &[FixedFactor],
) -> Result<Vec<FactorContext>, LevelUnavailableError> {
    level.require()?;
    let none = FactorContext::new(FixedFactor::ONE, parity, split);
    let mut contexts = alloc::vec![none; factors.len()];
    levels::contexts(level, split, parity, factors, &mut contexts);
    Ok(contexts)
}

/// The 16.16 locations (spec section 5) of all points of each context, one after another.
///
/// # Errors
/// [`LevelUnavailableError`] if this machine cannot run the level.
pub fn locations(
    level: Level,
    contexts: &[FactorContext],
) -> Result<Vec<u32>, LevelUnavailableError> {
    level.require()?;
    let mut locations = Vec::with_capacity(contexts.iter().map(|c| c.points as usize).sum());
    levels::locations(level, contexts, &mut locations);
    Ok(locations)
}
