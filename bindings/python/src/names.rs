//! Names and factors of a patch, as arguments.

use crate::errors::argument;
use pyo3::prelude::*;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};
use tess_verify::case::Case;
use tess_verify::names::Named;

/// The value of a name.
pub(crate) fn named<T: Named>(name: &str) -> PyResult<T> {
    T::from_name(name).map_err(argument)
}

/// A configuration from its three names.
pub(crate) fn config(partitioning: &str, output: &str, split: &str) -> PyResult<Config> {
    Ok(Config {
        partitioning: named::<Partitioning>(partitioning)?,
        output: named::<OutputPrimitive>(output)?,
        split: named::<SplitOrder>(split)?,
    })
}

/// The factors of one patch from outer and inside ones.
pub(crate) fn factors(domain: Domain, outer: &[f32], inner: &[f32]) -> PyResult<PatchFactors> {
    let wrong = || {
        let (outer_names, inner_names) = domain.factor_names().split_at(domain.outer_factors());
        argument(format!(
            "a {} patch has {} outer factors ({}) and {} inside factors ({}), not {} and {}",
            domain.name(),
            outer_names.len(),
            outer_names.join(", "),
            inner_names.len(),
            inner_names.join(", "),
            outer.len(),
            inner.len()
        ))
    };
    if outer.len() != domain.outer_factors() {
        return Err(wrong());
    }
    PatchFactors::from_slice(domain, &[outer, inner].concat()).ok_or_else(wrong)
}

/// One factor or several, as floats.
#[derive(FromPyObject)]
pub(crate) enum Floats {
    /// A number.
    One(f64),
    /// A sequence or an array.
    Many(Vec<f64>),
}

impl Floats {
    /// As binary32, rounded to the nearest.
    #[expect(clippy::cast_possible_truncation, reason = "to the nearest binary32, as documented")]
    pub(crate) fn to_f32(&self) -> Vec<f32> {
        match self {
            Self::One(factor) => vec![*factor as f32],
            Self::Many(factors) => factors.iter().map(|factor| *factor as f32).collect(),
        }
    }
}

/// One factor or several, as the bits of binary32 numbers.
#[derive(FromPyObject)]
pub(crate) enum Bits {
    /// A number.
    One(u32),
    /// A sequence or an array.
    Many(Vec<u32>),
}

impl Bits {
    /// The numbers with these bits.
    pub(crate) fn to_f32(&self) -> Vec<f32> {
        match self {
            Self::One(bits) => vec![f32::from_bits(*bits)],
            Self::Many(all) => all.iter().map(|bits| f32::from_bits(*bits)).collect(),
        }
    }
}

/// A case from its line, `case DOMAIN PARTITIONING OUTPUT SPLIT FACTOR...`.
pub(crate) fn case(line: &str) -> PyResult<Case> {
    line.parse().map_err(argument)
}
