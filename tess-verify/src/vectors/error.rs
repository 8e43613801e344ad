//! The error of a vector file, with its place.

use std::sync::Arc;

/// A vector file is malformed, truncated, too long or empty.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}: {field}: {message}")]
#[non_exhaustive]
pub struct VectorError {
    /// The name of the file.
    pub file: String,
    /// The line, from 1.
    pub line: u64,
    /// The field, such as a column name.
    pub field: &'static str,
    /// The fault, and what is expected.
    pub message: String,
}

/// The place of the reader.
#[derive(Clone, Debug)]
pub(crate) struct LinePlace {
    pub(crate) file: Arc<str>,
    pub(crate) line: u64,
}

impl LinePlace {
    pub(crate) fn error(&self, field: &'static str, message: impl Into<String>) -> VectorError {
        VectorError { file: self.file.to_string(), line: self.line, field, message: message.into() }
    }
}
