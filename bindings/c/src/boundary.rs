//! Where pointers become values: the only place that looks through a caller's pointer.
//!
//! Null and misaligned pointers are refused. What cannot be checked is the caller's part and
//! stands under `# Safety` of every function: that the memory behind a pointer is there.

use crate::status::{TESS_MISALIGNED, TESS_NULL_POINTER, TESS_OVERLAP, TessStatus};
use std::mem::MaybeUninit;

/// Refuses null and misaligned pointers.
pub(crate) fn check<T>(pointer: *const T) -> Result<(), TessStatus> {
    if pointer.is_null() {
        Err(TESS_NULL_POINTER)
    } else if !pointer.is_aligned() {
        Err(TESS_MISALIGNED)
    } else {
        Ok(())
    }
}

/// Refuses two output buffers of `a_len` and `b_len` elements that share memory.
pub(crate) fn check_apart<A, B>(
    (a, a_len): (*const A, usize),
    (b, b_len): (*const B, usize),
) -> Result<(), TessStatus> {
    let bytes = |start: usize, len: usize, size: usize| {
        start..start.saturating_add(len.saturating_mul(size))
    };
    let a = bytes(a.addr(), a_len, size_of::<A>());
    let b = bytes(b.addr(), b_len, size_of::<B>());
    let apart = a.is_empty() || b.is_empty() || a.end <= b.start || b.end <= a.start;
    if apart { Ok(()) } else { Err(TESS_OVERLAP) }
}

/// Copies what a pointer points to.
///
/// # Safety
/// - If not null and aligned, `pointer` points to a `T` that is initialised and can be read.
pub(crate) unsafe fn read<T: Copy>(pointer: *const T) -> Result<T, TessStatus> {
    check(pointer)?;
    // SAFETY: not null and aligned, as was just checked; readable, as the caller promises.
    Ok(unsafe { pointer.read() })
}

/// Writes through a pointer.
///
/// # Safety
/// - If not null and aligned, `pointer` points to memory for a `T` that can be written.
pub(crate) unsafe fn write<T: Copy>(pointer: *mut T, value: T) -> Result<(), TessStatus> {
    check(pointer)?;
    // SAFETY: not null and aligned, as was just checked; writable, as the caller promises.
    unsafe { pointer.write(value) };
    Ok(())
}

/// A caller's input array. With `len` 0 the pointer is not looked at.
///
/// # Safety
/// - If not null and aligned, `pointer` points to `len` values that are initialised, can be read,
///   and are not written while the slice lives.
pub(crate) unsafe fn list<'a, T>(pointer: *const T, len: usize) -> Result<&'a [T], TessStatus> {
    if len == 0 {
        return Ok(&[]);
    }
    check(pointer)?;
    // SAFETY: not null and aligned, as was just checked; `len` readable values, as the caller
    // promises, which also bounds their size by that of the address space.
    Ok(unsafe { std::slice::from_raw_parts(pointer, len) })
}

/// A caller's output array, which need not be initialised. With `len` 0 the pointer is not
/// looked at.
///
/// # Safety
/// - If not null and aligned, `pointer` points to memory for `len` values that can be written and
///   that nothing else reads or writes while the slice lives.
pub(crate) unsafe fn room<'a, T>(
    pointer: *mut T,
    len: usize,
) -> Result<&'a mut [MaybeUninit<T>], TessStatus> {
    if len == 0 {
        return Ok(&mut []);
    }
    check(pointer)?;
    // SAFETY: not null and aligned, as was just checked; room for `len` values that is ours alone,
    // as the caller promises. `MaybeUninit<T>` has the layout of `T` and is always initialised.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer.cast(), len) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlap_is_found() {
        let words = [0u32; 8];
        let at = |i: usize| &raw const words[i];
        assert_eq!(check_apart((at(0), 4), (at(4), 4)), Ok(()), "next to each other");
        assert_eq!(check_apart((at(4), 4), (at(0), 4)), Ok(()), "the other way round");
        assert_eq!(check_apart((at(0), 5), (at(4), 4)), Err(TESS_OVERLAP), "one word shared");
        assert_eq!(check_apart((at(4), 4), (at(0), 5)), Err(TESS_OVERLAP), "and reversed");
        assert_eq!(check_apart((at(2), 1), (at(0), 8)), Err(TESS_OVERLAP), "contained");
        assert_eq!(check_apart((at(2), 0), (at(0), 8)), Ok(()), "empty");
        assert_eq!(check_apart((at(2), usize::MAX), (at(7), 1)), Err(TESS_OVERLAP), "hostile");
    }
}
