//! The exceptions of `python/tess_model/errors.py`.

use pyo3::PyErr;
use std::fmt::Display;
use tess_verify::check::CheckError;

pyo3::import_exception!(tess_model.errors, ArgumentError);
pyo3::import_exception!(tess_model.errors, NoSuchElementError);
pyo3::import_exception!(tess_model.errors, OutputError);
pyo3::import_exception!(tess_model.errors, FileFormatError);
pyo3::import_exception!(tess_model.errors, TessError);

/// An argument without a meaning.
pub(crate) fn argument(message: impl Display) -> PyErr {
    ArgumentError::new_err(message.to_string())
}

/// An array that cannot be written.
pub(crate) fn output(message: impl Display) -> PyErr {
    OutputError::new_err(message.to_string())
}

/// A malformed file.
pub(crate) fn file_format(message: impl Display) -> PyErr {
    FileFormatError::new_err(message.to_string())
}

/// An element that a patch does not have.
pub(crate) fn no_such_element(message: impl Display) -> PyErr {
    NoSuchElementError::new_err(message.to_string())
}

/// The reason why a check has no verdict.
pub(crate) fn check(error: CheckError) -> PyErr {
    match error {
        CheckError::Vectors(error) | CheckError::Malformed { error, .. } => file_format(error),
        CheckError::NoListings(_) => argument(error),
        error => TessError::new_err(error.to_string()),
    }
}

/// The reason why threads cannot be started.
pub(crate) fn threads(error: tess_simd::ThreadsError) -> PyErr {
    TessError::new_err(error.to_string())
}

/// The reason why a batch was refused.
pub(crate) fn batch(error: tess_simd::Error) -> PyErr {
    match error {
        tess_simd::Error::BufferTooSmall { .. } => output(error),
        error => argument(error),
    }
}
