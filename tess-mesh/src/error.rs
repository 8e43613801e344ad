//! The reasons to refuse a file.

use thiserror::Error;

/// A file or an option that is refused. The message names the file, the place in it, and the fault.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct LoadError {
    kind: LoadErrorKind,
    message: String,
}

/// The kind of a [`LoadError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LoadErrorKind {
    /// The file cannot be read, or is not an ordinary file.
    File,
    /// The kind of the file is not known.
    Format,
    /// The contents break a rule of their format, or cannot be made into a surface.
    Content,
    /// The contents need more memory than
    /// [`LoadOptions::max_memory`](crate::LoadOptions::max_memory).
    Limit,
    /// An option does not apply to this kind of file.
    Option,
}

impl LoadError {
    pub(crate) fn new(kind: LoadErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }

    /// The kind of the fault.
    #[must_use]
    pub const fn kind(&self) -> LoadErrorKind {
        self.kind
    }
}
