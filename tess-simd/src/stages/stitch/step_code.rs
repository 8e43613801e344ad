//! The codes of stitches: one for each index.
//!
//! Entry `k` of the outer row is `k`, entry `k` of the inner row is `k - 128`. With rows that run
//! up by one, an index is its code plus a constant that its sign chooses.

/// Codes of a whole stitch that are turned into indices at a time; tables are padded to it.
pub(crate) const CODES_AT_ONCE: usize = 32;

/// The number that is added to an entry of the inner row.
const INNER: i8 = i8::MIN;

/// A code that no entry of any row has.
pub(crate) const NOWHERE: i8 = i8::MAX;

/// The code of an entry of the outer row, at most 64.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "at most 64")]
pub(crate) const fn outer(k: u32) -> i8 {
    k as i8
}

/// The code of an entry of the inner row, at most 63.
#[inline(always)]
pub(crate) const fn inner(k: u32) -> i8 {
    outer(k) + INNER
}
