//! The one thing that can go wrong: a buffer that is too small.

use core::fmt;

/// Which of a caller's two buffers an error speaks of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Buffer {
    /// The domain points.
    Points,
    /// The indices.
    Indices,
}

/// A buffer of the caller is too small; nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BufferTooSmallError {
    /// The buffer.
    pub buffer: Buffer,
    /// Elements that the output needs.
    pub needed: usize,
    /// Elements that the buffer has.
    pub got: usize,
}

impl fmt::Display for BufferTooSmallError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = match self.buffer {
            Buffer::Points => "point",
            Buffer::Indices => "index",
        };
        write!(
            f,
            "the {what} buffer holds {} elements, but the patch needs {}",
            self.got, self.needed
        )
    }
}

impl core::error::Error for BufferTooSmallError {}
