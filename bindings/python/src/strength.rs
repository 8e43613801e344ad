//! The strength of a comparison with a device, by names.

use crate::errors::argument;
use pyo3::PyResult;
use tess_verify::check::{Conversion, Denormals, Elements, ListOrder, Strength};

/// The orders that `tess check` accepts.
const ORDERS: [(&str, ListOrder); 3] =
    [("exact", ListOrder::Exact), ("sequence", ListOrder::Sequence), ("any", ListOrder::Any)];
const ELEMENTS: [(&str, Elements); 2] =
    [("primitives", Elements::Primitives), ("points", Elements::Points)];
const CONVERSIONS: [(&str, Conversion); 2] =
    [("exact", Conversion::Exact), ("0.6ulp", Conversion::Within06Ulp)];
const DENORMALS: [(&str, Denormals); 2] = [("keep", Denormals::Keep), ("flush", Denormals::Flush)];

/// The strength from the values of the options `--order`, `--points`, `--conversion` and
/// `--denormals` of `tess check`.
pub(crate) fn strength(
    order: &str,
    elements: &str,
    conversion: &str,
    denormals: &str,
) -> PyResult<Strength> {
    Ok(Strength {
        order: one_of("order", order, &ORDERS)?,
        elements: one_of("elements", elements, &ELEMENTS)?,
        conversion: one_of("conversion", conversion, &CONVERSIONS)?,
        denormals: one_of("denormals", denormals, &DENORMALS)?,
    })
}

/// The choice with a name.
pub(crate) fn one_of<T: Copy>(what: &str, name: &str, choices: &[(&str, T)]) -> PyResult<T> {
    let found = choices.iter().find(|(known, _)| *known == name);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let known: Vec<_> = choices.iter().map(|(known, _)| *known).collect();
        argument(format!("unknown {what} {name:?}, expected one of: {}", known.join(", ")))
    })
}
