//! A caller's buffer between two guards.

use std::ffi::c_void;

/// Bytes of a guard: more than the 64 elements that a call on one patch may overwrite behind its
/// output.
const GUARD: usize = 2048;

/// A buffer, aligned to 8 bytes, of any number of bytes.
#[derive(Default)]
pub(crate) struct GuardedMemory(Vec<u64>);

/// Bytes of a buffer and its guards.
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Image(Vec<u8>);

impl GuardedMemory {
    /// Makes it this large. What it held is kept, or everything is filled with numbers that differ.
    pub(crate) fn fit(&mut self, bytes: usize, keep: bool) {
        if !keep {
            self.0.clear();
        }
        let filled = |number: usize| (number as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let words = (2 * GUARD + bytes).div_ceil(8);
        let held = self.0.len();
        self.0.extend((held..words).map(filled));
        self.0.truncate(words);
    }

    /// Where the buffer begins.
    pub(crate) fn start(&mut self) -> *mut c_void {
        self.0.as_mut_ptr().wrapping_byte_add(GUARD).cast()
    }

    pub(crate) fn image(&self) -> Image {
        let bytes = self.0.len() * 8;
        Image(unsafe { std::slice::from_raw_parts(self.0.as_ptr().cast(), bytes) }.to_vec())
    }

    /// Changes a bit of a byte.
    pub(crate) fn flip(&mut self, byte: usize) {
        let byte = GUARD + byte;
        self.0[byte / 8] ^= 1 << (byte % 8 * 8);
    }

    /// Writes values to the buffer.
    pub(crate) fn put(&mut self, bytes: &[u8]) {
        let room = self.0.len() * 8 - 2 * GUARD;
        assert!(bytes.len() <= room, "{} bytes into {room}", bytes.len());
        unsafe { self.start().cast::<u8>().copy_from(bytes.as_ptr(), bytes.len()) };
    }
}

impl Image {
    /// Element `number` of the buffer.
    pub(crate) fn element<const N: usize>(&mut self, number: usize) -> &mut [u8; N] {
        let start = GUARD + number * N;
        (&mut self.0[start..start + N]).try_into().expect("as many bytes")
    }

    /// Element `number`, of 2 or 4 bytes, as a number.
    pub(crate) fn value(&self, number: usize, size: usize) -> u32 {
        let bytes = &self.0[GUARD + number * size..];
        match size {
            2 => u16::from_ne_bytes([bytes[0], bytes[1]]).into(),
            _ => u32::from_ne_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
        }
    }

    /// Bytes of the buffer from another image.
    pub(crate) fn take(&mut self, other: &Self, bytes: std::ops::Range<usize>) {
        let range = GUARD + bytes.start..GUARD + bytes.end;
        self.0[range.clone()].copy_from_slice(&other.0[range]);
    }

    /// The first byte of the buffer that differs: negative in the guard before it.
    pub(crate) fn first_difference(&self, other: &Self) -> Option<isize> {
        let at = self.0.iter().zip(&other.0).position(|(one, other)| one != other)?;
        Some(at.cast_signed() - GUARD.cast_signed())
    }
}
