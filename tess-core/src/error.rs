//! The only error of this crate: a buffer that is too small.

use core::fmt;

/// One of the caller's two buffers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Buffer {
    /// The domain points.
    Points,
    /// The indices.
    Indices,
}

/// The caller's buffer is too small; nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BufferTooSmallError {
    /// The buffer that is too small.
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
