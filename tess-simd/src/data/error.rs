//! The reasons to refuse a batch.

use core::fmt;
use tess_core::Domain;

/// One of the caller's buffers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BatchBuffer {
    /// The domain points.
    Points,
    /// The indices.
    Indices,
    /// The ranges, one for each patch.
    Ranges,
}

/// The reason why a batch was refused. Buffers and outputs keep their contents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A buffer is too small. Make it as large as `needed`.
    BufferTooSmall {
        /// The buffer.
        buffer: BatchBuffer,
        /// Elements that the output needs.
        needed: usize,
        /// Elements that the buffer has.
        got: usize,
    },
    /// The largest index does not fit the index format. Use wider indices, number each patch
    /// separately, or make the batch smaller.
    IndexTooLarge {
        /// The largest index needed.
        largest: u64,
        /// The largest index of the format.
        limit: u64,
    },
    /// The batch has more than 2^32 - 1 points or indices. Split it.
    BatchTooLarge {
        /// Its points.
        points: u64,
        /// Its indices.
        indices: u64,
    },
    /// The columns of the batch have different lengths. Give each column one factor per patch.
    UnevenColumns {
        /// The shortest length, and another one.
        lengths: [usize; 2],
    },
    /// The patches of the batch have different domains. Make a batch of each domain.
    MixedDomains {
        /// Number of the first patch whose domain is not the batch's.
        patch: usize,
        /// Its domain.
        found: Domain,
        /// The batch's domain: the one that it was made with, or the first patch's.
        expected: Domain,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BufferTooSmall { buffer, needed, got } => {
                let what = match buffer {
                    BatchBuffer::Points => "point",
                    BatchBuffer::Indices => "index",
                    BatchBuffer::Ranges => "range",
                };
                write!(f, "the {what} buffer holds {got} elements, but {needed} are needed")
            }
            Self::IndexTooLarge { largest, limit } => {
                write!(f, "the batch needs the index {largest}, but indices end at {limit}")
            }
            Self::BatchTooLarge { points, indices } => {
                write!(
                    f,
                    "the batch has {points} points and {indices} indices; at most 4294967295 of \
                     each can be written at a time"
                )
            }
            Self::UnevenColumns { lengths: [one, other] } => {
                write!(f, "a column has {one} factors and another {other}; all need one length")
            }
            Self::MixedDomains { patch, found, expected } => write!(
                f,
                "patch {patch} has the domain {found:?}, its batch {expected:?}; a batch has one domain"
            ),
        }
    }
}

impl core::error::Error for Error {}
