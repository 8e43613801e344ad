//! What can go wrong. Whatever it is, nothing was written.

use crate::level::Level;
use core::fmt;

/// The caller's buffers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Buffer {
    /// The domain points.
    Points,
    /// The indices.
    Indices,
    /// The ranges, one for each patch.
    Ranges,
}

/// Why a batch was not tessellated; nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A buffer is too small. Make it as large as `needed`.
    BufferTooSmall {
        /// The buffer.
        buffer: Buffer,
        /// Elements that the output needs.
        needed: usize,
        /// Elements that the buffer has.
        got: usize,
    },
    /// The largest index does not fit the index format. Use wider indices, number each patch on
    /// its own, or make the batch smaller.
    IndexTooLarge {
        /// The largest index needed.
        largest: u64,
        /// The largest index of the format.
        format: u64,
    },
    /// The batch has more than 2^32 - 1 points or indices. Make it smaller.
    BatchTooLarge {
        /// Its points.
        points: u64,
        /// Its indices.
        indices: u64,
    },
    /// The columns of the batch have different lengths.
    UnevenColumns,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BufferTooSmall { buffer, needed, got } => {
                let what = match buffer {
                    Buffer::Points => "point",
                    Buffer::Indices => "index",
                    Buffer::Ranges => "range",
                };
                write!(f, "the {what} buffer holds {got} elements, but the batch needs {needed}")
            }
            Self::IndexTooLarge { largest, format } => {
                write!(f, "the batch needs the index {largest}, but indices end at {format}")
            }
            Self::BatchTooLarge { points, indices } => {
                write!(f, "a batch of {points} points and {indices} indices is too large")
            }
            Self::UnevenColumns => write!(f, "the columns of factors have different lengths"),
        }
    }
}

impl core::error::Error for Error {}

/// This machine, or this build, cannot run a CPU level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelUnavailable(pub Level);

impl fmt::Display for LevelUnavailable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "this machine cannot run the CPU level {}", self.0)
    }
}

impl core::error::Error for LevelUnavailable {}
