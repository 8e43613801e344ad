//! numpy arrays as the libraries' slices.

use crate::errors::{argument, output};
use numpy::PyArray;
use numpy::ndarray::Dimension;
use numpy::{
    Element, PyArray1, PyArray2, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadwriteArray,
    PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use std::ops::Range;
use tess_core::{Domain, DomainPoint};
use tess_simd::PatchRange;
use tess_verify::Named;

/// A copy of the factors of a batch, so that other threads may write to the array meanwhile. It has
/// the shape (patches, factors of the domain), and is of floats that are exactly binary32 numbers,
/// or of uint32 (bit patterns). Errors: any other array; other integers could be either.
pub(crate) fn factors(domain: Domain, array: &Bound<'_, PyAny>) -> PyResult<Vec<f32>> {
    let factors = domain.factors();
    let wrong = |found: String| {
        argument(format!(
            "factors must be an array of shape (patches, {factors}) for the domain {}, of floats or of uint32 (bit \
             patterns), not {found}",
            domain.name()
        ))
    };
    refuse_masked("factors", array)?;
    let made = numpy::get_array_module(array.py())?.call_method1("asarray", (array,));
    let made = made.map_err(|_| wrong("a sequence of other shapes".to_owned()))?;
    let Ok(untyped) = made.cast::<PyUntypedArray>() else {
        return Err(wrong(format!("an object of type {}", array.get_type().name()?)));
    };
    if untyped.ndim() != 2 || untyped.shape()[1] != factors {
        return Err(wrong(described(untyped)));
    }
    let made = aligned(made)?;
    let borrowed = |error| argument(format!("factors: {error}"));
    if let Ok(array) = made.cast::<PyArray2<f32>>() {
        let array = array.try_readonly().map_err(borrowed)?;
        copied(array.as_array().iter().copied())
    } else if let Ok(array) = made.cast::<PyArray2<u32>>() {
        let array = array.try_readonly().map_err(borrowed)?;
        copied(array.as_array().iter().copied().map(f32::from_bits))
    } else if let Ok(array) = made.cast::<PyArray2<f64>>() {
        let array = array.try_readonly().map_err(borrowed)?;
        let inexact = |factor: &&f64| narrowed(**factor).is_none();
        if let Some(factor) = array.as_array().iter().find(inexact) {
            return Err(argument(format!(
                "factors: {factor} is no binary32 number; round it first"
            )));
        }
        copied(array.as_array().iter().map(|factor| narrowed(*factor).unwrap_or(f32::NAN)))
    } else {
        Err(wrong(described(made.cast()?)))
    }
}

/// The array, or a copy if its elements are not aligned, as those that `numpy.frombuffer` takes
/// from the middle of a buffer. References to such elements would be undefined.
fn aligned(array: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    match array.getattr("flags")?.getattr("aligned")?.is_truthy()? {
        true => Ok(array),
        false => array.call_method0("copy"),
    }
}

/// The number as a binary32 number, if it is exactly one; a NaN may lose its payload.
#[expect(clippy::cast_possible_truncation, reason = "what is lost is looked for")]
fn narrowed(factor: f64) -> Option<f32> {
    let narrow = factor as f32;
    (factor.is_nan() || f64::from(narrow).to_bits() == factor.to_bits()).then_some(narrow)
}

/// Integers as uint32, from an array of any integer type or a value that numpy converts to one.
/// Errors: anything other than integers, or an integer outside 0..2**32 - 1.
pub(crate) fn exact_words<'py>(
    what: &str,
    integers: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<u32>>> {
    let py = integers.py();
    refuse_masked(what, integers)?;
    let array = aligned(numpy::get_array_module(py)?.call_method1("asarray", (integers,))?)?;
    if let Ok(words) = array.cast::<PyArrayDyn<u32>>() {
        return Ok(words.clone());
    }
    let untyped = array.cast::<PyUntypedArray>()?;
    let wrong = || argument(format!("{what} must be uint32, not {}", described(untyped)));
    let is_integer = matches!(untyped.dtype().kind(), b'i' | b'u');
    if !is_integer && !untyped.is_empty() {
        return Err(wrong());
    }
    let words = array.call_method1("astype", (u32::get_dtype(py),))?;
    let is_equal = array.call_method1("__eq__", (&words,))?.call_method0("all")?;
    if !is_equal.is_truthy()? {
        return Err(argument(format!("{what}: an element is negative or above 2**32 - 1")));
    }
    Ok(words.cast_into()?)
}

/// The elements in a new vector. Errors: `MemoryError`, because a broadcast array can have more
/// elements than memory can hold.
pub(crate) fn copied<T>(elements: impl ExactSizeIterator<Item = T>) -> PyResult<Vec<T>> {
    let mut copy = Vec::new();
    copy.try_reserve_exact(elements.len()).map_err(|_| {
        PyMemoryError::new_err(format!("no memory for a copy of {} elements", elements.len()))
    })?;
    copy.extend(elements);
    Ok(copy)
}

/// An array of zeros. Errors: `MemoryError`.
pub(crate) fn zeros<'py, T: Element, D: Dimension>(
    py: Python<'py>,
    shape: impl IntoPyObject<'py>,
) -> PyResult<Bound<'py, PyArray<T, D>>> {
    let made = numpy::get_array_module(py)?.call_method1("zeros", (shape, T::get_dtype(py)))?;
    Ok(made.cast_into()?)
}

/// Refuses numpy's masked arrays, whose mask would be lost. Errors: the array is masked.
pub(crate) fn refuse_masked(what: &str, array: &Bound<'_, PyAny>) -> PyResult<()> {
    if array.hasattr("mask")? && array.hasattr("filled")? {
        return Err(argument(format!(
            "{what}: the mask of a masked array would be lost; fill it first"
        )));
    }
    Ok(())
}

/// Type and shape in words.
pub(crate) fn described(array: &Bound<'_, PyUntypedArray>) -> String {
    format!("{} of shape {:?}", array.dtype(), array.shape())
}

/// An array of `out` as one slice to write. It is C-contiguous (see [`addresses`]). Errors: it is
/// read-only, misaligned, or borrowed by another call.
pub(crate) fn writable<'py, T: Element, D: Dimension>(
    what: &str,
    array: &Bound<'py, PyArray<T, D>>,
) -> PyResult<PyReadwriteArray<'py, T, D>> {
    if !array.data().is_aligned() {
        return Err(output(format!("{what}: the array is not aligned to its elements")));
    }
    array.try_readwrite().map_err(|error| match error {
        numpy::BorrowError::NotWriteable => output(format!("{what}: the array is read-only")),
        error => output(format!("{what}: another array or call uses the same memory ({error})")),
    })
}

/// The addresses that an array of `out` covers. Errors: it is not C-contiguous, so its elements may
/// have gaps between them or precede the first one.
pub(crate) fn addresses<T: Element, D: Dimension>(
    what: &str,
    array: &Bound<'_, PyArray<T, D>>,
) -> PyResult<Range<usize>> {
    if !array.is_c_contiguous() {
        return Err(output(format!("{what}: the array is not C-contiguous")));
    }
    let start = array.data() as usize;
    Ok(start..start + array.len() * size_of::<T>())
}

/// Whether two address ranges have a byte in common.
pub(crate) fn overlap(one: &Range<usize>, other: &Range<usize>) -> bool {
    one.start.max(other.start) < one.end.min(other.end)
}

/// A new array with a row for each point.
pub(crate) fn fixed_array<'py>(py: Python<'py>, points: &[DomainPoint]) -> Array2<'py, u32> {
    rows_of(py, points, |point| [point.u.to_bits(), point.v.to_bits()])
}

/// A new array with a row of values for each point.
///
/// # Panics
/// Never: each row has two elements.
pub(crate) fn rows_of<'py, T: Element>(
    py: Python<'py>,
    points: &[DomainPoint],
    row: impl Fn(&DomainPoint) -> [T; 2],
) -> Array2<'py, T> {
    let flat: Vec<T> = points.iter().flat_map(row).collect();
    PyArray1::from_vec(py, flat).reshape([points.len(), 2]).expect("two elements a row")
}

/// Pairs of coordinates as points.
pub(crate) fn fixed_points(words: &mut [u32]) -> &mut [DomainPoint] {
    const {
        assert!(size_of::<DomainPoint>() == 8 && align_of::<DomainPoint>() == 4, "two words");
    }
    let (pairs, _) = words.as_chunks_mut::<2>();
    #[expect(unsafe_code, reason = "a reinterpretation that safe Rust has no words for")]
    // SAFETY: `DomainPoint` is `repr(C)` of two `U16F16`, each of which is a transparent `u32`, so
    // it has the size, the alignment and the valid bit patterns of `[u32; 2]`; the slice is
    // borrowed exclusively for as long as the result.
    unsafe {
        std::slice::from_raw_parts_mut(pairs.as_mut_ptr().cast(), pairs.len())
    }
}

/// Groups of four words as ranges.
pub(crate) fn ranges(words: &mut [u32]) -> &mut [PatchRange] {
    const {
        assert!(size_of::<PatchRange>() == 16 && align_of::<PatchRange>() == 4, "four words");
    }
    let (groups, _) = words.as_chunks_mut::<4>();
    #[expect(unsafe_code, reason = "a reinterpretation that safe Rust has no words for")]
    // SAFETY: `PatchRange` is `repr(C)` of four `u32`, so it has the size, the alignment and the
    // valid bit patterns of `[u32; 4]`; the slice is borrowed exclusively for as long as the
    // result.
    unsafe {
        std::slice::from_raw_parts_mut(groups.as_mut_ptr().cast(), groups.len())
    }
}

/// Arrays of two types of elements.
pub(crate) type Array1<'py, T> = Bound<'py, PyArray1<T>>;
/// Arrays of rows.
pub(crate) type Array2<'py, T> = Bound<'py, PyArray2<T>>;
