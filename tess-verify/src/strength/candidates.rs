//! The factors that a conforming device may have processed in place of the given ones.

use super::{Conversion, Denormals};
use crate::case::{Case, factor_list, factors_from_list, outer_count};
use crate::generate::from_fixed;
use tess_core::{Domain, FixedFactor, PatchFactors, ProcessedFactor, ProcessedPatch};

/// The cases whose exact outputs are all legal for `case`; the first is the case itself.
///
/// At most two conversions for each of six factors, and a culled patch: 65 cases.
#[must_use]
pub fn candidates(case: &Case, conversion: Conversion, denormals: Denormals) -> Vec<Case> {
    let mut lists = vec![factor_list(&case.factors)];
    if conversion == Conversion::Within06Ulp {
        for (position, other) in other_neighbours(case).into_iter().enumerate() {
            if let Some(other) = other {
                let mut with_other = lists.clone();
                with_other.iter_mut().for_each(|list| list[position] = other);
                lists.extend(with_other);
            }
        }
    }
    if denormals == Denormals::Flush {
        let mut flushed = factor_list(&case.factors);
        for factor in &mut flushed[..outer_count(case.domain())] {
            if factor.is_subnormal() {
                *factor = 0.0;
            }
        }
        lists.push(flushed);
    }
    let to_case = |list: Vec<f32>| {
        factors_from_list(case.domain(), &list).map(|factors| Case { factors, ..*case })
    };
    lists.into_iter().filter_map(to_case).collect()
}

/// For each factor the other fixed-point number that it may become, as an exact binary32.
fn other_neighbours(case: &Case) -> Vec<Option<f32>> {
    let patch = case.patch();
    let (ProcessedPatch::Minimum(factors) | ProcessedPatch::Regular(factors)) = patch.processed()
    else {
        return Vec::new();
    };
    let is_fractional = |position| {
        let density = case.domain() == Domain::Isoline && position == 0;
        !density && !case.config.partitioning.has_integer_factors()
    };
    processed_list(factors)
        .enumerate()
        .map(|(position, factor)| is_fractional(position).then(|| other_neighbour(&factor))?)
        .collect()
}

fn processed_list(
    factors: &PatchFactors<ProcessedFactor>,
) -> impl Iterator<Item = ProcessedFactor> {
    factor_list(factors).into_iter()
}

/// The other legal neighbour, if the factor lies within 0.4 to 0.6 of the way between two.
#[expect(clippy::float_arithmetic, reason = "exact: a binary32 scaled by 2^16 in binary64")]
fn other_neighbour(factor: &ProcessedFactor) -> Option<f32> {
    let scaled = f64::from(f32::from_bits(factor.rounded)) * 65536.0;
    let nearest = factor.fixed.to_bits();
    let error = scaled - f64::from(nearest);
    let other = if error > 0.0 { nearest + 1 } else { nearest - 1 };
    let ambiguous = (0.4..=0.6).contains(&error.abs());
    ambiguous.then(|| from_fixed(FixedFactor::from_bits(other).to_bits()))
}
