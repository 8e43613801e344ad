//! Conversion of pointers to values: only this module dereferences a caller's pointers.
//!
//! Null and misaligned pointers are refused. Whether a pointer leads to memory cannot be checked:
//! every function states this requirement under `# Safety`.

use crate::status::{TESS_MISALIGNED, TESS_NULL_POINTER, TESS_OVERLAP, TESS_TOO_LARGE, TessStatus};
use std::mem::MaybeUninit;
use std::ops::Range;

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

/// The addresses of a caller's array.
pub(crate) type Bytes = Range<usize>;

/// The addresses of an array of `len` values; `0..0` if there are none. Refuses arrays that exceed
/// the address space, and null pointers to one value or more.
pub(crate) fn bytes<T>(pointer: *const T, len: usize) -> Result<Bytes, TessStatus> {
    if len == 0 {
        // Apart from every array, which saves each comparison of two arrays a look at both lengths.
        return Ok(0..0);
    }
    if pointer.is_null() {
        return Err(TESS_NULL_POINTER);
    }
    if len > isize::MAX.unsigned_abs() / size_of::<T>() {
        return Err(TESS_TOO_LARGE);
    }
    let end = pointer.addr().checked_add(len * size_of::<T>());
    end.map(|end| pointer.addr()..end).ok_or(TESS_TOO_LARGE)
}

/// Refuses two arrays that share memory.
fn check_apart(a: &Bytes, b: &Bytes) -> Result<(), TessStatus> {
    if a.end <= b.start || b.end <= a.start { Ok(()) } else { Err(TESS_OVERLAP) }
}

/// Refuses arrays if any two of them share memory.
pub(crate) fn check_all_apart(arrays: &[Bytes]) -> Result<(), TessStatus> {
    for (i, a) in arrays.iter().enumerate() {
        for b in arrays.iter().skip(i + 1) {
            check_apart(a, b)?;
        }
    }
    Ok(())
}

/// Copies the value that a pointer points to.
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

/// A caller's input array. If `len` is 0, the pointer is ignored.
///
/// # Safety
/// - If not null and aligned, `pointer` points to `len` values that are initialised, can be read,
///   and are not written while the slice lives.
pub(crate) unsafe fn list<'a, T>(pointer: *const T, len: usize) -> Result<&'a [T], TessStatus> {
    if len == 0 {
        return Ok(&[]);
    }
    check_array(pointer, len)?;
    // SAFETY: not null, aligned and of a possible size, as was just checked; `len` readable
    // values, as the caller promises.
    Ok(unsafe { std::slice::from_raw_parts(pointer, len) })
}

/// A caller's output array, which need not be initialised. If `len` is 0, the pointer is ignored.
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
    check_array(pointer, len)?;
    // SAFETY: not null, aligned and of a possible size, as was just checked; room for `len` values
    // that nothing else uses, as the caller promises. `MaybeUninit<T>` has the layout of `T`.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer.cast(), len) })
}

/// Whether a caller's output arrays are initialised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct MemoryState {
    is_initialised: bool,
}

impl MemoryState {
    /// They may be uninitialised.
    pub(crate) const ANY: Self = Self { is_initialised: false };

    /// They are initialised.
    ///
    /// # Safety
    /// - Every array that is passed to [`initialised`] with this value is initialised.
    pub(crate) const unsafe fn initialised() -> Self {
        Self { is_initialised: true }
    }

    /// Whether they are initialised.
    pub(crate) const fn is_initialised(self) -> bool {
        self.is_initialised
    }
}

/// The array as an initialised one: writes `value` to every element unless `memory` is initialised.
pub(crate) fn initialised<T: Copy>(
    room: &mut [MaybeUninit<T>],
    memory: MemoryState,
    value: T,
) -> &mut [T] {
    if !memory.is_initialised {
        room.fill(MaybeUninit::new(value));
    }
    // SAFETY: every element was just written, or is initialised, as the maker of `memory` promised;
    // `MaybeUninit<T>` has the layout of `T`.
    unsafe { &mut *(std::ptr::from_mut(room) as *mut [T]) }
}

fn check_array<T>(pointer: *const T, len: usize) -> Result<(), TessStatus> {
    check(pointer)?;
    bytes(pointer, len).map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlap_is_found() {
        let words = [0u32; 8];
        let at = |i: usize, len| bytes(&raw const words[i], len).expect("an array");
        assert_eq!(check_apart(&at(0, 4), &at(4, 4)), Ok(()), "next to each other");
        assert_eq!(check_apart(&at(4, 4), &at(0, 4)), Ok(()), "the other way round");
        assert_eq!(check_apart(&at(0, 5), &at(4, 4)), Err(TESS_OVERLAP), "one word shared");
        assert_eq!(check_apart(&at(4, 4), &at(0, 5)), Err(TESS_OVERLAP), "and reversed");
        assert_eq!(check_apart(&at(2, 1), &at(0, 8)), Err(TESS_OVERLAP), "contained");
        assert_eq!(check_apart(&at(2, 0), &at(0, 8)), Ok(()), "empty");
    }

    #[test]
    fn null_is_no_overlap() {
        let null = std::ptr::null::<u32>();
        assert_eq!(bytes(null, 1), Err(TESS_NULL_POINTER), "a value at null");
        assert_eq!(bytes(null, 0), Ok(0..0), "no value");
    }

    #[test]
    fn impossible_sizes_are_refused() {
        let word = 0u32;
        let most = isize::MAX.unsigned_abs() / 4;
        assert!(bytes(&raw const word, most).is_ok(), "half of all addresses");
        for len in [most + 1, usize::MAX / 4, usize::MAX / 4 + 1, usize::MAX] {
            assert_eq!(bytes(&raw const word, len), Err(TESS_TOO_LARGE), "{len} words");
        }
    }
}
