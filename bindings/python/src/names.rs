//! Names and factors of a patch, as arguments.

use crate::arrays::refuse_masked;
use crate::errors::argument;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyBytes};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};
use tess_verify::{Case, Named};

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

/// One factor or several, rounded to the nearest binary32. Errors: anything other than a number, a
/// sequence of numbers or an array.
#[expect(clippy::cast_possible_truncation, reason = "to the nearest binary32, as documented")]
pub(crate) fn floats(factors: &Bound<'_, PyAny>) -> PyResult<Vec<f32>> {
    let all: Vec<f64> = one_or_many(factors, "numbers")?;
    Ok(all.into_iter().map(|factor| factor as f32).collect())
}

/// One factor or several, from the bits of binary32 numbers. Errors: anything other than an integer
/// below 2^32, a sequence of such integers or an array.
pub(crate) fn bits(factors: &Bound<'_, PyAny>) -> PyResult<Vec<f32>> {
    let all: Vec<u32> = one_or_many(factors, "integers from 0 to 2**32 - 1")?;
    Ok(all.into_iter().map(f32::from_bits).collect())
}

fn one_or_many<T>(factors: &Bound<'_, PyAny>, what: &str) -> PyResult<Vec<T>>
where
    T: for<'a> FromPyObjectOwned<'a>,
{
    refuse_masked("factors", factors)?;
    let is_text = factors.is_instance_of::<PyBytes>() || factors.is_instance_of::<PyByteArray>();
    let found = if is_text {
        None
    } else {
        factors.extract().map(|one| vec![one]).or_else(|_| factors.extract()).ok()
    };
    found.ok_or_else(|| argument(format!("factors are {what}, not {}", shown(factors))))
}

/// A value in a message: as Python shows it, if that is short.
fn shown(value: &Bound<'_, PyAny>) -> String {
    let repr = value.repr().map(|repr| repr.to_string()).unwrap_or_default();
    match repr.chars().count() {
        1..=80 => repr,
        _ => format!("an object of type {}", value.get_type()),
    }
}

/// An argument as a whole number in the range of `T`. Errors: any other value.
pub(crate) fn whole<T>(value: &Bound<'_, PyAny>) -> PyResult<T>
where
    T: for<'a> FromPyObjectOwned<'a>,
{
    value.extract::<T>().map_err(|_| {
        let most = 8 * size_of::<T>();
        argument(format!("expected an integer from 0 to 2**{most} - 1, not {}", shown(value)))
    })
}

/// An argument like that of [`whole`], or `None`. Errors: those of [`whole`].
pub(crate) fn whole_or_none<T>(value: &Bound<'_, PyAny>) -> PyResult<Option<T>>
where
    T: for<'a> FromPyObjectOwned<'a>,
{
    if value.is_none() { Ok(None) } else { whole(value).map(Some) }
}

/// A case from its line, `case DOMAIN PARTITIONING OUTPUT SPLIT FACTOR...`.
pub(crate) fn case(line: &str) -> PyResult<Case> {
    line.parse().map_err(argument)
}
