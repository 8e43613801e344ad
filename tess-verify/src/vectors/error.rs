//! The fault of a vector file, and its place.

use std::sync::Arc;

/// A vector file is malformed, truncated, too long or empty.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}: {field}: {message}")]
#[non_exhaustive]
pub struct VectorError {
    /// Name of the file.
    pub file: String,
    /// Line, from 1.
    pub line: u64,
    /// The field, such as a column name.
    pub field: &'static str,
    /// The fault and what would be right.
    pub message: String,
}

/// Where the reader is.
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
