//! Both forms, bit for bit.

use crate::data::lanes::Column;
use crate::levels::{ALL, Factors};
use crate::stages::factor_context::Context;
use crate::stages::place::Spacing;
use crate::work::{Stage, Work};
use tess_core::{FactorContext, FixedFactor, Parity, Partitioning, SplitOrder};
use tess_simd::Level;

/// Compares every stage on binary32 of all kinds and on fixed-point factors all over their range, at the
/// level `baseline`.
pub(crate) fn many() -> Result<(), String> {
    for raw in [any_numbers(), near_integers()] {
        let mut work = Work::new(Level::Baseline, raw, vec![], vec![]);
        for partitioning in Partitioning::ALL {
            both(&mut work, Stage::Factors(partitioning))?;
        }
    }
    for order in SplitOrder::ALL {
        for parity in [Parity::Even, Parity::Odd] {
            let factors = fixed_factors(parity);
            let edges = factors.iter().flat_map(|block| spacings(block, order)).collect();
            let mut work = Work::new(Level::Baseline, vec![], factors, edges);
            both(&mut work, Stage::Contexts(order))?;
            both(&mut work, Stage::Locations)?;
        }
    }
    Ok(())
}

fn both(work: &mut Work, stage: Stage) -> Result<(), String> {
    work.run_both(stage);
    same(work, stage)
}

/// Says where the results of a stage differ.
pub(crate) fn same(work: &Work, stage: Stage) -> Result<(), String> {
    if work.len(stage) == 0 {
        return Err(format!("{}: nothing to compare", stage.name()));
    }
    let different = match stage {
        Stage::Factors(_) => different_factors(work),
        Stage::Contexts(order) => different_spacings(work, order),
        Stage::Locations => different_locations(work),
    };
    match different {
        None => Ok(()),
        Some(i) => Err(format!("{stage:?}: the results of input {i} differ")),
    }
}

fn different_factors(work: &Work) -> Option<usize> {
    let [arrays, wide] = &work.processed;
    arrays.iter().zip(wide).position(|(a, b)| {
        (a.fixed, a.odd, a.alive, a.minimum) != (b.fixed, b.odd, b.alive, b.minimum)
    })
}

/// Compares with the core, too.
fn different_spacings(work: &Work, order: SplitOrder) -> Option<usize> {
    let (arrays, wide) = &work.contexts;
    let results = work.factors.iter().zip(arrays).zip(wide);
    results.into_iter().position(|((factors, (arrays, points)), wide)| {
        spacings(factors, order).enumerate().any(|(i, expected)| {
            let arrays = numbers(&arrays.get(i, points[i]));
            let (wide, expected) = (numbers(&wide.get(i)), numbers(&expected));
            arrays != expected || wide != expected
        })
    })
}

fn different_locations(work: &Work) -> Option<usize> {
    let (arrays, wide) = &work.locations;
    let results = work.edges.iter().zip(arrays).zip(wide);
    results.into_iter().position(|((edge, arrays), wide)| {
        let points = edge.points as usize;
        arrays.from(0)[..points] != wide.0[..points]
    })
}

const fn numbers(spacing: &Spacing) -> [u32; 4] {
    let Spacing { points, split, step, lag } = *spacing;
    [points, split, step, lag]
}

/// The spacings of a block, from the core's contexts.
fn spacings(factors: &Factors, order: SplitOrder) -> impl Iterator<Item = Spacing> {
    factors.fixed.iter().zip(&factors.odd).map(move |(&fixed, &odd)| {
        let parity = if odd == 1 { Parity::Odd } else { Parity::Even };
        let context = FactorContext::new(FixedFactor::from_bits(fixed), parity, order);
        Spacing::new(&Context::from(&context))
    })
}

/// A million bit patterns; those of a patch have nothing in common.
fn any_numbers() -> Vec<Column<f32>> {
    blocks((0..1 << 20).map(|i: u32| f32::from_bits(i.wrapping_mul(0x9E37_79B1))))
}

/// The 600 neighbours on each side of each integer up to 66, the integers next to one another.
fn near_integers() -> Vec<Column<f32>> {
    let near = |offset: u32| {
        (1..=66_u8).map(move |integer| f32::from_bits(f32::from(integer).to_bits() - 600 + offset))
    };
    blocks((0..1200).flat_map(near))
}

/// Every 211th factor of a parity, and those next to an integer.
fn fixed_factors(parity: Parity) -> Vec<Factors> {
    let odd = parity.odd();
    let in_range = |bits: &u32| odd == 1 || *bits == 0x1_0000 || *bits >= 0x2_0000;
    let some = |bits: &u32| bits.is_multiple_of(211) || (bits + 40) & 0xFFFF < 80;
    let all = (0x1_0000..=(64 - odd) << 16).filter(in_range).filter(some);
    let columns: Vec<Column> = blocks(all);
    columns.into_iter().map(|fixed| Factors { fixed, odd: [odd; ALL] }).collect()
}

/// As many whole blocks as there are.
fn blocks<T: Copy>(elements: impl Iterator<Item = T>) -> Vec<Column<T>> {
    elements.collect::<Vec<_>>().as_chunks::<ALL>().0.to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_give_the_same_bits() {
        assert_eq!(many(), Ok(()), "every stage");
    }

    #[test]
    fn planted_faults_are_seen() {
        let mut work = Work::at_random(Level::Baseline);
        for stage in Stage::TIMED {
            work.run_both(stage);
            assert_eq!(same(&work, stage), Ok(()), "before: {stage:?}");
            work.plant_fault(stage);
            assert!(same(&work, stage).is_err(), "a wrong bit: {stage:?}");
        }
        let empty = Work::new(Level::Baseline, vec![], vec![], vec![]);
        assert!(same(&empty, Stage::Locations).is_err(), "no edges");
    }
}
